/// @file How far two convex cores are apart, or along which direction they overlap least.
#pragma once

#include <array>
#include <optional>

#include "narrow_phase/convex.h"

namespace cairn {

/// A point of A − B, all differences of a point of A and one of B.
struct Difference {
    Vec3 w;  ///< a − b [m]
    Vec3 a;  ///< the point of A [m]

    Difference() = default;
    Difference(const Convex& shape_a, const Convex& shape_b, const Vec3& direction)
        : w(shape_a.support(direction)), a(w) {
        w -= shape_b.support(-direction);
    }
    Vec3 b() const { return a - w; }
};

/// The closest points of two cores, or those of least overlap.
struct Separation {
    Vec3 normal = Vec3::UnitX();  ///< unit, from A to B
    double distance = 0;          ///< along the normal [m]; negative = overlap
    Vec3 on_a = Vec3::Zero();
    Vec3 on_b = Vec3::Zero();
};

/// @param limit cores farther apart than this are of no interest [m], ≥ 0
/// @return false if they are
bool separate(const Convex& a, const Convex& b, double limit, Separation& separation);

/// Four points of A − B.
using Tetrahedron = std::array<Difference, 4>;

/// What the search for the closest points of A and B found.
struct Closeness {
    enum class Kind { beyond, apart, touching } kind;
    std::optional<Tetrahedron> around{};  ///< the origin, where cores that touch overlap enough to have one
};

/// Closest points of two cores. @source Gilbert, Johnson, Keerthi 1988, doi:10.1109/56.2083
/// @param separation is set if they are apart; cores apart by less than rounding allows to tell count as touching
Closeness findClosest(const Convex& a, const Convex& b, double limit, Separation& separation);

/// The direction of least overlap of two cores that touch or overlap: grows a polytope inside A − B towards its facet
/// nearest to the origin. A facet beyond which the origin lies counts as near as it separates, so that touching is no
/// special case.
/// @param around the polytope to begin with, unless it is none or flat @param direction a first guess otherwise, not
/// zero
void findLeastOverlap(const Convex& a, const Convex& b, const std::optional<Tetrahedron>& around, const Vec3& direction,
                      Separation& separation);

}  // namespace cairn
