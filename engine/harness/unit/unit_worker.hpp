/// Tests run in a worker process (engine/base/worker.hpp): GLSL that hangs or crashes a driver costs one
/// test.
#pragma once

#include "base/worker.hpp"
#include "gl/context.hpp"
#include "harness/unit/unit_runner.hpp"

namespace lobe::harness {

struct UnitWorkerSettings {
    gl::ContextRequest context;
    std::vector<std::filesystem::path> folders;   ///< for includes
    std::chrono::milliseconds timeLimit{60'000};  ///< a test
};

/// The parent's end.
class UnitClient {
public:
    explicit UnitClient(UnitWorkerSettings settings);

    /// What is wrong with the test, its GLSL or the driver is in the result; throws ContextError and
    /// UsageError for the context, and InputError if the worker can't be started.
    UnitResult run(const TestFile& file, const TestCase& test, const RunSettings& settings);

    const std::string& backend() const { return backend_; }    ///< empty before the first result
    const std::string& renderer() const { return renderer_; }  ///< the same

private:
    UnitWorkerSettings settings_;
    Worker worker_;
    std::string backend_, renderer_;
};

/// The worker's end: to be given to serveWorker().
Message serveUnitRequest(const Message& request);

}  // namespace lobe::harness
