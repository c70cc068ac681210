/// @file Mass of several solids together.
#pragma once

#include "geometry/geometry.h"

namespace cairn {

/// What a part of a compound adds: its mass, with the shape's own properties.
struct PartMass {
    double mass;
    const CompoundPart& part;
    UnitMassProperties unit;
};

/// Mass, principal moments, centre and axes of all parts, in place of volume and moments for density 1.
UnitMassProperties combine(std::span<const PartMass> parts);

}  // namespace cairn
