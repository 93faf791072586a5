/// What `lobe-check PATH...` was asked for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gl/context.hpp"

namespace lobe::app {

struct CheckOptions {
    std::vector<std::string> paths;
    gl::ContextRequest context;
    std::string filter;  ///< a regular expression, empty: all
    std::vector<std::string> tags;
    std::vector<std::filesystem::path> folders;  ///< -I
    std::optional<uint64_t> seed;
    std::optional<int64_t> rows;
    int64_t repeat = 1;
    double timeLimit = 60.0;  ///< s, a test
    bool list = false, listTags = false, watch = false, quiet = false, noColor = false;
    std::string junit, json, tap;  ///< files, "-": standard output, empty: none
};

/// Throws UsageError. Nothing after --help was printed.
std::optional<CheckOptions> parseCheckOptions(const std::vector<std::string>& arguments);

}  // namespace lobe::app
