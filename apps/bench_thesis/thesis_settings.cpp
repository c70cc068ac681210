#include "thesis_settings.h"

namespace cairn::thesis {

namespace {

/// §5.1, "high performance solver settings".
void setPerformance(Settings& settings) {
    settings.steps_per_second = 240;
    settings.correction.penetration_threshold = 1.74e-3;
    settings.sleep.sleep_threshold = 8.33e-3;
    settings.resolution.resolution_threshold = 83.4e-6;
    settings.resolution.global_iterations = 2;
    settings.resolution.shock_propagation = true;
    settings.resolution.shock_iterations = 6;
    settings.resolution.restitution_threshold = 4.58e-2;
    settings.gravity_damping.damping = 0.7;
    settings.gravity_damping.damping_threshold = 8.33e-2;
}

/// §5.5, "high accuracy solver settings".
void setAccuracy(Settings& settings) {
    settings.steps_per_second = 960;
    settings.correction.penetration_threshold = 0.1e-3;
    settings.sleep.sleep_threshold = 0.52e-3;
    settings.resolution.resolution_threshold = 5.2e-6;
    settings.resolution.global_iterations = 0;
    settings.resolution.shock_propagation = false;
    settings.resolution.restitution_threshold = 1.15e-2;
    settings.gravity_damping.damping = 0;
}

}  // namespace

Settings thesisSettings(Preset preset, std::int64_t threads, Variant variant) {
    // What the thesis does not name (contact margin, bias of the motion, queue switch, ...) is the preset's.
    Settings settings = Settings::preset(preset);
    settings.parallel.threads = threads;
    settings.correction.correction = CorrectionKind::propagated;
    settings.correction.spread_levels = 0;
    settings.correction.correction_rounds = 1;
    settings.resolution.resolution = ResolutionKind::impulse_queue;
    settings.resolution.order = ResolutionOrder::highest_closing_speed;
    settings.sleep.sleeping = true;
    if (preset == Preset::performance) {
        setPerformance(settings);
    } else {
        setAccuracy(settings);
    }
    if (variant == Variant::undamped) settings.gravity_damping.damping = 0;
    if (variant == Variant::greedy || variant == Variant::latest_first) {
        settings.resolution.global_iterations = 0;
        settings.resolution.shock_propagation = false;
    }
    if (variant == Variant::latest_first) settings.resolution.order = ResolutionOrder::arbitrary;
    return settings;
}

}  // namespace cairn::thesis
