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
StepRate ownSteps(Preset preset) {
    switch (preset) {
        case Preset::performance:
            return StepRate::bySize(240);
        case Preset::accuracy:
            return StepRate::bySize(960);
        case Preset::thesis_accuracy:
            return 960;
        default:
            return 240;
    }
}

/// The defaults. @param scale |g|Δt as a multiple of that with 10 m/s² and the preset's own time step; below likewise
void setPerformance(Settings& s, double scale) {
    s.resolution.resolution_threshold *= scale;
    s.resolution.restitution_threshold *= scale;
    s.sleep.sleep_threshold *= scale;
}

void setAccuracy(Settings& s, double scale) {
    s.correction.allowed_overlap = 0.83e-3;
    s.resolution.resolution_threshold = 5.2e-6 * scale;
    s.resolution.restitution_threshold = 11.5e-3 * scale;
    s.resolution.tolerance = 0.01;
    s.resolution.pulled_tolerance = 1e-4;
    s.resolution.shock_propagation = false;
    s.sleep.sleep_threshold = 0.52e-3 * scale;
    s.sleep.damping = 0;
}

/// The algorithms of the thesis, and none of what was added since: nothing is looked ahead for, begins with the last
/// step's impulses or is held still. All that its results depend on is named here, whatever the defaults
/// become.
void setThesisAlgorithms(Settings& s) {
    s.correction.correction = CorrectionKind::propagated;
    s.resolution.resolution = ResolutionKind::impulse_queue;
    s.resolution.restitution_law = RestitutionLaw::newton;
    s.resolution.restitution_speed = RestitutionSpeed::closing;
    s.resolution.impacts = Impacts::of_resolution;
    s.sleep.sleeping = true;
    s.integration.exact_flight = false;
    s.integration.most_parts = 1;
}

/// "High performance solver settings". @source thesis §5.1
void setThesis(Settings& s, double scale) {
    setThesisAlgorithms(s);
    s.detection.contact_margin = 1e-4;
    s.correction.penetration_threshold = 1.74e-3;
    s.resolution.resolution_threshold = 83.4e-6 * scale;
    s.resolution.restitution_threshold = 45.8e-3 * scale;
    s.resolution.iterations = 2;
    s.resolution.shock_propagation = true;
    s.sleep.sleep_threshold = 8.33e-3 * scale;
    s.sleep.damping = 0.7;
}

/// "High accuracy solver settings". @source thesis §5.5
void setThesisAccuracy(Settings& s, double scale) {
    setThesisAlgorithms(s);
    s.detection.contact_margin = 1e-5;
    s.correction.penetration_threshold = 0.1e-3;
    s.resolution.resolution_threshold = 5.2e-6 * scale;
    s.resolution.restitution_threshold = 11.5e-3 * scale;
    s.resolution.iterations = 0;
    s.resolution.shock_propagation = false;
    s.sleep.sleep_threshold = 0.52e-3 * scale;
    s.sleep.damping = 0;
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
    const StepRate own_steps = ownSteps(preset);
    Settings s;
    if (steps_per_second != 0)
        setField(s, "steps_per_second", steps_per_second);
    else
        s.steps_per_second = own_steps;
    if (!(gravity >= 0 && std::isfinite(gravity))) {
        throw InputError(fmt::format("gravity is {} m/s²; it must be finite and at least 0", gravity));
    }
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
