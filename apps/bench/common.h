/// @file What the suites of `cairn bench` share: progress, medians, and where figures come from.
#pragma once

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cairn/scene.h"

namespace cairn::bench {

using Json = nlohmann::ordered_json;

/// Somebody asked to stop.
struct Interrupted {};

/// Told often while a suite runs. @param part that is done, 0 to 1 @throws Interrupted
using Progress = std::function<void(double part, const std::string& what)>;

/// How much is run.
enum class Extent {
    full,  ///< everything
    quick  ///< shortened, once: shows that it works; the numbers do not count
};

/// The longest that a scene runs in a quick measurement [s].
inline constexpr double quick_seconds = 0.5;

/// Cairn with other settings, beside the one that every run has.
struct Variant {
    std::string name;
    std::vector<std::pair<std::string, std::string>> fields;  ///< added to the overrides of all
    std::optional<Preset> preset{};                           ///< in place of that of all
};

/// What a variant changes, on top of what is changed for all.
SettingOverrides combined(SettingOverrides all, const Variant& variant);

/// What a suite found.
struct Outcome {
    std::string table;  ///< for the terminal
    Json json;          ///< origin, suite and entries
};

/// Time that has passed.
struct Times {
    double wall_ms = 0;
    double processor_ms = 0;  ///< that the threads of this program ran; on a busy machine less than the wall time
};

/// Measures from its making on.
class Stopwatch {
  public:
    Stopwatch();
    Times read() const;

  private:
    std::chrono::steady_clock::time_point wall_;
    double processor_ms_;
};

/// The middle value; of an even number the mean of the two in the middle. @param values not empty
double median(std::vector<double> values);
/// Median of each place over the repetitions. @param repetitions of equal length, not empty
std::vector<double> medians(const std::vector<std::vector<double>>& repetitions);
double average(const std::vector<double>& values);
double largest(const std::vector<double>& values);

/// The head of a suite's JSON: suite, version, date, machine, compiler and flags. The commit is added by
/// tools/bench_record, since a program does not know what its sources have become.
Json originOf(const std::string& suite, Extent extent);

/// A scene of the benchmarks: a built-in one, a scene file, or "heavy:RATIO", a box that carries one RATIO times as
/// heavy. @throws InputError, IoError
Scene benchScene(const std::string& name);
/// A scene for `seconds` at most.
Scene shortened(Scene scene, double seconds);

}  // namespace cairn::bench
