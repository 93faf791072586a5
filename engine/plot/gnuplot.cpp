#include "plot/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sstream>
#include <vector>

#include "base/error.hpp"

namespace lobe::plot {
namespace {

constexpr const char* kProgram = "gnuplot";

/// A stream of the child: a file without a name rather than a pipe, so that neither side ever waits for the
/// other.
class Stream {
public:
    Stream() : file_(std::tmpfile()) {
        if (!file_) throw OutputError(std::string("a temporary file can't be made: ") + std::strerror(errno));
    }
    int descriptor() const { return fileno(file_.get()); }

    void write(const std::string& text) const {
        if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() ||
            std::fflush(file_.get()) != 0 || lseek(descriptor(), 0, SEEK_SET) != 0)
            throw OutputError(std::string("a temporary file can't be written: ") + std::strerror(errno));
    }

    std::string read() const {
        std::rewind(file_.get());
        std::string text;
        std::array<char, 65536> part{};
        for (size_t got = 0; (got = std::fread(part.data(), 1, part.size(), file_.get())) > 0;)
            text.append(part.data(), got);
        return text;
    }

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
};

/// The environment without what changes gnuplot's output or where it looks for files.
std::vector<std::string> environment() {
    std::vector<std::string> kept{"LC_ALL=C.UTF-8"};
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view variable(*entry);
        if (!variable.starts_with("LC_") && !variable.starts_with("LANG") &&
            !variable.starts_with("GNUPLOT") && !variable.starts_with("GDFONTPATH"))
            kept.emplace_back(variable);
    }
    return kept;
}

[[noreturn]] void failToStart(int reason) {
    throw InputError(reason == ENOENT
                         ? "gnuplot is not installed, which draws SVG and PNG: expected the Debian package "
                           "gnuplot-nox; CSV needs none"
                         : std::string("gnuplot can't be started: ") + std::strerror(reason));
}

pid_t start(const Stream& in, const Stream& out, const Stream& complaints) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, complaints.descriptor(), STDERR_FILENO);
    std::array<std::string, 2> arguments{kProgram, "-d"};  // -d: no configuration files
    std::array<char*, 3> argv{arguments[0].data(), arguments[1].data(), nullptr};
    std::vector<std::string> variables = environment();
    std::vector<char*> envp;
    envp.reserve(variables.size() + 1);
    for (std::string& variable : variables)
        envp.push_back(variable.data());
    envp.push_back(nullptr);
    pid_t pid = -1;
    const int failed = posix_spawnp(&pid, kProgram, &actions, nullptr, argv.data(), envp.data());
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) failToStart(failed);
    return pid;
}

/// The first line that is gnuplot's own: font libraries warn of caches that they can't write.
std::string firstComplaint(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const size_t start = line.find_first_not_of(" \t\r");
        if (start == std::string::npos || line.find("ontconfig") != std::string::npos ||
            line.find("Pango-") != std::string::npos || line.find("Cairo-") != std::string::npos)
            continue;
        return line.substr(start);
    }
    return {};
}

/// Bytes of the first character, 0 where it is none that XML may hold: not UTF-8, or a control character.
size_t characterLength(std::string_view text) {
    const auto byteAt = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byteAt(0);
    if (first < 0x80) return first < 0x20 || first == 0x7F ? 0 : 1;
    const size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
    uint32_t code = first & (0xFFU >> (length + 1));
    for (size_t i = 1; i < length; ++i) {
        if ((byteAt(i) & 0xC0U) != 0x80U) return 0;
        code = code << 6U | (byteAt(i) & 0x3FU);
    }
    const bool overlong = code < (length == 4 ? 0x10000U : length == 3 ? 0x800U : 0x80U);
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    const bool control = code < 0xA0;
    return overlong || surrogate || control || code > 0x10FFFF || (code & 0xFFFEU) == 0xFFFEU ? 0 : length;
}

}  // namespace

std::string gnuplotText(std::string_view text) {
    std::string result = "\"";
    while (!text.empty()) {
        const size_t length = characterLength(text);
        const std::string_view character = length == 0 ? "?" : text.substr(0, length);
        text.remove_prefix(std::max<size_t>(length, 1));
        for (char c : character) {
            const auto byte = static_cast<unsigned char>(c);
            if (c == ' ' || (byte < 0x80 && std::isalpha(byte) != 0)) {
                result += c;
                continue;
            }
            std::array<char, 8> escape{};
            std::snprintf(escape.data(), escape.size(), "\\%03o", unsigned{byte});
            result += escape.data();
        }
    }
    return result + '"';
}

std::string runGnuplot(const std::string& commands) {
    const Stream in, out, complaints;
    in.write(commands);
    const pid_t pid = start(in, out, complaints);
    int status = 0;
    while (waitpid(pid, &status, 0) < 0)
        if (errno != EINTR) throw Error(ExitCode::checkFailed, "gnuplot was lost");
    std::string picture = out.read();
    const std::string complaint = firstComplaint(complaints.read());
    if (!WIFEXITED(status))
        throw Error(ExitCode::checkFailed, "gnuplot died of signal " + std::to_string(WTERMSIG(status)));
    if (WEXITSTATUS(status) == 127) failToStart(ENOENT);  // where posix_spawnp can't say so itself
    if (WEXITSTATUS(status) != 0 || !complaint.empty() || picture.empty())
        throw Error(ExitCode::checkFailed,
                    "gnuplot: " + (complaint.empty()
                                       ? "drew nothing (status " + std::to_string(WEXITSTATUS(status)) + ")"
                                       : complaint));
    return picture;
}

}  // namespace lobe::plot
