#include "correction/position_sweeps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cairn {

namespace {

/// So many sweeps, forth and back, are for what is a little too deep: the next steps go on from there.
constexpr int usual_sweeps = 3;
/// And so many as long as a sweep still finds contacts deeper than a multiple of the threshold, as in impacts.
constexpr int most_sweeps = 20;
constexpr double deep_multiple = 2;

/// Whether an impulse may change the velocity of a body or finds a fixed one: not of one that is held still.
bool mayReceive(const BodyState& bodies, BodyIndex i) {
    return bodies.isFixed(i) || bodies.asleep[i] == 0;
}

}  // namespace

CorrectionCounts PositionSweeps::correct(const BatchView& batch, const ContactsOfBodies&, std::span<Contact> contacts,
                                         const BodyState& bodies, const CorrectionSettings& settings) {
    const double threshold = -settings.penetration_threshold;  // thr_pen
    CorrectionCounts counts;
    counts.penetrating = std::ranges::count_if(
        batch.contacts, [&](std::uint32_t index) { return contacts[index].distance < threshold; });
    if (counts.penetrating == 0) return counts;
    gather(batch, contacts, bodies);
    for (int i = 1; i <= most_sweeps; ++i) {
        const double deepest = sweep(threshold, settings.remaining_penetration * threshold);
        if (!(deepest < (i < usual_sweeps ? threshold : deep_multiple * threshold))) break;
    }
    counts.displaced = displace(batch, bodies);
    pay(contacts, bodies);
    for (const Overlap& overlap : overlaps_) {
        Contact& contact = contacts[overlap.index];
        const Vec3& a = shares_[overlap.a].displacement;
        const Vec3& b = shares_[overlap.b].displacement;
        contact.point += 0.5 * (a + b);
        contact.distance += (a - b).dot(contact.normal);
        if (overlap.distance < threshold && !(contact.distance < threshold)) ++counts.corrected;
    }
    counts.uncorrected = counts.penetrating - counts.corrected;
    return counts;
}

/// Lists the contacts between bodies that can move apart.
void PositionSweeps::gather(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
    if (local_.size() < bodies.size()) local_.resize(bodies.size());
    const auto fixed = static_cast<std::uint32_t>(batch.bodies.size());
    for (std::uint32_t i = 0; i < fixed; ++i) local_[batch.bodies[i]] = i;
    shares_.assign(batch.bodies.size() + 1, {});
    overlaps_.clear();
    for (const std::uint32_t index : batch.contacts) {
        const Contact& contact = contacts[index];
        const double inverse_a = bodies.mass_inv[contact.a];
        const double part_a = inverse_a / (inverse_a + bodies.mass_inv[contact.b]);
        if (!std::isfinite(part_a) || !std::isfinite(contact.distance)) continue;
        overlaps_.push_back({contact.normal, contact.distance, part_a, 1 - part_a,
                             bodies.isFixed(contact.a) ? fixed : local_[contact.a],
                             bodies.isFixed(contact.b) ? fixed : local_[contact.b], index});
    }
}

/// Visits all contacts forth and back. @return the smallest distance found on the way forth [m], 0 if none is too small
double PositionSweeps::sweep(double threshold, double remaining) {
    double deepest = 0;
    for (const Overlap& overlap : overlaps_) {
        deepest = std::min(deepest, separate(overlap, threshold, remaining));
    }
    if (deepest == 0) return 0;
    for (std::size_t i = overlaps_.size(); i-- > 0;) separate(overlaps_[i], threshold, remaining);
    return deepest;
}

/// Moves the bodies of one contact apart if it is too deep by now. @return the distance found then, else 0 [m]
inline double PositionSweeps::separate(const Overlap& overlap, double threshold, double remaining) {
    Vec3& a = shares_[overlap.a].displacement;
    Vec3& b = shares_[overlap.b].displacement;
    const double distance = overlap.distance + (a - b).dot(overlap.normal);
    if (!(distance < threshold)) return 0;
    const Vec3 push = (remaining - distance) * overlap.normal;
    a += overlap.part_a * push;
    b -= overlap.part_b * push;
    return distance;
}

/// Moves the bodies, wakes them and finds out what they owe. @return how many were moved
std::int64_t PositionSweeps::displace(const BatchView& batch, const BodyState& bodies) {
    std::int64_t moved = 0;
    for (std::size_t i = 0; i < batch.bodies.size(); ++i) {
        const BodyIndex body = batch.bodies[i];
        Share& share = shares_[i];
        if (!share.displacement.allFinite()) share.displacement.setZero();
        if (share.displacement.isZero(0)) continue;
        bodies.position[body] += share.displacement;
        bodies.wake(body, WakeReason::displaced);
        share.debt = std::max(0.0, -bodies.acceleration.dot(share.displacement) / bodies.mass_inv[body]);
        ++moved;
    }
    return moved;
}

/// Takes what the lifted bodies owe from the motion along the normals of their contacts, in ascending order.
void PositionSweeps::pay(std::span<const Contact> contacts, const BodyState& bodies) {
    for (const Overlap& overlap : overlaps_) {
        Share& a = shares_[overlap.a];
        Share& b = shares_[overlap.b];
        const Contact& contact = contacts[overlap.index];
        if (!(a.debt + b.debt > 0) || !mayReceive(bodies, contact.a) || !mayReceive(bodies, contact.b)) continue;
        payAt(contact, a, b, bodies);
    }
}

/// Lets one contact give what it has of what its bodies owe. With λ on A and −λ on B along n, k = nᵀ·K·n and the normal
/// velocity u, the kinetic energy changes by λ·u + ½·k·λ²: at most by −u²/(2·k), at which u is 0.
void PositionSweeps::payAt(const Contact& contact, Share& a, Share& b, const BodyState& bodies) {
    const Vec3& n = contact.normal;
    const Vec3 lever_a = (contact.point - bodies.position[contact.a]).cross(n);
    const Vec3 lever_b = (contact.point - bodies.position[contact.b]).cross(n);
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
