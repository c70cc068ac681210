#include "correction/loosening.h"

#include <algorithm>
#include <cstddef>

namespace cairn {

namespace {

/// Contacts that are not deeper never count as inside each other [multiple of the threshold].
constexpr double shallowest = 8;
/// Smaller batches are searched quickly.
constexpr std::size_t fewest_bodies = 32;

/// Whether both bodies of a contact can move and are more than half inside each other: the overlap is deeper than
/// their centres are apart along the normal.
bool isInside(const Contact& contact, const BodyState& bodies, double threshold) {
    if (!(contact.distance < -shallowest * threshold)) return false;
    if (bodies.isFixed(contact.a) || bodies.isFixed(contact.b)) return false;
    return (bodies.position[contact.a] - bodies.position[contact.b]).dot(contact.normal) < -contact.distance;
}

}  // namespace

void Loosening::wish(BodyIndex body, const Vec3& way) {
    wishes_[body].sum += way;
    ++wishes_[body].count;
}

std::int64_t Loosening::run(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                            const CorrectionSettings& settings) {
    if (batch.bodies.size() < fewest_bodies) return 0;
    const double threshold = settings.penetration_threshold;
    const auto inside = std::ranges::count_if(
        batch.contacts, [&](std::uint32_t index) { return isInside(contacts[index], bodies, threshold); });
    if (4 * static_cast<std::size_t>(inside) <= batch.bodies.size()) return 0;
    wishes_.resize(bodies.size());
    for (const std::uint32_t index : batch.contacts) {
        const Contact& contact = contacts[index];
        if (!(contact.distance < -threshold)) continue;
        const Vec3 way = -contact.distance * contact.normal;
        const bool a_moves = !bodies.isFixed(contact.a);
        const bool b_moves = !bodies.isFixed(contact.b);
        const double share = a_moves && b_moves ? 0.5 : 1;
        if (a_moves) wish(contact.a, share * way);
        if (b_moves) wish(contact.b, -share * way);
    }
    std::int64_t moved = 0;
    for (const BodyIndex body : batch.bodies) {
        Wish& w = wishes_[body];
        if (w.count == 0) continue;
        w.sum /= w.count;
        bodies.position[body] += w.sum;
        bodies.wake(body, WakeReason::displaced);
        ++moved;
    }
    for (const std::uint32_t index : batch.contacts) {
        Contact& contact = contacts[index];
        const Vec3& a = wishes_[contact.a].sum;
        const Vec3& b = wishes_[contact.b].sum;
        contact.point += 0.5 * (a + b);
        contact.distance += (a - b).dot(contact.normal);
    }
    for (const BodyIndex body : batch.bodies) wishes_[body] = {};
    return moved;
}

}  // namespace cairn
