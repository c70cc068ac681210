/// @file Surfaces for tests, the same on every machine.
#pragma once

#include <numbers>
#include <utility>
#include <vector>

#include "cairn/shape.h"
#include "narrow_phase/pair_random.h"

namespace cairn::testing {

/// Triangles over a grid about the origin whose inner vertices are moved at random and whose diagonals run at random.
/// @param height of a place [m]
template <class Height>
Mesh irregularMesh(int cells, double edge, std::uint64_t seed, const Height& height,
                   SurfaceSides sides = SurfaceSides::one) {
    Random random(seed);
    std::vector<Vec3> vertices;
    const double step = edge / cells;
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            double x = i * step - 0.5 * edge;
            double y = j * step - 0.5 * edge;
            if (i > 0 && i < cells) x += random.uniform(-0.22, 0.22) * step;
            if (j > 0 && j < cells) y += random.uniform(-0.22, 0.22) * step;
            vertices.emplace_back(x, y, height(x, y));
        }
    }
    std::vector<TriangleCorners> triangles;
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            if (random.below(2) == 0) {
                triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            } else {
                triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
                triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        }
    }
    return Mesh(std::move(vertices), std::move(triangles), sides);
}

inline Mesh flatMesh(int cells, double edge, std::uint64_t seed = 1) {
    return irregularMesh(cells, edge, seed, [](double, double) { return 0.0; });
}

/// The surface of a box about the origin, two triangles per face.
inline Mesh boxMesh(const Vec3& size, SurfaceSides sides = SurfaceSides::one) {
    std::vector<Vec3> vertices;
    for (int i = 0; i < 8; ++i) {
        const Vec3 sign((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5);
        vertices.emplace_back(sign.cwiseProduct(size));
    }
    std::vector<TriangleCorners> triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                              {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return Mesh(std::move(vertices), std::move(triangles), sides);
}

/// Two planes that meet in the y axis. @param slope of both from there outwards; below 0 = a ridge
inline Mesh foldedMesh(double slope, int cells = 1, SurfaceSides sides = SurfaceSides::one) {
    std::vector<Vec3> vertices;
    std::vector<TriangleCorners> triangles;
    for (int j = 0; j <= cells; ++j) {
        const double y = 2.0 * j / cells - 1;
        vertices.emplace_back(-1, y, slope);
        vertices.emplace_back(0, y, 0);
        vertices.emplace_back(1, y, slope);
        if (j == 0) continue;
        const auto a = static_cast<std::uint32_t>(3 * (j - 1));
        triangles.push_back({a, a + 1, a + 4});
        triangles.push_back({a, a + 4, a + 3});
        triangles.push_back({a + 1, a + 2, a + 5});
        triangles.push_back({a + 1, a + 5, a + 4});
    }
    return Mesh(std::move(vertices), std::move(triangles), sides);
}

/// One of each kind of solid, about half a metre large.
inline std::vector<std::pair<const char*, Shape>> solids() {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i) {
        const double turn = 2 * std::numbers::pi * i / 8;
        points.emplace_back(0.25 * std::cos(turn), 0.2 * std::sin(turn), (i % 2 == 0 ? 0.2 : -0.2) + 0.01 * i);
    }
    return {{"sphere", Sphere{0.2}},
            {"box", Box{{0.4, 0.3, 0.2}}},
            {"capsule", Capsule{0.15, 0.3}},
            {"cylinder", Cylinder{0.15, 0.4}},
            {"hull", ConvexHull(points)},
            {"compound",
             Compound{{{Box{{0.3, 0.3, 0.1}}, {{0, 0, 0.1}}, {}, {}}, {Sphere{0.1}, {{0.1, 0, -0.1}}, {}, {}}}}}};
}

}  // namespace cairn::testing
