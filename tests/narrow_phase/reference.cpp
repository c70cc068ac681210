#include "narrow_phase/reference.h"

#include <algorithm>
#include <array>
#include <limits>

namespace cairn::testing {

namespace {

using Mat3L = Eigen::Matrix<Real, 3, 3>;

/// Up to four points.
struct Simplex {
    std::array<Vec3L, 4> points;
    std::size_t size = 0;

    void add(const Vec3L& p) { points[size++] = p; }
};

/// The point closest to the origin of the plane, line or space through points, if it lies between them.
bool closestOfHull(const Simplex& simplex, Vec3L& closest) {
    closest = simplex.points[0];
    const auto edges = static_cast<Eigen::Index>(simplex.size) - 1;
    Mat3L gram = Mat3L::Identity();
    Vec3L right = Vec3L::Zero();
    for (Eigen::Index i = 0; i < edges; ++i) {
        const Vec3L edge = simplex.points[static_cast<std::size_t>(i) + 1] - simplex.points[0];
        right[i] = -edge.dot(simplex.points[0]);
        for (Eigen::Index j = 0; j < edges; ++j) {
            gram(i, j) = edge.dot(simplex.points[static_cast<std::size_t>(j) + 1] - simplex.points[0]);
        }
    }
    const Real determinant = gram.determinant();
    if (!(std::abs(determinant) > 1e-24L * gram.diagonal().prod())) return false;
    const Vec3L weights = gram.inverse() * right;
    if (weights.head(edges).sum() > 1) return false;
    for (Eigen::Index i = 0; i < edges; ++i) {
        if (weights[i] < 0) return false;
        closest += weights[i] * (simplex.points[static_cast<std::size_t>(i) + 1] - simplex.points[0]);
    }
    return true;
}

/// Whether the origin lies within four points.
bool holdsOrigin(const Simplex& simplex) {
    Mat3L edges;
    for (Eigen::Index i = 0; i < 3; ++i) {
        edges.col(i) = simplex.points[static_cast<std::size_t>(i) + 1] - simplex.points[0];
    }
    const Real determinant = edges.determinant();
    if (!(std::abs(determinant) > 1e-16L * edges.colwise().norm().prod())) return false;
    const Vec3L weights = -(edges.inverse() * simplex.points[0]);
    return weights.minCoeff() >= 0 && weights.sum() <= 1;
}

/// Reduces a simplex to the face that holds its point closest to the origin.
Vec3L reduce(Simplex& simplex) {
    if (simplex.size == 4 && holdsOrigin(simplex)) return Vec3L::Zero();
    Vec3L best = Vec3L::Constant(std::numeric_limits<Real>::infinity());
    Simplex best_face;
    const unsigned whole = simplex.size == 4 ? 15 : 1U << simplex.size;
    for (unsigned mask = 1; mask < whole; ++mask) {
        Simplex face;
        for (std::size_t i = 0; i < simplex.size; ++i) {
            if ((mask >> i & 1U) != 0) face.add(simplex.points[i]);
        }
        Vec3L closest;
        if (!closestOfHull(face, closest) || closest.squaredNorm() >= best.squaredNorm()) continue;
        best = closest;
        best_face = face;
    }
    simplex = best_face;
    return best;
}

/// The corner farthest in a direction.
const Vec3L& farthest(const Solid& solid, const Vec3L& n) {
    return *std::max_element(solid.corners.begin(), solid.corners.end(),
                             [&](const Vec3L& p, const Vec3L& q) { return p.dot(n) < q.dot(n); });
}

}  // namespace

Solid::Solid(const Shape& shape, const Pose& pose) {
    const Mat3L axes = pose.orientation.cast<Real>().normalized().toRotationMatrix();
    const Vec3L centre = pose.position.cast<Real>();
    Vec3L half = Vec3L::Zero();
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        radius = sphere->radius;
    } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
        radius = capsule->radius;
        half.z() = 0.5L * capsule->length;
        edge_directions = {axes.col(2)};
    } else {
        half = 0.5L * std::get<Box>(shape).size.cast<Real>();
        edge_directions = {axes.col(0), axes.col(1), axes.col(2)};
        face_normals = edge_directions;
    }
    corners = {centre};
    for (Eigen::Index i = 0; i < 3; ++i) {
        if (half[i] == 0) continue;
        const std::vector<Vec3L> before = corners;
        corners.clear();
        for (const Vec3L& p : before) {
            corners.push_back(p - half[i] * axes.col(i));
            corners.push_back(p + half[i] * axes.col(i));
        }
    }
}

void Solid::move(const Vec3L& by) {
    for (Vec3L& corner : corners) corner += by;
}

Real Solid::fromSurface(const Vec3L& p) const {
    const Solid point(Sphere{}, {p.cast<double>(), Quat::Identity()});
    Solid exact = point;
    exact.corners[0] = p;
    const Real outside = coreDistance(exact, *this).norm();
    if (outside > 0 || face_normals.empty()) return std::abs(outside - radius);
    Real inside = std::numeric_limits<Real>::infinity();
    for (const Vec3L& n : face_normals) {
        inside = std::min({inside, farthest(*this, n).dot(n) - p.dot(n), p.dot(n) - farthest(*this, -n).dot(n)});
    }
    return inside;
}

Vec3L coreDistance(const Solid& a, const Solid& b) {
    Simplex simplex;
    simplex.add(a.corners[0] - b.corners[0]);
    Real size = 0;
    for (const Vec3L& p : a.corners) size = std::max(size, (p - b.corners[0]).norm());
    for (int iteration = 0; iteration < 64; ++iteration) {
        const Vec3L v = reduce(simplex);
        if (simplex.size == 4 || v.norm() <= 1e-14L * size) return Vec3L::Zero();
        const Vec3L support = farthest(a, -v) - farthest(b, v);
        if (v.squaredNorm() - support.dot(v) <= 1e-15L * v.squaredNorm()) return v;
        const Vec3L* end = simplex.points.data() + simplex.size;
        if (std::find<const Vec3L*>(simplex.points.data(), end, support) != end) return v;
        simplex.add(support);
    }
    return reduce(simplex);
}

Real separationAlong(const Solid& a, const Solid& b, const Vec3L& n) {
    return (farthest(a, -n) - farthest(b, n)).dot(n) - a.radius - b.radius;
}

Real gapOf(const Solid& a, const Solid& b) {
    const Real apart = coreDistance(a, b).norm();
    if (apart > 0) return apart - a.radius - b.radius;
    std::vector<Vec3L> normals = a.face_normals;
    normals.insert(normals.end(), b.face_normals.begin(), b.face_normals.end());
    for (const Vec3L& p : a.edge_directions) {
        for (const Vec3L& q : b.edge_directions) {
            if (p.cross(q).norm() > 1e-8L) normals.push_back(p.cross(q).normalized());
        }
    }
    if (normals.empty()) return -a.radius - b.radius;  // the cores are points or lie in one line
    Real result = -std::numeric_limits<Real>::infinity();
    for (const Vec3L& n : normals) result = std::max({result, separationAlong(a, b, n), separationAlong(a, b, -n)});
    return result;
}

}  // namespace cairn::testing
