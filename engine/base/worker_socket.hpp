/// The wire between Worker and serveWorker: frames over a Unix stream socket, blobs as descriptors.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "base/worker.hpp"

namespace lobe::worker_socket {

inline constexpr size_t kMaxHeaderBytes = size_t{16} << 20;
inline constexpr size_t kMaxBlobs = 64;
/// The descriptor under which a worker finds its end of the socket.
inline constexpr int kWorkerDescriptor = 3;

enum class FrameKind : uint32_t {
    message = 1,     ///< a request or its reply
    refusal = 2,     ///< header {"error": one line, "exitCode": N}
    outOfMemory = 3  ///< the worker's last word; no header
};

/// The first frame that a worker gets is a message whose header is its limits; requests follow.
inline constexpr const char* kMemoryKey = "memoryBytes";
inline constexpr const char* kTimeoutKey = "timeoutMs";

/// No value: wait for ever.
using Deadline = std::optional<std::chrono::steady_clock::time_point>;

enum class Outcome : uint8_t {
    done,
    closed,  ///< the other end is gone
    late     ///< the deadline passed
};

struct Frame {
    FrameKind kind = FrameKind::message;
    Message message;
};

/// Throws std::length_error when the message is over the limits above.
Outcome send(int socket, FrameKind kind, const Message& message, Deadline deadline);

/// Throws InputError when what arrives is not a frame within the limits, and std::bad_alloc when its blobs
/// can't be mapped; the whole frame has been taken from the socket then.
Outcome receive(int socket, Frame& frame, Deadline deadline);

/// Whether the other end has been closed. Never waits.
bool isClosed(int socket);

}  // namespace lobe::worker_socket
