/// @file A law of motion in the form in which it is evaluated.
#pragma once

#include <optional>

#include "cairn/motion.h"

namespace cairn {

/// Displacement and rotation since the beginning of a motion.
struct Excursion {
    Vec3 displacement = Vec3::Zero();  ///< [m, W]
    Vec3 turn = Vec3::Zero();          ///< rotation vector [rad, W]
};

/// Evaluates a motion at any time. Copies are cheap where they are shared.
class MotionCurve {
  public:
    /// @throws InputError with the member, its value and what is allowed
    explicit MotionCurve(Motion motion);

    const Motion& motion() const { return motion_; }
    /// @param time since the beginning of the motion [s]
    Excursion at(double time) const;
    /// When it comes to its end and holds, since the beginning of the motion [s]; none = never.
    std::optional<double> end() const;
    /// Whether it turns.
    bool turns() const;
    /// Whether its velocity is the same at all times.
    bool isEven() const { return std::holds_alternative<ConstantMotion>(motion_) && !turns(); }

  private:
    Excursion ofTable(const TableMotion& table, double time) const;

    Motion motion_;
    std::vector<Vec3> velocities_;  ///< of a table [entries] [m/s, W]
    std::vector<Vec3> spins_;       ///< of a table: time derivatives of the rotation vectors [entries] [rad/s]
};

}  // namespace cairn
