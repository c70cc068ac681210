#include "correction/propagation.h"

#include <algorithm>

namespace cairn {

void Propagation::reserve(std::size_t slots) {
    if (notes_.size() < slots) notes_.resize(slots);
}

PropagationOutcome Propagation::run(const Candidate& candidate, const ContactGraph& graph, std::size_t limit) {
    ++search_;
    displacement_ = candidate.displacement;
    other_ = candidate.other;
    moved_.clear();
    pending_.clear();
    if (limit == 0) return PropagationOutcome::abandoned;
    note(candidate.body, 1);
    while (!pending_.empty()) {
        std::pop_heap(pending_.begin(), pending_.end());
        const Push push = pending_.back();
        pending_.pop_back();
        // A body that was pushed further in the meantime has already been processed with that.
        if (push.share < share(push.body)) continue;
        if (!pushNeighbours(push, graph)) return PropagationOutcome::invalid;
        if (moved_.size() > limit) return PropagationOutcome::abandoned;
    }
    return PropagationOutcome::valid;
}

void Propagation::note(BodyIndex body, double share) {
    Note& known = notes_[body];
    if (known.search != search_) moved_.push_back(body);
    known = {search_, share};
    pending_.push_back({share, body});
    std::push_heap(pending_.begin(), pending_.end());
}

/// Algorithm 1 for one body. @return false if the search is invalid
bool Propagation::pushNeighbours(const Push& push, const ContactGraph& graph) {
    for (const std::uint32_t index : graph.contacts_of[push.body]) {
        const Contact& contact = graph.contacts[index];
        const bool is_a = contact.a == push.body;
        const BodyIndex neighbour = is_a ? contact.b : contact.a;
        const double along_n = displacement_.dot(contact.normal);
        const double towards = is_a ? -along_n : along_n;       // of the first displacement; n points from B to A
        const double gap = contact.distance - graph.remaining;  // (2.5.6)
        const double approach = push.share * towards;           // dX·n_XY
        // (2.3.4), (2.3.5); both are false for what is not a number, so nothing travels through it.
        if (!(approach > 0 && approach > gap)) continue;
        if (graph.bodies.isFixed(neighbour) || neighbour == other_) return false;
        // (2.3.6) with all vectors as multiples of the first: (s − e)/s · dX, s = share·towards.
        const double share_of_neighbour = gap > 0 ? push.share - gap / towards : push.share;
        if (share_of_neighbour > share(neighbour)) note(neighbour, share_of_neighbour);
    }
    return true;
}

}  // namespace cairn
