/// @file Planes, segments and polygons: what the testers of shapes with flat faces and straight edges share. Frames are
/// the caller's; all of them are near the bodies, so that nothing is lost far from the origin of W.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <span>

#include "cairn/types.h"

namespace cairn {

/// All points p with normal·p = offset; the normal is a unit vector.
struct Plane {
    Vec3 normal;
    double offset;

    double height(const Vec3& p) const { return normal.dot(p) - offset; }
};

/// The points centre + s·half, −1 ≤ s ≤ 1.
struct Segment {
    Vec3 centre;
    Vec3 half;

    Vec3 at(double s) const { return centre + s * half; }
};

/// Where two segments are closest.
struct SegmentParameters {
    double a;
    double b;
};

/// The closest points of two segments; of parallel ones, one of the closest pairs.
SegmentParameters closestOnSegments(const Segment& a, const Segment& b);
/// The parameter of the point of a segment closest to p.
double closestOnSegment(const Segment& segment, const Vec3& p);

/// A convex polygon in space, its corners in order.
struct ConvexPolygon {
    static constexpr std::size_t capacity = 32;

    std::size_t size = 0;
    std::array<Vec3, capacity> corners;

    void add(const Vec3& corner) {
        assert(size < capacity);
        corners[size++] = corner;
    }
};

/// Cuts away what lies above a plane. @param slack corners up to this height stay as they are [m]: a corner on the
/// plane must not be split in two by rounding
void clip(ConvexPolygon& polygon, const Plane& plane, double slack);

/// Removes corners that stand out from the line between their neighbours by no more than a tolerance [m], unless they
/// are the lowest there: where the edges of two faces are nearly parallel they cross anywhere, and a corner in the
/// middle of a straight edge holds nothing.
/// @param face from which heights are measured
void simplify(ConvexPolygon& polygon, const Plane& face, double tolerance);

/// A point of one shape below or slightly above a face of another.
struct FacePoint {
    Vec3 point;     ///< on the incident shape [m]
    double height;  ///< above the face [m]; negative = inside
};

/// The points of a face contact.
struct FacePoints {
    std::size_t size = 0;
    std::array<FacePoint, ConvexPolygon::capacity> points;
};

/// Collects points of a face contact that are not higher than the margin.
struct FaceCollector {
    Plane face;
    double margin;          ///< [m]
    double merge_distance;  ///< of points closer to each other than this the lower one is kept [m]

    void add(const Vec3& point, FacePoints& points) const;
};

/// The contact of a face with the polygon of another shape that faces it.
/// @param sides planes through the edges of the face, outward, perpendicular to it
/// @param incident is clipped to the sides
void collectFaceContact(const FaceCollector& collector, std::span<const Plane> sides, ConvexPolygon& incident,
                        FacePoints& points);

/// How much more separation another axis must show than a face axis before it is preferred [m]: contacts of resting
/// bodies, whose axes are nearly aligned, must not flip between a face and an edge from step to step.
/// @param face_separation of the face axis [m] @param size smallest half extent of both bodies [m]
double faceAxisBonus(double face_separation, double size);

/// Points of a manifold closer than this part of the smallest edge of their faces are one point: the corners of boxes
/// that stand on each other slightly turned come in pairs which would double the work and hold nothing more.
inline constexpr double merge_part = 1e-3;

}  // namespace cairn
