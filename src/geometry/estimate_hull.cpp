/// Estimates of hulls without building them.
#include <algorithm>
#include <array>

#include "geometry/convex_part.h"

namespace cairn {

namespace {

constexpr int bins = 10;       ///< of directions, along each edge of a cube
constexpr int directions = 7;  ///< of supports, along each edge of a cube
constexpr int cube_sides = 6;

/// A frame in which points lie in the cube from −1 to 1.
struct CubeFrame {
    Vec3 middle, scale;

    explicit CubeFrame(const std::vector<Vec3>& points) {
        Vec3 lower = points.front();
        Vec3 upper = lower;
        for (const Vec3& p : points) {
            lower = lower.cwiseMin(p);
            upper = upper.cwiseMax(p);
        }
        middle = 0.5 * (lower + upper);
        scale = 0.5 * (upper - lower);
        scale = scale.cwiseMax(std::max(1e-9 * scale.maxCoeff(), std::numeric_limits<double>::min()));
    }
    Vec3 operator()(const Vec3& p) const { return (p - middle).cwiseQuotient(scale); }
};

/// A direction to a point on the side of a cube; sides 3 to 5 are those below zero. @param u, v from −1 to 1
Vec3 towards(int side, double u, double v) {
    Vec3 direction;
    direction[side % 3] = side < 3 ? 1 : -1;
    direction[(side + 1) % 3] = u;
    direction[(side + 2) % 3] = v;
    return direction;
}

/// The point that is farthest along a direction; the first of several.
const Vec3& support(const std::vector<Vec3>& points, const Vec3& direction) {
    const Vec3* best = &points.front();
    double farthest = direction.dot(*best);
    for (const Vec3& p : points) {
        const double along = direction.dot(p);
        if (along > farthest) {
            farthest = along;
            best = &p;
        }
    }
    return *best;
}

}  // namespace

std::vector<Vec3> farthestOf(std::vector<Vec3> points) {
    struct Farthest {
        double distance = 0;
        std::size_t point = 0;
    };
    std::array<Farthest, std::size_t{cube_sides} * bins * bins> farthest{};
    if (points.size() <= farthest.size()) return points;
    const CubeFrame frame(points);
    const auto binOf = [](double x) { return std::clamp(static_cast<int>(0.5 * (x + 1) * bins), 0, bins - 1); };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 q = frame(points[i]);
        Eigen::Index axis = 0;
        const double largest = q.cwiseAbs().maxCoeff(&axis);
        if (!(largest > 0)) continue;
        const int side = static_cast<int>(axis) + (q[axis] < 0 ? 3 : 0);
        const int bin = (side * bins + binOf(q[(axis + 1) % 3] / largest)) * bins + binOf(q[(axis + 2) % 3] / largest);
        Farthest& there = farthest[static_cast<std::size_t>(bin)];
        if (q.squaredNorm() > there.distance) there = {q.squaredNorm(), i};
    }
    std::vector<Vec3> kept;
    for (const Farthest& one : farthest) {
        if (one.distance > 0) kept.push_back(points[one.point]);
    }
    return kept;
}

double volumeWithin(const std::vector<Vec3>& points) {
    if (points.empty()) return 0;
    const CubeFrame frame(points);
    std::vector<Vec3> scaled;
    scaled.reserve(points.size());
    for (const Vec3& p : points) scaled.push_back(frame(p));
    double six = 0;
    for (int side = 0; side < cube_sides; ++side) {
        std::array<std::array<Vec3, directions>, directions> corner;
        const auto at = [](int i) { return 2.0 * i / (directions - 1) - 1; };
        for (int i = 0; i < directions; ++i) {
            for (int j = 0; j < directions; ++j) {
                corner[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
                    support(scaled, towards(side, at(i), at(j)));
            }
        }
        double outward = 0;
        for (std::size_t i = 0; i + 1 < directions; ++i) {
            for (std::size_t j = 0; j + 1 < directions; ++j) {
                const Vec3 across = corner[i + 1][j + 1] - corner[i][j];
                const Vec3 up = corner[i][j + 1] - corner[i][j];
                const Vec3 right = corner[i + 1][j] - corner[i][j];
                outward += corner[i][j].dot(right.cross(across) + across.cross(up));
            }
        }
        six += side < 3 ? outward : -outward;
    }
    return six / 6 * frame.scale.prod();
}

}  // namespace cairn
