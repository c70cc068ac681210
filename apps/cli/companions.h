/// @file The programs that stand beside `cairn` and are started by it, as git starts its own.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace cairn::cli {

/// A program beside this one.
struct Companion {
    std::string_view program;      ///< its file, and the target that builds it
    std::string_view command;      ///< the subcommand of `cairn` that starts it
    std::string_view description;  ///< one line for --help
};

inline constexpr Companion view_companion{"cairn-view", "view", "Show a running scene or recordings in the browser"};
inline constexpr Companion bench_companion{"cairn-bench", "bench", "Measure"};
inline constexpr Companion thesis_companion{"cairn-bench-thesis", "thesis",
                                            "Repeat every benchmark of the thesis and write a report"};
inline constexpr Companion validate_companion{"cairn-validate", "validate",
                                              "Measure the physics against closed forms and experiments"};

/// Becomes the companion: returns only by throwing. @throws IoError that names the command that builds it
[[noreturn]] void becomeCompanion(const Companion& companion, const std::vector<std::string>& arguments);

/// Runs the companion to its end; what it prints is printed. @return its exit code, 128 or more after a signal
/// @throws IoError that names the command that builds it
int runCompanion(const Companion& companion, const std::vector<std::string>& arguments);

}  // namespace cairn::cli
