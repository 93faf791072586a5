#include "file_watch.hpp"

#include <functional>
#include <string>
#include <utility>

namespace lobe::view {

namespace fs = std::filesystem;

FileWatch::FileWatch(fs::path folder, std::vector<fs::path> files)
    : folder_(std::move(folder)), files_(std::move(files)), known_(fingerprint()) {}

void FileWatch::setFiles(std::vector<fs::path> files) {
    if (files == files_) return;
    files_ = std::move(files);
    known_ = fingerprint();
}

bool FileWatch::changed() {
    const size_t now = fingerprint();
    return std::exchange(known_, now) != now;
}

size_t FileWatch::fingerprint() const {
    size_t sum = 0;  // of the files, in whatever order a folder gives them
    const auto add = [&](const fs::path& file) {
        std::error_code failed;
        const auto time = fs::last_write_time(file, failed);
        if (failed) return;
        const std::string identity = file.string() + "\n" + std::to_string(time.time_since_epoch().count());
        sum += std::hash<std::string>()(identity);
    };
    std::error_code failed;
    fs::recursive_directory_iterator entry(folder_, fs::directory_options::skip_permission_denied, failed);
    for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed))
        if (entry->path().has_extension()) add(entry->path());
    for (const fs::path& file : files_)
        add(file);
    return sum;
}

}  // namespace lobe::view
