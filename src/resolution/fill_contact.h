/// @file What visits need of contacts, computed in lanes.
#pragma once

#include <span>

#include "resolution/contact_law.h"
#include "resolution/lane_contact.h"
#include "resolution/resolution.h"

namespace cairn {

/// Where the contacts of lanes come from.
struct Sources {
    OfLanes<const Contact> contacts{};     ///< in all lanes: one that is not filled repeats another
    std::array<bool, lane_count> fills{};  ///< else the lane gets a contact that no impulse can change
};

/// @param a, b the bodies @param position [slots] [m, W]
[[gnu::always_inline]] inline void fillContact(WideContact& wide, const PgsBody<Lanes>& a, const PgsBody<Lanes>& b,
                                               const Sources& sources, std::span<const Vec3> position,
                                               const ResolutionSettings& settings) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const Contact& contact = *sources.contacts[lane];
        setLane(wide.normal, lane, contact.normal);
        setLane(wide.r_a, lane, contact.pointOn(contact.a) - position[contact.a]);
        setLane(wide.r_b, lane, contact.pointOn(contact.b) - position[contact.b]);
        setLane(wide.impulse, lane, sources.fills[lane] ? contact.last_impulse : Vec3(Vec3::Zero()));
        setLane(wide.friction, lane, contact.static_friction);
    }
    BasicSymmetric3<Lanes> k;
    addCollisionMatrix(a.mass_inv, a.inertia_inv, wide.r_a, k);
    addCollisionMatrix(b.mass_inv, b.inertia_inv, wide.r_b, k);
    setInvertible(wide, k);
    const Lanes closing = wide.normal.dot(relativeVelocity(wide, a, b));
    const bool regular = isRegular(wide);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        if (!sources.fills[lane]) {
            setMasses(wide, lane, PgsContact{});
            continue;
        }
        if (!regular) {
            PgsContact contact = laneOf(wide, lane);
            mendSingular(contact);
            setMasses(wide, lane, contact);
        }
        setLane(wide.target, lane,
                ContactLaw::separatingSpeed(settings, *sources.contacts[lane], laneOf(closing, lane)));
    }
    const auto pushes = (wide.normal.dot(wide.impulse) > 0) & (wide.normal_mass > 0);
    wide.impulse = where(pushes, wide.impulse, Triple<Lanes>());
}

/// Likewise. What turns begins with nothing.
[[gnu::always_inline]] inline void fillContact(WideRollingContact& wide, const PgsBody<Lanes>& a,
                                               const PgsBody<Lanes>& b, const Sources& sources,
                                               std::span<const Vec3> position, const ResolutionSettings& settings) {
    WideContact& plain = wide;
    fillContact(plain, a, b, sources, position, settings);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        setLane(wide.rolling, lane, sources.contacts[lane]->rolling_friction);
        setLane(wide.spinning, lane, sources.contacts[lane]->spinning_friction);
    }
    wide.turning = {};
    wide.squared_lever = Lanes{};
    BasicCoupling<Lanes> coupling;
    BasicSymmetric3<Lanes> turn_k;
    const auto add = [&](const BasicSymmetric3<Lanes>& i, const Triple<Lanes>& r) __attribute__((always_inline)) {
        addCoupling(i, r, coupling);
        turn_k = {turn_k.xx + i.xx, turn_k.xy + i.xy, turn_k.xz + i.xz,
                  turn_k.yy + i.yy, turn_k.yz + i.yz, turn_k.zz + i.zz};
        const Lanes lever = where(i.xx + i.yy + i.zz > 0, r.squaredNorm(), Lanes{});
        wide.squared_lever = where(lever > wide.squared_lever, lever, wide.squared_lever);
    };
    add(a.inertia_inv, wide.r_a);
    add(b.inertia_inv, wide.r_b);
    setTurning(wide, turn_k, coupling);
}

}  // namespace cairn
