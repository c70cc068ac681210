#include "resolution/batch_plan.h"

#include <limits>

#include "batches/batch_motion.h"
#include "resolution/rolling.h"

namespace cairn {

namespace {

/// Batches with fewer contacts need fewer sweeps while they move.
constexpr std::size_t large_contacts = 1024;

/// Batches with at least so many contacts are swept by colours. In smaller ones the order of the contacts, from body to
/// body, carries impulses farther in a sweep.
constexpr std::size_t wide_contacts = 320;

/// A sweep that still changes speeds by more than lets bodies into each other by this multiple of the overlap allowed
/// is not the last one.
constexpr double safe_multiple = 4;

/// Whether some contact closes faster than one at rest does, or more than a part of them slide or separate faster.
bool isMoving(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
              const ResolutionSettings& settings) {
    const double threshold = settings.restitution_threshold;
    std::size_t sliding = 0;
    for (const std::uint32_t i : batch.contacts) {
        const Vec3 velocity = relativeVelocity(contacts[i], bodies);
        if (contacts[i].normal.dot(velocity) < -threshold) return true;
        sliding += velocity.squaredNorm() > threshold * threshold ? 1 : 0;
    }
    return static_cast<double>(sliding) > settings.sliding_part * static_cast<double>(batch.contacts.size());
}

/// The speed with which no body of the batch gets into another one by more than a few times what is allowed.
double safeSpeed(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : batch.contacts) least = std::min(least, contacts[i].allowed_overlap);
    return safe_multiple * least / bodies.time_step;
}

double changeByGravity(const BatchView& batch, const BodyState& bodies) {
    double mass = 0;
    for (const BodyIndex i : batch.bodies) mass += 1 / bodies.mass_inv[i];
    return bodies.fall.norm() * std::sqrt(mass);
}

/// Impulses have a shorter way through small batches.
std::int64_t movingSweepLimit(std::size_t contacts, const ResolutionSettings& settings) {
    if (contacts >= large_contacts) return settings.moving_sweep_limit;
    const double part = settings.small_sweep_part * static_cast<double>(settings.moving_sweep_limit);
    return std::max(std::int64_t{1}, static_cast<std::int64_t>(std::ceil(part)));
}

/// Batches at rest are swept until they converge, large ones only as far as the budget goes.
std::int64_t sweepLimit(std::size_t contacts, bool moving, const ResolutionSettings& settings) {
    if (moving || contacts == 0) return movingSweepLimit(contacts, settings);
    if (settings.visit_limit == 0) return settings.sweep_limit;
    const std::int64_t affordable = settings.visit_limit / (2 * static_cast<std::int64_t>(contacts));
    return std::min(std::max(affordable, settings.moving_sweep_limit), settings.sweep_limit);
}

/// Whether a batch is a stack, a chain or an arch. Where bodies have more neighbours than there they stand on more
/// contacts than they need, which share the load as their friction allows and not as the stiffest solution wants: then
/// direct steps only cost time.
bool isChain(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies, double most_pairs) {
    if (most_pairs == 0) return true;
    std::size_t pairs = 0;
    const Contact* last = nullptr;
    for (const std::uint32_t i : batch.contacts) {
        const Contact& contact = contacts[i];
        const bool same = last != nullptr && contact.a == last->a && contact.b == last->b;
        last = &contact;
        if (same || bodies.isImmovable(contact.a) || bodies.isImmovable(contact.b)) continue;
        ++pairs;
    }
    return static_cast<double>(pairs) <= most_pairs * static_cast<double>(batch.bodies.size());
}

}  // namespace

BatchKind kindOf(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
                 const ResolutionSettings& settings) {
    BatchKind kind{.framed = !batch.joints.empty()};
    for (const std::uint32_t i : batch.contacts) {
        const Contact& contact = contacts[i];
        kind.rolling += resistsRolling(contact) ? 1 : 0;
        kind.two_frictions = kind.two_frictions || contact.kinetic_friction < contact.static_friction;
    }
    kind.framed = kind.framed || kind.rolling > 0;
    kind.moving = isMoving(batch, contacts, bodies, settings);
    kind.may_leap = !kind.moving && !kind.framed &&
                    batch.bodies.size() <= static_cast<std::size_t>(settings.direct_limit) &&
                    isChain(batch, contacts, bodies, settings.direct_pairs);
    kind.coloured = batch.contacts.size() >= wide_contacts && !kind.may_leap;
    return kind;
}

SweepPlan planOf(const BatchView& batch, const BatchKind& kind, std::span<const Contact> contacts,
                 const BodyState& bodies, const ResolutionSettings& settings) {
    if (kind.moving && settings.moving_tolerance > 0) {
        return {.limit = settings.sweep_limit,
                .steady_speed = settings.sweep_tolerance,
                .tolerance = settings.moving_tolerance,
                .safe_speed = safeSpeed(batch, contacts, bodies),
                .change_by_gravity = changeByGravity(batch, bodies)};
    }
    return {.limit = sweepLimit(batch.contacts.size(), kind.moving, settings),
            .steady_speed = settings.sweep_tolerance};
}

}  // namespace cairn
