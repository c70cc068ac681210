/// @file Throws solids of all kinds onto rough ground of triangles and counts those that end below it.
/// Usage: cairn_drops THROWS SEED [PRESET [STEPS_PER_SECOND]]
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "cairn/world.h"
#include "surface_maker.h"

namespace {

using namespace cairn;
using cairn::testing::Random;

constexpr int bodies_per_world = 240;
constexpr int worlds_per_line = 50;  ///< between two lines that tell how far it is
constexpr double seconds = 1.5;      ///< in which all have fallen and met the ground many times
constexpr double fastest = 40;       ///< [m/s]
constexpr double below = 0.1;        ///< the middle of a body that is so far below the ground is lost [m]

double groundHeight(double x, double y) {
    return 0.4 * std::sin(2 * x) * std::cos(3 * y);
}

/// Hills of triangles 20 cm wide, with a rim that nothing leaves over.
Mesh roughGround() {
    return testing::irregularMesh(60, 12, 21, [](double x, double y) {
        return groundHeight(x, y) + (std::max(std::abs(x), std::abs(y)) > 5 ? 40.0 : 0.0);
    });
}

struct Thrown {
    BodyId id;
    const char* kind;
};

/// Throws one world full. @return how many of each kind were lost
std::map<std::string, int> throwAll(const Shape& ground, const Settings& settings, std::uint64_t seed) {
    World world(settings);
    const MaterialId oak = world.addMaterial({"oak", 800});
    world.setDefaultPairProperties({0.3, 0.5, 0.5});
    world.setGravity(Vec3(0, 0, -10));
    world.addBody({.shape = ground, .material = oak, .fixed = true});
    Random random(seed);
    const auto shapes = testing::solids();
    std::vector<Thrown> thrown;
    for (int i = 0; i < bodies_per_world; ++i) {
        const auto& [kind, shape] = shapes[static_cast<std::size_t>(i) % shapes.size()];
        const Vec3 at(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(1.5, 6));
        const Vec3 v(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-fastest, 0));
        thrown.push_back({world.addBody({.shape = shape,
                                         .material = oak,
                                         .pose = {at, random.orientation()},
                                         .linear_velocity = v,
                                         .angular_velocity = random.vector(5)}),
                          kind});
    }
    while (world.time() < seconds) world.step();
    std::map<std::string, int> lost;
    for (const Thrown& t : thrown) {
        const Vec3 p = world.pose(t.id).position;
        if (p.z() > groundHeight(p.x(), p.y()) - below) continue;
        ++lost[t.kind];
        fmt::print("lost: seed {} body {} ({}) is at ({}, {}, {})\n", seed, t.id.index, t.kind, p.x(), p.y(), p.z());
    }
    return lost;
}

int run(int throws, std::uint64_t seed, const Settings& settings) {
    const Shape ground = roughGround();
    std::map<std::string, int> lost;
    int done = 0;
    while (done < throws) {
        for (const auto& [kind, count] : throwAll(ground, settings, seed++)) lost[kind] += count;
        done += bodies_per_world;
        if (done / bodies_per_world % worlds_per_line != 0 && done < throws) continue;
        int all = 0;
        for (const auto& [kind, count] : lost) all += count;
        fmt::print("{} thrown, {} lost\n", done, all);
        std::fflush(stdout);
    }
    return lost.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        fmt::print(stderr, "usage: cairn_drops THROWS SEED [PRESET [STEPS_PER_SECOND]]\n");
        return 2;
    }
    const std::string preset = argc > 3 ? argv[3] : "performance";
    const double rate = argc > 4 ? std::atof(argv[4]) : 240;
    return run(std::atoi(argv[1]), std::strtoull(argv[2], nullptr, 10), Settings::preset(presetNamed(preset), rate));
}
