#include "persistence/contact_memory.h"

#include <algorithm>
#include <tuple>

#include "math/arrays.h"

namespace cairn {

namespace {

/// Contacts farther from each other than this part of the smaller body are not the same one.
constexpr double same_place = 0.1;

Vec3 placeOn(const BodyStorage& bodies, BodyIndex i, const Vec3& point) {
    return bodies.orientation[i].conjugate() * (point - bodies.position[i]);
}

bool isSamePair(const Contact& x, const Contact& y) {
    return x.a == y.a && x.b == y.b;
}

bool before(BodyIndex a, BodyIndex b, BodyIndex c, BodyIndex d) {
    return std::tie(a, b) < std::tie(c, d);
}

}  // namespace

/// @param cursor at or before the entries of the contact's pair; set to the first of them
std::span<const ContactMemory::Entry> ContactMemory::entriesOf(const Contact& contact, std::size_t& cursor) const {
    const auto isBefore = [&](const Entry& e) { return before(e.a, e.b, contact.a, contact.b); };
    // Pairs whose contacts are known are passed over in ever longer steps.
    std::size_t step = 1;
    while (cursor + step < entries_.size() && isBefore(entries_[cursor + step])) {
        cursor += step;
        step *= 2;
    }
    const auto ahead = std::span(entries_).subspan(cursor, std::min(step + 1, entries_.size() - cursor));
    cursor += static_cast<std::size_t>(std::ranges::partition_point(ahead, isBefore) - ahead.begin());
    std::size_t end = cursor;
    while (end < entries_.size() && entries_[end].a == contact.a && entries_[end].b == contact.b) ++end;
    return std::span(entries_).subspan(cursor, end - cursor);
}

/// Whether the entries of a contact's pair begin at a place.
bool ContactMemory::beginsAt(std::size_t place, const Contact& contact) const {
    const auto isOfPair = [&](const Entry& e) { return e.a == contact.a && e.b == contact.b; };
    return place < entries_.size() && isOfPair(entries_[place]) && (place == 0 || !isOfPair(entries_[place - 1]));
}

void ContactMemory::recallPair(const BodyStorage& bodies, std::span<Contact> contacts,
                               std::span<const Entry> remembered) {
    for (Contact& contact : contacts) {
        contact.last_impulse.setZero();
        contact.reference_impulse.setZero();
    }
    const Contact& first = contacts.front();
    const double reach = same_place * std::min(bodies.r_max[first.a], bodies.r_max[first.b]);
    if (contacts.size() == 1 && remembered.size() == 1) {
        const Entry& entry = remembered.front();
        const auto isNear = [&](BodyIndex body, const Vec3& place) {
            const Vec3 on_body = bodies.position[body] + bodies.orientation[body] * place;
            return (contacts.front().point - on_body).squaredNorm() < reach * reach;
        };
        if (!isNear(entry.a, entry.place_a) && !isNear(entry.b, entry.place_b)) return;
        contacts.front().last_impulse = entry.impulse;
        contacts.front().reference_impulse = entry.reference_impulse;
        return;
    }
    // Every remembered impulse goes to one contact as a whole: where points of a manifold merge or split, the pair
    // still gets the same push in total.
    for (const Entry& entry : remembered) {
        const Vec3 on_a = bodies.position[entry.a] + bodies.orientation[entry.a] * entry.place_a;
        const Vec3 on_b = bodies.position[entry.b] + bodies.orientation[entry.b] * entry.place_b;
        double nearest = reach * reach;
        Contact* heir = nullptr;
        for (Contact& contact : contacts) {
            const double distance =
                std::min((contact.point - on_a).squaredNorm(), (contact.point - on_b).squaredNorm());
            if (!(distance < nearest)) continue;
            nearest = distance;
            heir = &contact;
        }
        if (heir == nullptr) continue;
        heir->last_impulse += entry.impulse;
        heir->reference_impulse += entry.reference_impulse;
    }
}

void ContactMemory::recall(const BodyStorage& bodies, std::span<const std::uint8_t> known, std::span<Contact> contacts,
                           const Executor& executor) {
    same_.assign(contacts.size(), 0);
    executor.forBlocks(contacts.size(), [&](std::size_t begin, std::size_t end, int) {
        // The pair that a block's border cuts belongs to the block in which it begins.
        while (begin > 0 && begin < end && isSamePair(contacts[begin - 1], contacts[begin])) ++begin;
        if (begin == end) return;
        const auto start = std::ranges::partition_point(
            entries_, [&](const Entry& e) { return before(e.a, e.b, contacts[begin].a, contacts[begin].b); });
        auto cursor = static_cast<std::size_t>(start - entries_.begin());
        while (begin < end) {
            std::size_t last = begin + 1;
            while (last < contacts.size() && isSamePair(contacts[begin], contacts[last])) ++last;
            if (!known.empty() && (known[contacts[begin].a] & known[contacts[begin].b]) != 0) {
                if (beginsAt(begin, contacts[begin])) std::fill(same_.begin() + begin, same_.begin() + last, 1);
            } else {
                const auto remembered = entriesOf(contacts[begin], cursor);
                recallPair(bodies, contacts.subspan(begin, last - begin), remembered);
            }
            begin = last;
        }
    });
}

void ContactMemory::store(const BodyStorage& bodies, std::span<const std::uint8_t> unmoved,
                          std::span<const Contact> contacts, const Executor& executor) {
    resizeTightly(entries_, contacts.size());
    same_.resize(contacts.size(), 0);
    executor.forBlocks(contacts.size(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const Contact& contact = contacts[i];
            if ((same_[i] & unmoved[contact.a] & unmoved[contact.b]) != 0) {
                entries_[i].impulse = contact.impulse;
                entries_[i].reference_impulse = contact.reference_impulse;
                continue;
            }
            entries_[i] = {contact.a,
                           contact.b,
                           placeOn(bodies, contact.a, contact.point),
                           placeOn(bodies, contact.b, contact.point),
                           contact.impulse,
                           contact.reference_impulse};
        }
    });
}

void ContactMemory::forget(BodyIndex body) {
    std::erase_if(entries_, [&](const Entry& entry) { return entry.a == body || entry.b == body; });
}

}  // namespace cairn
