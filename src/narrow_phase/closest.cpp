#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "narrow_phase/separation.h"

namespace cairn {

namespace {

/// Cores closer than this part of their size touch: what is left of their difference by rounding has no direction.
constexpr double touching_part = 1e-8;

/// Relative error of the distance that ends the search.
constexpr double distance_error = 1e-10;

/// Round shapes need more of them than polyhedra, which end by themselves.
constexpr int most_iterations = 100;

/// Up to four points of A − B and the weights of the point of their hull closest to the origin.
struct Simplex {
    std::size_t size = 0;
    std::array<Difference, 4> points;
    std::array<double, 4> weights{};

    Vec3 onA() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < size; ++i) sum += weights[i] * points[i].a;
        return sum;
    }
    bool holds(const Vec3& w) const {
        return std::any_of(points.begin(), points.begin() + size, [&](const Difference& p) { return p.w == w; });
    }
};

/// Some of a simplex's points, ascending, with the weights of their point closest to the origin.
struct Face {
    std::size_t size = 0;
    std::array<std::size_t, 3> corners{};
    std::array<double, 3> weights{};
    double squared = std::numeric_limits<double>::infinity();

    void offer(const Face& other) {
        if (other.squared < squared) *this = other;
    }
    Vec3 closest(const Simplex& s) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < size; ++i) sum += weights[i] * s.points[corners[i]].w;
        return sum;
    }
};

void reduce(Simplex& s, const Face& face) {
    s.size = face.size;
    for (std::size_t i = 0; i < face.size; ++i) {
        s.points[i] = s.points[face.corners[i]];
        s.weights[i] = face.weights[i];
    }
}

Face closestOfPoint(const Simplex& s, std::size_t i) {
    return {1, {i}, {1}, s.points[i].w.squaredNorm()};
}

/// Only the inside of the edge; its ends are tried as points.
Face closestOfEdge(const Simplex& s, std::size_t i, std::size_t j) {
    const Vec3& p = s.points[i].w;
    const Vec3 edge = s.points[j].w - p;
    const double length = edge.squaredNorm();
    const double part = -p.dot(edge);
    if (!(part > 0 && part < length)) return {};
    const double t = part / length;
    return {2, {i, j}, {1 - t, t}, (p + t * edge).squaredNorm()};
}

/// Only the inside of the triangle.
Face closestOfTriangle(const Simplex& s, std::size_t i, std::size_t j, std::size_t k) {
    const Vec3& p = s.points[i].w;
    const Vec3 u = s.points[j].w - p;
    const Vec3 v = s.points[k].w - p;
    const Vec3 normal = u.cross(v);
    const double area = normal.squaredNorm();
    if (!(area > 1e-24 * u.squaredNorm() * v.squaredNorm())) return {};
    const double t = normal.dot(v.cross(p)) / area;
    const double r = normal.dot(p.cross(u)) / area;
    if (!(t > 0 && r > 0 && t + r < 1)) return {};
    const double height = normal.dot(p);
    return {3, {i, j, k}, {1 - t - r, t, r}, height * height / area};
}

/// Whether the origin is within a tetrahedron, on the same side of each face as the corner opposite to it.
bool holdsOrigin(const Simplex& s) {
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3& p = s.points[(i + 1) % 4].w;
        const Vec3 normal = (s.points[(i + 2) % 4].w - p).cross(s.points[(i + 3) % 4].w - p);
        const double corner = normal.dot(s.points[i].w - p);
        if (!(normal.dot(-p) * corner > 0)) return false;
    }
    return true;
}

/// The face of a simplex that holds its point closest to the origin. Only faces with the last point, which was added
/// because it leads closer than all others. @return none if the simplex holds the origin
std::optional<Face> closestFace(const Simplex& s) {
    if (s.size == 4 && holdsOrigin(s)) return {};
    const std::size_t last = s.size - 1;
    Face best = closestOfPoint(s, last);
    for (std::size_t i = 0; i < last; ++i) {
        best.offer(closestOfEdge(s, i, last));
        for (std::size_t j = i + 1; j < last; ++j) best.offer(closestOfTriangle(s, i, j, last));
    }
    return best;
}

}  // namespace

Closeness findClosest(const Convex& a, const Convex& b, double limit, Separation& separation) {
    using Kind = Closeness::Kind;
    const Vec3 centres = b.centre() - a.centre();
    Simplex simplex;
    simplex.size = 1;
    simplex.points[0] = Difference(a, b, centres.isZero(0) ? Vec3(Vec3::UnitX()) : centres);
    simplex.weights[0] = 1;
    const double touching = touching_part * (a.reach() + b.reach() + centres.norm());
    Vec3 v = simplex.points[0].w;
    double distance = v.norm();
    for (int i = 0; i < most_iterations && distance > touching; ++i) {
        const Difference next(a, b, -v);
        const double at_least = next.w.dot(v) / distance;
        if (at_least > limit) return {Kind::beyond};
        if (distance - at_least <= distance_error * distance || simplex.holds(next.w)) break;
        simplex.points[simplex.size++] = next;
        const std::optional<Face> face = closestFace(simplex);
        if (!face) return {Kind::touching, simplex.points};
        const Vec3 closest = face->closest(simplex);
        const double closer = closest.norm();
        if (!(closer < distance)) {  // rounding ends the descent
            --simplex.size;
            break;
        }
        reduce(simplex, *face);
        v = closest;
        distance = closer;
    }
    if (!(distance > touching)) return {Kind::touching};
    if (distance > limit) return {Kind::beyond};
    separation.on_a = simplex.onA();
    separation.on_b = separation.on_a - v;
    separation.normal = -v / distance;
    separation.distance = distance;
    return {Kind::apart};
}

bool separate(const Convex& a, const Convex& b, double limit, Separation& separation) {
    const Vec3 centres = b.centre() - a.centre();
    const double reach = a.reach() + b.reach() + limit;
    if (!(centres.squaredNorm() <= reach * reach)) return false;
    const Closeness closeness = findClosest(a, b, limit, separation);
    if (closeness.kind != Closeness::Kind::touching) return closeness.kind == Closeness::Kind::apart;
    const Vec3 direction = centres.isZero(0) ? Vec3(Vec3::UnitX()) : centres;
    findLeastOverlap(a, b, closeness.around, direction, separation);
    return separation.distance <= limit;
}

}  // namespace cairn
