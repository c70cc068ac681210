#include "geometry/half_space.h"
#include "geometry/hull_data.h"
#include "narrow_phase/convex.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

namespace {

/// Adds a corner. @param corner from the origin of A [m] @param origin height of that origin above the plane [m]
void addCorner(const Vec3& corner, double origin, const Pose& pose_a, double margin, Manifold& manifold) {
    const double height = origin + manifold.normal.dot(corner);
    if (height <= margin) manifold.add(pose_a.position + (corner - 0.5 * height * manifold.normal), height);
}

}  // namespace

void hullHalfSpace(const ConvexHull& a, const Pose& pose_a, const HalfSpace& b, const Pose& pose_b, double margin,
                   Manifold& manifold) {
    const Vec3 normal = pose_b.orientation * unitNormal(b);
    const double origin = normal.dot(pose_a.position - pose_b.position) - b.offset;
    const Mat3 axes = pose_a.orientation.toRotationMatrix();
    const Vec3 up = axes.transpose() * normal;
    const HullData& hull = a.data();
    std::size_t low = 0;
    for (const Vec3& corner : hull.corners) low += origin + up.dot(corner) <= margin ? 1 : 0;
    if (low == 0) return;
    manifold.normal = normal;
    if (low <= Manifold::capacity) {
        for (const Vec3& corner : hull.corners) addCorner(axes * corner, origin, pose_a, margin, manifold);
        return;
    }
    // Too many: those of the lowest face, and the deepest.
    const Convex convex(a, pose_a, pose_a.position);
    Feature feature;
    convex.findFeature(-normal, feature);
    const Vec3 deepest = convex.support(-normal);
    feature.corners.size = std::min(feature.corners.size, Manifold::capacity - 1);
    bool has_deepest = false;
    for (std::size_t i = 0; i < feature.corners.size; ++i) {
        has_deepest = has_deepest || feature.corners.corners[i] == deepest;
        addCorner(feature.corners.corners[i], origin, pose_a, margin, manifold);
    }
    if (!has_deepest) addCorner(deepest, origin, pose_a, margin, manifold);
}

}  // namespace cairn
