#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "scene_testing.h"

namespace cairn {
namespace {

SceneRun started(const std::string& name) {
    const Scene scene = builtInScene(name);
    return SceneRun(scene, settingsFor(scene));
}

/// What became of the load of a catapult, averaged over its boxes [m].
struct Toss {
    double height = 0;
    double distance = 0;
};

Toss toss(const std::string& name) {
    SceneRun run = started(name);
    const Scene scene = builtInScene(name);
    const std::size_t first = 3;  // after ground, fulcrum and plank
    const std::size_t last = scene.bodies.size() - 1;
    std::vector<Toss> tosses(last);
    while (run.world().time() < 2) {
        run.step();
        for (std::size_t i = first; i < last; ++i) {
            const Vec3 way = run.world().pose(run.ids()[i]).position - scene.bodies[i].position;
            tosses[i].height = std::max(tosses[i].height, way.z());
            tosses[i].distance = std::max(tosses[i].distance, way.head<2>().norm());
        }
    }
    Toss mean;
    for (std::size_t i = first; i < last; ++i) {
        mean.height += tosses[i].height / static_cast<double>(last - first);
        mean.distance += tosses[i].distance / static_cast<double>(last - first);
    }
    return mean;
}

// Thesis Figure 37.
TEST(Demonstrations, CatapultTossesTheLighterLoadHigherAndFarther) {
    const Toss heavy = toss("catapult7");
    const Toss light = toss("catapult15");
    EXPECT_GT(heavy.height, 0.5);
    EXPECT_GT(light.height, heavy.height);
    EXPECT_GT(light.distance, heavy.distance);
}

TEST(Demonstrations, CatapultIsAtRestUntilTheWeightFalls) {
    SceneRun run = started("catapult7");
    while (run.world().time() < 0.7) run.step();
    const Scene& scene = run.scene();
    for (std::size_t i = 2; i + 1 < scene.bodies.size(); ++i) {
        EXPECT_LT((run.world().pose(run.ids()[i]).position - scene.bodies[i].position).norm(), 2e-3) << i;
    }
}

// Thesis §5.6: as many balls leave as arrive, whatever their number.
TEST(Demonstrations, CradleSendsOutAsManyBallsAsArrive) {
    for (int arriving = 1; arriving <= 4; ++arriving) {
        SceneRun run = started("cradle:5:" + std::to_string(arriving));
        while (run.world().time() < 1) run.step();
        for (int i = 0; i < 5; ++i) {
            const double speed = run.world().linearVelocity(run.ids()[static_cast<std::size_t>(i)]).x();
            EXPECT_NEAR(speed, i >= 5 - arriving ? 1 : 0, 1e-3) << arriving << " arrive, ball " << i;
        }
    }
}

}  // namespace
}  // namespace cairn
