/// @file Convex shapes as each other sees them when they touch: where they reach farthest in a direction and what of
/// them faces it. All shapes that are no spheres or half-spaces can meet through this.
#pragma once

#include "cairn/shape.h"
#include "narrow_phase/features.h"

namespace cairn {

/// What of a shape's core faces a direction: one corner, a line of two or a face of three and more.
struct Feature {
    ConvexPolygon corners;
    Plane face{};            ///< of a face, outward
    double disc_radius = 0;  ///< of a face that is a disc, whose corners stand on its rim; otherwise 0 [m]
    Vec3 disc_centre = Vec3::Zero();

    bool isFace() const { return corners.size > 2; }
    bool isLine() const { return corners.size == 2; }
};

/// A triangle of a surface as convex shapes meet it.
struct ConvexTriangle {
    std::array<Vec3, 3> corners;  ///< in the frame of the convex shapes
    Vec3 normal;                  ///< unit, about which the corners run counter-clockwise
};

/// A posed convex shape: all points within a radius of its core. Its frame has the axes of W and an origin near both
/// bodies.
class Convex {
  public:
    /// @param pose of the shape's frame @param origin of this frame [m, W]
    Convex(const Sphere& sphere, const Pose& pose, const Vec3& origin);
    Convex(const Box& box, const Pose& pose, const Vec3& origin);
    Convex(const Capsule& capsule, const Pose& pose, const Vec3& origin);
    Convex(const Cylinder& cylinder, const Pose& pose, const Vec3& origin);
    Convex(const ConvexHull& hull, const Pose& pose, const Vec3& origin);
    /// @param triangle in this frame; must live as long
    explicit Convex(const ConvexTriangle& triangle);

    /// The point of the core farthest in a direction of any length. @return [m]
    Vec3 support(const Vec3& direction) const;
    /// @param direction unit
    void findFeature(const Vec3& direction, Feature& feature) const;

    /// Whether the sides are those of a tube about the shape's z axis.
    bool isTube() const { return kind_ == Kind::line || kind_ == Kind::cylinder; }
    Vec3 tubeAxis() const { return axes_.col(2); }               ///< unit @pre isTube()
    double tubeRadius() const { return half_.x() + rounding_; }  ///< [m] @pre isTube()

    const Vec3& centre() const { return centre_; }
    double rounding() const { return rounding_; }  ///< radius around the core [m]
    double reach() const { return reach_; }        ///< farthest point of the core from the centre [m]
    double smallest() const { return smallest_; }  ///< smallest half extent [m]

  private:
    enum class Kind : std::uint8_t { point, box, line, cylinder, hull, triangle };

    void findBoxFace(const Vec3& direction, Feature& feature) const;
    void findHullFace(const Vec3& direction, Feature& feature) const;
    void findTriangleFace(const Vec3& direction, Feature& feature) const;
    void findLine(const Vec3& direction, Feature& feature) const;
    void findCylinderFeature(const Vec3& direction, Feature& feature) const;
    void addCap(const Vec3& direction, double end, Feature& feature) const;

    Kind kind_;
    Mat3 axes_ = Mat3::Identity();  ///< shape's frame to W
    Vec3 centre_;
    const HullData* hull_ = nullptr;
    const ConvexTriangle* triangle_ = nullptr;
    Vec3 hull_origin_ = Vec3::Zero();  ///< of the frame of a hull's corners
    Vec3 half_ = Vec3::Zero();         ///< half extents; of a cylinder radius, radius and half length
    double rounding_ = 0;
    double reach_ = 0;
    double smallest_ = 0;
};

/// Any solid shape but a compound.
Convex convexOf(const Shape& shape, const Pose& pose, const Vec3& origin);

/// Of the corners of a larger face so many stand for it, evenly spread.
inline constexpr std::size_t most_face_corners = 16;

/// Corners that stand for the rim of a disc.
inline constexpr int rim_corners = 8;

/// The body-fixed direction, across the axis, of one of the corners of a rim. @param index < rim_corners
Eigen::Vector2d rimDirection(int index);

/// A tilted disc reaches lower than the corners of its rim. From this depth on, as a part of its radius, it needs a
/// corner of its own at its lowest point; below it the corners hold as well and stay where they are.
inline constexpr double rim_part = 1e-5;

/// A corner of a rim closer to its lowest point than this part of the radius gives way to it.
inline constexpr double rim_spacing = 0.4;

}  // namespace cairn
