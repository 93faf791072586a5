/// Tells when one of the files below a folder, or one of a few others, has been changed.
#pragma once

#include <filesystem>
#include <vector>

namespace lobe::view {

class FileWatch {
public:
    /// What is there now is not a change.
    FileWatch(std::filesystem::path folder, std::vector<std::filesystem::path> files = {});

    void setFiles(std::vector<std::filesystem::path> files);
    /// Whether anything was written, added or removed since the last call.
    bool changed();

private:
    size_t fingerprint() const;
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_;
    size_t known_;
};

}  // namespace lobe::view
