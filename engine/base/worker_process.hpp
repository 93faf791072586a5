/// A worker's process and the parent's end of its socket.
#pragma once

#include <sys/types.h>

#include <string>

namespace lobe {

class WorkerProcess {
public:
    /// Starts the program that workerProgram(name) finds; throws InputError when it can't be started.
    explicit WorkerProcess(const std::string& name);
    /// Closes the socket, on which the worker ends; kills it when it does not within 100 ms.
    ~WorkerProcess();
    WorkerProcess(const WorkerProcess&) = delete;
    WorkerProcess& operator=(const WorkerProcess&) = delete;

    int socket() const { return socket_; }

    /// Kills it, and says in words what it had died of before: "crashed (signal 11)".
    std::string killAndExplain();

private:
    pid_t pid_ = -1;
    int socket_ = -1;
};

}  // namespace lobe
