/// @file The machine of the measurements, and how fast it is beside the thesis's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace cairn::thesis {

/// PassMark's single-thread ratings, rounded, as an estimate of how much faster a newer core is with the same program.
/// Public user-submitted averages; they scatter by several per cent. @source https://www.cpubenchmark.net
inline constexpr double rating_e6400 = 803;
inline constexpr double rating_i7_940 = 1240;

/// What is known about this machine.
struct Machine {
    std::string processor;
    std::string system;
    std::string compiler;
    std::int64_t cores = 1;
    std::optional<double> rating;  ///< single-thread, if the processor is known or was given
    std::string rating_source;
};

/// @param rating given by the user
Machine thisMachine(std::optional<double> rating);

}  // namespace cairn::thesis
