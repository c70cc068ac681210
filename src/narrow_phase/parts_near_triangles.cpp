#include "narrow_phase/parts_near_triangles.h"

#include <algorithm>

namespace cairn {

std::vector<PartNearTriangle> partsNearTriangles(const Compound& compound, const Pose& pose, const SurfaceData& surface,
                                                 double margin) {
    const Mat3 turn = pose.orientation.toRotationMatrix();
    const Mat3 spread = turn.cwiseAbs();
    // Rounding leaves out nothing.
    const double slack = 1e-12 * pose.position.cwiseAbs().maxCoeff() + 1e-9 * surface.radius;
    const auto place = [&](const Bounds& bounds) -> Bounds {
        const Vec3 half = 0.5 * (bounds.upper - bounds.lower);
        const Vec3 centre = pose.position + turn * (bounds.lower + half);
        const Vec3 extent = spread * half + Vec3::Constant(margin + slack);
        return {centre - extent, centre + extent};
    };
    std::vector<PartNearTriangle> near;
    compound.tree->forEachPair(surface.tree, place, [&](std::uint32_t part, std::uint32_t triangle) {
        near.push_back({part, triangle});
    });
    std::ranges::sort(near);
    return near;
}

}  // namespace cairn
