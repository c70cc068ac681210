#include "golden/scenes.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "golden/making.h"

namespace cairn::golden {
namespace {

Scene stacks(std::string_view name) {
    Scene scene = builtInScene(name);
    scene.bodies.back().position.x() = -0.4;  // the ball is about to hit the first wall
    return scene;
}

Scene well(std::string_view name) {
    Scene scene = builtInScene(name);
    for (SceneBody& body : scene.bodies) {
        if (!body.fixed) body.position.z() -= 0.35;
    }
    return scene;
}

Scene cage(std::string_view name) {
    Scene scene = builtInScene(name);
    scene.events.front().time = 0.1;  // of gravity
    return scene;
}

Scene catapult(std::string_view name) {
    Scene scene = builtInScene(name);
    SceneBody& weight = scene.bodies.back();  // has fallen almost down
    weight.position.z() = 1.1;
    weight.linear_velocity = {0, 0, -8};
    return scene;
}

constexpr std::array<Action, 1> push_tower = {{{0.1, [](SceneRun& run, const Scales& by) {
                                                    run.world().applyImpulse(run.ids()[12], impulse({2, 0.5, 0}, by));
                                                }}}};
constexpr std::array<Action, 1> push_wall = {{{0.1, [](SceneRun& run, const Scales& by) {
                                                   run.world().applyImpulse(run.ids()[14], impulse({2, 0.5, 0}, by));
                                               }}}};

constexpr auto table = std::to_array<GoldenScene>({
    {"stacks5", [] { return stacks("stacks5"); }, {24, 60, 120}, {48, 128, 192}},
    {"stacks8", [] { return stacks("stacks8"); }, {24, 60, 120}, {48, 128, 192}},
    {"well324", [] { return well("well324"); }, {30, 60, 120}, {120, 240, 360}},
    {"well392", [] { return well("well392"); }, {30, 60, 120}, {120, 240, 360}},
    {"cage384", [] { return cage("cage384"); }, {40, 90, 200}, {200, 400, 720}},
    {"cage2816", [] { return cage("cage2816"); }, {24, 60, 100}, {80, 160, 240}},
    {"catapult7", [] { return catapult("catapult7"); }, {24, 60, 120}, {60, 120, 300}},
    {"catapult15", [] { return catapult("catapult15"); }, {24, 60, 120}, {60, 120, 300}},
    {"cradle", [] { return builtInScene("cradle"); }, {12, 40, 120}, {48, 160, 480}},
    {"tower", [] { return builtInScene("tower:20"); }, {20, 100, 240}, {40, 120, 240}, push_tower},
    {"wall", [] { return builtInScene("wall:8"); }, {20, 60, 120}, {40, 110, 140}, push_wall},
    {"mixed_heap", mixedHeap, {30, 80, 180}, {120, 280, 480}},
    {"mechanism", mechanism, {30, 80, 240}, {120, 240, 480}},
    {"rolling_friction", rollingFriction, {30, 120, 240}, {60, 120, 240}},
    {"zero_gravity", zeroGravity, {20, 40, 80}, {80, 120, 240}},
    {"swaying_gravity", swayingGravity, {30, 80, 180}, {60, 160, 320}},
    {"terrain", terrain, {60, 120, 240}, {160, 320, 560}},
    {"waking_by_ball", settlingStacks, {90, 120, 200}, {360, 440, 720}, throw_ball},
    {"changing_bodies", changingPile, {20, 60, 120}, {40, 120, 260}, change_bodies},
    {"contacts319", [] { return crowdedSlab("319 contacts", 35, 0); }, {2, 4, 8}, {2, 6, 12}, {}, 319},
    {"contacts320", [] { return crowdedSlab("320 contacts", 35, 1); }, {2, 4, 8}, {2, 6, 12}, {}, 320},
    {"contacts1023", [] { return crowdedSlab("1023 contacts", 3, 992); }, {2, 8, 24}, {8, 24, 48}, {}, 1023},
    {"contacts1024", [] { return crowdedSlab("1024 contacts", 3, 993); }, {2, 8, 24}, {8, 24, 48}, {}, 1024},
    {"sliding3", [] { return rollingBalls("3 % sliding", 3); }, {4, 12, 24}, {16, 48, 96}, {}, 100},
    {"sliding4", [] { return rollingBalls("4 % sliding", 4); }, {4, 12, 24}, {16, 48, 96}, {}, 100},
    {"held30of40", [] { return partlyAsleep("30 of 40 asleep", 30); }, {4, 12, 24}, {16, 48, 96}},
    {"held31of40", [] { return partlyAsleep("31 of 40 asleep", 31); }, {4, 12, 24}, {16, 48, 96}},
    {"pile", pyramid, {6, 30, 90}, {24, 90, 180}},
    {"pile_with_joint", jointedPyramid, {6, 30, 90}, {24, 90, 180}},
});

/// The steps of thesis_accuracy, whose iterations have no limit: where the cost is bearable, and as far as it is.
constexpr auto thesis_accuracy_steps = std::to_array<std::pair<std::string_view, HashSteps>>({
    {"stacks5", {24, 48, 64}},
    {"stacks8", {16, 24, 32}},
    {"well324", {40, 80, 120}},
    {"well392", {40, 80, 120}},
    {"cage384", {100, 200, 260}},
    {"catapult7", {60, 120, 160}},
    {"catapult15", {60, 120, 160}},
    {"cradle", {48, 160, 480}},
    {"tower", {40, 120, 240}},
    {"wall", {40, 110, 140}},
    {"mixed_heap", {60, 120, 180}},
    {"rolling_friction", {60, 120, 240}},
    {"zero_gravity", {80, 120, 240}},
    {"pile", {24, 60, 90}},
});

Settings settingsOf(const Scene& scene, Kind kind, std::int64_t threads) {
    Settings settings;
    if (kind == Kind::thesis || kind == Kind::thesis_accuracy) {
        // Their rows are kept for the thresholds of 10 m/s², whatever a scene's gravity is.
        settings = Settings::preset(kind == Kind::thesis ? Preset::thesis : Preset::thesis_accuracy);
        for (const auto& [name, value] : scene.settings) setField(settings, name, value);
    } else {
        SettingOverrides overrides;
        overrides.preset = kind == Kind::accuracy ? Preset::accuracy : Preset::performance;
        settings = settingsFor(scene, overrides);
    }
    settings.parallel = {threads, true};
    return settings;
}

SceneRun start(const GoldenScene& golden, Kind kind, std::int64_t threads, const Scales& scales) {
    const Scene scene = scaled(golden.make(), scales);
    return SceneRun(scene, settingsOf(scene, kind, threads));
}

}  // namespace

std::string_view nameOf(Kind kind) {
    switch (kind) {
        case Kind::performance:
            return "performance";
        case Kind::accuracy:
            return "accuracy";
        case Kind::thesis:
            return "thesis";
        case Kind::thesis_accuracy:
            return "thesis_accuracy";
    }
    throw std::logic_error("a kind of settings without a name");
}

std::span<const std::int64_t> GoldenScene::hashSteps(Kind kind) const {
    if (kind == Kind::accuracy) return accuracy_steps;
    if (kind != Kind::thesis_accuracy) return steps;
    const auto found = std::ranges::find(thesis_accuracy_steps, name, &std::pair<std::string_view, HashSteps>::first);
    if (found == thesis_accuracy_steps.end()) return {};
    return found->second;
}

std::span<const GoldenScene> goldenScenes() {
    return table;
}

const GoldenScene& goldenScene(std::string_view name) {
    const auto found = std::ranges::find(table, name, &GoldenScene::name);
    if (found == table.end()) throw std::out_of_range("no golden scene is called " + std::string(name));
    return *found;
}

GoldenRun::GoldenRun(const GoldenScene& golden, Kind kind, std::int64_t threads, const Scales& scales)
    : left_(golden.actions), scales_(scales), run_(start(golden, kind, threads, scales)) {}

void GoldenRun::step() {
    // A time that is a whole number of steps belongs to that step, however it is rounded.
    const double now = run_.world().time() / scales_.time + 1e-9;
    while (!left_.empty() && left_.front().time <= now) {
        run_.world().gather();
        left_.front().act(run_, scales_);
        left_ = left_.subspan(1);
    }
    run_.step();
}

void GoldenRun::stepUntil(std::int64_t count) {
    while (world().stepCount() < count) step();
}

}  // namespace cairn::golden
