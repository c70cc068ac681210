/// @file The way of a body between two detections.
#pragma once

#include "cairn/types.h"

namespace cairn {

/// Where a body was moved from, and how far it got.
struct BodyWay {
    /// Places on the way: where the body was detected before, where it began to fly, since the correction had moved it,
    /// and where it has flown.
    static constexpr double detected = 0, begun = 1, flown = 2;

    Pose from;              ///< of the centre of mass, where the body was detected before [m, W]
    Pose begin;             ///< likewise, where it began to fly [m, W]
    Vec3 w = Vec3::Zero();  ///< then [rad/s, W]
    double place = flown;   ///< how far it got

    /// What it flew of its flight, 0 to 1.
    double part() const { return place > begun ? place - begun : 0; }
};

/// Calls visit(member) for all of a way.
template <class AnyWay, class Visit>
void forMembers(AnyWay& way, const Visit& visit) {
    visit(way.from.position);
    visit(way.from.orientation);
    visit(way.begin.position);
    visit(way.begin.orientation);
    visit(way.w);
    visit(way.place);
}

/// A pose on the way of a body. @param now where it is @param place beyond way.place it is there
inline Pose poseOnWay(const Pose& now, const BodyWay& way, double place) {
    const auto between = [](const Pose& from, const Pose& to, double part) -> Pose {
        return {from.position + part * (to.position - from.position), from.orientation.slerp(part, to.orientation)};
    };
    if (place >= way.place) return now;
    if (place == BodyWay::detected) return way.from;
    if (place == BodyWay::begun) return way.begin;
    if (place > BodyWay::begun) return between(way.begin, now, (place - BodyWay::begun) / way.part());
    if (way.place > BodyWay::begun) return between(way.from, way.begin, place);
    return between(way.from, now, place / way.place);
}

}  // namespace cairn
