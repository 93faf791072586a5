/// Work that may crash, hang or eat memory is done in another process.
///
/// Decoders of files from outside (images, models) run in a worker: a program of ours that serves requests
/// over a socket until it is closed. If it dies, hangs or passes its memory limit, the request fails with a
/// reason and the next request starts a new one. Bulk data travels in shared memory, never through the
/// socket.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/shared_memory.hpp"

namespace lobe {

/// What travels in either direction: a short text (JSON) and any number (up to 64) of blobs.
struct Message {
    std::string header;
    std::vector<SharedMemory> blobs;
};

struct WorkerLimits {
    size_t memoryBytes = size_t{4} << 30;       ///< RLIMIT_AS of the worker beyond what it maps at start
    std::chrono::milliseconds timeout{30'000};  ///< per request, wall clock
    std::string subject = "the decoder";        ///< what the worker is called in reasons
};

/// The worker did not answer: it crashed, hung or took too much memory.
struct WorkerFailure : InputError {
    using InputError::InputError;
    bool late = false;  ///< over the time limit
};

/// The parent's end. Not for use by two threads at once: give each its own.
class Worker {
public:
    /// `program` is the name that workerProgram() finds. Starts it at once, without waiting for it to be
    /// ready.
    Worker(std::string program, WorkerLimits limits);
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Sends a request and waits for the reply. What the worker itself refuses is thrown with the worker's
    /// exit code (OutputError, UsageError, otherwise InputError or Error); else WorkerFailure with a reason
    /// fit for "FILE: REASON": "the decoder crashed (signal 11)", "the decoder took longer than 30 s", "the
    /// decoder needs more than 4096 MiB". The next call after one of the latter has a new process.
    /// std::length_error for a message over 64 blobs or 16 MiB of header.
    Message call(const Message& request);

private:
    struct Process;
    void start();
    void stop();
    std::string program_;
    WorkerLimits limits_;
    std::unique_ptr<Process> process_;
};

/// The worker's end: serves requests from the socket that its parent gave it until the
/// parent closes it or ends, then returns the exit status for main(). `handler` may throw: Error is passed on
/// with its exit code, bad_alloc as a word about the memory limit, any other exception as InputError.
int serveWorker(const std::function<Message(const Message&)>& handler);

}  // namespace lobe
