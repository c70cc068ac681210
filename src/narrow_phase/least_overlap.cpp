#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "narrow_phase/separation.h"

namespace cairn {

namespace {

/// Error of the depth that ends the search, as a part of the size of A − B.
constexpr double depth_error = 1e-11;

/// Heights above a facet below this part of the size of A − B are rounding.
constexpr double flat_part = 1e-13;

/// A tetrahedron lower than this part of the size of A − B is too flat to begin with.
constexpr double low_part = 1e-3;

/// A triangle of the polytope, counter-clockwise seen from outside.
struct Facet {
    std::array<std::uint8_t, 3> corners;
    std::array<std::uint8_t, 3> across;  ///< the facet beyond the edge from each corner to the next
    bool visible;
    Vec3 normal;  ///< unit, outward
};

/// An edge between a facet that stays and one that goes.
struct Border {
    std::uint8_t begin;
    std::uint8_t end;
    std::uint8_t beyond;  ///< the facet that stays
    std::uint8_t fresh;   ///< the facet that is put on the edge
};

/// A convex polytope whose corners are points of A − B.
class Polytope {
  public:
    /// Begins with four points. @return false if they are too flat @param size about that of A − B [m]
    bool begin(const Tetrahedron& around, double size);
    /// Begins with points far apart. @return false if A − B is flat
    bool begin(const Convex& a, const Convex& b, const Vec3& direction);
    /// The facet whose plane lies farthest inwards, seen from the origin.
    std::uint8_t nearest() const;
    const Facet& facet(std::uint8_t index) const { return facets_[index]; }
    /// Of a facet's plane from the origin along the normal; negative = the origin is outside.
    double offset(std::uint8_t index) const { return offset_[index]; }
    double size() const { return size_; }
    /// Takes a point beyond a facet in. @return false if the polytope is full or rounding spoils it
    bool add(const Difference& point, std::uint8_t seen_by);
    /// The point of A where the origin, seen along the normal, meets a facet.
    Vec3 onA(std::uint8_t index) const;

  private:
    static constexpr std::size_t most_corners = 96;
    static constexpr std::size_t most_facets = 2 * most_corners;
    static constexpr double no_facet = std::numeric_limits<double>::infinity();

    bool put(std::uint8_t index, std::uint8_t i, std::uint8_t j, std::uint8_t k);
    bool putFirst(bool is_above);
    void findVisible(const Vec3& w, std::uint8_t first);
    bool collectBorder();
    std::uint8_t freeFacet();

    std::size_t corner_count_ = 0;
    std::size_t facet_count_ = 0;
    std::size_t border_count_ = 0;
    std::size_t visible_count_ = 0;
    double size_ = 0;
    std::array<Difference, most_corners> corners_;
    std::array<Facet, most_facets> facets_;
    std::array<double, most_facets> offset_;  ///< side by side, since they are compared again and again; ∞ = no facet
    std::array<std::uint8_t, most_facets> visible_;
    std::array<Border, most_facets> border_;
};

bool Polytope::put(std::uint8_t index, std::uint8_t i, std::uint8_t j, std::uint8_t k) {
    Facet& facet = facets_[index];
    const Vec3& p = corners_[i].w;
    facet.normal = (corners_[j].w - p).cross(corners_[k].w - p);
    const double length = facet.normal.norm();
    if (!(length > std::numeric_limits<double>::min())) return false;
    facet.normal /= length;
    offset_[index] = facet.normal.dot(p);
    facet.corners = {i, j, k};
    facet.visible = false;
    return true;
}

/// Puts facets on the first four corners. @param is_above whether the last lies above the others, where these are
/// counter-clockwise
bool Polytope::putFirst(bool is_above) {
    corner_count_ = 4;
    facet_count_ = 4;
    const auto second = static_cast<std::uint8_t>(is_above ? 2 : 1);
    const auto third = static_cast<std::uint8_t>(3 - second);
    facets_[0].across = {1, 2, 3};
    facets_[1].across = {0, 3, 2};
    facets_[2].across = {0, 1, 3};
    facets_[3].across = {0, 2, 1};
    return put(0, 0, second, third) && put(1, second, 0, 3) && put(2, third, second, 3) && put(3, 0, third, 3);
}

bool Polytope::begin(const Tetrahedron& around, double size) {
    std::ranges::copy(around, corners_.begin());
    size_ = size;
    const Vec3& p = corners_[0].w;
    const Vec3 normal = (corners_[1].w - p).cross(corners_[2].w - p);
    if (!putFirst(normal.dot(corners_[3].w - p) > 0)) return false;
    for (std::uint8_t i = 0; i < 4; ++i) {
        double height = 0;  // of the corner that the facet lacks
        for (std::size_t k = 0; k < 4; ++k) {
            height = std::max(height, offset_[i] - facets_[i].normal.dot(corners_[k].w));
        }
        if (height < low_part * size) return false;
    }
    return true;
}

bool Polytope::begin(const Convex& a, const Convex& b, const Vec3& direction) {
    corners_[0] = Difference(a, b, direction);
    corners_[1] = Difference(a, b, -direction);
    const Vec3 line = (corners_[1].w - corners_[0].w).stableNormalized();
    size_ = (corners_[1].w - corners_[0].w).norm();
    double farthest = 0;
    const Vec3 u = line.unitOrthogonal();
    const Vec3 v = line.cross(u);
    for (const Vec3& side : {u, Vec3(-u), v, Vec3(-v)}) {
        const Difference candidate(a, b, side);
        const double away = (candidate.w - corners_[0].w).cross(line).norm();
        if (!(away > farthest)) continue;
        farthest = away;
        corners_[2] = candidate;
    }
    if (!(farthest > flat_part * size_)) return false;
    size_ = std::max(size_, farthest);
    const Vec3 normal = line.cross(corners_[2].w - corners_[0].w).normalized();
    const Difference above(a, b, normal);
    const Difference below(a, b, -normal);
    const double up = (above.w - corners_[0].w).dot(normal);
    const double down = (corners_[0].w - below.w).dot(normal);
    if (!(std::max(up, down) > flat_part * size_)) return false;
    size_ = std::max({size_, up, down});
    corners_[3] = up >= down ? above : below;
    return putFirst(up >= down);
}

std::uint8_t Polytope::nearest() const {
    const auto end = offset_.begin() + facet_count_;
    const double least = Eigen::Map<const Eigen::ArrayXd>(offset_.data(), end - offset_.begin()).minCoeff();
    return static_cast<std::uint8_t>(std::find(offset_.begin(), end, least) - offset_.begin());
}

void Polytope::findVisible(const Vec3& w, std::uint8_t first) {
    visible_count_ = 1;
    visible_[0] = first;
    facets_[first].visible = true;
    for (std::size_t i = 0; i < visible_count_; ++i) {
        for (const std::uint8_t other : facets_[visible_[i]].across) {
            Facet& facet = facets_[other];
            // A facet in whose plane the point lies goes, too: kept, it would have a neighbour without an area.
            if (facet.visible || facet.normal.dot(w) - offset_[other] < -flat_part * size_) continue;
            facet.visible = true;
            visible_[visible_count_++] = other;
        }
    }
}

bool Polytope::collectBorder() {
    border_count_ = 0;
    for (std::size_t i = 0; i < visible_count_; ++i) {
        const Facet& facet = facets_[visible_[i]];
        for (std::size_t e = 0; e < 3; ++e) {
            if (facets_[facet.across[e]].visible) continue;
            const Border edge{facet.corners[e], facet.corners[(e + 1) % 3], facet.across[e], 0};
            for (std::size_t k = 0; k < border_count_; ++k) {
                if (border_[k].begin == edge.begin || border_[k].end == edge.end) return false;  // not one loop
            }
            border_[border_count_++] = edge;
        }
    }
    return border_count_ >= 3;
}

std::uint8_t Polytope::freeFacet() {
    const auto facets_end = offset_.begin() + facet_count_;
    const auto free = std::find(offset_.begin(), facets_end, no_facet);
    if (free == facets_end) ++facet_count_;
    return static_cast<std::uint8_t>(free - offset_.begin());
}

bool Polytope::add(const Difference& point, std::uint8_t seen_by) {
    if (corner_count_ == most_corners) return false;
    findVisible(point.w, seen_by);
    if (!collectBorder()) return false;
    const auto corner = static_cast<std::uint8_t>(corner_count_++);
    corners_[corner] = point;
    for (std::size_t i = 0; i < visible_count_; ++i) offset_[visible_[i]] = no_facet;
    for (std::size_t i = 0; i < border_count_; ++i) {
        Border& edge = border_[i];
        edge.fresh = freeFacet();
        if (!put(edge.fresh, edge.begin, edge.end, corner)) return false;
        facets_[edge.fresh].across[0] = edge.beyond;
        Facet& beyond = facets_[edge.beyond];
        for (std::size_t e = 0; e < 3; ++e) {
            if (beyond.corners[e] == edge.end) beyond.across[e] = edge.fresh;
        }
    }
    for (std::size_t i = 0; i < border_count_; ++i) {
        for (std::size_t k = 0; k < border_count_; ++k) {
            if (border_[k].begin == border_[i].end) facets_[border_[i].fresh].across[1] = border_[k].fresh;
            if (border_[k].end == border_[i].begin) facets_[border_[i].fresh].across[2] = border_[k].fresh;
        }
    }
    return true;
}

Vec3 Polytope::onA(std::uint8_t index) const {
    const Facet& facet = facets_[index];
    const Difference& p = corners_[facet.corners[0]];
    const Difference& q = corners_[facet.corners[1]];
    const Difference& r = corners_[facet.corners[2]];
    const Vec3 u = q.w - p.w;
    const Vec3 v = r.w - p.w;
    const Vec3 normal = u.cross(v);
    const Vec3 from = offset_[index] * facet.normal - p.w;
    // The two triangles of the parallelogram of two edges go on in each other, so the weights may leave 0 to 1.
    const double t = std::clamp(normal.dot(from.cross(v)) / normal.squaredNorm(), -1.0, 2.0);
    const double s = std::clamp(normal.dot(u.cross(from)) / normal.squaredNorm(), -1.0, 2.0);
    return p.a + t * (q.a - p.a) + s * (r.a - p.a);
}

}  // namespace

void findLeastOverlap(const Convex& a, const Convex& b, const std::optional<Tetrahedron>& around, const Vec3& direction,
                      Separation& separation) {
    Polytope polytope;
    separation.distance = -std::numeric_limits<double>::infinity();
    const double size = 2 * (a.reach() + b.reach());
    bool growing = (around.has_value() && polytope.begin(*around, size)) || polytope.begin(a, b, direction);
    if (!growing) {
        // Two flat cores in one plane: every direction across it parts them at once.
        separation.normal = direction.stableNormalized();
        const Difference point(a, b, separation.normal);
        separation.distance = -point.w.dot(separation.normal);
        separation.on_a = point.a;
        separation.on_b = point.b();
        return;
    }
    while (growing) {
        const std::uint8_t index = polytope.nearest();
        const Facet& facet = polytope.facet(index);
        const Difference point(a, b, facet.normal);
        const double depth = point.w.dot(facet.normal);
        const bool done = depth - polytope.offset(index) <= depth_error * polytope.size();
        if (done || -depth > separation.distance) {
            separation.normal = facet.normal;
            separation.distance = -depth;
            separation.on_a = polytope.onA(index);
            separation.on_b = separation.on_a - depth * facet.normal;
        }
        growing = !done && polytope.add(point, index);
    }
}

}  // namespace cairn
