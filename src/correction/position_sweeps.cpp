#include "correction/position_sweeps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "batches/batch_motion.h"
#include "math/rotation.h"

namespace cairn {

namespace {

/// So many sweeps, forth and back, are for what is a little too deep: the next steps go on from there.
constexpr int usual_sweeps = 3;
/// And so many as long as a sweep still finds contacts deeper than a multiple of the threshold, as in impacts.
constexpr int most_sweeps = 20;
constexpr double deep_multiple = 1.3;
/// The lighter body of a contact moves so many times as far as the other at most, after the usual sweeps. Between heavy
/// ones it has nowhere to go, and by inverse masses it would be pushed to and fro for as many sweeps as it is lighter.
constexpr double most_uneven = 8;
constexpr double by_masses = std::numeric_limits<double>::infinity();
constexpr double unlimited = std::numeric_limits<double>::infinity();
/// What is far too deep is left so deep in one step: pushes apart of all of it would drive others into each other,
/// which this step does not see.
constexpr double left_of_deep = 0.5;
/// A body is turned so far that what touches goes by this multiple of the threshold: contacts are those of the sides
/// that bodies turn to each other now.
constexpr double most_turned = 3;
/// In batches with overlaps of more than this multiple, which a scene or a user began with, any turn is allowed: bodies
/// come apart only through each other.
constexpr double most_grown = 10;

/// What the motion of a batch does not pay for may lift each body by this part of how far it falls from rest in a time
/// step, …
constexpr double free_part = 0.01;

/// … times the eighth power of how much deeper it is than deep_multiple, as only what a scene or a user begins with is.
double freePartAt(double depth) {
    const double deeper = std::max(1.0, depth / deep_multiple);
    const double squared = deeper * deeper;
    return free_part * (squared * squared) * (squared * squared);
}

/// Whether an impulse may change the velocity of a body or finds a fixed one: not of one that is held still.
bool mayReceive(const BodyState& bodies, BodyIndex i) {
    return bodies.isFixed(i) || bodies.asleep[i] == 0;
}

}  // namespace

CorrectionCounts PositionSweeps::correct(const BatchView& batch, const ContactsOfBodies&, std::span<Contact> contacts,
                                         const BodyState& bodies, double remaining) {
    CorrectionCounts counts;
    counts.penetrating =
        std::ranges::count_if(batch.contacts, [&](std::uint32_t index) { return contacts[index].isTooDeep(); });
    if (counts.penetrating == 0) return counts;
    gather(batch, contacts, bodies);
    for (int i = 1; i <= most_sweeps; ++i) {
        const double deepest = sweep(contacts, bodies, {remaining, i > usual_sweeps ? most_uneven : by_masses});
        if (!(deepest > (i < usual_sweeps ? 1 : deep_multiple))) break;
    }
    displace(batch, bodies);
    return counts;
}

CorrectionCounts PositionSweeps::settle(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                                        const PosesBefore& before) {
    CorrectionCounts counts;
    counts.displaced = findMoved(batch, bodies, before);
    if (counts.displaced > 0) {
        const double part = grantedPart(batch, contacts, bodies, before);
        if (part < 1) takeBack(part, batch, bodies, before);
    }
    for (const std::uint32_t index : batch.contacts) {
        Contact& contact = contacts[index];
        const Share& a = shareOf(contact.a, bodies);
        const Share& b = shareOf(contact.b, bodies);
        const bool deep = contact.isTooDeep();
        if ((a.moved || b.moved) && std::isfinite(contact.distance)) moveContact(contact, a, b, before);
        if (deep) ++(contact.isTooDeep() ? counts.uncorrected : counts.corrected);
    }
    return counts;
}

/// Lists the contacts between bodies that can move apart.
void PositionSweeps::gather(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
    const auto fixed = static_cast<std::uint32_t>(batch.bodies.size());
    bodies.writePlaces(batch.bodies);
    shares_.assign(batch.bodies.size() + 1, {});
    overlaps_.clear();
    levers_.clear();
    stuck_ = false;
    for (const std::uint32_t index : batch.contacts) {
        const Contact& contact = contacts[index];
        if (!std::isfinite(contact.distance)) continue;
        stuck_ = stuck_ || contact.distance < -most_grown * contact.allowed_overlap;
        overlaps_.push_back({.normal = contact.normal,
                             .distance = contact.distance,
                             .threshold = -contact.allowed_overlap,
                             .a = bodies.isFixed(contact.a) ? fixed : bodies.place[contact.a],
                             .b = bodies.isFixed(contact.b) ? fixed : bodies.place[contact.b],
                             .index = index});
    }
}

/// The levers of a contact, which only those need that are too deep or whose bodies moved.
const PositionSweeps::Levers& PositionSweeps::leversOf(Overlap& overlap, std::span<const Contact> contacts,
                                                       const BodyState& bodies) {
    if (overlap.levers != no_levers) return levers_[overlap.levers];
    overlap.levers = static_cast<std::uint32_t>(levers_.size());
    const Contact& contact = contacts[overlap.index];
    Levers& l = levers_.emplace_back();
    l.a = (contact.pointOn(contact.a) - bodies.position[contact.a]).cross(contact.normal);
    l.b = (contact.pointOn(contact.b) - bodies.position[contact.b]).cross(contact.normal);
    l.turn_a = bodies.inertiaInv_W[contact.a] * l.a;
    l.turn_b = bodies.inertiaInv_W[contact.b] * l.b;
    for (const auto& [place, body] : {std::pair(overlap.a, contact.a), std::pair(overlap.b, contact.b)}) {
        const double lever = (contact.pointOn(body) - bodies.position[body]).norm();
        const double angle = lever > 0 ? most_turned * contact.allowed_overlap / lever : 0;
        shares_[place].most_turn = std::max(shares_[place].most_turn, stuck_ ? unlimited : angle);
    }
    l.mass_a = bodies.mass_inv[contact.a];
    l.mass_b = bodies.mass_inv[contact.b];
    l.k_a = l.mass_a + l.turn_a.dot(l.a);
    l.k_b = l.mass_b + l.turn_b.dot(l.b);
    return l;
}

/// Visits all contacts forth and back. @return the largest overlap found on the way forth, as a multiple of what is
/// allowed; 0 if none is too deep
double PositionSweeps::sweep(std::span<const Contact> contacts, const BodyState& bodies, const Push& push) {
    double deepest = 0;
    for (Overlap& overlap : overlaps_) {
        deepest = std::max(deepest, separate(overlap, contacts, bodies, push));
    }
    if (deepest == 0) return 0;
    for (std::size_t i = overlaps_.size(); i-- > 0;) separate(overlaps_[i], contacts, bodies, push);
    return deepest;
}

/// Moves the bodies of one contact apart if it is too deep by now. @return how deep as sweep() says, else 0
inline double PositionSweeps::separate(Overlap& overlap, std::span<const Contact> contacts, const BodyState& bodies,
                                       const Push& push) {
    Share& a = shares_[overlap.a];
    Share& b = shares_[overlap.b];
    if (!isMoved(overlap) && !(overlap.distance < overlap.threshold)) return 0;
    const Levers& levers = leversOf(overlap, contacts, bodies);
    const double distance = distanceOf(overlap);
    const double k = levers.k_a + levers.k_b;
    if (!(distance < overlap.threshold && k > 0 && std::isfinite(k))) return 0;
    const double goal = std::min(push.remaining * overlap.threshold, left_of_deep * overlap.distance);
    if (!(distance < goal)) return 0;
    // What cannot move leaves all to the other.
    const bool both = levers.k_a > 0 && levers.k_b > 0;
    const double part_a = both ? std::min(1.0, push.largest_ratio * levers.k_b / levers.k_a) : 1;
    const double part_b = both ? std::min(1.0, push.largest_ratio * levers.k_a / levers.k_b) : 1;
    const double impulse = (goal - distance) / (part_a * levers.k_a + part_b * levers.k_b);
    a.displacement += part_a * impulse * levers.mass_a * overlap.normal;
    a.turnBy(part_a * impulse * levers.turn_a);
    a.moved = a.moved || levers.mass_a > 0;
    b.displacement -= part_b * impulse * levers.mass_b * overlap.normal;
    b.turnBy(-part_b * impulse * levers.turn_b);
    b.moved = b.moved || levers.mass_b > 0;
    return distance / overlap.threshold;
}

/// With what the bodies moved so far. @pre the levers are known, or neither body moved
double PositionSweeps::distanceOf(const Overlap& overlap) const {
    if (overlap.levers == no_levers) return overlap.distance;
    const Share& a = shares_[overlap.a];
    const Share& b = shares_[overlap.b];
    const Levers& levers = levers_[overlap.levers];
    return overlap.distance + (a.displacement - b.displacement).dot(overlap.normal) + a.turn.dot(levers.a) -
           b.turn.dot(levers.b);
}

void PositionSweeps::displace(const BatchView& batch, const BodyState& bodies) {
    for (std::size_t i = 0; i < batch.bodies.size(); ++i) {
        const BodyIndex body = batch.bodies[i];
        const Share& share = shares_[i];
        if (!share.displacement.allFinite() || !share.turn.allFinite() || share.displacement.isZero(0)) continue;
        bodies.position[body] += share.displacement;
        if (share.turn.isZero(0)) continue;
        bodies.orientation[body] = (fromRotationVector(share.turn) * bodies.orientation[body]).normalized();
        bodies.inertiaInv_W[body] = toWorldInertia(bodies.inertiaInv_B[body], bodies.orientation[body]);
    }
}

/// Finds how far the bodies were moved and what they owe, and wakes them. @return how many were
std::int64_t PositionSweeps::findMoved(const BatchView& batch, const BodyState& bodies, const PosesBefore& before) {
    std::int64_t moved = 0;
    bodies.writePlaces(batch.bodies);
    shares_.assign(batch.bodies.size() + 1, {});
    for (std::size_t i = 0; i < batch.bodies.size(); ++i) {
        const BodyIndex body = batch.bodies[i];
        Share& share = shares_[i];
        share.displacement = bodies.position[body] - before.position[body];
        if (bodies.orientation[body].coeffs() != before.orientation[body].coeffs()) {
            share.turn = toRotationVector(bodies.orientation[body] * before.orientation[body].conjugate());
        }
        share.moved = !share.displacement.isZero(0);
        if (!share.moved) continue;
        bodies.wake(body, WakeReason::displaced);
        const Vec3 weight = bodies.gravityFactor(body) * bodies.acceleration / bodies.mass_inv[body];
        share.lift = std::max(0.0, -weight.dot(share.displacement));
        share.debt = share.lift;
        ++moved;
    }
    return moved;
}

/// Takes what the lifted bodies owe from the motion along the normals of their contacts, in ascending order. @return
/// the part of the way of all bodies that is paid for or free: one for all of them, so that they keep off each other
double PositionSweeps::grantedPart(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
                                   const PosesBefore& before) {
    for (const std::uint32_t index : batch.contacts) {
        const Contact& contact = contacts[index];
        Share& a = shareOf(contact.a, bodies);
        Share& b = shareOf(contact.b, bodies);
        if (std::isfinite(contact.distance)) {
            const double depth = -contact.distance / contact.allowed_overlap;
            a.depth = std::max(a.depth, depth);
            b.depth = std::max(b.depth, depth);
        }
        if (!(a.debt + b.debt > 0) || !mayReceive(bodies, contact.a) || !mayReceive(bodies, contact.b)) continue;
        payAt(contact, a, b, bodies, before);
    }
    // Supports that move lift what they carry.
    if (!hasStillSupports(batch, contacts, bodies)) return 1;
    double lift = 0, unpaid = 0, free = 0;
    for (std::size_t i = 0; i < batch.bodies.size(); ++i) {
        const Share& share = shares_[i];
        if (!(share.lift > 0)) continue;
        const BodyIndex body = batch.bodies[i];
        const double fall = (bodies.gravityFactor(body) * bodies.time_step * bodies.acceleration).squaredNorm() / 2;
        lift += share.lift;
        unpaid += share.debt;
        free += freePartAt(share.depth) * fall / bodies.mass_inv[body];
    }
    return unpaid > free ? (lift - unpaid + free) / lift : 1;
}

/// Lets all bodies have gone only a part of their way.
void PositionSweeps::takeBack(double part, const BatchView& batch, const BodyState& bodies, const PosesBefore& before) {
    for (std::size_t i = 0; i < batch.bodies.size(); ++i) {
        Share& share = shares_[i];
        if (!share.moved) continue;
        const BodyIndex body = batch.bodies[i];
        share.displacement *= part;
        bodies.position[body] = before.position[body] + share.displacement;
        if (share.turn.isZero(0)) continue;
        share.turn *= part;
        bodies.orientation[body] = (fromRotationVector(share.turn) * before.orientation[body]).normalized();
        bodies.inertiaInv_W[body] = toWorldInertia(bodies.inertiaInv_B[body], bodies.orientation[body]);
    }
}

/// Brings a contact to where its bodies are now.
void PositionSweeps::moveContact(Contact& contact, const Share& a, const Share& b, const PosesBefore& before) const {
    const auto along = [&](BodyIndex i, const Share& share) {
        if (!share.moved) return 0.0;
        const Vec3 lever = contact.pointOn(i) - before.position[i];
        return contact.normal.dot(share.displacement + share.turn.cross(lever));
    };
    contact.distance += along(contact.a, a) - along(contact.b, b);
    contact.point += 0.5 * (a.displacement + b.displacement);
    const Vec3 past = 0.5 * (a.displacement - b.displacement);
    contact.slide += past - past.dot(contact.normal) * contact.normal;
}

/// Lets one contact give what it has of what its bodies owe. With λ on A and −λ on B along n, k = nᵀ·K·n and the normal
/// velocity u, the kinetic energy changes by λ·u + ½·k·λ²: at most by −u²/(2·k), at which u is 0.
void PositionSweeps::payAt(const Contact& contact, Share& a, Share& b, const BodyState& bodies,
                           const PosesBefore& before) {
    const Vec3& n = contact.normal;
    const Vec3 lever_a = (contact.pointOn(contact.a) - before.position[contact.a]).cross(n);
    const Vec3 lever_b = (contact.pointOn(contact.b) - before.position[contact.b]).cross(n);
    const Vec3 turn_a = bodies.inertiaInv_W[contact.a] * lever_a;
    const Vec3 turn_b = bodies.inertiaInv_W[contact.b] * lever_b;
    const double inverse_a = bodies.mass_inv[contact.a];
    const double inverse_b = bodies.mass_inv[contact.b];
    const double k = inverse_a + inverse_b + turn_a.dot(lever_a) + turn_b.dot(lever_b);
    const double u = n.dot(bodies.v[contact.a] - bodies.v[contact.b]) + bodies.w[contact.a].dot(lever_a) -
                     bodies.w[contact.b].dot(lever_b);
    const double energy = 0.5 * u * u / k;
    if (!(energy > 0 && std::isfinite(energy))) return;
    const double owed = a.debt + b.debt;
    const double paid = std::min(owed, energy);
    const double impulse = u * (std::sqrt(1 - paid / energy) - 1) / k;
    bodies.v[contact.a] += (impulse * inverse_a) * n;
    bodies.w[contact.a] += impulse * turn_a;
    bodies.v[contact.b] -= (impulse * inverse_b) * n;
    bodies.w[contact.b] -= impulse * turn_b;
    const double left = 1 - paid / owed;
    a.debt *= left;
    b.debt *= left;
}

}  // namespace cairn
