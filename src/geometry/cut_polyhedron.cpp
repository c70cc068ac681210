/// Cuts a polyhedron by a plane. Which points are before, in and behind the plane is decided once per point, and the
/// point of an edge in the plane is computed once per edge; all else is bookkeeping of edges, so that both sides are
/// closed whatever the rounding.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "geometry/polyhedron.h"

namespace cairn {

namespace {

/// An edge that a face has on one side of the plane begins (−) or ends (+) in the plane.
struct Crossing {
    double along;  ///< the line in which the face meets the plane [m]
    std::uint32_t point;
    std::int32_t ends;
};

double cross2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// A loop of the new faces, or several that touch.
struct FaceLoop {
    std::vector<PolyhedronEdge> edges;
    double area = 0;  ///< negative of a hole [m²]
};

class Cutter {
  public:
    Cutter(const Polyhedron& solid, const CuttingPlane& plane, double tolerance, Points& points)
        : solid_(solid), plane_(plane), tolerance_(tolerance), points_(points) {
        const std::size_t axis = plane.normal.cwiseAbs().x() < 0.7 ? 0 : 1;
        u_ = plane.normal.cross(Vec3::Unit(static_cast<Eigen::Index>(axis))).normalized();
        v_ = plane.normal.cross(u_);
    }

    std::pair<Polyhedron, Polyhedron> cut() {
        classify();
        for (const PolyhedronFace& face : solid_.faces) cutFace(face);
        close(sides_[0], plane_.normal);
        close(sides_[1], -plane_.normal);
        return {std::move(sides_[0]), std::move(sides_[1])};
    }

  private:
    /// −1 before, 0 in, 1 behind the plane.
    int sideOf(std::uint32_t point) const { return point < side_.size() ? side_[point] : 0; }
    double heightOf(std::uint32_t point) const { return plane_.normal.dot(points_[point]) - plane_.offset; }
    Eigen::Vector2d flat(std::uint32_t point) const { return {u_.dot(points_[point]), v_.dot(points_[point])}; }

    void classify();
    std::uint32_t crossingOf(std::uint32_t from, std::uint32_t to);
    void cutFace(const PolyhedronFace& face);
    void addCut(const PolyhedronFace& face);
    void joinCrossings(const Vec3& line);
    void close(Polyhedron& side, const Vec3& normal) const;
    std::vector<PolyhedronEdge> openEdges(const Polyhedron& side) const;
    std::vector<FaceLoop> loopsOf(std::span<const PolyhedronEdge> border, const Vec3& normal) const;
    bool isInside(const FaceLoop& loop, std::uint32_t point) const;

    const Polyhedron& solid_;
    CuttingPlane plane_;
    double tolerance_;
    Points& points_;
    Vec3 u_, v_;                     ///< axes in the plane
    std::vector<std::int8_t> side_;  ///< of each point that was there before
    std::unordered_map<std::uint64_t, std::uint32_t> crossed_;
    std::array<Polyhedron, 2> sides_;
    // Of the face that is cut.
    std::array<std::vector<PolyhedronEdge>, 2> border_;
    std::vector<Crossing> crossings_;
};

void Cutter::classify() {
    side_.assign(points_.size(), 0);
    for (const PolyhedronEdge& edge : solid_.edges) {
        const double height = heightOf(edge.from);
        if (std::abs(height) > tolerance_) side_[edge.from] = height > 0 ? 1 : -1;
    }
}

std::uint32_t Cutter::crossingOf(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t low = std::min(from, to);
    const std::uint32_t high = std::max(from, to);
    const auto [place, is_new] =
        crossed_.try_emplace((std::uint64_t{low} << 32U) | high, static_cast<std::uint32_t>(points_.size()));
    if (is_new) {
        const double h = heightOf(low);
        const Vec3 p = points_[low] + h / (h - heightOf(high)) * (points_[high] - points_[low]);
        points_.push_back(p);
    }
    return place->second;
}

void Cutter::cutFace(const PolyhedronFace& face) {
    int lowest = 1;
    int highest = -1;
    for (const PolyhedronEdge& edge : solid_.edgesOf(face)) {
        lowest = std::min(lowest, sideOf(edge.from));
        highest = std::max(highest, sideOf(edge.from));
    }
    if (lowest < 0 && highest > 0) return addCut(face);
    // A face in the plane bounds what is on the side that it looks away from.
    const bool behind = highest > 0 || (lowest == 0 && face.normal.dot(plane_.normal) < 0);
    sides_[behind ? 1 : 0].add(face.normal, solid_.edgesOf(face));
}

void Cutter::addCut(const PolyhedronFace& face) {
    border_[0].clear();
    border_[1].clear();
    crossings_.clear();
    const auto piece = [&](std::uint32_t from, std::uint32_t to, int side) {
        border_[side > 0 ? 1 : 0].push_back({from, to});
        if (side <= 0) return;
        if (sideOf(from) == 0) crossings_.push_back({0, from, -1});
        if (sideOf(to) == 0) crossings_.push_back({0, to, 1});
    };
    for (const auto& [from, to] : solid_.edgesOf(face)) {
        const int a = sideOf(from);
        const int b = sideOf(to);
        if (a * b < 0) {
            const std::uint32_t between = crossingOf(from, to);
            piece(from, between, a);
            piece(between, to, b);
        } else {
            piece(from, to, a + b);
        }
    }
    joinCrossings(face.normal.cross(plane_.normal));
    sides_[0].add(face.normal, border_[0]);
    sides_[1].add(face.normal, border_[1]);
}

/// Closes the border behind the plane by edges along the line in which the face meets it, from where an edge ends to
/// the nearest where one begins, and the border before it by the same edges the other way round.
void Cutter::joinCrossings(const Vec3& line) {
    for (Crossing& c : crossings_) c.along = line.dot(points_[c.point]);
    std::ranges::sort(crossings_, [](const Crossing& a, const Crossing& b) {
        return std::tie(a.along, a.point, a.ends) < std::tie(b.along, b.point, b.ends);
    });
    std::vector<Crossing> waiting;
    for (const Crossing& c : crossings_) {
        if (waiting.empty() || waiting.back().ends == c.ends) {
            waiting.push_back(c);
            continue;
        }
        const std::uint32_t from = c.ends > 0 ? c.point : waiting.back().point;
        const std::uint32_t to = c.ends > 0 ? waiting.back().point : c.point;
        waiting.pop_back();
        if (from == to) continue;
        border_[1].push_back({from, to});
        border_[0].push_back({to, from});
    }
}

/// The edges that a closing face needs: those that run against edges without a partner.
std::vector<PolyhedronEdge> Cutter::openEdges(const Polyhedron& side) const {
    struct Counted {
        std::uint32_t low, high;
        std::int32_t sign;
    };
    std::vector<Counted> all;
    for (const auto& [from, to] : side.edges) {
        if (sideOf(from) == 0 && sideOf(to) == 0) {
            all.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
        }
    }
    std::ranges::sort(
        all, [](const Counted& a, const Counted& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
    std::vector<PolyhedronEdge> open;
    for (std::size_t begin = 0; begin < all.size();) {
        std::int32_t sum = 0;
        std::size_t end = begin;
        for (; end < all.size() && all[end].low == all[begin].low && all[end].high == all[begin].high; ++end) {
            sum += all[end].sign;
        }
        const PolyhedronEdge against =
            sum > 0 ? PolyhedronEdge{all[begin].high, all[begin].low} : PolyhedronEdge{all[begin].low, all[begin].high};
        open.insert(open.end(), static_cast<std::size_t>(std::abs(sum)), against);
        begin = end;
    }
    return open;
}

std::vector<FaceLoop> Cutter::loopsOf(std::span<const PolyhedronEdge> border, const Vec3& normal) const {
    std::unordered_map<std::uint32_t, std::uint32_t> first_at;
    std::vector<std::uint32_t> group(border.size());
    const auto find = [&](std::uint32_t i) {
        while (group[i] != i) i = group[i] = group[group[i]];
        return i;
    };
    for (std::uint32_t i = 0; i < border.size(); ++i) {
        group[i] = i;
        for (const std::uint32_t point : {border[i].from, border[i].to}) {
            const std::uint32_t a = find(first_at.try_emplace(point, i).first->second);
            const std::uint32_t b = find(i);
            group[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<FaceLoop> loops;
    std::vector<std::size_t> number(border.size());
    const double sense = normal.dot(u_.cross(v_));
    for (std::uint32_t i = 0; i < border.size(); ++i) {
        const std::uint32_t of = find(i);
        if (of == i) {
            number[i] = loops.size();
            loops.emplace_back();
        }
        FaceLoop& loop = loops[number[of]];
        const Eigen::Vector2d origin = flat(border[of].from);
        loop.edges.push_back(border[i]);
        loop.area += 0.5 * sense * cross2(flat(border[i].from) - origin, flat(border[i].to) - origin);
    }
    return loops;
}

/// By how often a line from the point crosses the loop.
bool Cutter::isInside(const FaceLoop& loop, std::uint32_t point) const {
    const Eigen::Vector2d p = flat(point);
    bool inside = false;
    for (const auto& [from, to] : loop.edges) {
        const Eigen::Vector2d a = flat(from) - p;
        const Eigen::Vector2d b = flat(to) - p;
        if ((a.y() > 0) == (b.y() > 0)) continue;
        if (a.x() + (b.x() - a.x()) * (a.y() / (a.y() - b.y())) > 0) inside = !inside;
    }
    return inside;
}

/// Adds a face for each outer loop with the holes in it, so that what hangs together shares edges.
void Cutter::close(Polyhedron& side, const Vec3& normal) const {
    const std::vector<PolyhedronEdge> border = openEdges(side);
    std::vector<FaceLoop> loops = loopsOf(border, normal);
    for (FaceLoop& hole : loops) {
        if (hole.area > 0) continue;
        FaceLoop* holder = nullptr;
        for (FaceLoop& loop : loops) {
            if (loop.area <= 0 || !isInside(loop, hole.edges.front().from)) continue;
            if (holder == nullptr || loop.area < holder->area) holder = &loop;
        }
        if (holder == nullptr) continue;
        holder->edges.insert(holder->edges.end(), hole.edges.begin(), hole.edges.end());
        hole.edges.clear();
    }
    for (const FaceLoop& loop : loops) {
        if (!loop.edges.empty()) side.add(normal, loop.edges);
    }
}

}  // namespace

std::pair<Polyhedron, Polyhedron> cut(const Polyhedron& solid, const CuttingPlane& plane, double tolerance,
                                      Points& points) {
    return Cutter(solid, plane, tolerance, points).cut();
}

}  // namespace cairn
