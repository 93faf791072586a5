#include "base/worker.hpp"

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/worker_process.hpp"
#include "base/worker_socket.hpp"

namespace lobe {
namespace {

using worker_socket::Frame;
using worker_socket::FrameKind;
using worker_socket::Outcome;

[[noreturn]] void throwRefusal(const std::string& header) {
    const nlohmann::json refusal = nlohmann::json::parse(header, nullptr, false);
    const bool sound = refusal.is_object() && refusal.contains("error") && refusal["error"].is_string() &&
                       refusal.contains("exitCode") && refusal["exitCode"].is_number_integer();
    if (!sound) throw InputError("the decoder answered nothing readable");
    const std::string error = refusal["error"];
    const auto code = static_cast<ExitCode>(refusal["exitCode"].get<int>());
    switch (code) {
        case ExitCode::unreadableInput:
            throw InputError(error);
        case ExitCode::unwritableOutput:
            throw OutputError(error);
        case ExitCode::usage:
            throw UsageError(error);
        default:
            throw Error(code, error);
    }
}

std::string seconds(std::chrono::milliseconds time) {
    const nlohmann::json value = static_cast<double>(time.count()) / 1000.0;
    return time.count() % 1000 == 0 ? std::to_string(time.count() / 1000) : value.dump();
}

}  // namespace

struct Worker::Process : WorkerProcess {
    using WorkerProcess::WorkerProcess;
};

Worker::Worker(std::string program, WorkerLimits limits) : program_(std::move(program)), limits_(limits) {
    start();
}

Worker::~Worker() = default;

void Worker::start() {
    process_ = std::make_unique<Process>(program_);
    Message limits;
    limits.header = nlohmann::json{{worker_socket::kMemoryKey, limits_.memoryBytes},
                                   {worker_socket::kTimeoutKey, limits_.timeout.count()}}
                        .dump();
    // A new socket's buffer takes this at once. If the worker is already dead, the first call finds out why.
    worker_socket::send(process_->socket(), FrameKind::message, limits, std::chrono::steady_clock::now());
}

void Worker::stop() {
    process_.reset();
}

Message Worker::call(const Message& request) {
    // One that died while idle (killed by hand, say) is not the fault of this request.
    if (process_ && worker_socket::isClosed(process_->socket())) stop();
    if (!process_) start();

    const auto deadline = std::chrono::steady_clock::now() + limits_.timeout;
    Frame reply;
    Outcome outcome = Outcome::closed;
    try {
        outcome = worker_socket::send(process_->socket(), FrameKind::message, request, deadline);
        // A worker may have said why before it ended.
        if (outcome != Outcome::late) outcome = worker_socket::receive(process_->socket(), reply, deadline);
    } catch (...) {
        process_->killAndExplain();
        stop();
        throw;
    }
    if (outcome == Outcome::done && reply.kind == FrameKind::message) return std::move(reply.message);
    if (outcome == Outcome::done && reply.kind == FrameKind::refusal) throwRefusal(reply.message.header);

    const std::string death = process_->killAndExplain();
    stop();
    const std::string reason =
        outcome == Outcome::done   ? "needs more than " + std::to_string(limits_.memoryBytes >> 20) + " MiB"
        : outcome == Outcome::late ? "took longer than " + seconds(limits_.timeout) + " s"
                                   : death;
    WorkerFailure failure(limits_.subject + " " + reason);
    failure.late = outcome == Outcome::late;
    throw failure;
}

}  // namespace lobe
