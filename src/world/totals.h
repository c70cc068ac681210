/// @file Energy and momentum of all dynamic bodies.
#pragma once

#include "body/body_storage.h"

namespace cairn {

double kineticEnergyOf(const BodyStorage& bodies);  ///< [J]
/// [J], zero at the origin. @param acceleration sum of the global accelerations [m/s², W]
double potentialEnergyOf(const BodyStorage& bodies, const Vec3& acceleration);
Vec3 linearMomentumOf(const BodyStorage& bodies);   ///< [N·s, W]
Vec3 angularMomentumOf(const BodyStorage& bodies);  ///< about the origin [N·m·s, W]

}  // namespace cairn
