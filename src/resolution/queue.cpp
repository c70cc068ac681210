#include "resolution/queue.h"

#include <algorithm>
#include <bit>

namespace cairn {

void ClosingList::reset(std::span<const double> delta, double threshold) {
    delta_ = delta;
    threshold_ = threshold;
    entries_.clear();
    entries_.reserve(delta.size());
    place_.assign(delta.size(), no_contact);
}

void ArrayQueue::reset(std::span<const double> delta, double threshold) {
    list_.reset(delta, threshold);
    delta_ = delta;
    updated_ = last_ = {};
}

std::uint32_t ArrayQueue::next() {
    // last_ came before everything else, so whatever was not refreshed since still comes after it. If the first of the
    // refreshed ones does not come after it either, nothing can come before that one. (At the start last_ is +∞ and
    // everything was refreshed.) The thesis compares δ alone; comparing the index, too, keeps ties exact.
    QueueEntry first = updated_;
    if (last_ < first) {
        for (const QueueEntry& entry : list_.entries()) first = std::min(first, entry);
    }
    last_ = first;
    updated_ = {};
    return first.contact;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Reads member by member: the members were just written one by one, and a processor cannot hand such writes on to a
/// wider read before they have reached the cache.
double smallestOfFamily(const double* family) {
    const auto lesser = [](double x, double y) { return x < y ? x : y; };
    return lesser(lesser(lesser(family[0], family[1]), lesser(family[2], family[3])),
                  lesser(lesser(family[4], family[5]), lesser(family[6], family[7])));
}

/// Index of the first member that has a value. @pre one has it
std::size_t firstWith(const double* family, double value) {
    unsigned mask = 0;  // without branches, which could not be foreseen
    for (unsigned i = 0; i < TournamentQueue::fan_out; ++i) mask |= static_cast<unsigned>(family[i] == value) << i;
    return static_cast<std::size_t>(std::countr_zero(mask));
}

}  // namespace

void TournamentQueue::reset(std::span<const double> delta, double threshold) {
    delta_ = delta;
    threshold_ = threshold;
    changed_.clear();
    level_begin_.clear();
    std::size_t total = 0;
    for (std::size_t nodes = delta.size() / fan_out;; nodes /= fan_out) {
        nodes = (nodes + fan_out - 1) / fan_out * fan_out;
        level_begin_.push_back(total);
        total += nodes;
        if (nodes <= fan_out) break;
    }
    nodes_.assign(total, infinity);
}

void TournamentQueue::refresh(std::span<const std::uint32_t> contacts) {
    std::size_t seen = SIZE_MAX;
    for (const std::uint32_t i : contacts) {
        const std::size_t node = i / fan_out;
        if (node == seen) continue;
        seen = node;
        const double smallest = smallestOfFamily(&delta_[node * fan_out]);
        const double value = smallest < threshold_ ? smallest : infinity;
        if (value == nodes_[node]) continue;
        nodes_[node] = value;
        changed_.push_back(static_cast<std::uint32_t>(node));
    }
}

void TournamentQueue::carryUp() {
    for (std::size_t level = 0; level + 1 < level_begin_.size(); ++level) {
        const double* below = &nodes_[level_begin_[level]];
        double* nodes = &nodes_[level_begin_[level + 1]];
        std::size_t kept = 0;
        std::size_t seen = SIZE_MAX;
        for (const std::uint32_t child : changed_) {
            const std::size_t node = child / fan_out;
            if (node == seen) continue;
            seen = node;
            const double value = smallestOfFamily(below + node * fan_out);
            if (value == nodes[node]) continue;
            nodes[node] = value;
            changed_[kept++] = static_cast<std::uint32_t>(node);
        }
        changed_.resize(kept);
    }
    changed_.clear();
}

std::uint32_t TournamentQueue::next() {
    carryUp();
    const double smallest = smallestOfFamily(&nodes_[level_begin_.back()]);
    if (smallest == infinity) return no_contact;
    std::size_t index = 0;
    for (std::size_t level = level_begin_.size(); level-- > 0;) {
        index = index * fan_out + firstWith(&nodes_[level_begin_[level] + index * fan_out], smallest);
    }
    return static_cast<std::uint32_t>(index * fan_out + firstWith(&delta_[index * fan_out], smallest));
}

}  // namespace cairn
