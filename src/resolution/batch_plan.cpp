#include "resolution/batch_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "batches/batch_motion.h"
#include "resolution/rolling.h"

namespace cairn {

namespace {

/// Batches with at least so many contacts are solved by colours, which threads can divide. In smaller ones the order of
/// the contacts, from body to body, carries impulses farther in a sweep.
constexpr std::size_t coloured_contacts = 320;

/// From so many contacts on that order leaves enough of them that do not wait for each other to fill lanes.
constexpr std::size_t wide_contacts = 64;

/// A sweep that still changes speeds by more than lets bodies into each other by this multiple of the overlap allowed
/// is not the last one.
constexpr double safe_multiple = 4;

/// How deep contacts are that the correction has dealt with, as a multiple of the overlap allowed. Where they are
/// deeper, impulses were not what the pile needs, and less error is tolerated by this power of the depth.
constexpr double usual_depth = 0.7;
constexpr int depth_power = 4;

/// A sweep that changes no contact's velocity by more than this part of the resolution threshold is the last one.
constexpr double steady_part = 0.01;

/// What rests is swept so many times as often at most: it needs the same impulses in the next step, and a jam whose
/// contacts do not carry it yet falls a little in every step. What moves needs others then.
constexpr std::int64_t resting_sweeps = 3;

/// Most pairs of bodies in touch per body in stacks, chains and arches.
constexpr double chain_pairs = 1.5;

/// A direct step may take so many products of blocks per contact, as long as about twenty sweeps.
constexpr double most_products = 25;

/// What contacts are, summed over a batch.
struct ContactSums {
    double mass = 0;      ///< reduced masses of the bodies [kg]
    double motion = 0;    ///< with the squared velocities before the step's gravity [J]
    double scale = 0;     ///< what of that tells how exact impulses need to be [J]
    double depth = 0;     ///< squared overlaps as multiples of what is allowed
    bool pulled = false;  ///< forces act on some of the bodies

    /// The mass is that of the two bodies against each other as far as they can move.
    void add(const Contact& contact, const BodyState& bodies) {
        const double part = std::min(0.0, contact.distance) / contact.allowed_overlap;
        depth += part * part;
        const bool moves_a = !bodies.isImmovable(contact.a), moves_b = !bodies.isImmovable(contact.b);
        const double inverse = (moves_a ? bodies.mass_inv[contact.a] : 0) + (moves_b ? bodies.mass_inv[contact.b] : 0);
        if (!(inverse > 0)) return;
        Vec3 velocity = relativeVelocity(contact, bodies);
        if (moves_a != moves_b) velocity -= moves_a ? bodies.fallOf(contact.a) : Vec3(-bodies.fallOf(contact.b));
        mass += 1 / inverse;
        const bool is_pulled = std::max(bodies.loadOf(contact.a), bodies.loadOf(contact.b)) == Load::pulled;
        pulled = pulled || is_pulled;
        // What others deny a body is no motion, or a jam would be solved as roughly as a fall, and never hold.
        if (bodies.isDenied(contact.a) || bodies.isDenied(contact.b)) return;
        motion += velocity.squaredNorm() / inverse;
        // Friction that balances a force must not become less exact the faster the force makes its bodies slide.
        const double along = contact.normal.dot(velocity);
        scale += (is_pulled ? along * along : velocity.squaredNorm()) / inverse;
    }
};

/// Whether a batch is a stack, a chain or an arch. Where bodies have more neighbours than there they stand on more
/// contacts than they need, which share the load as their friction allows and not as the stiffest solution wants: then
/// direct steps only cost time.
bool isChain(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
    std::size_t pairs = 0;
    const Contact* last = nullptr;
    for (const std::uint32_t i : batch.contacts) {
        const Contact& contact = contacts[i];
        const bool same = last != nullptr && contact.a == last->a && contact.b == last->b;
        last = &contact;
        if (same || bodies.isImmovable(contact.a) || bodies.isImmovable(contact.b)) continue;
        ++pairs;
    }
    const auto count = static_cast<double>(batch.bodies.size());
    const auto edges = static_cast<double>(pairs);
    // Each loop leaves two bodies with three neighbours when all with fewer are eliminated, and a sixth of those is at
    // worst a dense block. Fomin, Høie: Pathwidth of cubic graphs and exact algorithms, Information Processing Letters
    // 97 (2006), doi:10.1016/j.ipl.2005.10.012
    const double dense = std::max(0.0, edges - count + 1) / 3;
    const double products = dense * dense * dense / 6;
    return edges <= chain_pairs * count && products <= most_products * static_cast<double>(batch.contacts.size());
}

}  // namespace

BatchKind kindOf(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
                 const ResolutionSettings& settings) {
    BatchKind kind{.framed = !batch.joints.empty()};
    ContactSums sums;
    double least_allowed = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : batch.contacts) {
        const Contact& contact = contacts[i];
        kind.rolling += resistsRolling(contact) ? 1 : 0;
        kind.two_frictions = kind.two_frictions || contact.kinetic_friction < contact.static_friction;
        least_allowed = std::min(least_allowed, contact.allowed_overlap);
        sums.add(contact, bodies);
    }
    const auto count = static_cast<double>(batch.contacts.size());
    kind.pulled = sums.pulled;
    kind.motion = std::sqrt(sums.scale);
    kind.depth = count > 0 ? std::sqrt(sums.depth / count) : 0;
    kind.safe_way = safe_multiple * least_allowed;
    kind.rests = sums.motion <= settings.restitution_threshold * settings.restitution_threshold * sums.mass;
    kind.may_step_directly = kind.rests && !kind.framed && kind.rolling == 0 && isChain(batch, contacts, bodies);
    const std::size_t size = kind.may_step_directly ? 0 : batch.contacts.size();
    kind.order = size >= coloured_contacts ? SweepOrder::by_colours
                 : size >= wide_contacts   ? SweepOrder::in_order
                                           : SweepOrder::one_by_one;
    return kind;
}

SweepPlan planOf(const BatchKind& kind, const BodyState& bodies, const ResolutionSettings& settings) {
    const double deeper = std::max(1.0, kind.depth / usual_depth);
    const bool stricter = kind.pulled && settings.pulled_tolerance < settings.tolerance;
    const double part = stricter ? settings.pulled_tolerance / settings.tolerance : 1;
    return {.limit = sweepLimit(settings) * (kind.rests ? resting_sweeps : 1),
            .steady_speed = part * steady_part * settings.resolution_threshold,
            .tolerance = part * settings.tolerance / std::pow(deeper, depth_power),
            .safe_speed = kind.safe_way / bodies.time_step,
            .motion = kind.motion};
}

}  // namespace cairn
