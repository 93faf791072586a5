#include "watch.hpp"

namespace lobe::app {

FileTimes::FileTimes(const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) {
        std::error_code failed;
        const auto time = std::filesystem::last_write_time(file, failed);
        if (!failed) times_[file] = time;
    }
}

}  // namespace lobe::app
