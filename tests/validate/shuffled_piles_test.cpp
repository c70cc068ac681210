/// Piles do not depend on the order in which their bodies stand in a scene, no more than on what nobody can measure.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "cairn/scene.h"
#include "validate/random.h"

namespace cairn::validation {
namespace {

struct Rest {
    double time = 0;     ///< until 98 % sleep [s]
    double overlap = 0;  ///< mean of the overlapping contacts then [m]
};

Rest rest(const Scene& scene) {
    SceneRun run(scene, settingsFor(scene));
    const World& world = run.world();
    const auto moving = std::ranges::count_if(scene.bodies, [](const SceneBody& body) { return !body.fixed; });
    double overlap = 0;
    while (world.time() < 20 && static_cast<double>(world.statistics().asleep) < 0.98 * static_cast<double>(moving)) {
        run.step();
        overlap = world.statistics().mean_overlap;
    }
    return {world.time(), overlap};
}

/// Poses changed by what a double hardly tells.
Scene changed(Scene scene, Random& random) {
    constexpr double little = 1e-9;
    for (SceneBody& body : scene.bodies) {
        if (body.fixed) continue;
        body.position += little * Vec3(random.normal(), random.normal(), random.normal());
        const Vec3 turn = little * Vec3(random.normal(), random.normal(), random.normal());
        body.orientation = (Quat(1, turn.x(), turn.y(), turn.z()) * body.orientation).normalized();
    }
    return scene;
}

Scene shuffled(Scene scene, Random& random) {
    for (std::size_t i = scene.bodies.size(); i > 1; --i) {
        const auto k = static_cast<std::size_t>(random.uniform() * static_cast<double>(i));
        std::swap(scene.bodies[i - 1], scene.bodies[k]);
    }
    return scene;
}

/// Least, middle and largest of one value.
std::array<double, 3> rangeOf(const std::vector<Rest>& rests, double Rest::*value) {
    std::vector<double> values;
    for (const Rest& r : rests) values.push_back(r.*value);
    std::ranges::sort(values);
    return {values.front(), values[values.size() / 2], values.back()};
}

// Medians, since in some runs a last ball rolls on for long, in whatever order.
TEST(ShuffledPiles, RestAsThoseWhosePosesHardlyDiffer) {
    for (const char* name : {"heap:100", "pit:300"}) {
        const Scene scene = builtInScene(name);
        Random random(7);
        std::vector<Rest> others, in_other_order;
        for (int i = 0; i < 10; ++i) {
            others.push_back(rest(changed(scene, random)));
            in_other_order.push_back(rest(shuffled(scene, random)));
        }
        for (const auto value : {&Rest::time, &Rest::overlap}) {
            const auto [least, middle, most] = rangeOf(others, value);
            EXPECT_LT(std::abs(rangeOf(in_other_order, value)[1] - middle), most - least) << name;
        }
    }
}

}  // namespace
}  // namespace cairn::validation
