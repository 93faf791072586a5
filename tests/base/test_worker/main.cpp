/// Does what the request's header says: echo, and every way in which a decoder can go wrong.
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/error.hpp"
#include "base/worker.hpp"

namespace {

using lobe::Message;
using lobe::SharedMemory;

Message textReply(std::string text) {
    Message reply;
    reply.header = std::move(text);
    return reply;
}

void eatMemory() {
    std::vector<std::vector<char>> eaten;
    for (;;)
        eaten.emplace_back(size_t{8} << 20, 'x');
}

int openDescriptors() {
    int count = 0;
    for (int descriptor = 0; descriptor < 256; ++descriptor)
        count += fcntl(descriptor, F_GETFD) != -1 ? 1 : 0;
    return count;
}

Message handle(const Message& request) {
    const std::string& order = request.header;
    if (order == "echo" || order.starts_with("echo ")) {
        Message reply;
        reply.header = order;
        for (const SharedMemory& blob : request.blobs)
            reply.blobs.push_back(SharedMemory::copyOf(blob.bytes()));
        return reply;
    }
    if (order == "pid") return textReply(std::to_string(getpid()));
    if (order == "descriptors") return textReply(std::to_string(openDescriptors()));
    if (order == "segfault") std::raise(SIGSEGV);
    if (order == "abort") std::abort();
    if (order == "exit") std::_Exit(9);
    if (order == "hang") {
        for (volatile bool forever = true; forever;) {
        }
    }
    if (order == "sleep") std::this_thread::sleep_for(std::chrono::hours(1));
    if (order == "memory") eatMemory();
    if (order == "bad_alloc") throw std::bad_alloc();
    if (order == "input") throw lobe::InputError("width: 0; expected at least 1");
    if (order == "output") throw lobe::OutputError("/x/y.png: No space left on device");
    if (order == "usage") throw lobe::UsageError("unknown option");
    if (order == "exception") throw std::runtime_error("plain \xff text");
    if (order == "number") throw 7;
    if (order == "garbage") {
        const std::string noise(4096, '?');
        if (write(3, noise.data(), noise.size()) < 0) std::abort();
        return {};
    }
    if (order == "noise") {
        if (write(STDOUT_FILENO, "out", 3) < 0 || write(STDERR_FILENO, "err", 3) < 0) std::abort();
        return textReply("done");
    }
    throw lobe::UsageError("unknown order " + order);
}

}  // namespace

int main() {
    return lobe::serveWorker(handle);
}
