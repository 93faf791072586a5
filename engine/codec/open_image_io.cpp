#include "codec/open_image_io.hpp"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <mutex>
#include <thread>

namespace lobe::codec {

void setUpOpenImageIo() {
    static std::once_flag once;
    std::call_once(once, [] {
        // Only EXR's compression gains from threads; each takes address space, which the worker has little
        // of.
        constexpr unsigned kMostThreads = 4;
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads",
                        static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, kMostThreads)));
    });
}

}  // namespace lobe::codec
