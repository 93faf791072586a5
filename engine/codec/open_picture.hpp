/// A picture file in memory (PNG, JPEG, HDR, EXR), opened by OpenImageIO and found to be of a bearable size.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

#include "codec/format.hpp"

namespace lobe::codec {

class OpenPicture {
public:
    /// Throws InputError when the file is damaged, of a kind that is not read, or over the limits of
    /// codec.hpp.
    explicit OpenPicture(Bytes file);

    const OIIO::ImageSpec& spec() const { return input_->spec(); }

    /// The first `channels` channels of the first part, interleaved; throws InputError unless all could be
    /// read.
    void read(OIIO::TypeDesc type, int channels, void* pixels);

private:
    std::string reduced_;  ///< the file without what pixels do not need, where that is worth it
    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory_;
    std::unique_ptr<OIIO::ImageInput> input_;
};

}  // namespace lobe::codec
