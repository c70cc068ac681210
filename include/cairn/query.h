/// @file Questions about shapes where they are: what a ray or a moving shape hits, what overlaps, how far apart they
/// are. World asks them of its bodies; the functions here ask them of two shapes and need no world. What is asked of a
/// shape with parts names the part, of a mesh or height field the triangle; of all other shapes the part is 0. Surfaces
/// of one side are seen by rays from this side only.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "cairn/filter.h"
#include "cairn/shape.h"
#include "cairn/types.h"

namespace cairn {

/// A half line, or a line with an end.
struct Ray {
    Vec3 origin = Vec3::Zero();                              ///< [m, W]
    Vec3 direction = Vec3::UnitX();                          ///< [W], any length but zero
    double reach = std::numeric_limits<double>::infinity();  ///< farthest distance of a hit [m], ≥ 0
};

/// Where a ray first meets a shape. One that begins inside meets it at once: distance 0, the normal against the ray.
struct SurfaceHit {
    double distance = 0;          ///< from the origin of the ray [m]
    Vec3 point = Vec3::Zero();    ///< [m, W]
    Vec3 normal = Vec3::UnitX();  ///< of the surface: unit, outward, W
    std::uint32_t part = 0;       ///< index in Compound::parts, or in triangles of a mesh or height field
};

/// Where a shape that moves without turning first touches another. Shapes that overlap or touch at the beginning have
/// the distance 0; the normal is then the direction in which they part soonest.
struct ShapeHit {
    double distance = 0;            ///< that the moving shape goes until then [m]
    Vec3 point = Vec3::Zero();      ///< on the other shape [m, W]; one of many where faces or edges touch
    Vec3 normal = Vec3::UnitX();    ///< unit, from the other shape to the moving one, W
    std::uint32_t moving_part = 0;  ///< of the moving shape
    std::uint32_t part = 0;         ///< of the other shape
};

/// The points in which two shapes are closest, or overlap deepest.
struct ClosestPoints {
    double distance = 0;          ///< along the normal [m]; negative = overlap
    Vec3 on_a = Vec3::Zero();     ///< on the surface of A [m, W]
    Vec3 on_b = Vec3::Zero();     ///< on the surface of B [m, W]
    Vec3 normal = Vec3::UnitX();  ///< unit, from B to A, W
    std::uint32_t part_a = 0;     ///< of A
    std::uint32_t part_b = 0;     ///< of B
};

/// One point in which two shapes touch, as a step of the world finds it.
struct ShapeContact {
    Vec3 point;                    ///< halfway between the surfaces [m, W]
    Vec3 normal;                   ///< unit, from B to A, W
    double distance;               ///< along the normal [m]; negative = overlap
    std::uint32_t part_a, part_b;  ///< of A and of B
};

/// A body that a ray hits.
struct RayHit : SurfaceHit {
    BodyId body{};  ///< which one
};

/// A body that a moving shape hits.
struct BodyHit : ShapeHit {
    BodyId body{};  ///< which one
};

/// A part of a body that overlaps a shape.
struct Overlap {
    BodyId body{};           ///< which one
    std::uint32_t part = 0;  ///< of the body

    friend bool operator==(const Overlap&, const Overlap&) = default;
};

/// A body near a shape.
struct NearBody {
    BodyId body{};          ///< which one
    ClosestPoints closest;  ///< A is the shape, B the body
};

/// Which bodies a question is about: of all that are no sensors …
struct QueryFilter {
    std::span<const BodyId> except{};   ///< not these; ids that are stale are no error
    std::span<const GroupId> groups{};  ///< only those that are in one of these, which there must be; empty = all
};

// Every function below throws InputError for shapes out of range, for poses, rays and ways that are not finite or
// farther than 1e9 m, and for a direction of length zero; those of a world also for a group that it does not have.

/// Where a ray meets a shape. @param pose of the shape in W
std::optional<SurfaceHit> castRay(const Shape& shape, const Pose& pose, const Ray& ray);

/// Where a shape that moves along a line touches another. Ends exact to about 1e-7 of the smaller shape.
/// @param moving, pose where it begins @param way [m, W], not zero: it stops at its end @param other, other_pose stays
/// @throws InputError for a half-space that moves
/// @source Newton's method on the distance, which is convex along the way; conservative advancement,
/// Mirtich 1996
std::optional<ShapeHit> castShape(const Shape& moving, const Pose& pose, const Vec3& way, const Shape& other,
                                  const Pose& other_pose);

/// Whether two shapes have a point in common. Two half-spaces count as apart.
bool overlap(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);

/// Closest points and signed distance of two shapes. Of compounds that overlap, the two parts that overlap deepest
/// count. @throws InputError for two half-spaces
ClosestPoints closestPoints(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);

/// The contacts of two shapes, by part of A and then of B. @param margin up to this distance [m], ≥ 0
std::vector<ShapeContact> contactsOf(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                     double margin);

}  // namespace cairn
