#include "resolution/queue.h"

#include <algorithm>

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

void TournamentQueue::reset(std::span<const double> delta, double threshold) {
    delta_ = delta;
    threshold_ = threshold;
    level_begin_.assign(1, 0);
    std::size_t below = delta.size();
    do {
        below = std::max<std::size_t>(1, (below + fan_out - 1) / fan_out);
        level_begin_.push_back(level_begin_.back() + below);
    } while (below > 1);
    nodes_.assign(level_begin_.back(), QueueEntry{});
}

QueueEntry TournamentQueue::winnerOfContacts(std::size_t node) const {
    const std::size_t begin = node * fan_out;
    const std::size_t end = std::min(begin + fan_out, delta_.size());
    std::size_t winner = no_contact;
    double smallest = threshold_;
    for (std::size_t i = begin; i < end; ++i) {
        if (delta_[i] < smallest) {
            smallest = delta_[i];
            winner = i;
        }
    }
    return winner == no_contact ? QueueEntry{} : QueueEntry{smallest, static_cast<std::uint32_t>(winner)};
}

void TournamentQueue::replay(const QueueEntry& entry, std::uint32_t contact) {
    std::size_t index = contact / fan_out;
    for (std::size_t level = 1; level + 1 < level_begin_.size(); ++level) {
        const std::size_t below_begin = level_begin_[level - 1];
        const std::size_t below_end = level_begin_[level];
        index /= fan_out;
        QueueEntry& node = nodes_[below_end + index];
        if (entry < node) {
            node = entry;
        } else if (node.contact == contact) {
            const std::size_t begin = below_begin + index * fan_out;
            const std::size_t end = std::min(begin + fan_out, below_end);
            node = nodes_[begin];
            for (std::size_t i = begin + 1; i < end; ++i) node = std::min(node, nodes_[i]);
        } else {
            return;
        }
    }
}

}  // namespace cairn
