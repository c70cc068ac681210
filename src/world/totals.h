/// @file Energy and momentum of all dynamic bodies, summed without rounding: the same bits whoever has which body.
#pragma once

#include "body/body_storage.h"
#include "math/exact_sum.h"

namespace cairn {

ExactSum kineticEnergyOf(const BodyStorage& bodies);  ///< [J]
/// [J], zero at the origin. @param acceleration sum of the global accelerations [m/s², W]
ExactSum potentialEnergyOf(const BodyStorage& bodies, const Vec3& acceleration);
ExactVectorSum linearMomentumOf(const BodyStorage& bodies);   ///< [N·s, W]
ExactVectorSum angularMomentumOf(const BodyStorage& bodies);  ///< about the origin [N·m·s, W]

}  // namespace cairn
