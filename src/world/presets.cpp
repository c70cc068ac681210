#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/settings.h"

namespace cairn {

namespace {

constexpr std::array<std::string_view, 4> preset_names = {"performance", "accuracy", "thesis", "thesis_accuracy"};

/// Time steps per second that a preset's thresholds are given for.
double ownSteps(Preset preset) {
    return preset == Preset::accuracy || preset == Preset::thesis_accuracy ? 960 : 240;
}

/// The defaults. @param scale |g|Δt as a multiple of that with 10 m/s² and the preset's own time step; below likewise
void setPerformance(Settings& s, double scale) {
    s.resolution.resolution_threshold *= scale;
    s.resolution.restitution_threshold *= scale;
    s.resolution.sweep_tolerance *= scale;
    s.resolution.wake_speed *= scale;
    s.sleep.sleep_threshold *= scale;
    s.gravity_damping.damping_threshold *= scale;
}

void setAccuracy(Settings& s, double scale) {
    s.correction.allowed_overlap = 0.83e-3;
    s.resolution.resolution_threshold = 5.2e-6 * scale;
    s.resolution.restitution_threshold = 11.5e-3 * scale;
    s.resolution.global_iterations = 0;
    s.resolution.shock_propagation = false;
    s.resolution.tolerance = 0.01;
    s.resolution.sweep_tolerance = 1e-8 * scale;
    s.resolution.direct_limit = 1000;
    s.resolution.direct_pairs = 0;
    s.resolution.wake_speed = 0.52e-3 * scale;
    s.sleep.sleep_threshold = 0.52e-3 * scale;
    s.gravity_damping.damping = 0;
    s.gravity_damping.damping_threshold = 0;
}

/// The algorithms of the thesis, and none of what was added since: nothing is looked ahead for, begins with the last
/// step's impulses or is held still. All that its results depend on is named here, whatever the defaults
/// become.
void setThesisAlgorithms(Settings& s) {
    s.detection.broad_phase = BroadPhaseKind::hash_grids;
    s.detection.speculative_contacts = false;
    s.correction.correction = CorrectionKind::propagated;
    s.correction.remaining_penetration = 0.7;
    s.resolution.resolution = ResolutionKind::impulse_queue;
    s.resolution.order = ResolutionOrder::highest_closing_speed;
    s.resolution.restitution_law = RestitutionLaw::newton;
    s.resolution.restitution_speed = RestitutionSpeed::closing;
    s.resolution.impacts = Impacts::of_resolution;
    s.resolution.shock_iterations = 6;
    s.resolution.queue_switch = 64;
    s.resolution.wake_speed = 0;
    s.sleep.sleeping = true;
    s.sleep.motion_limit = 3;
    s.integration.gyroscopic = true;
    s.integration.exact_flight = false;
}

/// "High performance solver settings". @source thesis §5.1
void setThesis(Settings& s, double scale) {
    setThesisAlgorithms(s);
    s.detection.contact_margin = 1e-4;
    s.correction.penetration_threshold = 1.74e-3;
    s.resolution.resolution_threshold = 83.4e-6 * scale;
    s.resolution.restitution_threshold = 45.8e-3 * scale;
    s.resolution.global_iterations = 2;
    s.resolution.shock_propagation = true;
    s.sleep.sleep_threshold = 8.33e-3 * scale;
    s.gravity_damping.damping = 0.7;
    s.gravity_damping.damping_threshold = 83.3e-3 * scale;
}

/// "High accuracy solver settings". @source thesis §5.5
void setThesisAccuracy(Settings& s, double scale) {
    setThesisAlgorithms(s);
    s.detection.contact_margin = 1e-5;
    s.correction.penetration_threshold = 0.1e-3;
    s.resolution.resolution_threshold = 5.2e-6 * scale;
    s.resolution.restitution_threshold = 11.5e-3 * scale;
    s.resolution.global_iterations = 0;
    s.resolution.shock_propagation = false;
    s.sleep.sleep_threshold = 0.52e-3 * scale;
    s.gravity_damping.damping = 0;
    s.gravity_damping.damping_threshold = 0;
}

}  // namespace

std::span<const std::string_view> presetNames() {
    return preset_names;
}

std::string_view nameOf(Preset preset) {
    return preset_names.at(static_cast<std::size_t>(preset));
}

Preset presetNamed(std::string_view name) {
    const auto found = std::ranges::find(preset_names, name);
    if (found == preset_names.end()) {
        throw InputError(
            fmt::format("there is no preset '{}'; the presets are {}", name, fmt::join(preset_names, ", ")));
    }
    return static_cast<Preset>(found - preset_names.begin());
}

Settings Settings::preset(Preset preset, double steps_per_second, double gravity) {
    const double own_steps = ownSteps(preset);
    Settings s;
    setField(s, "steps_per_second", steps_per_second == 0 ? own_steps : steps_per_second);
    if (!(gravity >= 0 && std::isfinite(gravity))) {
        throw InputError(fmt::format("gravity is {} m/s²; it must be finite and at least 0", gravity));
    }
    s.sleep.motion_bias = std::pow(0.9, 240 / s.steps_per_second);
    // All speeds are multiples of |g|Δt; at the preset's own step and g = 10 they are the thesis's figures.
    const double scale = own_steps / s.steps_per_second * (gravity > 0 ? gravity / 10 : 1);
    switch (preset) {
        case Preset::performance:
            setPerformance(s, scale);
            break;
        case Preset::accuracy:
            setAccuracy(s, scale);
            break;
        case Preset::thesis:
            setThesis(s, scale);
            break;
        case Preset::thesis_accuracy:
            setThesisAccuracy(s, scale);
            break;
    }
    return s;
}

}  // namespace cairn
