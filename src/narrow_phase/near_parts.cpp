#include "narrow_phase/near_parts.h"

#include <algorithm>

#include "geometry/bounds_tree.h"

namespace cairn {

NearParts::NearParts(const Compound& compound, const Pose& pose, const Shape& other, const Pose& other_pose,
                     const Bounds& bounds, double margin) {
    const auto* ground = std::get_if<HalfSpace>(&other);
    if (compound.tree && ground != nullptr) {
        findAt(*ground, pose.inverse().toOuter(other_pose), *compound.tree, margin);
    } else if (compound.tree && bounds.lower.allFinite() && bounds.upper.allFinite()) {
        // The bounds turned into the frame of the compound, in bounds of their own.
        const double slack = 1e-12 * pose.position.cwiseAbs().maxCoeff();
        const Vec3 half = 0.5 * (bounds.upper - bounds.lower) + Vec3::Constant(margin + slack);
        const Vec3 centre = pose.toInner(0.5 * (bounds.upper + bounds.lower));
        const Vec3 extent = pose.orientation.conjugate().toRotationMatrix().cwiseAbs() * half;
        compound.tree->forEachOverlapping(widened({centre - extent, centre + extent}),
                                          [this](std::uint32_t part) { add(part); });
    } else {
        all_ = true;
    }
    if (all_) {
        count_ = compound.parts.size();
    } else {
        std::sort(parts_.begin(), parts_.begin() + count_);
    }
}

void NearParts::add(std::uint32_t part) {
    if (count_ == most) all_ = true;
    if (!all_) parts_[count_++] = part;
}

void NearParts::findAt(const HalfSpace& ground, const Pose& ground_in_compound, const BoundsTree& tree, double margin) {
    const Vec3 normal = ground_in_compound.orientation * ground.normal.normalized();
    const double height = ground.offset + normal.dot(ground_in_compound.position) + margin;
    // As the rounding of bounds; what is far from the origin is found early.
    const double slack = 1e-9 * (std::abs(height) + ground_in_compound.position.norm());
    const auto reaches = [&](const Bounds& bounds) {
        const Vec3 half = 0.5 * (bounds.upper - bounds.lower);
        const double lowest = normal.dot(bounds.lower + half) - normal.cwiseAbs().dot(half);
        return lowest <= height + slack;
    };
    tree.forEachWhere(reaches, [this](std::uint32_t part) { add(part); });
}

}  // namespace cairn
