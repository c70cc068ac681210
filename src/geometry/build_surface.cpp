#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/shape_entry.h"
#include "geometry/surface_data.h"

namespace cairn {

namespace {

/// Vertices that lie farther from a plane than this part of the largest coordinate are not in it: files keep
/// coordinates with 24 bits.
constexpr double in_plane_part = 2e-7;

/// A triangle lower than this part of its longest edge has no area: nothing is known of its normal.
constexpr double flattest_triangle = 1e-9;

/// Cosine between neighbours in one plane; what is folded back lies in it, too, but is another face.
constexpr double same_side_cosine = 0.5;

void requireNumbers(std::span<const Vec3> vertices, std::span<const TriangleCorners> triangles) {
    if (vertices.size() >= SurfaceData::none || triangles.size() > UINT32_MAX / 3) {
        throw InputError(
            fmt::format("a mesh has {} vertices and {} triangles; at most {} triangles are possible, "
                        "divide it among several bodies",
                        vertices.size(), triangles.size(), UINT32_MAX / 3));
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3& v = vertices[i];
        if (v.allFinite() && v.cwiseAbs().maxCoeff() <= largest_dimension) continue;
        throw InputError(fmt::format("vertex {} of a mesh is at ({}, {}, {}) m; it must be finite and within ±{} m", i,
                                     v.x(), v.y(), v.z(), largest_dimension));
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (const std::uint32_t corner : triangles[i]) {
            if (corner < vertices.size()) continue;
            throw InputError(
                fmt::format("triangle {} of a mesh has the vertex {}; indices must be below the number of "
                            "vertices, {}",
                            i, corner, vertices.size()));
        }
    }
}

bool isBefore(const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Makes vertices at one place the first of them.
void weld(SurfaceData& surface) {
    std::vector<Vec3>& vertices = surface.vertices;
    for (Vec3& v : vertices) v += Vec3::Zero();  // no −0, which equals +0 and has other bits
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        if (vertices[a] != vertices[b]) return isBefore(vertices[a], vertices[b]);
        return a < b;
    });
    std::vector<std::uint32_t> first(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && vertices[order[i]] == vertices[order[i - 1]];
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    for (TriangleCorners& triangle : surface.triangles) {
        for (std::uint32_t& corner : triangle) corner = first[corner];
    }
}

bool hasArea(const std::array<Vec3, 3>& corners) {
    const Vec3 u = corners[1] - corners[0];
    const Vec3 v = corners[2] - corners[0];
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
    return u.cross(v).norm() > flattest_triangle * longest;
}

/// Two corners or three that name the same triangle are equal. @param sides of two no order is another side
TriangleCorners nameOf(TriangleCorners corners, SurfaceSides sides) {
    if (sides == SurfaceSides::two) {
        std::ranges::sort(corners);
    } else {
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    }
    return corners;
}

void removeUseless(SurfaceData& surface) {
    std::vector<TriangleCorners>& triangles = surface.triangles;
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::vector<TriangleCorners> names;
    for (const TriangleCorners& triangle : triangles) names.push_back(nameOf(triangle, surface.sides));
    std::ranges::sort(
        order, [&](std::uint32_t a, std::uint32_t b) { return names[a] != names[b] ? names[a] < names[b] : a < b; });
    std::vector<std::uint8_t> again(triangles.size(), 0);
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (names[order[i]] == names[order[i - 1]]) again[order[i]] = 1;
    }
    std::size_t kept = 0;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (!hasArea(surface.corners(i))) {
            ++surface.repairs.degenerate;
        } else if (again[i] != 0) {
            ++surface.repairs.duplicate;
        } else {
            triangles[kept++] = triangles[i];
        }
    }
    triangles.resize(kept);
    triangles.shrink_to_fit();
    if (kept > 0) return;
    throw InputError(
        fmt::format("a mesh has no triangle with an area ({} without one); it needs at least one, of three "
                    "vertices at different places that are not in one line",
                    surface.repairs.degenerate));
}

/// Keeps the vertices that are corners.
void removeUnused(SurfaceData& surface) {
    constexpr std::uint32_t unused = SurfaceData::none;
    std::vector<std::uint32_t> place(surface.vertices.size(), unused);
    for (const TriangleCorners& triangle : surface.triangles) {
        for (const std::uint32_t corner : triangle) place[corner] = 0;
    }
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] == unused) continue;
        place[i] = kept;
        surface.vertices[kept++] = surface.vertices[i];
    }
    surface.repairs.welded = surface.vertices.size() - kept;
    surface.vertices.resize(kept);
    surface.vertices.shrink_to_fit();
    for (TriangleCorners& triangle : surface.triangles) {
        for (std::uint32_t& corner : triangle) corner = place[corner];
    }
}

/// An edge of a triangle by the vertices at its ends.
struct SurfaceEdge {
    std::uint32_t low, high;
    std::uint32_t triangle;
    std::uint8_t index;
    std::uint8_t rises;  ///< from the lower vertex to the higher

    bool isAt(const SurfaceEdge& other) const { return low == other.low && high == other.high; }
};

void findNeighbours(SurfaceData& surface) {
    std::vector<SurfaceEdge> edges;
    edges.reserve(3 * surface.triangles.size());
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
        for (std::uint8_t k = 0; k < 3; ++k) {
            const std::uint32_t from = surface.triangles[t][k];
            const std::uint32_t to = surface.triangles[t][(k + 1U) % 3U];
            edges.push_back({std::min(from, to), std::max(from, to), t, k, static_cast<std::uint8_t>(from < to)});
        }
    }
    std::ranges::sort(edges, [](const SurfaceEdge& a, const SurfaceEdge& b) {
        return std::tie(a.low, a.high, a.triangle, a.index) < std::tie(b.low, b.high, b.triangle, b.index);
    });
    constexpr std::uint32_t none = SurfaceData::none;
    surface.across.assign(surface.triangles.size(), {none, none, none});
    for (std::size_t begin = 0; begin < edges.size();) {
        std::size_t end = begin + 1;
        while (end < edges.size() && edges[end].isAt(edges[begin])) ++end;
        const SurfaceEdge& a = edges[begin];
        const SurfaceEdge& b = edges[end - 1];
        if (end - begin == 2 && (surface.sides == SurfaceSides::two || a.rises != b.rises)) {
            surface.across[a.triangle][a.index] = b.triangle;
            surface.across[b.triangle][b.index] = a.triangle;
        } else {
            surface.repairs.open_edges += end - begin;
        }
        begin = end;
    }
}

void findFans(SurfaceData& surface) {
    surface.fan_begin.assign(surface.vertices.size() + 1, 0);
    for (const TriangleCorners& triangle : surface.triangles) {
        for (const std::uint32_t corner : triangle) ++surface.fan_begin[corner + 1];
    }
    std::partial_sum(surface.fan_begin.begin(), surface.fan_begin.end(), surface.fan_begin.begin());
    surface.fans.resize(3 * surface.triangles.size());
    std::vector<std::uint32_t> next(surface.fan_begin.begin(), surface.fan_begin.end() - 1);
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
        for (const std::uint32_t corner : surface.triangles[t]) surface.fans[next[corner]++] = t;
    }
}

Vec3 crossOf(const SurfaceData& surface, std::uint32_t t) {
    return (surface.corner(t, 1) - surface.corner(t, 0)).cross(surface.corner(t, 2) - surface.corner(t, 0));
}

/// Whether a triangle lies in the plane of a face and looks to its side.
bool liesIn(const SurfaceData& surface, const SurfaceFace& face, std::uint32_t t, double tolerance) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(std::abs(face.height(surface.corner(t, k))) <= tolerance)) return false;
    }
    const double cosine = crossOf(surface, t).normalized().dot(face.normal);
    return (surface.sides == SurfaceSides::two ? std::abs(cosine) : cosine) > same_side_cosine;
}

/// Gathers triangles that lie in one plane from the largest ones on, whose planes are known best.
void findFaces(SurfaceData& surface, double tolerance) {
    const std::size_t count = surface.triangles.size();
    std::vector<double> area(count);
    for (std::uint32_t t = 0; t < count; ++t) area[t] = crossOf(surface, t).squaredNorm();
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::ranges::sort(order,
                      [&](std::uint32_t a, std::uint32_t b) { return area[a] != area[b] ? area[a] > area[b] : a < b; });
    surface.face_of.assign(count, SurfaceData::none);
    std::vector<std::uint32_t> waiting;
    for (const std::uint32_t seed : order) {
        if (surface.face_of[seed] != SurfaceData::none) continue;
        const auto index = static_cast<std::uint32_t>(surface.faces.size());
        const Vec3 normal = crossOf(surface, seed).normalized();
        const SurfaceFace face{normal, normal.dot(surface.corner(seed, 0))};
        surface.faces.push_back(face);
        surface.face_of[seed] = index;
        waiting.assign(1, seed);
        while (!waiting.empty()) {
            const std::uint32_t t = waiting.back();
            waiting.pop_back();
            for (const std::uint32_t other : surface.across[t]) {
                if (other == SurfaceData::none || surface.face_of[other] != SurfaceData::none) continue;
                if (!liesIn(surface, face, other, tolerance)) continue;
                surface.face_of[other] = index;
                waiting.push_back(other);
            }
        }
    }
    surface.faces.shrink_to_fit();
}

void findExtent(SurfaceData& surface) {
    surface.lower = surface.upper = surface.vertices.front();
    for (const Vec3& v : surface.vertices) {
        surface.lower = surface.lower.cwiseMin(v);
        surface.upper = surface.upper.cwiseMax(v);
        surface.radius = std::max(surface.radius, v.norm());
    }
    std::vector<Bounds> bounds;
    bounds.reserve(surface.triangles.size());
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) bounds.push_back(surface.boundsOf(t));
    surface.tree.build(bounds);
}

}  // namespace

SurfaceData buildSurface(std::vector<Vec3> vertices, std::vector<TriangleCorners> triangles, SurfaceSides sides) {
    requireNumbers(vertices, triangles);
    SurfaceData surface;
    surface.vertices = std::move(vertices);
    surface.triangles = std::move(triangles);
    surface.sides = sides;
    weld(surface);
    removeUseless(surface);
    removeUnused(surface);
    findNeighbours(surface);
    findFans(surface);
    findExtent(surface);
    const double largest = surface.lower.cwiseAbs().cwiseMax(surface.upper.cwiseAbs()).maxCoeff();
    findFaces(surface, in_plane_part * largest);
    return surface;
}

}  // namespace cairn
