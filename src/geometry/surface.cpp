#include <cmath>

#include "geometry/surface_data.h"

namespace cairn {

namespace {

/// Sine by which a direction may miss the region of an edge or corner: directions of contacts are known to less.
constexpr double region_slack = 1e-4;

template <class T>
std::size_t bytesOf(const std::vector<T>& values) {
    return values.capacity() * sizeof(T);
}

/// A ray turned and sheared so that it runs along z.
struct ShearedRay {
    std::array<Eigen::Index, 3> axis;
    Vec3 shear;
    Vec3 origin;

    explicit ShearedRay(const LocalRay& ray) : origin(ray.origin) {
        Eigen::Index z = 0;
        ray.direction.cwiseAbs().maxCoeff(&z);
        axis = {(z + 1) % 3, (z + 2) % 3, z};
        shear = Vec3(ray.direction[axis[0]], ray.direction[axis[1]], 1) / ray.direction[z];
    }
    Vec3 turned(const Vec3& p) const {
        const Vec3 from = p - origin;
        const double z = from[axis[2]];
        return {from[axis[0]] - shear[0] * z, from[axis[1]] - shear[1] * z, shear[2] * z};
    }
};

/// How a ray meets the plane of three corners within them. Of an edge, whichever side asks gets the same number, so
/// that no ray passes between two neighbours.
std::optional<double> distanceAlong(const ShearedRay& ray, const std::array<Vec3, 3>& corners) {
    const Vec3 a = ray.turned(corners[0]);
    const Vec3 b = ray.turned(corners[1]);
    const Vec3 c = ray.turned(corners[2]);
    const double u = c.x() * b.y() - c.y() * b.x();
    const double v = a.x() * c.y() - a.y() * c.x();
    const double w = b.x() * a.y() - b.y() * a.x();
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return {};
    const double sum = u + v + w;
    if (sum == 0) return {};
    const double distance = (u * a.z() + v * b.z() + w * c.z()) / sum;
    if (!(distance >= 0)) return {};
    return distance;
}

std::optional<LocalHit> hitOf(const SurfaceData& surface, std::uint32_t triangle, const LocalRay& ray,
                              const ShearedRay& sheared) {
    const Vec3& normal = surface.face(triangle).normal;
    const bool from_behind = normal.dot(ray.direction) > 0;
    if (from_behind && surface.sides == SurfaceSides::one) return {};
    const std::optional<double> distance = distanceAlong(sheared, surface.corners(triangle));
    if (!distance) return {};
    return LocalHit{*distance, from_behind ? Vec3(-normal) : normal, triangle};
}

/// The direction, across an edge, in which a triangle lies beside it.
Vec3 besideEdge(const Vec3& begin, const Vec3& end, const Vec3& opposite) {
    const Vec3 along = (end - begin).normalized();
    const Vec3 from = opposite - begin;
    return (from - from.dot(along) * along).normalized();
}

/// The corner of a triangle that is none of two vertices.
const Vec3& thirdCorner(const SurfaceData& surface, std::uint32_t triangle, std::uint32_t a, std::uint32_t b) {
    std::size_t k = 0;
    while (k < 2 && (surface.triangles[triangle][k] == a || surface.triangles[triangle][k] == b)) ++k;
    return surface.corner(triangle, k);
}

bool isOutwardOfEdge(const SurfaceData& surface, std::uint32_t triangle, std::size_t k, const Vec3& direction) {
    const std::uint32_t a = surface.triangles[triangle][k];
    const std::uint32_t b = surface.triangles[triangle][(k + 1) % 3];
    const Vec3& begin = surface.vertices[a];
    const Vec3& end = surface.vertices[b];
    if (direction.dot(besideEdge(begin, end, surface.corner(triangle, (k + 2) % 3))) > region_slack) return false;
    Vec3 normal = surface.face(triangle).normal;
    if (const std::uint32_t other = surface.across[triangle][k]; other != SurfaceData::none) {
        const Vec3& opposite = thirdCorner(surface, other, a, b);
        if (direction.dot(besideEdge(begin, end, opposite)) > region_slack) return false;
        normal += surface.face(other).normal;
    }
    return surface.sides == SurfaceSides::two || direction.dot(normal) >= -region_slack;
}

bool isOutwardOfCorner(const SurfaceData& surface, std::uint32_t vertex, const Vec3& direction) {
    const Vec3& tip = surface.vertices[vertex];
    Vec3 normal = Vec3::Zero();
    for (const std::uint32_t triangle : surface.fan(vertex)) {
        std::size_t k = 0;
        while (k < 2 && surface.triangles[triangle][k] != vertex) ++k;
        const Vec3 u = (surface.corner(triangle, (k + 1) % 3) - tip).normalized();
        const Vec3 v = (surface.corner(triangle, (k + 2) % 3) - tip).normalized();
        if (direction.dot(u) > region_slack || direction.dot(v) > region_slack) return false;
        normal += std::atan2(u.cross(v).norm(), u.dot(v)) * surface.face(triangle).normal;
    }
    return surface.sides == SurfaceSides::two || direction.dot(normal) >= -region_slack;
}

}  // namespace

std::size_t SurfaceData::bytes() const {
    return bytesOf(vertices) + bytesOf(triangles) + bytesOf(across) + bytesOf(face_of) + bytesOf(faces) +
           bytesOf(fan_begin) + bytesOf(fans) + tree.bytes();
}

std::optional<LocalHit> castRay(const SurfaceData& surface, const LocalRay& ray, double reach) {
    const ShearedRay sheared(ray);
    std::optional<LocalHit> best;
    // Rounding at the faces of a box must not hide a triangle that lies in one.
    const double slack = 1e-9 * (surface.radius + ray.origin.norm());
    double farthest = reach + slack;
    surface.tree.forEachAlong(
        {ray.origin, ray.direction, Vec3::Constant(slack)}, farthest, [&](std::uint32_t triangle) {
            const std::optional<LocalHit> hit = hitOf(surface, triangle, ray, sheared);
            if (!hit || hit->distance > reach) return;
            if (best &&
                (hit->distance > best->distance || (hit->distance == best->distance && triangle > best->part))) {
                return;
            }
            best = hit;
            farthest = hit->distance + slack;
        });
    return best;
}

std::optional<LocalHit> castRayAt(const SurfaceData& surface, std::uint32_t triangle, const LocalRay& ray) {
    return hitOf(surface, triangle, ray, ShearedRay(ray));
}

ClosestOnTriangle closestOnTriangle(const std::array<Vec3, 3>& corners, const Vec3& p) {
    using Kind = TriangleFeature::Kind;
    const auto& [a, b, c] = corners;
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double d1 = ab.dot(p - a);
    const double d2 = ac.dot(p - a);
    if (d1 <= 0 && d2 <= 0) return {a, {Kind::corner, 0}};
    const double d3 = ab.dot(p - b);
    const double d4 = ac.dot(p - b);
    if (d3 >= 0 && d4 <= d3) return {b, {Kind::corner, 1}};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + d1 / (d1 - d3) * ab, {Kind::edge, 0}};
    const double d5 = ab.dot(p - c);
    const double d6 = ac.dot(p - c);
    if (d6 >= 0 && d5 <= d6) return {c, {Kind::corner, 2}};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + d2 / (d2 - d6) * ac, {Kind::edge, 2}};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), {Kind::edge, 1}};
    }
    const double sum = va + vb + vc;
    return {a + vb / sum * ab + vc / sum * ac, {}};
}

bool isWithinFace(const SurfaceData& surface, std::uint32_t triangle, const TriangleFeature& feature) {
    if (feature.kind == TriangleFeature::Kind::inside) return true;
    if (feature.kind == TriangleFeature::Kind::edge) return !surface.isBorder(triangle, feature.index);
    const std::uint32_t vertex = surface.triangles[triangle][feature.index];
    for (const std::uint32_t other : surface.fan(vertex)) {
        if (surface.face_of[other] != surface.face_of[triangle]) return false;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool meets = surface.triangles[other][k] == vertex || surface.triangles[other][(k + 1) % 3] == vertex;
            if (meets && surface.isBorder(other, k)) return false;
        }
    }
    return true;
}

bool isOutward(const SurfaceData& surface, std::uint32_t triangle, const TriangleFeature& feature,
               const Vec3& direction) {
    if (feature.kind == TriangleFeature::Kind::edge) {
        return isOutwardOfEdge(surface, triangle, feature.index, direction);
    }
    return isOutwardOfCorner(surface, surface.triangles[triangle][feature.index], direction);
}

}  // namespace cairn
