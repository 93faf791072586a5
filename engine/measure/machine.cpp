#include "measure/machine.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

namespace lobe::measure {
namespace {

std::string cpuName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            if (const size_t colon = line.find(": "); colon != std::string::npos)
                return line.substr(colon + 2);
    return "unknown";
}

}  // namespace

nlohmann::json machineJson() {
    utsname system{};
    uname(&system);
    double load = 0.0;
    const bool known = getloadavg(&load, 1) == 1;
    return {{"cpu", cpuName()},
            {"cores", std::thread::hardware_concurrency()},
            {"memory_bytes", static_cast<int64_t>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGE_SIZE)},
            {"os", std::string(system.sysname) + " " + system.release + " " + system.machine},
            {"load", known ? nlohmann::json(load) : nlohmann::json()}};
}

nlohmann::json contextJson(const gl::ContextInfo& info, Clock clock) {
    return {{"backend", info.backend},
            {"renderer", info.renderer},
            {"version", info.version},
            {"driver", info.vendor},
            {"clock", nameOf(clock)}};
}

std::string utcNow() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text.data();
}

}  // namespace lobe::measure
