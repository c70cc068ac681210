/// @file Volume, centre and inertia of a solid with flat faces.
#pragma once

#include "geometry/geometry.h"

namespace cairn {

/// Sums over tetrahedra between one point and triangles of the surface. With edges a, b, c from that point a
/// tetrahedron has the volume det/6 with det = a·(b × c), its first moment det/24·(a + b + c) and its second one
/// det/120·(aaᵀ + bbᵀ + ccᵀ + ssᵀ) with s = a + b + c.
class TetrahedronSums {
  public:
    /// @param a, b, c corners of a triangle, counter-clockwise seen from outside, less the common point
    void add(const Vec3& a, const Vec3& b, const Vec3& c) {
        const double det = a.dot(b.cross(c));
        const Vec3 s = a + b + c;
        volume_ += det / 6;
        first_ += det / 24 * s;
        second_ += det / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
    double volume() const { return volume_; }
    Vec3 centre() const { return first_ / volume_; }  ///< less the common point
    /// About the centre, for density 1.
    Mat3 inertia() const {
        const Vec3 middle = centre();
        const Mat3 about = second_ - volume_ * middle * middle.transpose();
        return about.trace() * Mat3::Identity() - about;
    }

  private:
    double volume_ = 0;
    Vec3 first_ = Vec3::Zero();
    Mat3 second_ = Mat3::Zero();
};

}  // namespace cairn
