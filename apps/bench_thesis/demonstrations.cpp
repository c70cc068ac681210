#include "demonstrations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "demonstration_scenes.h"
#include "moments.h"
#include "thesis_settings.h"

namespace cairn::thesis {

namespace {

constexpr std::int64_t threads = 1;  // a dozen bodies

/// The performance settings, with room for the gravity of the scene.
Settings settingsOf(const Scene& scene) {
    Settings settings = thesisSettings(Preset::thesis, threads);
    // Without gravity nothing pulls a body down again, so none may be put to sleep (3.2.5).
    if (scene.gravity.isZero()) settings.sleep.sleeping = false;
    return settings;
}

std::int64_t simulationSteps(const Scene& scene) {
    return static_cast<std::int64_t>(std::ceil(scene.duration * simulation_steps_per_second - 1e-6));
}

Experiment demonstration(std::string key, double weight, Scene scene, std::function<Json(const Surroundings&)> run) {
    const Settings settings = settingsOf(scene);
    return {std::move(key), weight, false, fingerprintOf(scene, settings), std::move(run)};
}

/// The boxes that a catapult throws.
std::vector<std::size_t> loadOf(const Scene& scene) {
    std::vector<std::size_t> load;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        if (!body.fixed && body.name != "plank" && body.name != "weight") load.push_back(i);
    }
    return load;
}

Json throwLoad(const SceneExperiment& what, const Surroundings& surroundings) {
    const Scene& scene = what.scene;
    SceneRun run(scene, what.settings);
    Moments moments(what, surroundings.recording);
    moments.look(run, 0, {});
    const std::vector<std::size_t> load = loadOf(scene);
    Json value = {{"boxes", load.size()}};
    double peak = 0;
    double range = 0;
    const std::int64_t steps = simulationSteps(scene);
    for (std::int64_t step = 1; step <= steps; ++step) {
        moments.look(run, step, run.simulationStep());
        double height = 0;
        range = 0;
        for (const std::size_t i : load) {
            const Vec3 now = run.world().pose(run.ids()[i]).position;
            const Vec3 way = now - scene.bodies[i].position;
            height = std::max(height, now.z());
            range = std::max(range, std::hypot(way.x(), way.y()));
        }
        peak = std::max(peak, height);
        value["height_m"].push_back(height);
        value["distance_m"].push_back(range);
        surroundings.progress(static_cast<double>(step) / static_cast<double>(steps));
    }
    moments.close();
    value["peak_m"] = peak;
    value["range_m"] = range;
    value["lost"] = run.world().faults().size();
    return value;
}

Json swing(const Scene& scene, int balls, int moving) {
    SceneRun run(scene, settingsOf(scene));
    const Vec3 momentum = run.world().linearMomentum();
    const double energy = run.world().kineticEnergy();
    const double speed = scene.bodies.front().linear_velocity.x();
    for (std::int64_t step = simulationSteps(scene); step > 0; --step) run.simulationStep();
    double error = 0;
    for (int i = 0; i < balls; ++i) {
        const Vec3 exact = Vec3::UnitX() * (i >= balls - moving ? speed : 0);
        const BodyId id = run.ids()[static_cast<std::size_t>(i)];
        error = std::max(error, (run.world().linearVelocity(id) - exact).norm() / speed);
    }
    return {{"velocity_error", error},
            {"momentum_error", (run.world().linearMomentum() - momentum).norm() / momentum.norm()},
            {"energy_error", std::abs(run.world().kineticEnergy() / energy - 1)}};
}

Json swingForEver(const Scene& scene, std::int64_t time_steps, const Surroundings& surroundings) {
    constexpr std::int64_t samples = 200;
    SceneRun run(scene, settingsOf(scene));
    const double energy = run.world().kineticEnergy();
    Json value = {{"steps", time_steps}};
    for (std::int64_t sample = 1; sample <= samples; ++sample) {
        while (run.world().stepCount() < sample * time_steps / samples) run.step();
        value["time_s"].push_back(run.world().time());
        value["energy_error"].push_back(run.world().kineticEnergy() / energy - 1);
        surroundings.progress(static_cast<double>(sample) / samples);
    }
    const auto moves = [&](BodyId id) { return run.world().linearVelocity(id).norm() > 1e-9; };
    value["moving"] = std::count_if(run.ids().begin(), run.ids().end(), moves);
    return value;
}

Json spinDown(const Scene& scene, const Surroundings& surroundings) {
    SceneRun run(scene, settingsOf(scene));
    const BodyId ball = run.ids()[spinning_ball];
    const std::int64_t steps = simulationSteps(scene);
    Json value = {{"rest_step", nullptr}};
    for (std::int64_t step = 1; step <= steps; ++step) {
        run.simulationStep();
        value["spin"].push_back(run.world().angularVelocity(ball).norm());
        if (!run.world().isAsleep(ball)) {
            value["rest_step"] = nullptr;
        } else if (value["rest_step"].is_null()) {
            value["rest_step"] = step;
        }
        surroundings.progress(static_cast<double>(step) / static_cast<double>(steps));
    }
    value["lost"] = run.world().faults().size();
    return value;
}

}  // namespace

Experiment catapult(const std::string& scene) {
    SceneExperiment what{scene, builtInScene(scene), {}, 0.2, {0, 1, 1.2}};
    what.settings = settingsOf(what.scene);
    return demonstration(scene, what.weight, what.scene,
                         [what](const Surroundings& surroundings) { return throwLoad(what, surroundings); });
}

Experiment cradle(int balls, int moving) {
    const std::string name = fmt::format("cradle:{}:{}", balls, moving);
    const Scene scene = builtInScene(name);
    return demonstration(fmt::format("cradle-{}-{}", balls, moving), 0.02, scene,
                         [=](const Surroundings&) { return swing(scene, balls, moving); });
}

Experiment endlessCradle(int balls, int moving, std::int64_t time_steps) {
    const Scene scene = endlessCradleScene(balls, moving);
    return demonstration(
        fmt::format("cradle-{}-{}-steps{}", balls, moving, time_steps), 3e-6 * static_cast<double>(time_steps), scene,
        [=](const Surroundings& surroundings) { return swingForEver(scene, time_steps, surroundings); });
}

Experiment spinningBall(SpinAxis axis) {
    const bool horizontal = axis == SpinAxis::horizontal;
    const Scene scene = spinningBallScene(horizontal ? Vec3::UnitX() : Vec3::UnitZ());
    return demonstration(horizontal ? "spin-horizontal" : "spin-vertical", 0.1, scene,
                         [=](const Surroundings& surroundings) { return spinDown(scene, surroundings); });
}

}  // namespace cairn::thesis
