#include "selection.hpp"

#include <algorithm>
#include <regex>
#include <set>

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using harness::TestCase;
using harness::TestFile;
using harness::UnitResult;

constexpr const char* kSuffix = "_test.glsl";

std::vector<fs::path> testFilesIn(const std::string& path) {
    std::error_code failed;
    if (!fs::exists(path, failed)) throw InputError(path + ": no such file or folder");
    if (!fs::is_directory(path, failed)) return {path};
    // Whatever has such a name was meant to run: links to nowhere are reported, not passed over.
    std::error_code ignored;
    std::vector<fs::path> files;
    for (fs::recursive_directory_iterator it(path, failed), end; !failed && it != end; it.increment(failed))
        if (it->path().filename().string().ends_with(kSuffix) && !it->is_directory(ignored))
            files.push_back(it->path());
    if (failed) throw InputError(path + ": can't be read: " + failed.message());
    std::sort(files.begin(), files.end());
    return files;
}

std::regex filterOf(const CheckOptions& options) {
    try {
        return std::regex(options.filter);
    } catch (const std::regex_error& error) {
        throw UsageError("--filter '" + options.filter + "': " + error.what() +
                         "; expected a regular expression");
    }
}

bool hasTag(const TestCase& test, const std::vector<std::string>& tags) {
    return tags.empty() || std::any_of(tags.begin(), tags.end(), [&](const std::string& tag) {
               return std::find(test.tags.begin(), test.tags.end(), tag) != test.tags.end();
           });
}

UnitResult unreadable(const fs::path& path, const Error& error) {
    UnitResult result;
    result.file = path.lexically_normal().generic_string();
    result.name = "(file)";
    result.status = UnitResult::Status::error;
    result.code = error.exitCode();
    result.message = error.what();
    return result;
}

std::string hintFor(const CheckOptions& options, const std::set<std::string>& tags) {
    const std::vector<std::string> known(tags.begin(), tags.end());
    return options.tags.size() == 1 ? didYouMean(options.tags[0], known) : "";
}

}  // namespace

size_t Selection::chosen() const {
    size_t count = 0;
    for (const TestFile& file : files)
        count += file.tests.size();
    return count;
}

Selection select(const CheckOptions& options) {
    Selection selection;
    const std::regex filter = filterOf(options);
    std::set<std::string> tags;
    std::set<fs::path> taken;
    for (const std::string& argument : options.paths)
        for (const fs::path& path : testFilesIn(argument)) {
            if (!taken.insert(fs::weakly_canonical(path)).second) continue;
            try {
                TestFile file = harness::readTestFile(path);
                selection.found += file.tests.size();
                for (const TestCase& test : file.tests)
                    tags.insert(test.tags.begin(), test.tags.end());
                std::erase_if(file.tests, [&](const TestCase& test) {
                    return !hasTag(test, options.tags) || !std::regex_search(test.name, filter);
                });
                selection.files.push_back(std::move(file));
            } catch (const Error& error) {
                selection.unreadable.push_back(unreadable(path, error));
            }
        }
    if (selection.found == 0 && selection.unreadable.empty())
        throw InputError(options.paths[0] + ": no tests; expected '/// @test' in files named *" + kSuffix);
    if (selection.chosen() == 0 && selection.unreadable.empty())
        throw UsageError("none of " + std::to_string(selection.found) + " tests chosen" +
                         hintFor(options, tags));
    return selection;
}

}  // namespace lobe::app
