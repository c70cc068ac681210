#include "correction/propagation.h"

#include <algorithm>

namespace cairn {

void Propagation::reserve(std::size_t slots) {
    if (notes_.size() >= slots) return;
    notes_.resize(slots);
    // A body is moved once and is once at most among the pushes of one length. It can be several times among the
    // shorter ones, but not all bodies are there at a time.
    const std::size_t room = notes_.capacity();
    moved_.reserve(room);
    stack_.reserve(room);
    shorter_.reserve(room);
}

PropagationOutcome Propagation::run(const Candidate& candidate, const ContactGraph& graph, std::size_t limit) {
    ++search_;
    displacement_ = candidate.displacement;
    other_ = candidate.other;
    moved_.clear();
    stack_.clear();
    shorter_.clear();
    if (limit == 0) return PropagationOutcome::abandoned;
    note(candidate.body, 1);
    stack_.push_back({1, candidate.body});
    for (Push push{}; pop(push);) {
        if (!pushNeighbours(push, graph)) return PropagationOutcome::invalid;
        if (moved_.size() > limit) return PropagationOutcome::abandoned;
    }
    return PropagationOutcome::valid;
}

/// Takes the next push. @return false if there is none
bool Propagation::pop(Push& push) {
    if (!stack_.empty()) {
        push = stack_.back();
        stack_.pop_back();
        return true;
    }
    while (!shorter_.empty()) {
        std::pop_heap(shorter_.begin(), shorter_.end());
        push = shorter_.back();
        shorter_.pop_back();
        // A body that was pushed further in the meantime has already been processed with that.
        if (push.share == share(push.body)) return true;
    }
    return false;
}

/// Associates a displacement with a body if it is longer than the one it has. @return whether it is
bool Propagation::note(BodyIndex body, double share) {
    Note& known = notes_[body];
    if (known.search != search_) {
        if (!(share > 0)) return false;
        moved_.push_back(body);
    } else if (!(share > known.share)) {
        return false;
    }
    known = {search_, share};
    return true;
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
        if (gap > 0) {
            const double rest = push.share - gap / towards;
            if (!note(neighbour, rest)) continue;
            shorter_.push_back({rest, neighbour});
            std::push_heap(shorter_.begin(), shorter_.end());
        } else if (note(neighbour, push.share)) {
            stack_.push_back({push.share, neighbour});
        }
    }
    return true;
}

}  // namespace cairn
