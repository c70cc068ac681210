#include "correction/propagation.h"

#include <algorithm>

#include "math/arrays.h"

namespace cairn {

void Propagation::begin(std::span<const std::uint32_t> place, std::size_t bodies) {
    place_ = place;
    if (entries_.size() < bodies) resizeTightly(entries_, bodies);
}

PropagationOutcome Propagation::run(const Candidate& candidate, PushGraph& graph, std::size_t limit) {
    ++search_;
    displacement_ = candidate.displacement;
    moved_.clear();
    stack_.clear();
    shorter_.clear();
    if (limit == 0) return PropagationOutcome::abandoned;
    extend(candidate.body, 1, {});
    stack_.push_back({1, candidate.body});
    for (Open open{}; pop(open);) {
        if (graph.isBlocked(open.body, open.share, candidate) || !pushNeighbours(open, candidate, graph)) {
            rememberWayTo(open.body, candidate, graph);
            return PropagationOutcome::invalid;
        }
        if (moved_.size() > limit) return PropagationOutcome::abandoned;
    }
    return PropagationOutcome::valid;
}

/// Tells the graph how the push came to a body from where it is blocked.
void Propagation::rememberWayTo(BodyIndex body, const Candidate& candidate, PushGraph& graph) const {
    while (body != candidate.body) {
        const Way& way = entries_[place_[body]].pushed_by;
        graph.rememberWay(way.body, displacement_, way.link);
        body = way.body;
    }
}

/// Takes the next body. @return false if there is none
bool Propagation::pop(Open& open) {
    if (!stack_.empty()) {
        open = stack_.back();
        stack_.pop_back();
        return true;
    }
    while (!shorter_.empty()) {
        std::pop_heap(shorter_.begin(), shorter_.end());
        open = shorter_.back();
        shorter_.pop_back();
        // A body that was pushed further in the meantime has already been processed with that.
        if (open.share == share(open.body)) return true;
    }
    return false;
}

/// Associates a displacement with a body if it is longer than the one it has. @return whether it is
bool Propagation::extend(BodyIndex body, double share, const Way& pushed_by) {
    Entry& known = entries_[place_[body]];
    if (known.search != search_) {
        if (!(share > 0)) return false;
        moved_.push_back(body);
    } else if (!(share > known.share)) {
        return false;
    }
    known = {search_, share, pushed_by};
    return true;
}

/// Algorithm 1 for one body. @return false if the search is invalid
bool Propagation::pushNeighbours(const Open& open, const Candidate& candidate, PushGraph& graph) {
    std::size_t straightest = stack_.size();
    double furthest = 0;
    const std::span<const PushLink> links = graph.linksOf(open.body);
    for (std::uint32_t i = 0; i < links.size(); ++i) {
        const PushLink& link = links[i];
        const Push push = pushThrough(link, open.share, displacement_);
        if (!push.happens) continue;
        if (link.neighbour_fixed || link.neighbour == candidate.other) {
            graph.rememberWay(open.body, displacement_, i);
            return false;
        }
        if (!extend(link.neighbour, push.share, {open.body, i})) continue;
        if (push.share < open.share) {
            shorter_.push_back({push.share, link.neighbour});
            std::push_heap(shorter_.begin(), shorter_.end());
            continue;
        }
        if (push.towards > furthest) {
            furthest = push.towards;
            straightest = stack_.size();
        }
        stack_.push_back({push.share, link.neighbour});
    }
    // What lies straight ahead goes on first: it leads to whatever blocks the search in the fewest steps.
    if (straightest < stack_.size()) std::swap(stack_[straightest], stack_.back());
    return true;
}

}  // namespace cairn
