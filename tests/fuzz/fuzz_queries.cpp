/// Any question about two shapes in any poses has a finite answer that agrees with the others.
#include <cmath>

#include "cairn/query.h"
#include "fuzz/bytes.h"
#include "geometry/geometry.h"

namespace {

using namespace cairn;

bool isUnit(const Vec3& v) {
    return std::abs(v.norm() - 1) < 1e-9;
}

double sizeOf(const Shape& shape) {
    return isInfinite(shape) ? 1 : largestRadius(shape);
}

void askRay(fuzz::Bytes& in, const Shape& shape, const Pose& pose) {
    const Ray ray{in.vector(10), in.vector(1), in.below(2) == 0 ? 5 : std::abs(in.number(100))};
    const auto hit = castRay(shape, pose, ray);
    if (!hit) return;
    fuzz::require(hit->distance >= 0 && hit->distance <= ray.reach);
    fuzz::require(hit->point.allFinite() && isUnit(hit->normal));
    fuzz::require(hit->normal.dot(ray.direction) <= 0);
}

void askPair(fuzz::Bytes& in, const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    const bool meet = overlap(a, pose_a, b, pose_b);
    fuzz::require(overlap(b, pose_b, a, pose_a) == meet || !contactsOf(a, pose_a, b, pose_b, 1e-6).empty());
    for (const ShapeContact& contact : contactsOf(a, pose_a, b, pose_b, 0.01)) {
        fuzz::require(contact.point.allFinite() && isUnit(contact.normal) && contact.distance <= 0.01);
    }
    if (isInfinite(a)) return;
    const ClosestPoints closest = closestPoints(a, pose_a, b, pose_b);
    fuzz::require(std::isfinite(closest.distance) && isUnit(closest.normal));
    fuzz::require(closest.on_a.allFinite() && closest.on_b.allFinite());
    fuzz::require((closest.distance <= 0) == meet);
    const auto hit = castShape(a, pose_a, in.vector(10), b, pose_b);
    if (!hit) {
        fuzz::require(closest.distance > 0);
        return;
    }
    fuzz::require(std::isfinite(hit->distance) && hit->distance >= 0);
    fuzz::require(hit->point.allFinite() && isUnit(hit->normal));
    fuzz::require(hit->distance >= closest.distance - 1e-6 * (sizeOf(a) + sizeOf(b)));
}

void ask(fuzz::Bytes& in) {
    const Shape a = fuzz::anyShape(in);
    const Shape b = fuzz::anyShape(in);
    const Pose pose_a{Vec3(in.within(1), in.within(1), in.within(1)), fuzz::rotation(in)};
    const double reach = sizeOf(a) + sizeOf(b);
    const Pose pose_b{Vec3(in.within(reach), in.within(reach), in.within(reach)), fuzz::rotation(in)};
    askRay(in, a, pose_a);
    askPair(in, a, pose_a, b, pose_b);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes in(data, size);
    try {
        ask(in);
    } catch (const InputError&) {
        return 0;  // numbers that no shape or ray may have
    }
    return 0;
}
