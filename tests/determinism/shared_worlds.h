/// @file What tests of worlds that ranks share have in common.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "cairn/ranks.h"
#include "cairn/scene.h"

namespace cairn {

inline constexpr Partition by_hash{.kind = PartitionKind::hash};
inline constexpr Partition restless{.kind = PartitionKind::hash, .restless = true};

/// Lets a scene run so many steps, alone and on some ranks, and expects the same states.
inline void expectSameSteps(const SceneSource& scene, int steps, const Partition& partition, int count = 3) {
    SceneRun alone(scene, settingsFor(scene));
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < steps; ++i) {
        alone.step();
        hashes.push_back(alone.world().stateHash());
    }
    runRanks(count, [&](Ranks& ranks) {
        SceneRun run(scene, settingsFor(scene), ranks, partition);
        for (int i = 0; i < steps; ++i) {
            run.step();
            ASSERT_EQ(sumOverRanks(ranks, run.world().stateHash()), hashes[static_cast<std::size_t>(i)]) << i;
        }
        run.world().gather();
        EXPECT_EQ(run.world().kineticEnergy(), alone.world().kineticEnergy());
        EXPECT_EQ(run.world().potentialEnergy(), alone.world().potentialEnergy());
        EXPECT_TRUE(std::ranges::equal(run.world().sensed(), alone.world().sensed()));
        EXPECT_TRUE(run.world().save() == alone.world().save());
    });
}

inline SceneBody ballAt(const Vec3& position) {
    SceneBody ball;
    ball.shape = Sphere{0.1};
    ball.material = "stone";
    ball.position = position;
    return ball;
}

/// Balls over a plane, in a row.
inline Scene row(int count) {
    Scene scene;
    scene.name = "row";
    scene.duration = 1;
    scene.gravity = {0, 0, -9.81};
    scene.materials = {{"stone", 2500}};
    SceneBody ground;
    ground.shape = HalfSpace{Vec3::UnitZ(), 0};
    ground.material = "stone";
    ground.fixed = true;
    scene.bodies = {ground};
    for (int i = 0; i < count; ++i) scene.bodies.push_back(ballAt({0.5 * i, 0, 0.1 + 0.05 * i}));
    return scene;
}

/// The text of the error of a call.
template <class Call>
std::string errorOf(const Call& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace cairn
