/// Any two shapes in any poses give finite contacts with a unit normal, and swapped the opposite ones.
#include <cmath>

#include "fuzz/bytes.h"
#include "geometry/geometry.h"
#include "geometry/half_space.h"
#include "narrow_phase/narrow_phase.h"

namespace {

using namespace cairn;

bool isTube(const Shape& shape) {
    return std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Capsule>(shape);
}

/// Largest error of a distance as a part of the lengths. Of two cylinders whose axes are up to 0.1 rad from parallel
/// the caps are taken for circles also when seen along the other's axis, and sides are measured between the axes: of
/// the radii both leave out 1 − cos(0.1). A capsule's side is one of these. Everything else is known up to rounding.
double depthError(const Shape& a, const Shape& b) {
    return isTube(a) && isTube(b) ? 5e-3 : 1e-9;
}

/// How high a shape reaches along a direction: its own for a half-space. @param direction [W], unit @return [m]
double heightOf(const Shape& shape, const Pose& pose, const Vec3& direction) {
    if (const auto* plane = std::get_if<HalfSpace>(&shape)) {
        fuzz::require((pose.orientation * unitNormal(*plane) - direction).norm() < 1e-9);
        return direction.dot(pose.position) + plane->offset;
    }
    return direction.dot(pose.position + pose.orientation * support(shape, pose.orientation.conjugate() * direction));
}

/// The distance of two shapes along a direction, and so the least that a contact with this normal may have.
/// @param normal from B to A
double distanceAlong(const Vec3& normal, const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    return -heightOf(a, pose_a, -normal) - heightOf(b, pose_b, normal);
}

void collideSome(fuzz::Bytes& in) {
    const Shape a = fuzz::shape(in);
    const Shape b = fuzz::shape(in);
    const Quat turn = fuzz::rotation(in);
    const Pose pose_a{Vec3(in.within(1), in.within(1), in.within(1)), turn};
    double reach = 0;
    for (const Shape* shape : {&a, &b}) reach += isInfinite(*shape) ? 1 : largestRadius(*shape);
    const Vec3 offset(in.within(reach), in.within(reach), in.within(reach));
    const Pose pose_b{pose_a.position + (in.below(8) == 0 ? Vec3(0, 0, 0) : offset),
                      in.below(2) == 0 ? turn : fuzz::rotation(in)};
    const double margin = in.below(2) == 0 ? 1e-4 : std::abs(in.within(0.1));
    Manifold manifold;
    collide(a, pose_a, b, pose_b, margin, manifold);
    fuzz::require(manifold.size <= Manifold::capacity);
    Manifold swapped;
    collide(b, pose_b, a, pose_a, margin, swapped);
    fuzz::require((swapped.size == 0) == (manifold.size == 0));
    if (manifold.size == 0) return;
    fuzz::require(std::abs(manifold.normal.norm() - 1) < 1e-9);
    // Where two centres coincide no direction is better than its opposite.
    const bool concentric = pose_a.position == pose_b.position;
    fuzz::require(concentric || (swapped.normal + manifold.normal).norm() < 1e-9);
    const double deepest = distanceAlong(manifold.normal, a, pose_a, b, pose_b) - depthError(a, b) * reach;
    for (std::size_t i = 0; i < manifold.size; ++i) {
        fuzz::require(manifold.points[i].point.allFinite());
        fuzz::require(manifold.points[i].distance <= margin && manifold.points[i].distance >= deepest);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes in(data, size);
    try {
        collideSome(in);
    } catch (const InputError&) {
        return 0;  // the points of a hull were flat
    }
    return 0;
}
