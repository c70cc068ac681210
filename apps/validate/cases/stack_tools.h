/// @file What the cases of stacks share: a pile that should stand, watched.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "validate/case.h"
#include "validate/world_tools.h"

namespace cairn::validation {

/// A resolver by its name.
struct Resolver {
    ResolutionKind kind;
    const char* name;
    bool isJudged() const { return kind == ResolutionKind::accelerated_sweeps; }
    /// Wall time after which a stack is left [s]. The others are there to compare with.
    double patience(const Plan& plan) const { return isJudged() ? 3600 : plan.isQuick() ? 1 : 20; }
};
inline constexpr std::array<Resolver, 3> resolvers = {{{ResolutionKind::impulse_queue, "impulse_queue"},
                                                       {ResolutionKind::sweep, "sweep"},
                                                       {ResolutionKind::accelerated_sweeps, "accelerated_sweeps"}}};

/// How a stack fared.
struct Standing {
    double drift = 0;        ///< largest displacement of a body from where it was after the first second [m]
    double overlap = 0;      ///< largest [m]
    double support = 0;      ///< largest relative error of the ground's impulse over the last quarter
    double resolutions = 0;  ///< contacts resolved per step, mean
    double ms = 0;           ///< per step, mean
    double simulated = 0;    ///< [s]
    bool stands = false;     ///< nothing moved by more than a quarter of the smallest size
};

/// Simulates a stack. Ends early where it fell or where `patience` of wall time is used up.
/// @param weight of all bodies [N] @param size of the smallest body [m] @param patience [s]
inline Standing watch(World& world, const std::vector<BodyId>& bodies, BodyId ground, double weight, double size,
                      double duration, double patience, const Plan& plan) {
    using Clock = std::chrono::steady_clock;
    Standing standing;
    const auto begin = Clock::now();
    std::vector<Vec3> start, settled;
    for (const BodyId id : bodies) start.push_back(world.pose(id).position);
    settled = start;
    double moved = 0;
    const double rate = world.settings().steps_per_second;
    double impulse_error = 0;
    const auto spent = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
    while (world.time() < duration && spent() < patience && moved < size / 4) {
        plan.alive();
        world.step();
        const Statistics& statistics = world.statistics();
        standing.overlap = std::max(standing.overlap, statistics.largest_overlap);
        standing.resolutions += static_cast<double>(statistics.global_iterations + statistics.shock_iterations);
        const bool second_done = world.stepCount() == static_cast<std::int64_t>(rate);
        moved = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const Vec3 position = world.pose(bodies[i]).position;
            moved = std::max(moved, (position - start[i]).norm());
            if (second_done) settled[i] = position;
            if (world.time() > 1) standing.drift = std::max(standing.drift, (position - settled[i]).norm());
        }
        if (world.time() < 0.75 * duration) continue;
        double given = 0;
        for (const ContactInfo& c : world.contacts()) {
            if (c.a == ground) given -= c.impulse.z();
            if (c.b == ground) given += c.impulse.z();
        }
        impulse_error = std::max(impulse_error, std::abs(given * rate / weight - 1));
    }
    standing.simulated = world.time();
    standing.stands = moved < size / 4;
    if (world.time() <= 1) standing.drift = moved;
    standing.support = impulse_error;
    standing.ms = 1000 * spent() / static_cast<double>(world.stepCount());
    standing.resolutions /= static_cast<double>(world.stepCount());
    return standing;
}

/// What a stack must do.
struct StackTargets {
    double duration;  ///< that it stands [s]
    double way;       ///< that it drifts and bodies overlap, at most [m]
    bool supported;   ///< the ground carries the weight; where gravity is damped it does not
};

/// Adds how a stack fared: it must stand, without drift, with the ground carrying its weight. That is asked of the
/// resolution that the presets use; the others are shown.
inline void judge(Result& result, const Standing& s, const std::string& setup, const Resolver& resolver,
                  const StackTargets& targets) {
    const std::size_t first = result.quantities.size();
    const bool whole = s.simulated >= targets.duration - 1e-9;
    const std::string partly =
        whole || !s.stands ? "" : "the wall time of the case was used up; not all of it was simulated";
    result.atLeast("stands for", "s", s.stands ? s.simulated : 0, targets.duration, setup, s.stands ? partly : "fell");
    result.atMost("drift after the first second", "m", s.drift, targets.way, setup);
    result.atMost("largest overlap", "m", s.overlap, targets.way, setup);
    if (whole && targets.supported) {
        result.atMost("impulse of the ground against the weight, worst relative error", "", s.support, 1e-6, setup,
                      "in the last quarter of the time");
    }
    if (!resolver.isJudged()) result.onlyShowFrom(first);
    result.show("resolutions per step", "", s.resolutions, setup);
    result.show("wall time per step", "ms", s.ms, setup);
}

/// The performance preset with sleeping off.
inline Settings performanceSettings(ResolutionKind resolver) {
    Settings settings = Settings::preset(Preset::performance, 240, g);
    settings.sleep.sleeping = false;
    settings.resolution.resolution = resolver;
    // The thesis's: shock propagation does the rest.
    if (resolver == ResolutionKind::impulse_queue) settings.resolution.iterations = 2;
    return settings;
}

/// Builds a stack with the settings and watches it until the patience is used up [s].
using Stand = std::function<Standing(const Settings& settings, double patience)>;

/// Further time steps of stacks that do not take long.
inline std::vector<double> stackRates(const Plan& plan) {
    return plan.isQuick() ? std::vector<double>{} : std::vector<double>{240, 3840};
}

/// Judges a stack with either preset and shows it with the other resolutions.
/// @param name of the stack @param duration that it is to stand [s] @param rates further steps per second of the
/// accuracy preset, with the resolution that is judged
inline void judgeAllResolvers(Result& result, const std::string& name, double duration, const Plan& plan,
                              const Stand& stand, const std::vector<double>& rates = {}) {
    const auto setup = [&](const char* preset, double rate, const Resolver& resolver) {
        return fmt::format("{}, {}, {}, {}", name, preset, timeStepText(rate), resolver.name);
    };
    for (const Resolver& resolver : resolvers) {
        judge(result, stand(accurateSettings(960, resolver.kind), resolver.patience(plan)),
              setup("accuracy", 960, resolver), resolver, {duration, 1e-4, true});
    }
    const Resolver& judged = resolvers.back();
    for (const double rate : rates) {
        judge(result, stand(accurateSettings(rate, judged.kind), judged.patience(plan)),
              setup("accuracy", rate, judged), judged, {duration, 1e-4, true});
    }
    for (const Resolver& resolver : resolvers) {
        judge(result, stand(performanceSettings(resolver.kind), resolver.patience(plan)),
              setup("performance", 240, resolver), resolver, {duration, 2e-3, false});
    }
}

}  // namespace cairn::validation
