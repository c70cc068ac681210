/// @file Materials and what happens where two of them touch.
#pragma once

#include <string>

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
    /// Greatest torque against rolling over the normal force [m], ≥ 0; 0 = rolls freely, as in the thesis.
    double rolling_friction = 0;
    double spinning_friction = 0;  ///< likewise for the torque about the normal [m], ≥ 0
};

}  // namespace cairn
