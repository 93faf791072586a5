#include "standard_input.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>

#include "base/error.hpp"

namespace lobe::app {
namespace fs = std::filesystem;
namespace {

class Spool {
public:
    Spool() {
        std::string name = (fs::temp_directory_path() / "lobe-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw InputError("standard input: can't be kept in " + name + ": " + std::strerror(errno));
        folder_ = name;
        try {
            file_ = folder_ / (copy(folder_ / "stdin") ? "stdin.glb" : "stdin.gltf");
            fs::rename(folder_ / "stdin", file_);
        } catch (...) {
            remove();
            throw;
        }
    }
    ~Spool() { remove(); }
    Spool(const Spool&) = delete;
    Spool& operator=(const Spool&) = delete;

    const fs::path& file() const { return file_; }

private:
    /// Whether what was copied starts as GLB does.
    static bool copy(const fs::path& target) {
        std::ofstream out(target, std::ios::binary);
        std::array<char, 1 << 16> block{};
        size_t total = 0;
        bool binary = false;
        for (size_t got = 0; (got = std::fread(block.data(), 1, block.size(), stdin)) > 0; total += got) {
            if (total == 0) binary = got >= 4 && std::memcmp(block.data(), "glTF", 4) == 0;
            out.write(block.data(), static_cast<std::streamsize>(got));
        }
        if (std::ferror(stdin) != 0) throw InputError("standard input: can't be read");
        if (total == 0) throw InputError("standard input: empty; expected a glTF 2.0 scene, as JSON or GLB");
        if (!out.flush())
            throw InputError("standard input: can't be kept in " + target.string() + ": " +
                             std::strerror(errno));
        return binary;
    }

    void remove() const {
        std::error_code failed;
        fs::remove_all(folder_, failed);
    }

    fs::path folder_, file_;
};

}  // namespace

fs::path standardInputScene() {
    static const Spool spool;
    return spool.file();
}

}  // namespace lobe::app
