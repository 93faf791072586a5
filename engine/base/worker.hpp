/// Work that may crash, hang or eat memory is done in another process.
///
/// Decoders of files from outside (images, models) run in a worker: a program of ours that serves requests over a
/// socket until it is closed. If it dies, hangs or passes its memory limit, the request fails with a reason and the
/// next request starts a new one. Bulk data travels in shared memory, never through the socket.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lobe {

/// Anonymous memory that can be handed to another process (memfd). Move-only; unmapped on destruction.
class SharedMemory {
public:
    SharedMemory() = default;
    explicit SharedMemory(size_t bytes);                 ///< zeroed and writable; throws std::bad_alloc
    static SharedMemory adopt(int fileDescriptor);       ///< maps what another process sent; takes the descriptor
    static SharedMemory copyOf(std::span<const std::byte> bytes);
    SharedMemory(SharedMemory&& other) noexcept;
    SharedMemory& operator=(SharedMemory&& other) noexcept;
    ~SharedMemory();

    std::span<std::byte> bytes() { return {data_, size_}; }
    std::span<const std::byte> bytes() const { return {data_, size_}; }
    size_t size() const { return size_; }
    int fileDescriptor() const { return descriptor_; }

private:
    std::byte* data_ = nullptr;
    size_t size_ = 0;
    int descriptor_ = -1;
};

/// What travels in either direction: a short text (JSON) and any number (up to 64) of blobs.
struct Message {
    std::string header;
    std::vector<SharedMemory> blobs;
};

struct WorkerLimits {
    size_t memoryBytes = size_t{4} << 30;         ///< RLIMIT_AS of the worker beyond what it maps at start
    std::chrono::milliseconds timeout{30'000};    ///< per request, wall clock
};

/// The parent's end. Not for use by two threads at once: give each its own.
class Worker {
public:
    /// `program` is the name that workerProgram() finds. Starts it at once, without waiting for it to be ready.
    Worker(std::string program, WorkerLimits limits);
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Sends a request and waits for the reply. Throws InputError with a reason fit for "FILE: REASON": what the
    /// worker itself refused (header {"error": "..."}, exit code in {"exitCode": N} when not InputError's),
    /// "the decoder crashed (signal 11)", "the decoder took longer than 30 s", "the decoder needs more than 4096 MiB".
    Message call(const Message& request);

private:
    struct Process;
    void start();
    void stop();
    std::string program_;
    WorkerLimits limits_;
    std::unique_ptr<Process> process_;
};

/// The worker's end: serves requests from the socket that its parent gave it until the parent closes it, then
/// returns the exit status for main(). `handler` may throw: Error becomes {"error", "exitCode"}, bad_alloc a
/// message about the memory limit.
int serveWorker(const std::function<Message(const Message&)>& handler);

}  // namespace lobe
