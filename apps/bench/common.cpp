#include "common.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <numeric>
#include <string_view>

#include "bench_thesis/machine.h"
#include "cairn/version.h"

namespace cairn::bench {

namespace {

constexpr std::string_view heavy = "heavy:";

double processorMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// How many programs wanted a processor in the last minute; with more than there are cores times are too long.
double loadAverage() {
    double load = 0;
    return getloadavg(&load, 1) == 1 ? load : 0;
}

/// The day, in UTC.
std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    return fmt::format("{:04}-{:02}-{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday);
}

/// Two equal boxes on the ground, the upper one `ratio` times as heavy as the lower.
Scene heavyScene(const std::string& name) {
    constexpr double size = 0.1;
    double ratio = 0;
    const char* const end = name.data() + name.size();
    const auto [parsed, error] = std::from_chars(name.data() + heavy.size(), end, ratio);
    if (error != std::errc{} || parsed != end || !(ratio >= 1 && ratio <= 1e6)) {
        throw InputError(fmt::format("scene '{}': the ratio must be a number from 1 to 1e6, as in heavy:1000", name));
    }
    Scene scene = shortened(builtInScene("tower:2"), 10);
    scene.name = name;
    SceneBody& lower = scene.bodies.at(1);
    SceneBody& upper = scene.bodies.at(2);
    lower.mass = 800 * size * size * size;
    upper.mass = ratio * *lower.mass;
    return scene;
}

}  // namespace

SettingOverrides combined(SettingOverrides all, const Variant& variant) {
    if (variant.preset) all.preset = variant.preset;
    all.fields.insert(all.fields.end(), variant.fields.begin(), variant.fields.end());
    return all;
}

Stopwatch::Stopwatch() : wall_(std::chrono::steady_clock::now()), processor_ms_(processorMilliseconds()) {}

Times Stopwatch::read() const {
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - wall_;
    return {wall.count(), processorMilliseconds() - processor_ms_};
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::vector<double> medians(const std::vector<std::vector<double>>& repetitions) {
    std::vector<double> result(repetitions.front().size());
    std::vector<double> place(repetitions.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        for (std::size_t k = 0; k < place.size(); ++k) place[k] = repetitions[k][i];
        result[i] = median(place);
    }
    return result;
}

double average(const std::vector<double>& values) {
    if (values.empty()) return 0;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double largest(const std::vector<double>& values) {
    return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

Json originOf(const std::string& suite, Extent extent) {
    const thesis::Machine machine = thesis::thisMachine({});
    return {{"suite", suite},
            {"extent", extent == Extent::full ? "full" : "quick"},
            {"version", version},
            {"date", today()},
            {"machine", {{"processor", machine.processor}, {"cores", machine.cores}, {"system", machine.system}}},
            {"load_average", loadAverage()},
            {"compiler", machine.compiler},
            {"flags", CAIRN_BENCH_FLAGS}};
}

Scene benchScene(const std::string& name) {
    if (name.starts_with(heavy)) return heavyScene(name);
    if (isBuiltInScene(name)) return builtInScene(name);
    if (std::filesystem::exists(name)) return readScene(name);
    throw InputError(fmt::format(
        "there is no scene and no file '{}'; scenes are those of 'cairn scenes' and heavy:RATIO, such as heavy:1000",
        name));
}

Scene shortened(Scene scene, double seconds) {
    scene.duration = std::min(scene.duration, seconds);
    return scene;
}

}  // namespace cairn::bench
