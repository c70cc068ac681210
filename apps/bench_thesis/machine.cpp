#include "machine.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <fstream>
#include <map>
#include <thread>

namespace cairn::thesis {

namespace {

/// The first processor's lines of /proc/cpuinfo; empty where there is no such file.
std::map<std::string, std::string> processorFields() {
    std::map<std::string, std::string> fields;
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line) && !line.empty();) {
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos || colon + 2 > line.size()) continue;
        fields.emplace(line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1), line.substr(colon + 2));
    }
    return fields;
}

}  // namespace

Machine thisMachine(std::optional<double> rating) {
    Machine machine;
    auto fields = processorFields();
    machine.processor = fields["model name"].empty() ? "unknown processor" : fields["model name"];
    machine.cores = std::max<std::int64_t>(1, std::thread::hardware_concurrency());
    utsname name{};
    if (uname(&name) == 0) machine.system = fmt::format("{} {} {}", name.sysname, name.release, name.machine);
#ifdef __clang__
    machine.compiler = fmt::format("clang {}.{}", __clang_major__, __clang_minor__);
#else
    machine.compiler = fmt::format("g++ {}.{}", __GNUC__, __GNUC_MINOR__);
#endif
    if (rating) {
        machine.rating = rating;
        machine.rating_source = "given with --rating";
    } else if (fields["vendor_id"] == "AuthenticAMD" && fields["cpu family"] == "26" && fields["model"] == "2") {
        // Virtual machines hide the model; Zen 5 server parts are rated 3500 to 3850, and the highest counts here.
        machine.processor += " (Zen 5)";
        machine.rating = 3847;
        machine.rating_source = "that of the EPYC 9655, the fastest rated of the server parts this one may be";
    }
    return machine;
}

}  // namespace cairn::thesis
