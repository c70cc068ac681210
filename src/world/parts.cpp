#include "world/parts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "body/roundness.h"
#include "math/tolerances.h"
#include "world/division.h"
#include "world/joints.h"

namespace cairn {

namespace {

/// Bodies that touch, or are about to, may pass each other by this part of the smaller one's smallest extent between
/// two detections: by more, what lies ahead is not what was nearest.
constexpr double most_passed = 0.5;

/// What is fixed to a body where it touches may leave the straight way, since it turns, by this part of that extent:
/// the bounds of what bodies may overlap at rest and in a fall are 0.02 and 0.1 of it.
constexpr double most_bent = 0.03;

double stepLength(const WorldState& world, int units) {
    return units == step_units ? world.settings.timeStep() : world.settings.timeStep() * units / step_units;
}

int mostParts(const Settings& settings) {
    return static_cast<int>(std::bit_floor(static_cast<unsigned>(settings.integration.most_parts)));
}

bool mayDivide(const Settings& settings) {
    return foresees(settings) && mostParts(settings) > 1;
}

/// How a body turns its sides: not about the axis of what is round about it [rad/s, W].
Vec3 turningOf(const BodyStorage& bodies, BodyIndex i) {
    const Vec3& w = bodies.w[i];
    if (w.isZero(0)) return w;
    const Roundness round = roundnessOf(bodies, i);
    if (round == Roundness::everywhere) return Vec3::Zero();
    if (round == Roundness::none) return w;
    const Vec3 axis = bodies.shapePose(i).orientation * Vec3::UnitZ();
    return w - w.dot(axis) * axis;
}

/// How long two bodies may fly before their contact is found anew, at most so long as all others may [s].
double timeOf(const BodyStorage& bodies, const Contact& contact, double time) {
    const double extent = 2 * std::min(bodies.r_min[contact.a], bodies.r_min[contact.b]);
    const auto square = [](double x) { return x * x; };
    for (const BodyIndex i : {contact.a, contact.b}) {
        // Most turn and pass much too slowly, and this is quickly told: w²·r·time²/2 against what may bend.
        const double turning = bodies.w[i].squaredNorm() * square(time) / 2;
        if (square(turning) * (contact.point - bodies.position[i]).squaredNorm() <
            square(surely_below * most_bent * extent)) {
            continue;
        }
        const double bend = turningOf(bodies, i).squaredNorm() * (contact.point - bodies.position[i]).norm() / 2;
        if (bend > 0) time = std::min(time, std::sqrt(most_bent * extent / bend));
    }
    const Vec3 velocity = bodies.v[contact.a] - bodies.v[contact.b];
    if (velocity.squaredNorm() * square(time) < square(surely_below * most_passed * extent)) return time;
    // Along a plane all places are alike, but what bounces off it may meet what is behind.
    const auto isPlane = [&](BodyIndex i) { return std::holds_alternative<HalfSpace>(bodies.shape[i]); };
    const bool slides_alike = isPlane(contact.a) || isPlane(contact.b);
    if (slides_alike && contact.restitution == 0) return time;
    const double passing = slides_alike ? std::abs(contact.normal.dot(velocity)) : velocity.norm();
    return passing > 0 ? std::min(time, most_passed * extent / passing) : time;
}

/// Finds the bodies that move so far in a step that they may ask for a shorter part where they touch. Two others never
/// do. In most steps there are none, and there are fewer bodies than contacts. @param fast out: 1 for them
/// @return whether there are any
bool findFast(const BodyStorage& bodies, double step, std::vector<std::uint8_t>& fast) {
    double smallest = std::numeric_limits<double>::infinity();
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] != BodyKind::hole) smallest = std::min(smallest, bodies.r_min[i]);
    }
    // Contacts that are foreseen are off a body by no more than what others move: by less than its outer radius.
    const double passed = surely_below * most_passed * smallest;
    const double bent = surely_below * most_bent * smallest;
    fast.assign(bodies.slots(), 0);
    bool any = false;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] == BodyKind::hole || bodies.asleep[i] != 0) continue;
        const double r_max = bodies.r_max[i];
        const double squared_way = step * step * bodies.v[i].squaredNorm();
        const double squared_turn =
            bodies.w[i].isZero(0) ? 0 : step * step * bodies.w[i].squaredNorm() * (r_max * r_max);
        const bool turns_much = squared_turn > 2 * r_max * bent;
        // No root where the sum of both is surely too small.
        const bool moves_little = 2 * (squared_way + squared_turn) <= passed * passed;
        if (!turns_much && (moves_little || std::sqrt(squared_way) + std::sqrt(squared_turn) <= passed)) continue;
        fast[i] = 1;
        any = true;
    }
    return any;
}

/// How long the next part may be, by the contacts there are and how their bodies move [units].
int wantedUnits(WorldState& world) {
    std::vector<double>& shortest = world.data.shortest_of;
    const std::vector<std::uint8_t>& fast = world.data.fast;
    const double step = world.settings.timeStep();
    if (!findFast(world.bodies, step, world.data.fast)) return leastOnAny(world, step_units);
    shortest.assign(static_cast<std::size_t>(world.executor.threads()), step);
    const std::span<const ContactPair> pairs = world.data.pairs.pairs();
    world.executor.forBlocks(pairs.size(), [&](std::size_t begin, std::size_t end, int thread) {
        double& least = shortest[static_cast<std::size_t>(thread)];
        for (const ContactPair& pair : pairs.subspan(begin, end - begin)) {
            if ((fast[pair.a] | fast[pair.b]) == 0) continue;
            for (const Contact& contact : pair.contactsIn(world.data.contacts))
                least = timeOf(world.bodies, contact, least);
        }
    });
    const double time = *std::ranges::min_element(shortest);
    const int least = step_units / mostParts(world.settings);
    int units = step_units;
    while (units > least && stepLength(world, units) > time) units /= 2;
    return leastOnAny(world, units);
}

}  // namespace

bool foresees(const Settings& settings) {
    return settings.resolution.resolution == ResolutionKind::accelerated_sweeps &&
           settings.resolution.restitution_speed == RestitutionSpeed::closing;
}

bool notesWays(const Settings& settings) {
    return settings.integration.exact_flight || foresees(settings);
}

void beginPart(WorldState& world, int done) {
    world.part = {world.next_part.units, done, stepLength(world, world.next_part.units), world.part.units};
}

void chooseNextPart(WorldState& world) {
    if (!mayDivide(world.settings)) world.next_part.wanted = step_units;
    const int left = step_units - world.part.done - world.part.units;
    const int longest = left > 0 ? static_cast<int>(std::bit_floor(static_cast<unsigned>(left))) : step_units;
    world.next_part.units = std::min(longest, world.next_part.wanted);
}

bool shortenNextPart(WorldState& world) {
    if (!mayDivide(world.settings)) return false;
    world.next_part.wanted = wantedUnits(world);
    if (world.next_part.wanted >= world.next_part.units) return false;
    world.next_part.units = world.next_part.wanted;
    return true;
}

double nextPartLength(const WorldState& world) {
    return stepLength(world, world.next_part.units);
}

ContactsBegin contactsBegin(const WorldState& world, WarmStart warm_start) {
    const StepPart& part = world.part;
    // What users launched is resolved in no time.
    if (part.units == 0 || part.units == step_units) return {warm_start};
    const auto units = static_cast<double>(part.units);
    if (part.isFirst()) return {warm_start, units / step_units, units / step_units};
    return {warm_start, units / part.done, units / part.before, true};
}

void finishPart(WorldState& world) {
    const StepPart& part = world.part;
    // What was struck turns and passes otherwise than foreseen.
    shortenNextPart(world);
    if (part.units == step_units) return;
    if (!part.isLast()) bookJointImpulses(world);
    const double whole = part.isLast() ? static_cast<double>(step_units) / part.units : 1;
    for (Contact& contact : world.data.contacts) {
        contact.impulse += contact.earlier_impulse;
        contact.angular_impulse += contact.earlier_angular_impulse;
        contact.reference_impulse *= whole;
    }
}

}  // namespace cairn
