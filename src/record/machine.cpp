#include "record/machine.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <fstream>
#include <string_view>
#include <thread>

namespace cairn {

namespace {

/// The value of the first "key<spaces>separator value" line; empty if there is none.
std::string valueInFile(const char* file, std::string_view key, char separator) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with(key)) continue;
        const std::size_t at = line.find(separator);
        if (at == std::string::npos) continue;
        const std::size_t begin = line.find_first_not_of(" \t\"", at + 1);
        if (begin == std::string::npos) continue;
        const std::size_t end = line.find_last_not_of(" \t\"");
        return line.substr(begin, end + 1 - begin);
    }
    return {};
}

}  // namespace

std::string describeMachine() {
    utsname system{};
    const bool known = uname(&system) == 0;
    std::string processor = valueInFile("/proc/cpuinfo", "model name", ':');
    if (processor.empty()) processor = known ? system.machine : "unknown processor";
    std::string name = valueInFile("/etc/os-release", "PRETTY_NAME", '=');
    if (name.empty()) name = "unknown system";
    const std::string kernel =
        known ? fmt::format("{} {} {}", system.sysname, system.release, system.machine) : "unknown kernel";
    return fmt::format("{}, {} threads, {}, {}", processor, std::thread::hardware_concurrency(), name, kernel);
}

}  // namespace cairn
