/// Errors that a person reads: one line that says what, where, which value, and what was expected.
#pragma once

#include <stdexcept>
#include <string>

namespace lobe {

/// Exit codes of every program (docs/exit_codes.md). 77 is CTest's "skipped".
enum class ExitCode : int {
    ok = 0,
    checkFailed = 1,      ///< done, but a comparison or test failed, or a batch had a bad shot
    usage = 2,            ///< unknown option, value out of range, contradiction
    unreadableInput = 3,  ///< missing, damaged or hostile input
    noContext = 4,        ///< no usable OpenGL context
    shader = 5,           ///< a shader failed to compile or link
    nonFinite = 6,        ///< NaN or infinity in a picture
    unwritableOutput = 7  ///< output can't be written: folder, permission, full disk
};

/// Base of all that a program reports and exits with. what() is one line without a final dot or newline.
class Error : public std::runtime_error {
public:
    Error(ExitCode exitCode, const std::string& message) : std::runtime_error(message), exitCode_(exitCode) {}
    ExitCode exitCode() const { return exitCode_; }

private:
    ExitCode exitCode_;
};

struct UsageError : Error {
    explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// A damaged, missing or refused input. Message form: "FILE: PROPERTY: VALUE; expected EXPECTATION".
struct InputError : Error {
    explicit InputError(const std::string& message) : Error(ExitCode::unreadableInput, message) {}
};

struct ContextError : Error {
    explicit ContextError(const std::string& message) : Error(ExitCode::noContext, message) {}
};

struct ShaderError : Error {
    explicit ShaderError(const std::string& message) : Error(ExitCode::shader, message) {}
};

struct OutputError : Error {
    explicit OutputError(const std::string& message) : Error(ExitCode::unwritableOutput, message) {}
};

}  // namespace lobe
