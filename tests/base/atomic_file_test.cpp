#include "base/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "base/error.hpp"

namespace lobe {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

class AtomicFile : public testing::Test {
protected:
    AtomicFile() {
        std::string name = (fs::temp_directory_path() / "lobe-atomic-XXXXXX").string();
        folder = mkdtemp(name.data());
    }
    ~AtomicFile() override { fs::remove_all(folder); }

    std::vector<std::string> entries() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            names.push_back(fs::relative(entry.path(), folder).string());
        return names;
    }

    fs::path folder;
};

std::string contentOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Runs `action` in a child that may write at most `bytes` to a file; true when it ended with OutputError.
template<class Action>
bool isOutputErrorWithFileSize(rlim_t bytes, const Action& action) {
    const pid_t child = fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, bytes};
        setrlimit(RLIMIT_FSIZE, &limit);
        try {
            action();
        } catch (const OutputError&) {
            _exit(7);
        } catch (...) {
            _exit(1);
        }
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 7;
}

TEST_F(AtomicFile, WritesReplacesAndMakesFolders) {
    const fs::path file = folder / "a" / "b" / "report.json";
    writeAtomically(file, "first");
    EXPECT_EQ(contentOf(file), "first");
    const std::string second("second \0 with a zero", 20);
    writeAtomically(file, second);
    EXPECT_EQ(contentOf(file), second);
    writeAtomically(file, "");
    EXPECT_EQ(contentOf(file), "");
    EXPECT_THAT(entries(), testing::UnorderedElementsAre("a", "a/b", "a/b/report.json"));
}

TEST_F(AtomicFile, GivesAHiddenTemporaryNameWithTheSameExtensionBesideTheTarget) {
    const fs::path file = folder / "picture.v2.png";
    fs::path used;
    writeAtomically(file, [&](const fs::path& temporary) {
        used = temporary;
        EXPECT_EQ(temporary.extension(), ".png");
        EXPECT_EQ(temporary.parent_path(), folder);
        EXPECT_THAT(temporary.filename().string(), StartsWith("."));
        EXPECT_FALSE(fs::exists(file));
        std::ofstream(temporary) << "pixels";
    });
    EXPECT_FALSE(fs::exists(used));
    EXPECT_EQ(contentOf(file), "pixels");
    const fs::path longName = folder / (std::string(250, 'n') + ".png");
    writeAtomically(longName, "x");
    EXPECT_TRUE(fs::exists(longName));
}

TEST_F(AtomicFile, LeavesTheOldFileAndNothingElseOnFailure) {
    const fs::path file = folder / "picture.png";
    writeAtomically(file, "old");
    const auto halfWritten = [](const fs::path& temporary) {
        std::ofstream(temporary) << "half";
        throw InputError("stopped");
    };
    EXPECT_THROW(writeAtomically(file, halfWritten), InputError);
    EXPECT_EQ(contentOf(file), "old");
    EXPECT_THROW(writeAtomically(file, [](const fs::path&) {}), OutputError) << "nothing was written";
    EXPECT_EQ(contentOf(file), "old");
    EXPECT_THAT(entries(), testing::ElementsAre("picture.png"));
}

TEST_F(AtomicFile, NamesFileAndReason) {
    writeAtomically(folder / "file", "x");
    const std::vector<std::pair<fs::path, std::string>> cases = {
        {folder, "Is a directory"},
        {folder / "file" / "below.png", "Not a directory"},
        {folder / (std::string(300, 'n') + ".png"), "File name too long"},
        {"/proc/lobe/x.png", "No such file or directory"},
    };
    for (const auto& [target, reason] : cases) {
        try {
            writeAtomically(target, "x");
            ADD_FAILURE() << target << " was written";
        } catch (const OutputError& error) {
            EXPECT_THAT(error.what(), StartsWith(target.string() + ": "));
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    }
    EXPECT_THROW(writeAtomically("", "x"), OutputError);
    EXPECT_THROW(writeAtomically(folder / "new" / "", "x"), OutputError);
    EXPECT_THAT(entries(), testing::ElementsAre("file"));
}

TEST_F(AtomicFile, RefusesAFolderWithoutPermission) {
    const fs::path closed = folder / "closed";
    fs::create_directory(closed);
    fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec);
    const pid_t child = fork();  // as nobody: root may write everywhere
    if (child == 0) {
        fs::permissions(folder, fs::perms::all);
        if (geteuid() == 0 && setuid(65534) != 0) _exit(1);
        try {
            writeAtomically(closed / "x.png", "x");
        } catch (const OutputError& error) {
            _exit(std::string(error.what()).ends_with("Permission denied") ? 7 : 1);
        } catch (...) {
            _exit(1);
        }
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 7);
    fs::permissions(closed, fs::perms::owner_all);
}

TEST_F(AtomicFile, LeavesNothingOnAFullDisk) {
    const fs::path file = folder / "picture.png";
    writeAtomically(file, "old");
    const std::string text(100'000, 'x');
    EXPECT_FALSE(isOutputErrorWithFileSize(200'000, [&] { writeAtomically(folder / "fits.txt", text); }));
    EXPECT_TRUE(isOutputErrorWithFileSize(50'000, [&] { writeAtomically(file, text); }));
    EXPECT_EQ(contentOf(file), "old");
    EXPECT_THAT(entries(), testing::UnorderedElementsAre("picture.png", "fits.txt"));
    try {
        writeAtomically("/dev/full", "x");
        ADD_FAILURE() << "/dev/full was written";
    } catch (const OutputError& error) {
        EXPECT_STREQ(error.what(), "/dev/full: can't be written: No space left on device");
    }
}

TEST_F(AtomicFile, KeepsLinksAndDevices) {
    const fs::path file = folder / "real.json";
    const fs::path link = folder / "link.json";
    writeAtomically(file, "old");
    fs::create_symlink("real.json", link);
    writeAtomically(link, "new");
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(contentOf(file), "new");
    writeAtomically("/dev/null", "gone");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFile, IsWholeUnderConcurrentWriters) {
    const fs::path file = folder / "shared.txt";
    std::vector<std::thread> writers;
    for (const char letter : {'a', 'b', 'c', 'd'})
        writers.emplace_back([&file, letter] {
            for (int i = 0; i < 20; ++i)
                writeAtomically(file, std::string(10'000, letter));
        });
    for (std::thread& writer : writers)
        writer.join();
    const std::string content = contentOf(file);
    EXPECT_EQ(content, std::string(10'000, content.at(0)));
    EXPECT_THAT(entries(), testing::ElementsAre("shared.txt"));
}

}  // namespace
}  // namespace lobe
