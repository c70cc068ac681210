/// @file Motion by a law: where a body, or the frame of the whole world, is as a function of time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "cairn/types.h"

namespace cairn {

/// Moves and turns at constant rates, like a belt's roller, a drum or a piston.
struct ConstantMotion {
    Vec3 velocity = Vec3::Zero();  ///< [m/s, W]
    Vec3 spin = Vec3::Zero();      ///< [rad/s, W]
};

/// Swings like a shake table: x(t) = amplitude·(sin(2π·frequency·t + phase) − sin(phase)), so that it begins where the
/// body is; with the phase π/2 it begins at rest.
struct SineMotion {
    Vec3 amplitude = Vec3::Zero();  ///< of the displacement [m, W]
    Vec3 turn = Vec3::Zero();       ///< of the rotation vector [rad, W]
    double frequency = 1;           ///< [Hz], > 0
    double phase = 0;               ///< [rad]
};

/// What a table does after its last time.
enum class TableEnd : std::uint8_t {
    hold,    ///< stays where it is
    repeat,  ///< begins anew; first and last entry must be the same place
};

/// Goes through given places at given times, on cubic curves with continuous velocity. Displacements and turns count
/// from the first entry, so that the body begins where it is.
struct TableMotion {
    std::vector<double> times;        ///< from the beginning of the motion, ascending, at least two [s]
    std::vector<Vec3> displacements;  ///< as many [m, W], or none
    std::vector<Vec3> turns;          ///< rotation vectors, as many [rad, W], or none
    /// As many [m/s, W]; or none: then those of a smooth curve, at rest at both ends unless the table repeats.
    std::vector<Vec3> velocities{};
    TableEnd end = TableEnd::hold;  ///< what comes after the last time
};

/// Any law of motion.
using Motion = std::variant<ConstantMotion, SineMotion, TableMotion>;

/// How an accelerogram is brought to an end.
enum class Baseline : std::uint8_t {
    none,     ///< as recorded: an offset of the instrument grows to a drift
    at_rest,  ///< less the straight line in time after which it ends at rest where it began
};

/// The motion that has accelerations which are straight lines between samples, from rest.
/// @param interval between two samples [s], > 0 @param accelerations at least two [m/s², W]
/// @throws InputError if they are not finite or too few
TableMotion integrateAccelerogram(double interval, std::span<const Vec3> accelerations, Baseline baseline);

}  // namespace cairn
