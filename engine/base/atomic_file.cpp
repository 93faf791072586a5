#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "base/error.hpp"

namespace lobe {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& target, int reason) {
    throw OutputError(target.string() + ": can't be written: " + std::strerror(reason));
}

/// Hidden, and unique among processes and threads: ".picture.1234-5.png" for "picture.png".
fs::path temporaryName(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    constexpr size_t kLongestStem = 128;  // of the 255 bytes that a name may have
    const std::string stem = target.stem().string().substr(0, kLongestStem);
    return target.parent_path() / ("." + stem + "." + std::to_string(getpid()) + "-" +
                                   std::to_string(counter++) + target.extension().string());
}

/// Waits until the file is on disk: only now does a full disk show on some file systems.
void flush(const fs::path& path, const fs::path& target) {
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail(target, errno);
    const int failed = fsync(descriptor) == 0 ? 0 : errno;
    close(descriptor);
    if (failed != 0) fail(target, failed);
}

/// Removes the file unless told that all went well.
class Temporary {
public:
    explicit Temporary(fs::path path) : path_(std::move(path)) {}
    ~Temporary() {
        if (!path_.empty()) unlink(path_.c_str());
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    const fs::path& path() const { return path_; }
    void renamedAway() { path_.clear(); }

private:
    fs::path path_;
};

void makeFolder(const fs::path& folder, const fs::path& target) {
    if (folder.empty()) return;
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) fail(target, failed.value());
}

void writeAll(const fs::path& path, std::string_view text, const fs::path& target) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0) fail(target, errno);
    int failed = 0;
    while (!text.empty() && failed == 0) {
        const ssize_t written = write(descriptor, text.data(), text.size());
        if (written >= 0)
            text.remove_prefix(static_cast<size_t>(written));
        else if (errno != EINTR)
            failed = errno;
    }
    if (close(descriptor) != 0 && failed == 0) failed = errno;
    if (failed != 0) fail(target, failed);
}

}  // namespace

void writeAtomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
    if (target.filename().empty())
        throw OutputError("'" + target.string() + "': can't be written: no file name");
    std::error_code ignored;
    const fs::file_status status = fs::status(target, ignored);
    if (fs::is_directory(status)) fail(target, EISDIR);
    // A device or pipe (/dev/null, /dev/stdout) is written to, never replaced.
    if (fs::exists(status) && !fs::is_regular_file(status)) return write(target);

    // A link stays, and what it leads to is replaced.
    const bool isLink = fs::is_symlink(fs::symlink_status(target, ignored));
    const fs::path file = isLink ? fs::weakly_canonical(target, ignored) : target;
    if (file.empty()) fail(target, ELOOP);
    makeFolder(file.parent_path(), target);
    Temporary temporary(temporaryName(file));
    write(temporary.path());
    flush(temporary.path(), target);
    if (rename(temporary.path().c_str(), file.c_str()) != 0) fail(target, errno);
    temporary.renamedAway();
}

void writeAtomically(const fs::path& target, std::string_view text) {
    writeAtomically(target, [&](const fs::path& path) { writeAll(path, text, target); });
}

}  // namespace lobe
