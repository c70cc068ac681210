#include "batches/surroundings.h"

#include <algorithm>

namespace cairn {

namespace {

bool isExcluded(const SurroundingsInput& input, const Contact& contact) {
    return !input.excluded.empty() && (input.excluded[contact.a] | input.excluded[contact.b]) != 0;
}

}  // namespace

void Surroundings::find(const SurroundingsInput& input, std::span<const std::uint32_t> seeds, const Rings& rings) {
    for (const auto& [root, body] : members_) {
        taken_[body] = Taken::none;
        joined_.part(body);
    }
    members_.clear();
    taken_.resize(std::max(taken_.size(), input.kind.size()), Taken::none);
    joined_.grow(input.kind.size());
    collectBodies(input, seeds, rings);
    collectContacts(input);
    divide();
}

/// Finds the bodies with all their contacts, ring after ring.
void Surroundings::collectBodies(const SurroundingsInput& input, std::span<const std::uint32_t> seeds,
                                 const Rings& rings) {
    inside_.clear();
    const auto take = [&](BodyIndex i) {
        if (input.kind[i] != BodyKind::dynamic || taken_[i] == Taken::all) return;
        taken_[i] = Taken::all;
        inside_.push_back(i);
    };
    for (const std::uint32_t i : seeds) {
        const Contact& contact = input.contacts[i];
        if (isExcluded(input, contact)) continue;
        take(contact.a);
        take(contact.b);
    }
    std::size_t begin = 0;
    for (int ring = 1; ring < rings.far; ++ring) {
        const std::size_t end = inside_.size();
        for (; begin < end; ++begin) {
            for (const std::uint32_t i : input.contacts_of[inside_[begin]]) {
                const Contact& contact = input.contacts[i];
                if (isExcluded(input, contact) || (ring >= rings.near && !rings.leads(contact))) continue;
                take(contact.a);
                take(contact.b);
            }
        }
    }
}

/// Finds their contacts, each once, and the bodies that those are with, and joins what they connect.
void Surroundings::collectContacts(const SurroundingsInput& input) {
    of_members_.clear();
    for (const BodyIndex body : inside_) {
        members_.emplace_back(body, body);
        for (const std::uint32_t i : input.contacts_of[body]) {
            const Contact& contact = input.contacts[i];
            if (isExcluded(input, contact)) continue;
            const BodyIndex other = contact.a == body ? contact.b : contact.a;
            if (taken_[other] == Taken::all && other < body) continue;
            of_members_.emplace_back(body, i);
            if (input.kind[other] != BodyKind::dynamic) continue;
            if (taken_[other] == Taken::none) {
                taken_[other] = Taken::some;
                members_.emplace_back(other, other);
            }
            joined_.join(body, other);
        }
    }
}

/// Sorts bodies and contacts by their groups, whose roots are their lowest bodies.
void Surroundings::divide() {
    for (auto& [root, body] : members_) root = joined_.find(body);
    for (auto& [root, contact] : of_members_) root = joined_.find(root);
    std::ranges::sort(members_);
    std::ranges::sort(of_members_);
    bodies_.clear();
    contacts_.clear();
    for (const auto& [root, body] : members_) bodies_.push_back(body);
    for (const auto& [root, contact] : of_members_) contacts_.push_back(contact);
    groups_.clear();
    for (std::size_t b = 0, c = 0; b < members_.size();) {
        const BodyIndex root = members_[b].first;
        const std::size_t first_body = b;
        const std::size_t first_contact = c;
        while (b < members_.size() && members_[b].first == root) ++b;
        while (c < of_members_.size() && of_members_[c].first == root) ++c;
        groups_.push_back({std::span(bodies_).subspan(first_body, b - first_body),
                           std::span(contacts_).subspan(first_contact, c - first_contact)});
    }
}

}  // namespace cairn
