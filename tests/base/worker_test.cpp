#include "base/worker.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <thread>

#include "base/error.hpp"
#include "base/resources.hpp"

namespace lobe {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::HasSubstr;

constexpr const char* kProgram = "lobe-test-worker";

Message order(const std::string& text) {
    Message message;
    message.header = text;
    return message;
}

std::string refusalOf(Worker& worker, const std::string& text) {
    try {
        worker.call(order(text));
    } catch (const InputError& error) {
        return error.what();
    } catch (const std::exception& error) {
        return std::string("not an InputError: ") + error.what();
    }
    return "no error";
}

pid_t pidOf(Worker& worker) {
    return static_cast<pid_t>(std::stol(worker.call(order("pid")).header));
}

/// Gone, or ended with all its threads and waiting for whoever inherited it.
bool hasEnded(pid_t pid) {
    const std::filesystem::path process = "/proc/" + std::to_string(pid);
    std::error_code gone;
    const std::filesystem::directory_iterator threads(process / "task", gone);
    if (gone) return true;
    std::ifstream stat(process / "stat");
    std::string word;
    std::string state;
    stat >> word >> word >> state;
    return state.empty() || (state == "Z" && std::distance(begin(threads), end(threads)) == 1);
}

bool endsWithin(pid_t pid, milliseconds patience) {
    const auto deadline = steady_clock::now() + patience;
    while (!hasEnded(pid)) {
        if (steady_clock::now() > deadline) return false;
        std::this_thread::sleep_for(milliseconds(2));
    }
    return true;
}

TEST(Worker, EchoesHeaderAndBlobs) {
    Worker worker(kProgram, {});
    for (const size_t size : {size_t{0}, size_t{1}, size_t{4097}, size_t{5'000'000}}) {
        Message request = order("echo \"quoted\"\n\u00e4 " + std::string(size / 4, 'h'));
        SharedMemory blob(size);
        for (size_t i = 0; i < size; ++i)
            blob.bytes()[i] = static_cast<std::byte>(i * 7);
        request.blobs.push_back(std::move(blob));
        request.blobs.emplace_back();
        const Message reply = worker.call(request);
        EXPECT_EQ(reply.header, request.header);
        ASSERT_EQ(reply.blobs.size(), 2U);
        ASSERT_EQ(reply.blobs[0].size(), size);
        EXPECT_TRUE(size == 0 ||
                    std::memcmp(reply.blobs[0].bytes().data(), request.blobs[0].bytes().data(), size) == 0);
        EXPECT_EQ(reply.blobs[1].size(), 0U);
    }
}

TEST(Worker, CarriesSixtyFourBlobsAndNoMore) {
    Worker worker(kProgram, {});
    Message request = order("echo");
    for (int i = 0; i < 64; ++i) {
        const std::array<std::byte, 1> value{static_cast<std::byte>(i)};
        request.blobs.push_back(SharedMemory::copyOf(value));
    }
    const Message reply = worker.call(request);
    ASSERT_EQ(reply.blobs.size(), 64U);
    for (int i = 0; i < 64; ++i)
        EXPECT_EQ(reply.blobs[static_cast<size_t>(i)].bytes()[0], static_cast<std::byte>(i));
    request.blobs.emplace_back(1);
    EXPECT_THROW(worker.call(request), std::length_error);
    EXPECT_EQ(worker.call(order("echo")).header, "echo");
}

TEST(Worker, LeaksNoDescriptors) {
    const auto count = [] {
        int open = 0;
        for (int descriptor = 0; descriptor < 256; ++descriptor)
            open += fcntl(descriptor, F_GETFD) != -1 ? 1 : 0;
        return open;
    };
    const int before = count();
    const int inheritable = open("/dev/null", O_RDONLY);  // without O_CLOEXEC, as other libraries open theirs
    ASSERT_GE(inheritable, 0);
    {
        Worker worker(kProgram, {});
        Worker second(kProgram, {});
        // The three standard ones and the socket.
        EXPECT_EQ(second.call(order("descriptors")).header, "4");
        for (int i = 0; i < 50; ++i) {
            Message request = order("echo");
            request.blobs.emplace_back(10);
            worker.call(request);
        }
        EXPECT_EQ(worker.call(order("descriptors")).header, "4");
        refusalOf(worker, "segfault");
        refusalOf(worker, "garbage");
    }
    close(inheritable);
    EXPECT_EQ(count(), before);
}

TEST(Worker, NamesEachWayToDieAndGoesOn) {
    Worker worker(kProgram, {size_t{256} << 20, milliseconds(20'000)});
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"abort", "the decoder crashed (signal 6)"},
        {"exit", "the decoder ended unexpectedly (exit status 9)"},
        {"bad_alloc", "the decoder needs more than 256 MiB"},
        {"garbage", "worker socket: what arrived is not a message"},
        {"exception", "plain \xef\xbf\xbd text"},
        {"number", "the decoder failed without a reason"},
        {"input", "width: 0; expected at least 1"},
    };
    for (const auto& [what, reason] : cases) {
        EXPECT_EQ(refusalOf(worker, what), reason);
        EXPECT_EQ(worker.call(order("echo")).header, "echo") << "after " << what;
    }
}

TEST(Worker, SurvivesASegmentationFault) {
    Worker worker(kProgram, {});
    const std::string reason = refusalOf(worker, "segfault");
#if defined(__SANITIZE_ADDRESS__)
    EXPECT_THAT(reason,
                HasSubstr("the decoder ended unexpectedly"));  // the sanitizer turns the signal into an exit
#else
    EXPECT_EQ(reason, "the decoder crashed (signal 11)");
#endif
    EXPECT_EQ(worker.call(order("echo")).header, "echo");
}

#if !defined(__SANITIZE_ADDRESS__)
TEST(Worker, BoundsMemory) {
    Worker worker(kProgram, {size_t{128} << 20, milliseconds(20'000)});
    EXPECT_EQ(refusalOf(worker, "memory"), "the decoder needs more than 128 MiB");
    EXPECT_EQ(worker.call(order("echo")).header, "echo");
    Message tooLarge = order("echo");
    tooLarge.blobs.emplace_back(size_t{200} << 20);
    EXPECT_THROW(worker.call(tooLarge), InputError);
    EXPECT_EQ(worker.call(order("echo")).header, "echo");
}
#endif

TEST(Worker, KeepsTheProcessAfterARefusal) {
    Worker worker(kProgram, {});
    const pid_t first = pidOf(worker);
    refusalOf(worker, "input");
    refusalOf(worker, "exception");
    EXPECT_EQ(pidOf(worker), first);
}

TEST(Worker, PassesExitCodesOn) {
    Worker worker(kProgram, {});
    EXPECT_THROW(worker.call(order("output")), OutputError);
    EXPECT_THROW(worker.call(order("usage")), UsageError);
    EXPECT_THROW(worker.call(order("input")), InputError);
}

TEST(Worker, EndsAHangAtItsTimeout) {
    Worker worker(kProgram, {size_t{256} << 20, milliseconds(300)});
    for (const std::string what : {"hang", "sleep"}) {
        const pid_t pid = pidOf(worker);
        const auto begin = steady_clock::now();
        EXPECT_EQ(refusalOf(worker, what), "the decoder took longer than 0.3 s");
        const auto took = steady_clock::now() - begin;
        EXPECT_GE(took, milliseconds(300));
        EXPECT_LT(took, milliseconds(5000));
        EXPECT_EQ(kill(pid, 0), -1) << "killed and reaped";
    }
}

TEST(Worker, IsReplacedWhenKilledWhileIdleOrBusy) {
    Worker worker(kProgram, {});
    const pid_t first = pidOf(worker);
    kill(first, SIGKILL);
    EXPECT_TRUE(endsWithin(first, milliseconds(5000)));
    const pid_t second = pidOf(worker);
    EXPECT_NE(second, first);
    std::thread killer([second] {
        std::this_thread::sleep_for(milliseconds(100));
        kill(second, SIGKILL);
    });
    EXPECT_EQ(refusalOf(worker, "sleep"), "the decoder was killed (signal 9; is the machine out of memory?)");
    killer.join();
    EXPECT_EQ(worker.call(order("echo")).header, "echo");
}

TEST(Worker, OutlivesTheThreadThatStartedIt) {
    std::unique_ptr<Worker> worker;
    pid_t first = 0;
    std::thread starter([&] {
        worker = std::make_unique<Worker>(kProgram, WorkerLimits{});
        first = pidOf(*worker);
    });
    starter.join();
    std::this_thread::sleep_for(milliseconds(50));
    EXPECT_EQ(pidOf(*worker), first);
}

TEST(Worker, EndsWithItsParent) {
    pid_t idle = 0;
    {
        Worker worker(kProgram, {});
        idle = pidOf(worker);
    }
    EXPECT_EQ(kill(idle, 0), -1) << "reaped by the destructor";

    // A parent that is killed while its worker is busy.
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    const pid_t parent = fork();
    if (parent == 0) {
        Worker worker(kProgram, {});
        const pid_t pid = pidOf(worker);
        if (write(ends[1], &pid, sizeof pid) != sizeof pid) _exit(1);
        try {
            worker.call(order("hang"));
        } catch (...) {
        }
        _exit(0);
    }
    pid_t busy = 0;
    ASSERT_EQ(read(ends[0], &busy, sizeof busy), static_cast<ssize_t>(sizeof busy));
    std::this_thread::sleep_for(milliseconds(50));
    kill(parent, SIGKILL);
    waitpid(parent, nullptr, 0);
    EXPECT_TRUE(endsWithin(busy, milliseconds(5000)));
    close(ends[0]);
    close(ends[1]);
}

TEST(Worker, IsQuiet) {
    Worker worker(kProgram, {});
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    EXPECT_EQ(worker.call(order("noise")).header, "done");
    refusalOf(worker, "abort");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Worker, CostsNothingWhileIdle) {
    Worker worker(kProgram, {});
    const pid_t pid = pidOf(worker);
    const auto ticks = [pid] {
        std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
        std::string word;
        for (int i = 0; i < 13; ++i)
            stat >> word;
        long user = 0;
        long system = 0;
        stat >> user >> system;
        return user + system;
    };
    const long before = ticks();
    std::this_thread::sleep_for(milliseconds(300));
    EXPECT_LE(ticks() - before, 1);
}

TEST(Worker, NamesAMissingProgram) {
    try {
        const Worker worker("lobe-no-such-worker", {});
        FAIL() << "started what is not there";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("lobe-no-such-worker"));
    }
}

TEST(WorkerProgram, RefusesToRunOnItsOwn) {
    const std::string command = workerProgram(kProgram).string() + " 2>/dev/null 3>&-";
    const int status = std::system(command.c_str());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), static_cast<int>(ExitCode::usage));
}

TEST(SharedMemory, MovesAndCopies) {
    SharedMemory first(100);
    for (const std::byte value : first.bytes())
        EXPECT_EQ(value, std::byte{0});
    first.bytes()[99] = std::byte{42};
    SharedMemory second = std::move(first);
    ASSERT_EQ(second.size(), 100U);
    EXPECT_EQ(second.bytes()[99], std::byte{42});
    SharedMemory third = SharedMemory::adopt(dup(second.fileDescriptor()));
    EXPECT_EQ(third.bytes()[99], std::byte{42});
    third.bytes()[0] = std::byte{7};
    EXPECT_EQ(second.bytes()[0], std::byte{7});
    constexpr size_t kTooMuch = std::numeric_limits<size_t>::max();
    EXPECT_THROW(SharedMemory{kTooMuch}, std::bad_alloc);
}

TEST(SharedMemory, RefusesWhatCouldShrink) {
    const int unsealed = memfd_create("unsealed", MFD_CLOEXEC);
    ASSERT_EQ(ftruncate(unsealed, 10), 0);
    EXPECT_THROW(SharedMemory::adopt(unsealed), InputError);
    EXPECT_THROW(SharedMemory::adopt(open("/dev/null", O_RDONLY | O_CLOEXEC)), InputError);
    const SharedMemory sealed(10);
    EXPECT_EQ(ftruncate(sealed.fileDescriptor(), 5), -1);
}

}  // namespace
}  // namespace lobe
