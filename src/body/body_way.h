/// @file The flight of a body until a detection.
#pragma once

#include "cairn/types.h"

namespace cairn {

/// From where a body flew, and how far it got.
struct BodyWay {
    Pose begin;             ///< of the centre of mass, where it began to fly [m, W]
    Vec3 v = Vec3::Zero();  ///< then [m/s, W]
    Vec3 w = Vec3::Zero();  ///< then [rad/s, W]
    double part = 1;        ///< of its flight that it has flown, 0 to 1
};

/// Calls visit(member) for all of a way.
template <class AnyWay, class Visit>
void forMembers(AnyWay& way, const Visit& visit) {
    visit(way.begin.position);
    visit(way.begin.orientation);
    visit(way.v);
    visit(way.w);
    visit(way.part);
}

/// A pose on the way of a body. @param now where it is @param part of the flight; beyond way.part it is there
inline Pose poseOnWay(const Pose& now, const BodyWay& way, double part) {
    if (part >= way.part) return now;
    if (part == 0) return way.begin;
    const double of_flown = part / way.part;
    return {way.begin.position + of_flown * (now.position - way.begin.position),
            way.begin.orientation.slerp(of_flown, now.orientation)};
}

}  // namespace cairn
