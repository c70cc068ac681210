/// @file No resolution may raise the kinetic energy of a batch.
#pragma once

#include "resolution/resolution.h"

namespace cairn {

/// Wraps a resolution that begins with the impulses of the last step and ends early. Where it raised the kinetic energy
/// of a batch, it begins anew without those impulses; if the energy is still above what it was, all impulses are taken
/// by the one factor below 1 that leaves it as it was, which keeps momentum and the friction cones. Limits of joints
/// take energy only. Batches with motors or on a moving support are left alone: those may give energy.
std::unique_ptr<Resolution> makeEnergyBound(std::unique_ptr<Resolution> resolution);

}  // namespace cairn
