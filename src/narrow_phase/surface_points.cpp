#include "narrow_phase/surface_points.h"

#include <algorithm>
#include <cmath>

namespace cairn {

bool meetsSegment(const Bounds& box, const Vec3& begin, const Vec3& end) {
    double enter = 0;
    double leave = 1;
    for (Eigen::Index k = 0; k < 3; ++k) {
        const double way = end[k] - begin[k];
        if (way == 0) {
            if (begin[k] < box.lower[k] || begin[k] > box.upper[k]) return false;
            continue;
        }
        const double lower = (box.lower[k] - begin[k]) / way;
        const double upper = (box.upper[k] - begin[k]) / way;
        enter = std::max(enter, std::min(lower, upper));
        leave = std::min(leave, std::max(lower, upper));
    }
    return enter <= leave;
}

TriangleFeature featureAt(const std::array<Vec3, 3>& corners, const Vec3& point, double tolerance) {
    using Kind = TriangleFeature::Kind;
    TriangleFeature nearest;
    double least = tolerance;
    for (std::uint8_t k = 0; k < 3; ++k) {
        if ((point - corners[k]).norm() <= tolerance) return {Kind::corner, k};
        const Vec3 edge = corners[(k + 1U) % 3U] - corners[k];
        const double apart = edge.cross(point - corners[k]).norm() / edge.norm();
        if (!(apart <= least)) continue;
        least = apart;
        nearest = {Kind::edge, k};
    }
    return nearest;
}

void addApart(FacePointList& points, const ManifoldPoint& point, double together) {
    for (ManifoldPoint& other : points) {
        if ((other.point - point.point).squaredNorm() > together * together) continue;
        if (point.distance < other.distance - 1e-3 * together) other = point;
        return;
    }
    points.push_back(point);
}

namespace {

struct FlatPoint {
    Eigen::Vector2d at;
    std::size_t index;
};

double turnOf(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
    const Eigen::Vector2d u = b.at - a.at;
    const Eigen::Vector2d v = c.at - a.at;
    return (u.x() * v.y() - u.y() * v.x()) / std::max((c.at - a.at).norm(), 1e-300);
}

/// Andrew's chain of the corners on one side, without the last.
void addChain(const std::vector<FlatPoint>& sorted, double tolerance, std::vector<std::size_t>& corners) {
    std::vector<FlatPoint> chain;
    for (const FlatPoint& p : sorted) {
        while (chain.size() > 1 && turnOf(chain[chain.size() - 2], chain.back(), p) <= tolerance) chain.pop_back();
        chain.push_back(p);
    }
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) corners.push_back(chain[i].index);
}

}  // namespace

void keepOutermost(FacePointList& points, const Vec3& normal, double tolerance) {
    if (points.size() < 3) return;
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    std::vector<FlatPoint> flat;
    for (std::size_t i = 0; i < points.size(); ++i) {
        flat.push_back({{u.dot(points[i].point), v.dot(points[i].point)}, i});
    }
    std::ranges::sort(flat, [](const FlatPoint& a, const FlatPoint& b) {
        return std::tuple(a.at.x(), a.at.y(), a.index) < std::tuple(b.at.x(), b.at.y(), b.index);
    });
    std::vector<std::size_t> corners;
    addChain(flat, tolerance, corners);
    std::ranges::reverse(flat);
    addChain(flat, tolerance, corners);
    const auto deepest = std::ranges::min_element(points, {}, &ManifoldPoint::distance);
    const auto deepest_index = static_cast<std::size_t>(deepest - points.begin());
    if (corners.size() >= Manifold::capacity) {
        constexpr std::size_t most = Manifold::capacity - 1;
        for (std::size_t i = 0; i < most; ++i) corners[i] = corners[i * corners.size() / most];
        corners.resize(most);
    }
    if (std::ranges::find(corners, deepest_index) == corners.end()) corners.push_back(deepest_index);
    std::ranges::sort(corners);
    FacePointList kept;
    for (const std::size_t i : corners) kept.push_back(points[i]);
    points = std::move(kept);
}

}  // namespace cairn
