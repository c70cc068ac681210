/// @file Materials and what happens where two of them touch.
#pragma once

#include <string>
#include <vector>

namespace cairn {

/// What a body is made of.
struct Material {
    std::string name;    ///< unique in a world, not empty
    double density = 0;  ///< [kg/m³], > 0
};

/// Contact properties of a pair of materials.
struct PairProperties {
    double restitution = 0.25;      ///< coefficient of restitution, 0 to 1
    double static_friction = 0.2;   ///< Coulomb's µs, ≥ 0
    double kinetic_friction = 0.2;  ///< Coulomb's µk, 0 to µs
    /// Greatest torque against rolling over the normal force [m], ≥ 0; 0 = rolls freely, as in the thesis. Bodies that
    /// touch in an area whose points are spread by as much resist by where they press instead.
    double rolling_friction = 0;
    double spinning_friction = 0;  ///< likewise for the torque about the normal [m], ≥ 0
};

/// A value that depends on a speed: on straight lines between points, constant before the first and after the last.
struct SpeedCurve {
    std::vector<double> speeds{};  ///< [m/s], ≥ 0, ascending; none = the property does not depend on speed
    std::vector<double> values{};  ///< as many
};

/// How properties of a pair of materials depend on the velocity with which two bodies meet at a contact, as it is in a
/// step when the forces have acted. What has no curve stays as PairProperties say.
struct PairLaw {
    SpeedCurve restitution{};  ///< over the speed with which they close along the normal; values 0 to 1
    /// Kinetic friction over the speed with which they slide; values ≥ 0. Static friction is at least as large.
    SpeedCurve friction{};
};

}  // namespace cairn
