/// @file Solids of all kinds thrown onto rough ground of triangles, for tests and for tools/drops.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "cairn/world.h"
#include "surface_maker.h"

namespace cairn::testing {

/// What the ground of the throws is made of.
enum class Ground { mesh, height_field };

/// Whether the solids of a world meet each other.
enum class Company {
    alone,     ///< each meets the ground only
    together,  ///< they strike and bury each other
};

/// Throws that fill one world.
struct Throws {
    Ground ground = Ground::mesh;
    Company company = Company::alone;
    Settings settings{};
    std::uint64_t seed = 1;
    int bodies = 240;
    double seconds = 1.5;  ///< all have fallen after 0.9
    double fastest = 40;   ///< downwards [m/s]
    double smallest = 1;   ///< of the sizes, as a part of the largest, which is about half a metre
};

/// A solid that is below the ground.
struct LostSolid {
    std::uint64_t seed;
    std::uint32_t index;
    std::string kind;
    Vec3 position;
};

inline double roughHeight(double x, double y) {
    return 0.4 * std::sin(2 * x) * std::cos(3 * y);
}

/// Hills of triangles 20 cm wide, with a rim that nothing leaves over.
inline Shape roughGround(Ground kind) {
    constexpr int cells = 60;
    constexpr double edge = 12;
    const auto height = [](double x, double y) {
        return roughHeight(x, y) + (std::max(std::abs(x), std::abs(y)) > 5 ? 40.0 : 0.0);
    };
    if (kind == Ground::mesh) return irregularMesh(cells, edge, 21, height);
    const double spacing = edge / cells;
    std::vector<double> heights;
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) heights.push_back(height(i * spacing - 0.5 * edge, j * spacing - 0.5 * edge));
    }
    return HeightField(cells + 1, heights, {spacing, spacing});
}

/// A solid with all lengths multiplied.
inline Shape scaledSolid(const Shape& shape, double by) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return Sphere{by * sphere->radius};
    if (const auto* box = std::get_if<Box>(&shape)) return Box{by * box->size};
    if (const auto* capsule = std::get_if<Capsule>(&shape)) return Capsule{by * capsule->radius, by * capsule->length};
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        return Cylinder{by * cylinder->radius, by * cylinder->length};
    }
    if (const auto* hull = std::get_if<ConvexHull>(&shape)) {
        std::vector<Vec3> points;
        for (const Vec3& corner : hull->corners()) points.emplace_back(by * corner);
        return ConvexHull(points);
    }
    Compound compound = std::get<Compound>(shape);
    for (CompoundPart& part : compound.parts) {
        part.shape = scaledSolid(part.shape, by);
        part.pose.position *= by;
    }
    return compound;
}

/// Throws one world full. @param ground of roughGround() @return what fell through
inline std::vector<LostSolid> throwSolids(const Shape& ground, const Throws& throws) {
    constexpr double below = 0.1;  // the middle of a body that is so far below the ground is lost [m]
    World world(throws.settings);
    const MaterialId oak = world.addMaterial({"oak", 800});
    world.setDefaultPairProperties({0.3, 0.5, 0.5});
    world.setGravity(Vec3(0, 0, -10));
    const GroupId thrown = world.addGroup("thrown");
    world.setGroupsTouch(thrown, thrown, throws.company == Company::together ? Touch::always : Touch::never);
    world.addBody({.shape = ground, .material = oak, .fixed = true});
    Random random(throws.seed);
    const auto shapes = solids();
    std::vector<BodyId> bodies;
    const auto kindOf = [&](std::size_t i) { return i % shapes.size(); };
    for (std::size_t i = 0; i < static_cast<std::size_t>(throws.bodies); ++i) {
        const Vec3 at(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(1, 3));
        const Vec3 v(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-throws.fastest, 0));
        const Quat turn = random.orientation();
        const Vec3 spin = random.vector(5);
        const Shape& whole = shapes[kindOf(i)].second;
        const double size = throws.smallest < 1 ? std::pow(throws.smallest, random.uniform(0, 1)) : 1;
        bodies.push_back(world.addBody({.shape = size < 1 ? scaledSolid(whole, size) : whole,
                                        .material = oak,
                                        .pose = {at, turn},
                                        .linear_velocity = v,
                                        .angular_velocity = spin,
                                        .groups = {thrown}}));
    }
    while (world.time() < throws.seconds) world.step();
    std::vector<LostSolid> lost;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec3 p = world.pose(bodies[i]).position;
        if (p.z() > roughHeight(p.x(), p.y()) - below) continue;
        lost.push_back({throws.seed, bodies[i].index, shapes[kindOf(i)].first, p});
    }
    return lost;
}

}  // namespace cairn::testing
