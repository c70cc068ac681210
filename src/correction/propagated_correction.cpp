#include "correction/propagated_correction.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace cairn {

namespace {

/// Moves the bodies of a search and wakes them. @return how many
std::int64_t moveBodies(const Propagation& search, const BodyState& bodies) {
    for (const BodyIndex body : search.moved()) {
        bodies.position[body] += search.share(body) * search.displacement();
        bodies.wake(body, WakeReason::displaced);
    }
    return static_cast<std::int64_t>(search.moved().size());
}

/// Brings the contacts of all moved bodies up to date. @source thesis (2.3.7)
void updateContacts(const Propagation& search, const ContactsOfBodies& contacts_of, std::span<Contact> contacts,
                    const BodyState& bodies, PushGraph& graph) {
    const auto shareOf = [&](BodyIndex i) { return bodies.isFixed(i) ? 0 : search.share(i); };
    for (const BodyIndex body : search.moved()) {
        for (const std::uint32_t index : contacts_of[body]) {
            Contact& contact = contacts[index];
            const double share_a = shareOf(contact.a);
            const double share_b = shareOf(contact.b);
            // A contact between two moved bodies is met twice and updated once, with its body A.
            if (body == contact.b && share_a > 0) continue;
            contact.point += (0.5 * (share_a + share_b)) * search.displacement();
            contact.distance += (share_a - share_b) * search.displacement().dot(contact.normal);
            for (const BodyIndex i : {contact.a, contact.b}) {
                if (!bodies.isFixed(i)) graph.distancesChanged(i);
            }
        }
    }
}

}  // namespace

CorrectionCounts PropagatedCorrection::correct(const BatchView& batch, const ContactsOfBodies& contacts_of,
                                               std::span<Contact> contacts, const BodyState& bodies, double remaining) {
    penetrating_.clear();
    for (const std::uint32_t index : batch.contacts) {
        if (contacts[index].isTooDeep()) penetrating_.push_back(index);
    }
    CorrectionCounts counts;
    counts.penetrating = static_cast<std::int64_t>(penetrating_.size());
    if (counts.penetrating == 0) return counts;
    bodies.writePlaces(batch.bodies);
    best_.begin(bodies.place, batch.bodies.size());
    trial_.begin(bodies.place, batch.bodies.size());
    graph_.reset(batch, contacts_of, contacts, bodies, remaining);
    for (const std::uint32_t index : penetrating_) {
        // The correction of another contact may have corrected this one.
        if (!contacts[index].isTooDeep()) continue;
        if (!choose(contacts[index], bodies, remaining)) continue;
        counts.displaced += moveBodies(best_, bodies);
        updateContacts(best_, contacts_of, contacts, bodies, graph_);
    }
    counts.uncorrected =
        std::ranges::count_if(penetrating_, [&](std::uint32_t index) { return contacts[index].isTooDeep(); });
    counts.corrected = counts.penetrating - counts.uncorrected;
    return counts;
}

bool PropagatedCorrection::choose(const Contact& contact, const BodyState& bodies, double remaining) {
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    CandidateKind best_kind = CandidateKind::normal;
    bool found = false;
    for (const Candidate& candidate : listCandidates(contact, bodies, -remaining * contact.allowed_overlap)) {
        // On a tie a step back along the velocity replaces one along the normal, so it may move as many bodies.
        const bool wins_tie = candidate.kind == CandidateKind::velocity && best_kind == CandidateKind::normal;
        const std::size_t limit = wins_tie ? fewest : fewest - 1;
        if (trial_.run(candidate, graph_, limit) != PropagationOutcome::valid) continue;
        std::swap(best_, trial_);
        fewest = best_.moved().size();
        best_kind = candidate.kind;
        found = true;
    }
    return found;
}

}  // namespace cairn
