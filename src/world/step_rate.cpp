#include "world/step_rate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/geometry.h"
#include "world/motions.h"

namespace cairn {

namespace {

constexpr double usual_extent = 0.12;  ///< [m]: of the thesis's bodies
constexpr double usual_gravity = 10;   ///< [m/s²]
constexpr double fewest_steps = 1e-3;  ///< [1/s], as of the setting; below likewise
constexpr double most_steps = 1e6;

/// What a body asks for: the larger, the less. @param gravity magnitude [m/s²]; 0 counts as 10
int exponentOf(double extent, double gravity) {
    double ratio = extent * usual_gravity / (usual_extent * (gravity > 0 ? gravity : usual_gravity));
    // Half of the logarithm, rounded, in steps that are exact: worlds that are scaled by powers of four step alike.
    int exponent = 0;
    for (; ratio >= 2 && std::isfinite(ratio); ratio /= 4) --exponent;
    for (; ratio <= 0.5 && ratio > 0; ratio *= 4) ++exponent;
    return exponent;
}

}  // namespace

double middleExtent(const Shape& shape) {
    const Bounds bounds = boundsOf(shape, Pose{});
    std::array<double, 3> extents{};
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        extents[static_cast<std::size_t>(axis)] = bounds.upper[axis] - bounds.lower[axis];
    }
    std::ranges::sort(extents);
    return extents[1];
}

void StepExponents::add(double extent) {
    ++counts_[exponentOf(extent, gravity_)];
    ++count_;
}

std::optional<int> StepExponents::median() const {
    if (count_ == 0) return std::nullopt;
    // From the smallest body on, which asks for the most.
    std::size_t before = (count_ - 1) / 2;
    auto entry = counts_.rbegin();
    for (; before >= entry->second; ++entry) before -= entry->second;
    return entry->first;
}

Settings withKnownSteps(const Settings& settings, int exponent) {
    if (!settings.steps_per_second.isBySize()) return settings;
    Settings known = settings;
    const double steps = std::clamp(std::ldexp(settings.steps_per_second, exponent), fewest_steps, most_steps);
    const double longer = settings.steps_per_second / steps;
    known.steps_per_second = steps;
    known.resolution.resolution_threshold *= longer;
    known.resolution.restitution_threshold *= longer;
    known.sleep.sleep_threshold *= longer;
    return known;
}

std::optional<int> stepExponentOf(const WorldState& world) {
    const BodyStorage& bodies = world.bodies;
    const Vec3 gravity = lastingGravity(world.gravity, world.gravity_law) + world.global_acceleration;
    StepExponents exponents(gravity.norm());
    // Of those that were dealt out a rank has a part.
    for (const double extent : world.dealt_extents) exponents.add(extent);
    for (BodyIndex i = 0; i < bodies.slots() && world.dealt_extents.empty(); ++i) {
        if (bodies.kind[i] == BodyKind::dynamic) exponents.add(middleExtent(bodies.shape[i]));
    }
    return exponents.median();
}

void settleSteps(WorldState& world) {
    if (world.sized) return;
    const std::optional<int> exponent = stepExponentOf(world);
    if (!exponent) return;
    world.sized = true;
    world.step_exponent = *exponent;
    world.dealt_extents = {};
    world.applySettings(withKnownSteps(world.settings, *exponent));
}

}  // namespace cairn
