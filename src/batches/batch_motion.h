/// @file How the bodies of a batch move: what the wrappers of resolutions note and ask.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "batches/batches.h"
#include "body/body_storage.h"
#include "body/contact.h"
#include "math/arrays.h"

namespace cairn {

/// The velocities of a body.
struct BodyMotion {
    Vec3 v;  ///< [m/s, W]
    Vec3 w;  ///< [rad/s, W]
};

inline bool isAtRest(const BodyState& bodies, BodyIndex i) {
    return bodies.v[i].isZero(0) && bodies.w[i].isZero(0) && (bodies.surface.empty() || bodies.surface[i].isZero(0));
}

/// @param motion out, one entry per body; keeps its memory
inline void saveMotion(std::span<const BodyIndex> saved, const BodyState& bodies, std::vector<BodyMotion>& motion) {
    resizeTightly(motion, saved.size());
    for (std::size_t n = 0; n < saved.size(); ++n) motion[n] = {bodies.v[saved[n]], bodies.w[saved[n]]};
}

/// ϑA − ϑB [m/s, W]. @source thesis (3.4.1)
inline Vec3 relativeVelocity(const Contact& contact, const BodyState& bodies) {
    const auto at = [&](BodyIndex i) -> Vec3 {
        return bodies.v[i] + bodies.w[i].cross(contact.pointOn(i) - bodies.position[i]) +
               bodies.surfaceVelocity(i, contact.normal);
    };
    return at(contact.a) - at(contact.b);
}

/// Its normal part [m/s]; negative = the contact closes. @source thesis (3.4.2)
inline double normalVelocity(const Contact& contact, const BodyState& bodies) {
    return contact.normal.dot(relativeVelocity(contact, bodies));
}

/// Whether some fixed body, or its surface, moves.
inline bool doSupportsMove(const BodyState& bodies) {
    for (BodyIndex i = 0; i < bodies.size(); ++i) {
        if (bodies.isFixed(i) && !isAtRest(bodies, i)) return true;
    }
    return false;
}

/// Whether no fixed body that moves touches the batch.
inline bool hasStillSupports(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
    if (!bodies.supports_move) return true;
    const auto holds = [&](BodyIndex i) { return !bodies.isFixed(i) || isAtRest(bodies, i); };
    return std::ranges::all_of(batch.contacts,
                               [&](std::uint32_t i) { return holds(contacts[i].a) && holds(contacts[i].b); });
}

}  // namespace cairn
