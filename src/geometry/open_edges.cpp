#include "geometry/open_edges.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <unordered_map>

namespace cairn {

namespace {

struct DirectedEdge {
    std::uint32_t low, high;
    int sign;  ///< 1 from low to high, −1 from high to low
};

std::vector<DirectedEdge> directedEdges(const SurfaceData& surface) {
    std::vector<DirectedEdge> edges;
    edges.reserve(3 * surface.triangles.size());
    for (const TriangleCorners& triangle : surface.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangle[k];
            const std::uint32_t to = triangle[(k + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
        }
    }
    std::ranges::sort(edges, [](const DirectedEdge& a, const DirectedEdge& b) {
        return std::tie(a.low, a.high, a.sign) < std::tie(b.low, b.high, b.sign);
    });
    return edges;
}

/// Groups of vertices that open edges join.
class HoleCounter {
  public:
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    std::size_t count() {
        std::set<std::uint32_t> roots;
        for (const auto& entry : parent_) roots.insert(find(entry.first));
        return roots.size();
    }

  private:
    std::uint32_t find(std::uint32_t i) {
        while (parent_.try_emplace(i, i).first->second != i) i = parent_[i];
        return i;
    }

    std::unordered_map<std::uint32_t, std::uint32_t> parent_;
};

}  // namespace

OpenEdges openEdgesOf(const SurfaceData& surface) {
    const std::vector<DirectedEdge> edges = directedEdges(surface);
    OpenEdges result;
    HoleCounter holes;
    for (std::size_t begin = 0; begin < edges.size();) {
        const auto [low, high, sign] = edges[begin];
        int sum = 0;
        std::size_t end = begin;
        for (; end < edges.size() && edges[end].low == low && edges[end].high == high; ++end) sum += edges[end].sign;
        const bool even = (end - begin) % 2 == 0;
        begin = end;
        if (sum == 0) continue;
        if (!result.any()) result.first = 0.5 * (surface.vertices[low] + surface.vertices[high]);
        if (even) {
            ++result.opposite;
        } else {
            ++result.open;
            holes.join(low, high);
        }
    }
    result.holes = holes.count();
    return result;
}

std::string describe(const OpenEdges& edges) {
    std::string what;
    if (edges.open > 0)
        what = fmt::format("{} open edges around {} {}", edges.open, edges.holes, edges.holes == 1 ? "hole" : "holes");
    if (edges.opposite > 0) {
        what += fmt::format("{}{} edges whose triangles look to opposite sides", what.empty() ? "" : " and ",
                            edges.opposite);
    }
    return fmt::format(
        "a mesh is not watertight: it has {}, the first at ({}, {}, {}) m; close the holes and turn the triangles that "
        "look inwards, or ask for its hull (hull_if_open)",
        what, edges.first.x(), edges.first.y(), edges.first.z());
}

}  // namespace cairn
