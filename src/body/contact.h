/// @file The contact: the only thing the response knows of geometry.
#pragma once

#include <cstdint>

#include "body/body_storage.h"

namespace cairn {

/// Two bodies touching (or about to) in one point. Body a always has the smaller slot index.
struct Contact {
    BodyIndex a = 0;
    BodyIndex b = 0;
    Vec3 point = Vec3::Zero();    ///< [m, W]
    Vec3 normal = Vec3::UnitX();  ///< n̂_BA_W: unit, from B to A
    double distance = 0;          ///< along the normal [m]; negative = overlap
    double restitution = 0;
    double static_friction = 0;
    double kinetic_friction = 0;
    Vec3 last_impulse = Vec3::Zero();  ///< that A received here in the last step [N·s, W]; zero for a new contact
    Vec3 impulse = Vec3::Zero();       ///< sum of what A received in this step [N·s, W]; B received the opposite
};

}  // namespace cairn
