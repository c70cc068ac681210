/// @file Surfaces for tests, the same on every machine.
#pragma once

#include <array>
#include <cmath>
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

/// A closed surface made of patches; where two of them have the same place it is one vertex.
class PatchedSurface {
  public:
    explicit PatchedSurface(std::uint64_t seed) : random_(seed) {}

    /// Adds triangles over a grid whose inner vertices are moved at random and whose diagonals run at random.
    /// @param place of u and v from 0 to 1 [m], the same to the bit on borders with other patches
    template <class Place>
    void add(int cells_u, int cells_v, const Vec3& outward, const Place& place) {
        const auto first = static_cast<std::uint32_t>(vertices_.size());
        for (int j = 0; j <= cells_v; ++j) {
            for (int i = 0; i <= cells_u; ++i) {
                const bool inner = i > 0 && i < cells_u && j > 0 && j < cells_v;
                const double aside = inner ? random_.uniform(-0.22, 0.22) : 0;
                const double along = inner ? random_.uniform(-0.22, 0.22) : 0;
                vertices_.push_back(place((i + aside) / cells_u, (j + along) / cells_v));
            }
        }
        const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (cells_u + 1) + i); };
        for (int j = 0; j < cells_v; ++j) {
            for (int i = 0; i < cells_u; ++i) {
                if (random_.below(2) == 0) {
                    addTriangle({at(i, j), at(i + 1, j), at(i + 1, j + 1)}, outward);
                    addTriangle({at(i, j), at(i + 1, j + 1), at(i, j + 1)}, outward);
                } else {
                    addTriangle({at(i, j), at(i + 1, j), at(i, j + 1)}, outward);
                    addTriangle({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, outward);
                }
            }
        }
    }
    Mesh mesh() const { return Mesh(vertices_, triangles_); }

  private:
    void addTriangle(TriangleCorners corners, const Vec3& outward) {
        const Vec3& a = vertices_[corners[0]];
        if ((vertices_[corners[1]] - a).cross(vertices_[corners[2]] - a).dot(outward) < 0) {
            std::swap(corners[1], corners[2]);
        }
        triangles_.push_back(corners);
    }

    Random random_;
    std::vector<Vec3> vertices_;
    std::vector<TriangleCorners> triangles_;
};

/// As boxMesh(), of many irregular triangles. @param cells along each edge
inline Mesh fineBoxMesh(const Vec3& size, const std::array<int, 3>& cells, std::uint64_t seed) {
    PatchedSurface surface(seed);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        for (const double end : {-0.5, 0.5}) {
            const auto axis = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
            surface.add(cells[u], cells[v], end * Vec3::Unit(axis(k)), [&](double at_u, double at_v) {
                Vec3 p;
                p[axis(k)] = end * size[axis(k)];
                p[axis(u)] = (at_u - 0.5) * size[axis(u)];
                p[axis(v)] = (at_v - 0.5) * size[axis(v)];
                return p;
            });
        }
    }
    return surface.mesh();
}

/// A cylinder about the z axis as it is triangulated: with plane facets, the first one towards x.
struct Prism {
    double radius;  ///< of its edges [m]
    double length;  ///< [m]
    int facets;

    /// How far its facets are from the axis [m].
    double inscribed() const { return radius * std::cos(std::numbers::pi / facets); }
    /// Where a facet begins. @param end −1 or 1
    Vec3 corner(int facet, double end) const {
        const double turn = (2 * (facet % facets) - 1) * std::numbers::pi / facets;
        return {radius * std::cos(turn), radius * std::sin(turn), 0.5 * end * length};
    }
    std::vector<Vec3> corners() const {
        std::vector<Vec3> all;
        for (int i = 0; i < facets; ++i) {
            for (const double end : {-1.0, 1.0}) all.push_back(corner(i, end));
        }
        return all;
    }
    /// @param across, along cells of a facet @param rings of the caps
    Mesh mesh(int across, int along, int rings, std::uint64_t seed) const {
        PatchedSurface surface(seed);
        for (int i = 0; i < facets; ++i) {
            const auto rim = [&](double u) -> Vec3 { return (1 - u) * corner(i, 0) + u * corner(i + 1, 0); };
            surface.add(across, along, rim(0.5),
                        [&](double u, double v) -> Vec3 { return rim(u) + (v - 0.5) * length * Vec3::UnitZ(); });
            for (const double end : {-0.5, 0.5}) {
                surface.add(across, rings, end * Vec3::UnitZ(),
                            [&](double u, double v) -> Vec3 { return v * rim(u) + end * length * Vec3::UnitZ(); });
            }
        }
        return surface.mesh();
    }
};

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
