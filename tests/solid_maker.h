/// @file Closed surfaces of concave solids for tests.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "cairn/shape.h"

namespace cairn::testing {

/// Triangles before they are a mesh.
struct Triangles {
    std::vector<Vec3> vertices;
    std::vector<TriangleCorners> corners;

    void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        const auto i = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), {a, b, c, d});
        corners.push_back({i, i + 1, i + 2});
        corners.push_back({i, i + 2, i + 3});
    }
    void turnInsideOut() {
        for (TriangleCorners& t : corners) std::swap(t[1], t[2]);
    }
    Mesh mesh() const { return Mesh(vertices, corners); }
    /// Turned, then multiplied and moved.
    Triangles placed(const Quat& turn, double scale, const Vec3& by) const {
        Triangles result = *this;
        for (Vec3& v : result.vertices) v = scale * (turn * v) + by;
        return result;
    }
};

using Cell = std::array<int, 3>;

/// The surface of the cubes of 1 m at some cells of a grid.
inline Triangles cubes(const std::set<Cell>& cells) {
    Triangles result;
    for (const Cell& cell : cells) {
        const Vec3 lower(cell[0], cell[1], cell[2]);
        for (int k = 0; k < 3; ++k) {
            for (const int side : {0, 1}) {
                Cell beside = cell;
                beside[static_cast<std::size_t>(k)] += side == 1 ? 1 : -1;
                if (cells.contains(beside)) continue;
                const Vec3 u = Vec3::Unit((k + 1) % 3);
                const Vec3 v = Vec3::Unit((k + 2) % 3);
                const Vec3 at = lower + side * Vec3::Unit(k);
                if (side == 1) {
                    result.quad(at, at + u, at + u + v, at + v);
                } else {
                    result.quad(at, at + v, at + u + v, at + u);
                }
            }
        }
    }
    return result;
}

/// An outline turned about the z axis. @param outline closed, counter-clockwise, of (distance from the axis, height)
/// [m]
inline Triangles revolved(const std::vector<std::array<double, 2>>& outline, int segments) {
    Triangles result;
    const auto at = [&](std::size_t i, int s) {
        const auto& [r, z] = outline[i % outline.size()];
        const double angle = 2 * std::numbers::pi * (s % segments) / segments;
        return Vec3(r * std::cos(angle), r * std::sin(angle), z);
    };
    for (std::size_t i = 0; i < outline.size(); ++i) {
        for (int s = 0; s < segments; ++s) result.quad(at(i, s), at(i, s + 1), at(i + 1, s + 1), at(i + 1, s));
    }
    return result;
}

inline Triangles torus(double large, double small, int segments, int around) {
    std::vector<std::array<double, 2>> outline;
    for (int i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * i / around;
        outline.push_back({large + small * std::cos(angle), small * std::sin(angle)});
    }
    return revolved(outline, segments);
}

/// The lower half of a ball with a smaller one taken out of it, about the origin. @param rings from the bottom upwards
inline Triangles bowl(double outer, double inner, int segments, int rings) {
    std::vector<std::array<double, 2>> outline;
    const auto add = [&](double radius, double angle) {
        const double r = std::abs(std::sin(angle)) < 1e-12 ? 0 : radius * std::sin(angle);
        outline.push_back({r, -radius * std::cos(angle)});
    };
    for (int i = 0; i <= rings; ++i) add(outer, 0.5 * std::numbers::pi * i / rings);
    for (int i = rings; i >= 0; --i) add(inner, 0.5 * std::numbers::pi * i / rings);
    return revolved(outline, segments);
}

}  // namespace cairn::testing
