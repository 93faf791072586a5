#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.hpp"
#include "base/worker.hpp"
#include "base/worker_socket.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define LOBE_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define LOBE_ADDRESS_SANITIZER 1
#endif
#endif

namespace lobe {
namespace {

using worker_socket::Frame;
using worker_socket::FrameKind;
using worker_socket::kWorkerDescriptor;
using worker_socket::Outcome;

void limit(decltype(RLIMIT_AS) resource, rlim_t value) {
    rlimit both{};
    getrlimit(resource, &both);
    both.rlim_cur = std::min(value, both.rlim_max);
    setrlimit(resource, &both);
}

/// Address space beyond what the program and its libraries map already. The address sanitizer reserves
/// terabytes of it for its shadow, so there is no such limit under it.
void limitMemory([[maybe_unused]] size_t bytes) {
#ifndef LOBE_ADDRESS_SANITIZER
    size_t mappedPages = 0;
    std::ifstream("/proc/self/statm") >> mappedPages;
    limit(RLIMIT_AS, mappedPages * static_cast<size_t>(sysconf(_SC_PAGESIZE)) + bytes);
#endif
}

/// The parent watches the clock; this ends the worker when the parent can't (stopped, or dead by SIGKILL).
void limitProcessorTime(std::chrono::milliseconds timeout) {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const auto spent = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 2);
    const auto allowed = static_cast<rlim_t>(std::chrono::ceil<std::chrono::seconds>(timeout).count() + 1);
    limit(RLIMIT_CPU, spent + allowed * std::max(1U, std::thread::hardware_concurrency()));
}

/// Ends the process when the parent's end of the socket closes, whatever the handler is doing then.
/// PR_SET_PDEATHSIG is no choice: it fires when the thread that started the worker ends, and loaders are
/// threads.
void endWithParent() {
    std::thread([] {
        pollfd entry{kWorkerDescriptor, 0, 0};
        while (poll(&entry, 1, -1) <= 0) {
        }
        _exit(0);
    }).detach();
}

void refuse(const std::string& error, ExitCode code) {
    Message refusal;
    refusal.header = nlohmann::json{{"error", error}, {"exitCode", static_cast<int>(code)}}.dump(
        -1, ' ', false, nlohmann::json::error_handler_t::replace);
    worker_socket::send(kWorkerDescriptor, FrameKind::refusal, refusal, std::nullopt);
}

/// False when the parent is gone. std::bad_alloc passes through.
bool serveOne(const std::function<Message(const Message&)>& handler, std::chrono::milliseconds timeout) {
    Frame request;
    if (worker_socket::receive(kWorkerDescriptor, request, std::nullopt) != Outcome::done) return false;
    limitProcessorTime(timeout);
    try {
        const Message reply = handler(request.message);
        return worker_socket::send(kWorkerDescriptor, FrameKind::message, reply, std::nullopt) ==
               Outcome::done;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const Error& error) {
        refuse(error.what(), error.exitCode());
    } catch (const std::exception& error) {
        refuse(error.what(), ExitCode::unreadableInput);
    } catch (...) {
        refuse("the decoder failed without a reason", ExitCode::unreadableInput);
    }
    return true;
}

}  // namespace

int serveWorker(const std::function<Message(const Message&)>& handler) {
    int type = 0;
    socklen_t size = sizeof type;
    if (getsockopt(kWorkerDescriptor, SOL_SOCKET, SO_TYPE, &type, &size) != 0) {
        std::fputs("this is a helper that lobe starts by itself; it has no use on its own\n", stderr);
        return static_cast<int>(ExitCode::usage);
    }
    fcntl(kWorkerDescriptor, F_SETFD, FD_CLOEXEC);
    std::signal(SIGXFSZ, SIG_IGN);  // a file over the size limit is then an error of write()
    limit(RLIMIT_CORE, 0);

    Frame first;
    if (worker_socket::receive(kWorkerDescriptor, first, std::nullopt) != Outcome::done) return 0;
    const nlohmann::json limits = nlohmann::json::parse(first.message.header);
    const std::chrono::milliseconds timeout(limits.at(worker_socket::kTimeoutKey).get<int64_t>());
    endWithParent();
    limitMemory(limits.at(worker_socket::kMemoryKey).get<size_t>());
    try {
        while (serveOne(handler, timeout)) {
        }
    } catch (const std::bad_alloc&) {
        worker_socket::send(kWorkerDescriptor, FrameKind::outOfMemory, {}, std::nullopt);
        return static_cast<int>(ExitCode::unreadableInput);
    }
    return 0;
}

}  // namespace lobe
