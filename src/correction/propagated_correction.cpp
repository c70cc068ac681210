#include "correction/propagated_correction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace cairn {

namespace {

/// Contacts that cannot be corrected are left alone up to this multiple of the threshold: spreading less would keep
/// resting piles awake.
constexpr double first_spread = 1.14;

/// How deep a contact must be for an attempt to spread it [multiple of the threshold]: 1.14, 1.5, 3, 6, …
double spreadFrom(std::int64_t level) {
    return level == 0 ? first_spread : std::ldexp(1.5, static_cast<int>(level - 1));
}

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
                    PushGraph& graph) {
    for (const BodyIndex body : search.moved()) {
        for (const std::uint32_t index : contacts_of[body]) {
            Contact& contact = contacts[index];
            const double share_a = search.share(contact.a);
            const double share_b = search.share(contact.b);
            // A contact between two moved bodies is met twice and updated once, with its body A.
            if (body == contact.b && share_a > 0) continue;
            contact.point += (0.5 * (share_a + share_b)) * search.displacement();
            contact.distance += (share_a - share_b) * search.displacement().dot(contact.normal);
            graph.distancesChanged(contact.a);
            graph.distancesChanged(contact.b);
        }
    }
}

}  // namespace

CorrectionCounts PropagatedCorrection::correct(const BatchView& batch, const ContactsOfBodies& contacts_of,
                                               std::span<Contact> contacts, const BodyState& bodies,
                                               const CorrectionSettings& settings) {
    const double threshold = -settings.penetration_threshold;  // thr_pen
    best_.reserve(bodies.size());
    trial_.reserve(bodies.size());
    penetrating_.clear();
    for (const std::uint32_t index : batch.contacts) {
        if (contacts[index].distance < threshold) penetrating_.push_back(index);
    }
    CorrectionCounts counts;
    counts.penetrating = static_cast<std::int64_t>(penetrating_.size());
    if (settings.spread_levels > 0) counts.displaced = loosening_.run(batch, contacts, bodies, settings);
    if (counts.displaced == 0) counts.displaced = push(contacts_of, contacts, bodies, settings);
    for (const std::uint32_t index : penetrating_) {
        if (contacts[index].distance < threshold) {
            ++counts.uncorrected;
        } else {
            ++counts.corrected;
        }
    }
    return counts;
}

std::int64_t PropagatedCorrection::push(const ContactsOfBodies& contacts_of, std::span<Contact> contacts,
                                        const BodyState& bodies, const CorrectionSettings& settings) {
    const double threshold = -settings.penetration_threshold;
    std::int64_t displaced = 0;
    Pass pass{threshold, settings.remaining_penetration * threshold};
    const double spread_part = (1 + settings.remaining_penetration) / 2;
    for (std::int64_t level = 0; level <= settings.spread_levels; ++level) {
        const bool any = std::any_of(penetrating_.begin(), penetrating_.end(),
                                     [&](std::uint32_t index) { return contacts[index].distance < pass.limit; });
        if (!any) break;
        graph_.reset(contacts_of, contacts, bodies, pass.remaining);
        displaced += run(pass, contacts_of, contacts, bodies);
        pass.limit = spreadFrom(level) * threshold;
        pass.remaining = spread_part * pass.limit;
    }
    return displaced;
}

/// Corrects the contacts deeper than the pass's limit. @return how many bodies were moved
std::int64_t PropagatedCorrection::run(const Pass& pass, const ContactsOfBodies& contacts_of,
                                       std::span<Contact> contacts, const BodyState& bodies) {
    std::int64_t displaced = 0;
    for (const std::uint32_t index : penetrating_) {
        // The correction of another contact may have corrected this one.
        if (!(contacts[index].distance < pass.limit)) continue;
        if (!choose(contacts[index], bodies, pass.remaining)) continue;
        displaced += moveBodies(best_, bodies);
        updateContacts(best_, contacts_of, contacts, graph_);
    }
    return displaced;
}

bool PropagatedCorrection::choose(const Contact& contact, const BodyState& bodies, double remaining) {
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    CandidateKind best_kind = CandidateKind::normal;
    bool found = false;
    for (const Candidate& candidate : listCandidates(contact, bodies, remaining)) {
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
