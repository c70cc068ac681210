#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "experiment.h"
#include "moments.h"

namespace cairn::thesis {

namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

/// Four digits are more than a measured time is worth.
double rounded(double value) {
    if (value == 0 || !std::isfinite(value)) return value;
    const double scale = std::pow(10.0, 4 - std::ceil(std::log10(std::abs(value))));
    return std::round(value * scale) / scale;
}

/// As in the thesis's figures: finding contacts and grouping them, and answering them.
double detectionTime(const Statistics& statistics) {
    const auto& ms = statistics.stage_ms;
    return ms[static_cast<std::size_t>(Stage::detection)] + ms[static_cast<std::size_t>(Stage::batches)];
}
double responseTime(const Statistics& statistics) {
    const auto& ms = statistics.stage_ms;
    return ms[static_cast<std::size_t>(Stage::correction)] + ms[static_cast<std::size_t>(Stage::velocities)] +
           ms[static_cast<std::size_t>(Stage::resolution)] + ms[static_cast<std::size_t>(Stage::sleeping)];
}

/// One simulation step, with what only its single time steps know.
struct StepRecord {
    Statistics sum;
    std::int64_t contacts_in_largest_batches = 0;  ///< sum over the time steps
    double total_ms = 0;
};

StepRecord simulate(SceneRun& run) {
    StepRecord record;
    const auto begin = std::chrono::steady_clock::now();
    for (int left = run.stepsPerSimulationStep(); left > 0; --left) {
        run.step();
        const Statistics& statistics = run.world().statistics();
        record.sum.add(statistics);
        record.contacts_in_largest_batches += statistics.largest_batch;
    }
    record.total_ms = Milliseconds(std::chrono::steady_clock::now() - begin).count();
    return record;
}

void append(Json& value, const StepRecord& record) {
    value["total_ms"].push_back(rounded(record.total_ms));
    value["detection_ms"].push_back(rounded(detectionTime(record.sum)));
    value["response_ms"].push_back(rounded(responseTime(record.sum)));
    value["iterations"].push_back(record.sum.global_iterations + record.sum.shock_iterations);
    value["contacts"].push_back(record.sum.contacts);
    value["largest_batch"].push_back(record.contacts_in_largest_batches);
    value["asleep"].push_back(record.sum.asleep);
}

Json run(const SceneExperiment& what, const Surroundings& surroundings) {
    SceneRun scene_run(what.scene, what.settings);
    const auto steps = static_cast<std::int64_t>(std::ceil(what.scene.duration * simulation_steps_per_second - 1e-6));
    Moments moments(what, surroundings.recording);
    moments.look(scene_run, 0, {});
    Json value = {{"bodies", scene_run.world().bodyCount()}, {"threads", what.settings.parallel.threads}};
    for (std::int64_t step = 1; step <= steps; ++step) {
        const StepRecord record = simulate(scene_run);
        append(value, record);
        moments.look(scene_run, step, record.sum);
        surroundings.progress(static_cast<double>(step) / static_cast<double>(steps));
    }
    moments.close();
    value["lost"] = scene_run.world().faults().size();
    value["state_hash"] = fmt::format("{:016x}", scene_run.world().stateHash());
    return value;
}

}  // namespace

Experiment measureScene(SceneExperiment what) {
    Experiment experiment{what.key, what.weight, true, fingerprintOf(what.scene, what.settings), {}};
    experiment.run = [what = std::move(what)](const Surroundings& surroundings) { return run(what, surroundings); };
    return experiment;
}

Scene shortened(Scene scene, double seconds) {
    scene.duration = std::min(scene.duration, seconds);
    return scene;
}

}  // namespace cairn::thesis
