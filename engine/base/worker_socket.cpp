#include "base/worker_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base/error.hpp"

namespace lobe::worker_socket {
namespace {

constexpr uint32_t kMagic = 0x45424f4c;  // "LOBE"

/// Native byte order: both ends are on one machine.
struct Prefix {
    uint32_t magic = kMagic;
    uint32_t kind = 0;
    uint32_t headerBytes = 0;
    uint32_t blobs = 0;
};

/// Descriptors that close unless taken.
struct Descriptors {
    std::vector<int> values;
    Descriptors() = default;
    Descriptors(const Descriptors&) = delete;
    Descriptors& operator=(const Descriptors&) = delete;
    ~Descriptors() {
        for (const int descriptor : values)
            if (descriptor >= 0) close(descriptor);
    }
};

union ControlBuffer {
    cmsghdr alignment;
    std::array<char, CMSG_SPACE(sizeof(int) * kMaxBlobs)> bytes;
};

Outcome waitFor(int socket, short events, Deadline deadline) {
    for (;;) {
        int milliseconds = -1;
        if (deadline) {
            const auto left =
                std::chrono::ceil<std::chrono::milliseconds>(*deadline - std::chrono::steady_clock::now());
            if (left.count() <= 0) return Outcome::late;
            milliseconds = static_cast<int>(std::min<int64_t>(left.count(), INT_MAX));
        }
        pollfd entry{socket, events, 0};
        if (poll(&entry, 1, milliseconds) > 0) return Outcome::done;
    }
}

/// The rest of a range, without descriptors.
Outcome sendBytes(int socket, const char* data, size_t size, Deadline deadline) {
    while (size > 0) {
        const ssize_t sent = ::send(socket, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent >= 0) {
            data += sent;
            size -= static_cast<size_t>(sent);
        } else if (errno == EAGAIN) {
            if (const Outcome waited = waitFor(socket, POLLOUT, deadline); waited != Outcome::done)
                return waited;
        } else if (errno != EINTR) {
            return Outcome::closed;
        }
    }
    return Outcome::done;
}

/// The descriptors ride on the first byte of the prefix.
Outcome sendPrefix(int socket, const Prefix& prefix, const std::vector<int>& descriptors, Deadline deadline) {
    std::array<char, sizeof(Prefix)> bytes{};
    std::memcpy(bytes.data(), &prefix, sizeof prefix);
    iovec range{bytes.data(), bytes.size()};
    msghdr header{};
    header.msg_iov = &range;
    header.msg_iovlen = 1;
    ControlBuffer control{};
    if (!descriptors.empty()) {
        header.msg_control = control.bytes.data();
        header.msg_controllen = CMSG_SPACE(sizeof(int) * descriptors.size());
        cmsghdr* const rights = CMSG_FIRSTHDR(&header);
        rights->cmsg_level = SOL_SOCKET;
        rights->cmsg_type = SCM_RIGHTS;
        rights->cmsg_len = CMSG_LEN(sizeof(int) * descriptors.size());
        std::memcpy(CMSG_DATA(rights), descriptors.data(), sizeof(int) * descriptors.size());
    }
    for (;;) {
        const ssize_t sent = sendmsg(socket, &header, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent > 0) {
            const size_t done = static_cast<size_t>(sent);
            return sendBytes(socket, bytes.data() + done, bytes.size() - done, deadline);
        }
        if (errno == EAGAIN) {
            if (const Outcome waited = waitFor(socket, POLLOUT, deadline); waited != Outcome::done)
                return waited;
        } else if (errno != EINTR) {
            return Outcome::closed;
        }
    }
}

void takeDescriptors(msghdr& header, Descriptors& descriptors) {
    for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
        if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_RIGHTS) continue;
        const size_t count = (part->cmsg_len - CMSG_LEN(0)) / sizeof(int);
        for (size_t i = 0; i < count; ++i) {
            int descriptor = -1;
            std::memcpy(&descriptor, CMSG_DATA(part) + i * sizeof(int), sizeof(int));
            descriptors.values.push_back(descriptor);
        }
    }
}

Outcome receiveBytes(int socket, char* data, size_t size, Descriptors& descriptors, Deadline deadline) {
    while (size > 0) {
        iovec range{data, size};
        ControlBuffer control{};
        msghdr header{};
        header.msg_iov = &range;
        header.msg_iovlen = 1;
        header.msg_control = control.bytes.data();
        header.msg_controllen = control.bytes.size();
        const ssize_t got = recvmsg(socket, &header, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
        if (got > 0) {
            takeDescriptors(header, descriptors);
            data += got;
            size -= static_cast<size_t>(got);
        } else if (got < 0 && errno == EAGAIN) {
            if (const Outcome waited = waitFor(socket, POLLIN, deadline); waited != Outcome::done)
                return waited;
        } else if (got == 0 || errno != EINTR) {
            return Outcome::closed;
        }
    }
    return Outcome::done;
}

}  // namespace

Outcome send(int socket, FrameKind kind, const Message& message, Deadline deadline) {
    if (message.header.size() > kMaxHeaderBytes || message.blobs.size() > kMaxBlobs)
        throw std::length_error("worker message: " + std::to_string(message.header.size()) +
                                " header bytes and " + std::to_string(message.blobs.size()) +
                                " blobs; at most " + std::to_string(kMaxHeaderBytes) + " and " +
                                std::to_string(kMaxBlobs));
    SharedMemory empty;  // stands for blobs that were never made
    std::vector<int> descriptors;
    for (const SharedMemory& blob : message.blobs) {
        if (blob.fileDescriptor() < 0 && empty.fileDescriptor() < 0) empty = SharedMemory(0);
        descriptors.push_back(blob.fileDescriptor() >= 0 ? blob.fileDescriptor() : empty.fileDescriptor());
    }
    Prefix prefix;
    prefix.kind = static_cast<uint32_t>(kind);
    prefix.headerBytes = static_cast<uint32_t>(message.header.size());
    prefix.blobs = static_cast<uint32_t>(descriptors.size());
    const Outcome outcome = sendPrefix(socket, prefix, descriptors, deadline);
    return outcome == Outcome::done
               ? sendBytes(socket, message.header.data(), message.header.size(), deadline)
               : outcome;
}

Outcome receive(int socket, Frame& frame, Deadline deadline) {
    Prefix prefix;
    std::array<char, sizeof prefix> bytes{};
    Descriptors descriptors;
    if (const Outcome got = receiveBytes(socket, bytes.data(), bytes.size(), descriptors, deadline);
        got != Outcome::done)
        return got;
    std::memcpy(&prefix, bytes.data(), sizeof prefix);
    const bool known = prefix.kind >= static_cast<uint32_t>(FrameKind::message) &&
                       prefix.kind <= static_cast<uint32_t>(FrameKind::outOfMemory);
    if (prefix.magic != kMagic || !known || prefix.headerBytes > kMaxHeaderBytes)
        throw InputError("worker socket: what arrived is not a message");
    frame.kind = static_cast<FrameKind>(prefix.kind);
    frame.message.header.resize(prefix.headerBytes);
    if (const Outcome got =
            receiveBytes(socket, frame.message.header.data(), prefix.headerBytes, descriptors, deadline);
        got != Outcome::done)
        return got;
    if (descriptors.values.size() != prefix.blobs)
        throw InputError("worker socket: " + std::to_string(descriptors.values.size()) + " of " +
                         std::to_string(prefix.blobs) + " blobs arrived");
    frame.message.blobs.clear();
    frame.message.blobs.reserve(prefix.blobs);
    for (int& descriptor : descriptors.values)
        frame.message.blobs.push_back(SharedMemory::adopt(std::exchange(descriptor, -1)));
    return Outcome::done;
}

bool isClosed(int socket) {
    pollfd entry{socket, 0, 0};
    return poll(&entry, 1, 0) > 0;
}

}  // namespace lobe::worker_socket
