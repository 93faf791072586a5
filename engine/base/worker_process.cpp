#include "base/worker_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <utility>

#include "base/error.hpp"
#include "base/resources.hpp"
#include "base/worker_socket.hpp"

namespace lobe {
namespace {

/// What posix_spawn is told, and its release.
struct SpawnPlan {
    posix_spawn_file_actions_t files{};
    posix_spawnattr_t attributes{};

    explicit SpawnPlan(int workerSocket) {
        posix_spawn_file_actions_init(&files);
        posix_spawnattr_init(&attributes);
        posix_spawn_file_actions_adddup2(&files, workerSocket, worker_socket::kWorkerDescriptor);
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        if (std::getenv("LOBE_WORKER_STDERR") == nullptr)
            posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addclosefrom_np(&files, worker_socket::kWorkerDescriptor + 1);

        // Neither the signals that the parent ignores or blocks, nor a Ctrl-C meant for the parent, are the
        // worker's.
        sigset_t none;
        sigset_t all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setpgroup(&attributes, 0);
        posix_spawnattr_setflags(&attributes,
                                 POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnPlan() {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;
};

bool reapWithin(pid_t pid, std::chrono::milliseconds patience) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    for (;;) {
        const pid_t reaped = waitpid(pid, nullptr, WNOHANG);
        if (reaped == pid || (reaped < 0 && errno != EINTR)) return true;
        if (std::chrono::steady_clock::now() >= deadline) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

std::string describe(int status) {
    if (WIFEXITED(status))
        return "ended unexpectedly (exit status " + std::to_string(WEXITSTATUS(status)) + ")";
    switch (WTERMSIG(status)) {
        case SIGXCPU:
            return "took too much processor time";
        case SIGKILL:
            return "was killed (signal 9; is the machine out of memory?)";
        default:
            return "crashed (signal " + std::to_string(WTERMSIG(status)) + ")";
    }
}

}  // namespace

WorkerProcess::WorkerProcess(const std::string& name) {
    const std::string program = workerProgram(name).string();
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw InputError("helper program " + name + " can't be started: " + std::strerror(errno));
    int failed = 0;
    {
        const SpawnPlan plan(ends[1]);
        std::string argument = program;
        std::array<char*, 2> arguments{argument.data(), nullptr};
        failed =
            posix_spawn(&pid_, program.c_str(), &plan.files, &plan.attributes, arguments.data(), environ);
    }
    close(ends[1]);
    if (failed != 0) {
        close(ends[0]);
        throw InputError("helper program " + program + " can't be started: " + std::strerror(failed));
    }
    socket_ = ends[0];
}

WorkerProcess::~WorkerProcess() {
    close(socket_);
    if (pid_ < 0 || reapWithin(pid_, std::chrono::milliseconds(100))) return;
    kill(pid_, SIGKILL);
    reapWithin(pid_, std::chrono::seconds(10));
}

std::string WorkerProcess::killAndExplain() {
    // A process that is already dying keeps the status that it dies with.
    kill(pid_, SIGKILL);
    int status = 0;
    pid_t reaped = -1;
    do {
        reaped = waitpid(pid_, &status, 0);
    } while (reaped < 0 && errno == EINTR);
    const bool known = reaped == std::exchange(pid_, -1);
    return known ? describe(status) : "ended unexpectedly";
}

}  // namespace lobe
