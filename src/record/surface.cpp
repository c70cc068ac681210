#include "record/surface.h"

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "geometry/hull_data.h"
#include "geometry/surface_data.h"

namespace cairn {

namespace {

// Enough that a ball looks round; thousands of them in hundreds of frames must still fit on a disk.
constexpr int segments = 12;      ///< around the axis
constexpr int rings_per_cap = 3;  ///< from a pole to the equator

void addPolygon(Surface& surface, std::initializer_list<std::int32_t> corners) {
    surface.corners.insert(surface.corners.end(), corners);
    surface.ends.push_back(static_cast<std::int32_t>(surface.corners.size()));
}

Surface boxSurface(const Box& box) {
    Surface surface;
    for (int i = 0; i < 8; ++i) {
        const Vec3 sign((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5);
        surface.points.emplace_back(sign.cwiseProduct(box.size));
    }
    addPolygon(surface, {0, 4, 6, 2});
    addPolygon(surface, {1, 3, 7, 5});
    addPolygon(surface, {0, 1, 5, 4});
    addPolygon(surface, {2, 6, 7, 3});
    addPolygon(surface, {0, 2, 3, 1});
    addPolygon(surface, {4, 5, 7, 6});
    return surface;
}

/// A capsule about z; a sphere if half_length is zero.
Surface roundSurface(double radius, double half_length) {
    Surface surface;
    const auto addRing = [&](double latitude, double shift) {
        for (int s = 0; s < segments; ++s) {
            const double longitude = 2 * std::numbers::pi * s / segments;
            surface.points.emplace_back(radius * std::cos(latitude) * std::cos(longitude),
                                        radius * std::cos(latitude) * std::sin(longitude),
                                        radius * std::sin(latitude) + shift);
        }
    };
    int rings = 0;
    for (int r = 1; r <= rings_per_cap; ++r, ++rings) {
        addRing(std::numbers::pi / 2 * (r - rings_per_cap) / rings_per_cap, -half_length);
    }
    // A sphere has one equator, a capsule two.
    for (int r = half_length > 0 ? 0 : 1; r < rings_per_cap; ++r, ++rings) {
        addRing(std::numbers::pi / 2 * r / rings_per_cap, half_length);
    }
    const auto south = static_cast<std::int32_t>(surface.points.size());
    surface.points.emplace_back(0, 0, -half_length - radius);
    surface.points.emplace_back(0, 0, half_length + radius);
    const auto at = [](int ring, int s) { return ring * segments + s % segments; };
    for (int s = 0; s < segments; ++s) {
        addPolygon(surface, {south, at(0, s + 1), at(0, s)});
        for (int r = 0; r + 1 < rings; ++r) {
            addPolygon(surface, {at(r, s), at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)});
        }
        addPolygon(surface, {at(rings - 1, s), at(rings - 1, s + 1), south + 1});
    }
    return surface;
}

Surface cylinderSurface(const Cylinder& cylinder) {
    Surface surface;
    constexpr int around = 2 * segments;
    for (const double end : {-0.5, 0.5}) {
        for (int s = 0; s < around; ++s) {
            const double longitude = 2 * std::numbers::pi * s / around;
            surface.points.emplace_back(cylinder.radius * std::cos(longitude), cylinder.radius * std::sin(longitude),
                                        end * cylinder.length);
        }
    }
    for (int s = 0; s < around; ++s) {
        const int next = (s + 1) % around;
        addPolygon(surface, {s, next, around + next, around + s});
    }
    for (int s = around - 1; s >= 0; --s) surface.corners.push_back(s);
    surface.ends.push_back(static_cast<std::int32_t>(surface.corners.size()));
    for (int s = 0; s < around; ++s) surface.corners.push_back(around + s);
    surface.ends.push_back(static_cast<std::int32_t>(surface.corners.size()));
    return surface;
}

Surface planeSurface(const HalfSpace& plane, const PlaneExtent& extent) {
    const Vec3 normal = plane.normal.normalized();
    // The offset is along the unit normal, whatever the length of the given one.
    const Vec3 centre = extent.centre + (plane.offset - normal.dot(extent.centre)) * normal;
    const Vec3 u = normal.unitOrthogonal() * extent.half_edge;
    const Vec3 v = normal.cross(u);
    Surface surface;
    surface.points = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
    addPolygon(surface, {0, 1, 2, 3});
    return surface;
}

Surface hullSurface(const ConvexHull& hull) {
    const HullData& data = hull.data();
    Surface surface;
    surface.points = data.corners;
    for (const HullFace& face : data.faces) {
        for (const std::uint32_t corner : data.loop(face)) {
            surface.corners.push_back(static_cast<std::int32_t>(corner));
        }
        surface.ends.push_back(static_cast<std::int32_t>(surface.corners.size()));
    }
    return surface;
}

Surface trianglesSurface(const SurfaceData& data) {
    Surface surface;
    surface.points = data.vertices;
    for (const TriangleCorners& triangle : data.triangles) {
        for (const std::uint32_t corner : triangle) surface.corners.push_back(static_cast<std::int32_t>(corner));
        surface.ends.push_back(static_cast<std::int32_t>(surface.corners.size()));
    }
    return surface;
}

Surface compoundSurface(const Compound& compound, const PlaneExtent& extent) {
    Surface surface;
    for (const CompoundPart& part : compound.parts) {
        const Surface own = makeSurface(part.shape, extent);
        const auto first_point = static_cast<std::int32_t>(surface.points.size());
        const auto first_corner = static_cast<std::int32_t>(surface.corners.size());
        for (const Vec3& point : own.points) surface.points.push_back(part.pose.toOuter(point));
        for (const std::int32_t corner : own.corners) surface.corners.push_back(first_point + corner);
        for (const std::int32_t end : own.ends) surface.ends.push_back(first_corner + end);
    }
    return surface;
}

}  // namespace

Surface makeSurface(const Shape& shape, const PlaneExtent& extent) {
    struct Visitor {
        const PlaneExtent& extent;
        Surface operator()(const Sphere& s) const { return roundSurface(s.radius, 0); }
        Surface operator()(const Box& b) const { return boxSurface(b); }
        Surface operator()(const Capsule& c) const { return roundSurface(c.radius, c.length / 2); }
        Surface operator()(const Cylinder& c) const { return cylinderSurface(c); }
        Surface operator()(const ConvexHull& h) const { return hullSurface(h); }
        Surface operator()(const Compound& c) const { return compoundSurface(c, extent); }
        Surface operator()(const Mesh& m) const { return trianglesSurface(m.data()); }
        Surface operator()(const HeightField& f) const { return trianglesSurface(f.data()); }
        Surface operator()(const HalfSpace& h) const { return planeSurface(h, extent); }
    };
    return std::visit(Visitor{extent}, shape);
}

}  // namespace cairn
