#include "harness/unit/unit_worker.hpp"

#include <algorithm>
#include <memory>

#include "base/error.hpp"

namespace lobe::harness {
namespace {

/// Graphics drivers map far more than they use.
constexpr size_t kAddressSpace = size_t{1} << 46;

nlohmann::json requestFor(const UnitWorkerSettings& worker, const TestFile& file, const TestCase& test,
                          const RunSettings& settings) {
    nlohmann::json request = {{"backend", static_cast<int>(worker.context.backend)},
                              {"device", worker.context.device},
                              {"file", file.path.string()},
                              {"test", test.name},
                              {"repetition", settings.repetition},
                              {"folders", nlohmann::json::array()}};
    for (const auto& folder : worker.folders)
        request["folders"].push_back(folder.string());
    if (settings.rows) request["rows"] = *settings.rows;
    if (settings.seed) request["seed"] = *settings.seed;
    return request;
}

RunSettings settingsIn(const nlohmann::json& request) {
    RunSettings settings;
    settings.repetition = request.at("repetition");
    if (request.contains("rows")) settings.rows = request["rows"].get<int64_t>();
    if (request.contains("seed")) settings.seed = request["seed"].get<uint64_t>();
    return settings;
}

std::string inSeconds(std::chrono::milliseconds time) {
    const nlohmann::json seconds = double(time.count()) / 1000.0;
    return time.count() % 1000 == 0 ? std::to_string(time.count() / 1000) : seconds.dump();
}

}  // namespace

UnitClient::UnitClient(UnitWorkerSettings settings)
    : settings_(std::move(settings)),
      worker_("lobe-check-worker", {kAddressSpace, settings_.timeLimit, "the test's process"}) {}

UnitResult UnitClient::run(const TestFile& file, const TestCase& test, const RunSettings& settings) {
    const auto failed = [&](UnitResult::Status status, ExitCode code, const std::string& message) {
        UnitResult result = resultFor(file, test);
        result.status = status;
        result.code = code;
        result.message = message;
        return result;
    };
    try {
        Message message;
        message.header = requestFor(settings_, file, test, settings).dump();
        const nlohmann::json reply = nlohmann::json::parse(worker_.call(message).header);
        backend_ = reply.at("backend");
        renderer_ = reply.at("renderer");
        return unitResultFrom(reply.at("result"));
    } catch (const WorkerFailure& failure) {
        return failed(UnitResult::Status::failed, ExitCode::checkFailed,
                      failure.late ? "exceeded the time limit of " + inSeconds(settings_.timeLimit) +
                                         " s; is there a loop without end?"
                                   : failure.what());
    } catch (const Error& error) {
        if (error.exitCode() == ExitCode::noContext) throw ContextError(error.what());
        if (error.exitCode() == ExitCode::usage) throw UsageError(error.what());  // no such device
        return failed(UnitResult::Status::error, error.exitCode(), error.what());
    }
}

Message serveUnitRequest(const Message& message) {
    const nlohmann::json request = nlohmann::json::parse(message.header);
    static std::unique_ptr<gl::Context> context;
    if (!context) {
        gl::ContextRequest wanted;
        wanted.backend = static_cast<gl::Backend>(request.at("backend").get<int>());
        wanted.device = request.at("device");
        context = gl::Context::create(wanted);
    }
    std::vector<std::filesystem::path> folders;
    for (const auto& folder : request.at("folders"))
        folders.emplace_back(folder.get<std::string>());
    const TestFile file = readTestFile(request.at("file").get<std::string>());
    const std::string name = request.at("test");
    const auto test = std::find_if(file.tests.begin(), file.tests.end(),
                                   [&](const TestCase& each) { return each.name == name; });
    if (test == file.tests.end()) throw InputError(file.name + ": has no test " + name + " any more");
    const UnitResult result = runTest(unitLibrary(folders), file, *test, settingsIn(request));
    Message reply;
    reply.header = nlohmann::json{{"result", nlohmann::json(toJson(result))},
                                  {"backend", context->info().backend},
                                  {"renderer", context->info().renderer}}
                       .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return reply;
}

}  // namespace lobe::harness
