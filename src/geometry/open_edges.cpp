#include "geometry/open_edges.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "math/groups.h"

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

/// How many groups the ends of open edges make.
std::size_t countHoles(std::span<const DirectedEdge> open, std::size_t vertices) {
    Groups groups(open.empty() ? 0 : vertices);
    for (const DirectedEdge& edge : open) groups.join(edge.low, edge.high);
    std::vector<std::uint32_t> holes;
    for (const DirectedEdge& edge : open) holes.push_back(groups.find(edge.low));
    std::ranges::sort(holes);
    return static_cast<std::size_t>(std::unique(holes.begin(), holes.end()) - holes.begin());
}

}  // namespace

OpenEdges openEdgesOf(const SurfaceData& surface) {
    const std::vector<DirectedEdge> edges = directedEdges(surface);
    OpenEdges result;
    std::vector<DirectedEdge> open;
    for (std::size_t begin = 0; begin < edges.size();) {
        const auto [low, high, sign] = edges[begin];
        int sum = 0;
        std::size_t end = begin;
        for (; end < edges.size() && edges[end].low == low && edges[end].high == high; ++end) sum += edges[end].sign;
        const bool even = (end - begin) % 2 == 0;
        begin = end;
        if (sum == 0) continue;
        if (open.empty() && result.opposite == 0) result.first = 0.5 * (surface.vertices[low] + surface.vertices[high]);
        if (even) {
            ++result.opposite;
        } else {
            open.push_back({low, high, sign});
        }
    }
    result.open = open.size();
    result.holes = countHoles(open, surface.vertices.size());
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
