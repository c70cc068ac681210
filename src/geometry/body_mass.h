/// @file Mass, centre of mass and inertia of a body.
#pragma once

#include <optional>

#include "cairn/shape.h"

namespace cairn {

/// What is given by hand, in the frame of the shape.
struct GivenMass {
    std::optional<double> mass;   ///< [kg]
    std::optional<Vec3> centre;   ///< of mass [m]
    std::optional<Mat3> inertia;  ///< about the centre of mass [kg·m²]
};

/// Mass properties of a body.
struct BodyMass {
    double mass;         ///< [kg]
    Vec3 inertia;        ///< principal moments about the centre of mass [kg·m², B]
    Pose body_in_shape;  ///< of B, centre of mass and principal axes, in the frame of the shape
};

/// @param density of the material [kg/m³]; parts of compounds may have their own, or a mass
/// A given mass scales what shape and densities give. Without an inertia that of the solid about its own centre of mass
/// holds, also where another centre is given.
/// @pre validateShape(shape), finite
/// @throws InputError if what is given is not finite, or no body has such an inertia
BodyMass bodyMass(const Shape& shape, double density, const GivenMass& given);

}  // namespace cairn
