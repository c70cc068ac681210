#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "activity/sleeping.h"
#include "integration/damping.h"
#include "integration/integration.h"
#include "pairs/warm_start.h"
#include "world/checks.h"
#include "world/clamping.h"
#include "world/diagnostics.h"
#include "world/division.h"
#include "world/events.h"
#include "world/faults.h"
#include "world/joints.h"
#include "world/loads.h"
#include "world/motions.h"
#include "world/pair_laws.h"
#include "world/parts.h"
#include "world/resolving.h"
#include "world/sensors.h"
#include "world/step_statistics.h"
#include "world/stillness.h"
#include "world/totals.h"
#include "world/world_state.h"

namespace cairn {

namespace {

/// Runs a stage, with the other threads where they help, and notes its wall time.
template <class Work>
void timed(WorldState& world, Stage stage, const Work& work) {
    const auto index = static_cast<std::size_t>(stage);
    HelpChoice& help = world.help[index];
    const bool always = world.settings.parallel.always_helped;
    const bool measured = !always && world.executor.othersAreFree();
    world.executor.setHelped(always || (measured && help.next()));
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - begin;
    world.statistics.stage_ms[index] += passed.count();
    if (measured) help.record(passed.count());
}

void measureIfAsked(WorldState& world, Measured point) {
    if (world.settings.diagnostics.diagnostics) measure(world, point);
}

/// Whether contacts begin with the impulses that the last step ended with.
WarmStart warmStart(const WorldState& world) {
    return world.settings.resolution.resolution == ResolutionKind::accelerated_sweeps ? WarmStart::on : WarmStart::off;
}

/// What the detection looks for: how far ahead depends on who takes the contacts.
DetectionRange rangeOf(const WorldState& world) {
    const Settings& s = world.settings;
    DetectionRange range{s.detection.contact_margin, s.correction.penetration_threshold, s.correction.allowed_overlap};
    const Vec3 acceleration = world.gravity + world.global_acceleration;
    if (foresees(s)) range.foresight = {nextPartLength(world), world.part.length * acceleration};
    return range;
}

PairsInput pairsInput(WorldState& world, const DetectionRange& range) {
    return {world.bodies, world.materials, world.broad_phase, world.data.excluded, range, world.executor};
}

/// The speed of the fastest point there is [m/s].
double fastestNow(WorldState& world) {
    const BodyStorage& b = world.bodies;
    std::vector<double>& fastest = world.data.fastest_of;
    fastest.assign(static_cast<std::size_t>(world.executor.threads()), 0.0);
    world.executor.forBlocks(b.slots(), [&](std::size_t begin, std::size_t end, int thread) {
        double& most = fastest[static_cast<std::size_t>(thread)];
        for (std::size_t i = begin; i < end; ++i) {
            if (b.kind[i] == BodyKind::hole || b.asleep[i] != 0) continue;
            const double turning = b.w[i].isZero(0) || !std::isfinite(b.r_max[i]) ? 0 : b.w[i].norm() * b.r_max[i];
            most = std::max(most, b.v[i].norm() + turning);
        }
    });
    return *std::ranges::max_element(fastest);
}

/// Finds the contacts of a part, which begin with what the last one left. @param begins whether it is the first
/// detection of the step
void detect(WorldState& world, bool begins) {
    const DetectionRange range = rangeOf(world);
    const double speed = range.foresight.time > 0 ? fastestNow(world) : 0;
    // An impact of two bodies gives twice that, to a light body that bounces.
    if (range.foresight.time > 0) world.data.fastest = 2 * speed;
    settleShared(world, range, speed, world.part.units > 0);
    if (begins) world.data.pairs.beginStep(world.bodies, world.data.generation);
    world.data.stopped.clear();
    beginContacts(world.data.contacts, contactsBegin(world, warmStart(world)), world.executor);
    world.data.pairs.detect(pairsInput(world, range), world.data.contacts);
    if (world.part.units > 0 && foresees(world.settings)) clampMotion(world, pairsInput(world, range));
    if (!shortenNextPart(world)) return;
    const DetectionRange shorter = rangeOf(world);
    world.data.pairs.detect(pairsInput(world, shorter), world.data.contacts);
}

/// Velocities that users gave were granted by no resolution: impacts that they would make in this step are resolved
/// before bodies fly on with them. @return whether the detections of the step have begun
bool grantLaunched(WorldState& world) {
    if (!std::exchange(world.launched, false)) return false;
    // In no time, so that forces act later in the step.
    world.part = {.units = 0};
    world.next_part = {};
    const DetectionRange range = rangeOf(world);
    if (!(range.foresight.time > 0)) return false;
    const BodyStorage& b = world.bodies;
    bool any = false;
    for (BodyIndex i = 0; i < b.slots() && !any; ++i) {
        any = b.kind[i] == BodyKind::dynamic && b.asleep[i] == 0 && movesFar(b, range, i, b.v[i], b.w[i]);
    }
    if (leastOnAny(world, any ? 0 : 1) > 0) return false;
    detect(world, true);
    batchContacts(world);
    BodyState bodies = world.bodies.state();
    bodies.time_step = nextPartLength(world);
    const DetectionRange ahead = rangeOf(world);
    resolveLaunched(world, bodies, pairsInput(world, ahead));
    shortenNextPart(world);
    measureIfAsked(world, Measured::resolution);
    bookJointImpulses(world);
    for (Contact& contact : world.data.contacts) {
        // The step's own contacts begin with what they had before.
        contact.impulse = contact.last_impulse;
        contact.angular_impulse.setZero();
    }
    return true;
}

void correctBatches(WorldState& world) {
    StepData& data = world.data;
    BodyState bodies = world.bodies.state();
    // What this lifts a body that bounces is in the account of its bounce.
    const bool touching = world.settings.resolution.restitution_speed == RestitutionSpeed::touching;
    if (!touching) bodies.acceleration = world.gravity + world.global_acceleration;
    data.deep.resize(data.views.size());
    data.schedule.forEach(world.executor, [&](std::uint32_t batch, int thread) {
        const auto t = static_cast<std::size_t>(thread);
        const CorrectionCounts counts = world.corrections[t]->correct(data.views[batch], data.contacts_of,
                                                                      data.contacts, bodies, remaining_penetration);
        data.correction_counts[t].add(counts);
        data.deep[batch] = counts.penetrating > 0 ? 1 : 0;
    });
    // The thesis's goes where it goes.
    if (world.settings.correction.correction != CorrectionKind::position_sweeps) return;
    if (std::ranges::find(data.deep, 1) == data.deep.end()) return;
    const bool moved = clampCorrection(world, rangeOf(world));
    bodies.time_step = world.part.length;
    bodies.supports_move = doSupportsMove(bodies);
    const PosesBefore before{world.bodies.detected_position, world.bodies.detected_orientation};
    data.schedule.forEach(world.executor, [&](std::uint32_t batch, int thread) {
        if (data.deep[batch] == 0) return;
        const auto t = static_cast<std::size_t>(thread);
        data.correction_counts[t].add(world.corrections[t]->settle(data.views[batch], data.contacts, bodies, before));
    });
    if (moved) measureCorrected(world, rangeOf(world));
}

void correctStage(WorldState& world) {
    StepData& data = world.data;
    const BodyState bodies = world.bodies.state();
    const bool traced = world.trace.tracing == Tracing::on;
    if (traced && world.part.isFirst()) world.trace.correction.assign(bodies.size(), Vec3::Zero());
    if (traced) {
        for (std::size_t i = 0; i < bodies.size(); ++i) world.trace.correction[i] -= bodies.position[i];
    }
    if (world.settings.resolution.restitution_speed == RestitutionSpeed::touching) {
        for (Contact& contact : data.contacts) contact.gap = contact.distance;
    }
    if (world.part.isFirst()) data.correction_counts.assign(world.corrections.size(), {});
    correctBatches(world);
    if (!traced) return;
    for (std::size_t i = 0; i < bodies.size(); ++i) world.trace.correction[i] += bodies.position[i];
}

void velocityStage(WorldState& world) {
    StepData& data = world.data;
    const Vec3 acceleration = world.gravity + world.global_acceleration;
    advanceLaws(world);
    data.supports.resize(world.bodies.slots());
    countSupports(world.bodies.kind, data.contacts, acceleration, data.supports);
    if (!acceleration.isZero(0)) countJointSupports(world, data.supports);
    // Without a global acceleration no direction is "down": sleeping bodies then stay asleep until something else
    // happens to them.
    if (!acceleration.isZero(0)) {
        wakeUnsupported(world.bodies.state(), world.bodies.supports, data.supports, world.executor);
        wakeJointed(world);
    }
    std::ranges::copy(data.supports, world.bodies.supports.begin());
    const bool exact = world.settings.integration.exact_flight;
    const bool touching = world.settings.resolution.restitution_speed == RestitutionSpeed::touching;
    if (exact || touching) saveVelocities(world.bodies, world.executor, data.before);
    const bool whole = world.part.isFirst() && world.part.isLast();
    findLoads(world);
    advanceVelocities(world.bodies, acceleration, world.settings.sleep, world.part.length, world.executor,
                      exact && whole ? std::optional(world.steps) : std::nullopt);
    if (world.part.isLast()) clearForces(world.bodies, world.executor);
    applySprings(world.springs, world.bodies, world.part.length);
    measureIfAsked(world, Measured::forces);
    dampVelocities(world.bodies, world.part.length, world.executor);
    measureIfAsked(world, Measured::damping);
    fixNonFinite(world);
    if (exact) saveForced(world.bodies, world.executor, data.before);
    // A law moves its body evenly within a step, so what is carried by it moves as evenly.
    for (std::size_t i = 0; exact && i < data.carried.size(); ++i) {
        if (data.carried[i] == Carried::unevenly) data.before.forced[i] = 0;
    }
    if (touching) {
        saveTouching(world.bodies, world.settings.resolution.restitution_threshold, world.part.length, data.before,
                     data.contacts);
    }
}

/// Completes flights as far as bodies have room.
void completeMotion(WorldState& world, const DetectionRange& range) {
    StepData& data = world.data;
    if (foresees(world.settings)) {
        data.uncompleted_position.assign(world.bodies.position.begin(), world.bodies.position.end());
        data.uncompleted_orientation.assign(world.bodies.orientation.begin(), world.bodies.orientation.end());
    }
    completeSmoothMotion(world.bodies, data.before, data.jointed, world.part.length, world.executor);
    if (!foresees(world.settings)) return;
    clampCompletion(world, range, {data.uncompleted_position, data.uncompleted_orientation});
}

void resolveStage(WorldState& world) {
    StepData& data = world.data;
    BodyState bodies = world.bodies.state();
    if (world.trace.tracing == Tracing::on) {
        world.trace.shock_stage.assign(bodies.size(), -1);
        bodies.shock_stage = world.trace.shock_stage;
    }
    bodies.time_step = nextPartLength(world);
    bodies.surface = data.surface;
    bodies.supports_move = doSupportsMove(bodies);
    const Vec3 acceleration = world.gravity + world.global_acceleration;
    bodies.whole_fall = world.part.length * acceleration;
    bodies.damped_fall = dampedPart(world.settings.sleep) * world.part.length * acceleration;
    applyPairLaws(world, bodies);
    buildJointBlocks(world);
    // Asked before a driven joint may break in this very step.
    const bool weighed = world.checks == Checks::on && mustKeepEnergy(world);
    const double energy = weighed ? kineticEnergyOf(world.bodies).rounded() : 0;
    const DetectionRange range = rangeOf(world);
    resolveContacts(world, bodies, pairsInput(world, range));
    finishJoints(world);
    fixNonFinite(world);
    if (weighed) checkEnergy(world, energy);
    measureIfAsked(world, Measured::resolution);
    if (world.settings.integration.exact_flight) {
        findBounced(world, bodies, data.before);
        completeMotion(world, range);
    }
    if (world.settings.resolution.restitution_speed == RestitutionSpeed::touching) {
        liftBounced(world.bodies, data.before);
    }
    measureIfAsked(world, Measured::completion);
    finishPart(world);
}

/// Bodies that do not fall asleep one by one: jointed ones do it together, and those that gravity does not pull down or
/// that a law carries never do, since stopping them when they are slow would take their momentum.
std::span<const std::uint8_t> listNotSleeping(WorldState& world) {
    StepData& data = world.data;
    const auto floats = [](double factor) { return !(factor > 0); };
    if (data.carried.empty() && std::ranges::none_of(world.bodies.gravity_factor, floats)) return data.jointed;
    data.not_sleeping = data.jointed;
    data.not_sleeping.resize(world.bodies.slots(), 0);
    for (std::size_t i = 0; i < data.not_sleeping.size(); ++i) {
        const bool is_carried = !data.carried.empty() && data.carried[i] != Carried::not_at_all;
        if (is_carried || floats(world.bodies.gravity_factor[i])) data.not_sleeping[i] = 1;
    }
    return data.not_sleeping;
}

void sleepStage(WorldState& world) {
    // In zero gravity nothing rests: a slow body that was stopped would lose its momentum.
    const bool weightless = (world.gravity + world.global_acceleration).isZero(0);
    // In a frame that is shaken, or under a gravity that changes, nothing is at rest either.
    const bool shaken = !world.frame_acceleration.isZero(0) || isGravityChanging(world);
    if (!world.settings.sleep.sleeping || weightless || shaken) return;
    BodyStorage& b = world.bodies;
    const std::span<const std::uint8_t> others = listNotSleeping(world);
    const StepLength step{world.settings.timeStep(), std::ldexp(StepLength{}.usual, world.step_exponent)};
    MotionState motion{b.motion, b.r_max, b.constant_force, b.constant_torque, others};
    if (foresees(world.settings)) {
        motion.way = world.data.before.way;
        motion.part_length = world.part.length;
        motion.mean_v = b.mean_v;
        motion.mean_w = b.mean_w;
    }
    fallAsleep(b.state(), motion, world.settings.sleep, step, world.executor);
    letJointedSleep(world);
}

void outputStage(WorldState& world) {
    collectEvents(world);
    world.data.generation.assign(world.bodies.generation.begin(), world.bodies.generation.end());
    summarize(world);
}

/// A step that leaves everything as it is.
void repeatStep(WorldState& world) {
    world.statistics.stage_ms = {};
    beginEvents(world);
    collectEvents(world);
}

void flyStage(WorldState& world) {
    const double time = world.part.length;
    if (notesWays(world.settings)) beginWays(world.bodies, world.executor, world.data.before);
    const JointFlight::Motion motion{world.settings.integration, world.settings.sleep,
                                     world.gravity + world.global_acceleration, time, world.data.contacts};
    world.joint_flight.begin(world.joints, world.data.joint_groups, world.bodies, motion);
    moveByLaw(world);
    advancePositions(world.bodies, time, world.executor);
    world.joint_flight.finish(world.joints, world.data.joint_groups, world.bodies, motion);
}

/// @param begins whether it has the first detection of the step
void computePart(WorldState& world, bool begins) {
    timed(world, Stage::positions, [&] { flyStage(world); });
    measureIfAsked(world, Measured::positions);
    timed(world, Stage::detection, [&] {
        chooseNextPart(world);
        detect(world, begins);
        if (world.part.isLast()) findSensed(world);
    });
    timed(world, Stage::batches, [&] { batchContacts(world); });
    timed(world, Stage::correction, [&] { correctStage(world); });
    measureIfAsked(world, Measured::correction);
    timed(world, Stage::velocities, [&] { velocityStage(world); });
    timed(world, Stage::resolution, [&] { resolveStage(world); });
}

void computeStep(WorldState& world) {
    ++world.places_version;
    world.statistics = {};
    const bool checked = world.checks != Checks::off;
    timed(world, Stage::events, [&] {
        beginEvents(world);
        // What user code did between the steps may have overflowed.
        fixNonFinite(world);
        wakeSpringEnds(world.springs, world.bodies);
        beginJointImpulses(world);
        prepareJoints(world);
        measureIfAsked(world, Measured::begin);
        beginLaws(world);
    });
    measureIfAsked(world, Measured::laws);
    bool begun = false;
    timed(world, Stage::positions, [&] { begun = grantLaunched(world); });
    int done = 0;
    do {
        beginPart(world, done);
        computePart(world, !begun);
        begun = true;
        done += world.part.units;
    } while (done < step_units);
    timed(world, Stage::sleeping, [&] { sleepStage(world); });
    measureIfAsked(world, Measured::sleep);
    timed(world, Stage::output, [&] { outputStage(world); });
    world.executor.setHelped(true);
    if (checked) checkState(world);
    countStillSteps(world);
}

}  // namespace

void stepWorld(WorldState& world) {
    ++world.steps;
    if (isStill(world)) {
        repeatStep(world);
    } else {
        computeStep(world);
    }
    // A quotient, not a sum: after a million steps the time is still exact to one rounding.
    const auto since = static_cast<double>(world.steps - world.steps_at_start);
    world.time = world.time_at_start + since / world.settings.steps_per_second;
}

}  // namespace cairn
