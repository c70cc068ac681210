/// Scenes of which everything is larger, slower and heavier, so that gravity stays, move alike bit for bit: no length,
/// time or mass is built into the engine.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "cairn/scene.h"
#include "golden/scene_names.h"
#include "golden/scenes.h"

namespace cairn {
namespace {

/// Lengths times 4ⁿ and what follows: powers of two, of which the roots that the engine takes are such, too, so that no
/// multiplication rounds.
Scales powerOf(int n) {
    return {std::ldexp(1.0, 2 * n), std::ldexp(1.0, n), std::ldexp(1.0, 6 * n)};
}

const std::array other_scales = {powerOf(1), powerOf(5), powerOf(-5)};

/// Equal, or both so small that products of them leave the range of doubles: what rounding left of a component that is
/// zero, and no step makes larger.
template <class Vector>
bool areAlike(const Vector& one, const Vector& other) {
    constexpr double nothing = 1e-70;
    return one == other || (one - other).cwiseAbs().maxCoeff() < nothing;
}

/// What differs in the first body that is not where the other one is; empty = nothing.
std::string difference(const BodyViews& one, const BodyViews& other, const Scales& by) {
    if (one.slots() != other.slots()) return "number of slots";
    const double speed = by.length / by.time;
    for (std::size_t i = 0; i < one.slots(); ++i) {
        if (one.kind[i] != other.kind[i]) return "kind of body " + std::to_string(i);
        if (one.kind[i] == BodyKind::hole) continue;
        const std::string body = " of body " + std::to_string(i);
        if (one.centre_of_mass[i] * by.length != other.centre_of_mass[i]) return "position" + body;
        if (!areAlike(one.principal_axes[i].coeffs(), other.principal_axes[i].coeffs())) return "orientation" + body;
        if (!areAlike<Vec3>(one.linear_velocity[i] * speed, other.linear_velocity[i])) return "velocity" + body;
        if (!areAlike<Vec3>(one.angular_velocity[i] / by.time, other.angular_velocity[i])) return "spin" + body;
        if (one.asleep[i] != other.asleep[i]) return "sleep" + body;
    }
    return {};
}

/// @param make of a run that is scaled @param steps time steps
template <class Make>
void expectAlike(const Make& make, std::int64_t steps) {
    const auto first = make(Scales{});
    std::vector<decltype(make(Scales{}))> others;
    for (const Scales& scales : other_scales) others.push_back(make(scales));
    while (first->world().stepCount() < steps) {
        first->step();
        const BodyViews bodies = first->world().bodyViews();
        for (std::size_t i = 0; i < others.size(); ++i) {
            others[i]->step();
            ASSERT_EQ(difference(bodies, others[i]->world().bodyViews(), other_scales[i]), "")
                << "lengths times " << other_scales[i].length << ", time step " << first->world().stepCount();
        }
    }
}

/// The golden scenes with the presets whose thresholds follow the sizes.
class Similarity : public testing::TestWithParam<golden::SceneAndKind> {};

TEST_P(Similarity, ScaledScenesMoveAlike) {
    const auto [name, kind] = GetParam();
    const golden::GoldenScene& scene = golden::goldenScene(name);
    const auto make = [&, kind = kind](const Scales& scales) {
        return std::make_unique<golden::GoldenRun>(scene, kind, 1, scales);
    };
    expectAlike(make, scene.hashSteps(kind).back());
}

std::vector<golden::SceneAndKind> scenesWithDerivedThresholds() {
    std::vector<golden::SceneAndKind> all = golden::everySceneWithEveryKind();
    std::erase_if(all, [](const auto& scene) {
        const golden::Kind kind = std::get<golden::Kind>(scene);
        return kind != golden::Kind::performance && kind != golden::Kind::accuracy;
    });
    return all;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Similarity, testing::ValuesIn(scenesWithDerivedThresholds()),
                         golden::nameOfSceneAndKind);

TEST(BuiltInScenes, MoveAlikeWhenTheyAreScaled) {
    constexpr std::size_t most_bodies = 1000;
    for (const BuiltInScene& named : builtInScenes()) {
        const Scene scene = builtInScene(named.example);
        if (scene.bodies.size() > most_bodies) continue;
        SCOPED_TRACE(named.example);
        const auto make = [&](const Scales& scales) {
            const Scene other = scaled(scene, scales);
            return std::make_unique<SceneRun>(other, settingsFor(other));
        };
        expectAlike(make, 60);
    }
}

TEST(SimilaritySettings, HoldWhateverIsGiven) {
    Scene scene = builtInScene("cage384");
    scene.settings = {{"steps_per_second", 150.0},       {"contact_margin", 0.0005},
                      {"penetration_threshold", 0.0003}, {"resolution_threshold", 0.0002},
                      {"restitution_threshold", 0.03},   {"sleep_threshold", 0.01}};
    const auto make = [&](const Scales& scales) {
        const Scene other = scaled(scene, scales);
        return std::make_unique<SceneRun>(other, settingsFor(other));
    };
    expectAlike(make, 120);
}

}  // namespace
}  // namespace cairn
