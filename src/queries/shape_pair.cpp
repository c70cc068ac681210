#include "queries/shape_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/half_space.h"
#include "geometry/surface_data.h"
#include "narrow_phase/separation.h"

namespace cairn {

namespace {

/// Shapes closer than this part of the smaller one are met by one more straight step: the distance is known to
/// little more, and its square is the error of the step.
constexpr double step_part = 1e-7;

/// Cores closer than this part of the smaller shape have no direction that could be trusted.
constexpr double touching_part = 1e-9;

/// Where shapes pass each other closely every step may only halve the gap.
constexpr int most_steps = 100;

/// A shape as a convex one. @param triangle room for that of a surface @pre no half-space, no compound
Convex coreOf(const Placed& placed, const Vec3& origin, ConvexTriangle& triangle) {
    const SurfaceData* surface = surfaceOf(placed.shape);
    if (surface == nullptr) return convexOf(placed.shape, placed.pose, origin);
    for (std::size_t k = 0; k < 3; ++k) {
        triangle.corners[k] = placed.pose.toOuter(surface->corner(placed.triangle, k)) - origin;
    }
    triangle.normal = placed.pose.orientation * surface->face(placed.triangle).normal;
    return Convex(triangle);
}

/// Farthest point in a direction. @param direction unit [W]
Vec3 farthestOf(const Placed& placed, const Vec3& direction) {
    const Vec3 local = placed.pose.orientation.conjugate() * direction;
    const SurfaceData* surface = surfaceOf(placed.shape);
    if (surface == nullptr) return placed.pose.toOuter(support(placed.shape, local));
    const std::array<Vec3, 3> corners = surface->corners(placed.triangle);
    return placed.pose.toOuter(
        *std::ranges::max_element(corners, {}, [&](const Vec3& corner) { return corner.dot(local); }));
}

ClosestPoints swapped(const ClosestPoints& found) {
    return {found.distance, found.on_b, found.on_a, -found.normal, found.part_b, found.part_a};
}

/// The lowest point of a bounded shape above a half-space.
ClosestPoints aboveHalfSpace(const Placed& a, const HalfSpace& ground, const Pose& pose) {
    const Vec3 normal = pose.orientation * unitNormal(ground);
    const Vec3 lowest = farthestOf(a, -normal);
    const double height = normal.dot(lowest - pose.position) - ground.offset;
    return {height, lowest, lowest - height * normal, normal, 0, 0};
}

/// Whether the direction to a shape is known also where it touches: its core is still apart, or it is flat.
bool keepsDirection(const Shape& shape) {
    return std::holds_alternative<Sphere>(shape) || std::holds_alternative<Capsule>(shape) ||
           std::holds_alternative<HalfSpace>(shape);
}

std::optional<ClosestPoints> within(const ClosestPoints& found, double limit) {
    if (found.distance <= limit) return found;
    return {};
}

}  // namespace

std::size_t partCount(const Shape& shape) {
    if (const SurfaceData* surface = surfaceOf(shape)) return surface->triangles.size();
    const auto* compound = std::get_if<Compound>(&shape);
    return compound != nullptr ? compound->parts.size() : 1;
}

Placed placedPart(const Shape& shape, const Pose& pose, std::size_t part) {
    const auto* compound = std::get_if<Compound>(&shape);
    if (compound == nullptr) return {shape, pose, static_cast<std::uint32_t>(part)};
    return {compound->parts[part].shape, pose.toOuter(compound->parts[part].pose)};
}

Bounds boundsOf(const Placed& placed) {
    const SurfaceData* surface = surfaceOf(placed.shape);
    if (surface == nullptr) return boundsOf(placed.shape, placed.pose);
    Vec3 lower = placed.pose.toOuter(surface->corner(placed.triangle, 0));
    Vec3 upper = lower;
    for (std::size_t k = 1; k < 3; ++k) {
        const Vec3 corner = placed.pose.toOuter(surface->corner(placed.triangle, k));
        lower = lower.cwiseMin(corner);
        upper = upper.cwiseMax(corner);
    }
    return {lower, upper};
}

std::optional<ClosestPoints> closestOfParts(const Placed& a, const Placed& b, double limit) {
    const auto* ground_a = std::get_if<HalfSpace>(&a.shape);
    const auto* ground_b = std::get_if<HalfSpace>(&b.shape);
    if (ground_a != nullptr && ground_b != nullptr) return {};
    if (ground_b != nullptr) return within(aboveHalfSpace(a, *ground_b, b.pose), limit);
    if (ground_a != nullptr) return within(swapped(aboveHalfSpace(b, *ground_a, a.pose)), limit);
    const Vec3& origin = a.pose.position;
    ConvexTriangle triangle_a;
    ConvexTriangle triangle_b;
    const Convex convex_a = coreOf(a, origin, triangle_a);
    const Convex convex_b = coreOf(b, origin, triangle_b);
    const double rounding = convex_a.rounding() + convex_b.rounding();
    // A little farther, so that rounding on the way to the distance does not decide what is within the limit.
    const auto isWithin = [&](double distance, Separation& separation) {
        return separate(convex_a, convex_b, (distance + rounding) * (1 + 1e-9), separation);
    };
    Separation found;
    if (!isWithin(limit, found)) return {};
    const Vec3 on_a = origin + found.on_a + convex_a.rounding() * found.normal;
    const Vec3 on_b = origin + found.on_b - convex_b.rounding() * found.normal;
    double distance = found.distance - convex_a.rounding() - convex_b.rounding();
    // A distance of less than rounding tells may come out as an overlap; whether they overlap is decided by a search
    // for nothing farther, in all questions alike.
    Separation touching;
    if (limit > 0 && distance <= 0 && !isWithin(0, touching)) distance = std::numeric_limits<double>::min();
    return within({distance, on_a, on_b, -found.normal, 0, 0}, limit);
}

std::optional<ShapeHit> castPart(const Placed& moving, const Vec3& direction, double reach, const Placed& other) {
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    const double size = std::min(largestRadius(moving.shape), largestRadius(other.shape));
    const bool is_round = keepsDirection(moving.shape) || keepsDirection(other.shape);
    double gone = 0;
    Vec3 normal = Vec3::Zero();
    for (int i = 0; i < most_steps; ++i) {
        const Placed at{moving.shape, {moving.pose.position + gone * direction, moving.pose.orientation}};
        const ClosestPoints closest = closestOfParts(at, other, everywhere).value();
        // Where cores touch, the direction before is the better one.
        if (i == 0 || is_round || closest.distance > touching_part * size) normal = closest.normal;
        if (closest.distance <= 0) return ShapeHit{gone, closest.on_b, normal, 0, 0};
        const double closing = -direction.dot(closest.normal);
        // The distance is convex along the way: where it grows it never shrinks again, and no step goes too far.
        if (!(closing > 0)) return {};
        gone += closest.distance / closing;
        if (gone > reach) return {};
        if (closest.distance <= step_part * size) return ShapeHit{gone, closest.on_b, normal, 0, 0};
    }
    return {};
}

}  // namespace cairn
