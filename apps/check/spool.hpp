#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace lobe::app {

/// Results wait in a file without a name until all are there.
class Spool {
public:
    Spool() : file_(std::tmpfile()) {
        if (file_ == nullptr) fail();
    }
    ~Spool() { std::fclose(file_); }
    Spool(const Spool&) = delete;
    Spool& operator=(const Spool&) = delete;

    void write(const std::string& text) {
        if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
    }

    void copyTo(std::FILE* target, const std::string& name) {
        std::rewind(file_);
        std::vector<char> block(1 << 16);
        while (const size_t size = std::fread(block.data(), 1, block.size(), file_))
            if (std::fwrite(block.data(), 1, size, target) != size) failTarget(name);
        if (std::ferror(file_) != 0) fail();
        if (std::fflush(target) != 0) failTarget(name);
    }

    [[noreturn]] static void failTarget(const std::string& name) {
        throw OutputError(name + ": can't be written: " + std::strerror(errno));
    }

private:
    [[noreturn]] static void fail() {
        throw OutputError(std::string("temporary file: can't be written: ") + std::strerror(errno));
    }
    std::FILE* file_;
};

}  // namespace lobe::app
