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

void LatestFirstQueue::reset(const ContactLists& lists, std::span<const double> delta, double threshold) {
    lists_ = &lists;
    delta_ = delta;
    threshold_ = threshold;
    links_.assign(delta.size(), {});
    latest_ = no_contact;
}

void LatestFirstQueue::refresh(std::uint32_t contact) {
    const bool closes = delta_[contact] < threshold_;
    if (closes == links_[contact].closes) return;
    if (closes) {
        append(contact);
    } else {
        remove(contact);
    }
}

void LatestFirstQueue::append(std::uint32_t contact) {
    links_[contact] = {latest_, no_contact, true};
    if (latest_ != no_contact) links_[latest_].later = contact;
    latest_ = contact;
}

void LatestFirstQueue::remove(std::uint32_t contact) {
    const auto [earlier, later, closes] = links_[contact];
    if (earlier != no_contact) links_[earlier].later = later;
    if (later != no_contact) {
        links_[later].earlier = earlier;
    } else {
        latest_ = earlier;
    }
    links_[contact] = {};
}

void ArrayQueue::reset(const ContactLists& lists, std::span<const double> delta, double threshold) {
    list_.reset(delta, threshold);
    lists_ = &lists;
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

/// One bit for each member that has the smallest value of all.
unsigned membersWith(const double* family, double smallest) {
    unsigned mask = 0;  // without branches, which could not be foreseen
    for (unsigned i = 0; i < TournamentQueue::fan_out; ++i) mask |= static_cast<unsigned>(family[i] <= smallest) << i;
    return mask;
}

}  // namespace

void TournamentQueue::reset(const ContactLists& lists, std::span<const double> delta, double threshold) {
    lists_ = &lists;
    delta_ = delta;
    threshold_ = threshold;
    noted_.assign(lists.bodies(), no_contact);
    level_begin_.clear();
    std::size_t total = 0;
    for (std::size_t nodes = lists.bodies();; nodes /= fan_out) {
        nodes = std::max<std::size_t>((nodes + fan_out - 1) / fan_out, 1) * fan_out;
        level_begin_.push_back(total);
        total += nodes;
        if (nodes == fan_out) break;
    }
    nodes_.assign(total, infinity);
    arranged_ = false;
}

void TournamentQueue::insert(std::uint32_t contact, std::uint32_t body) {
    const QueueEntry entry{delta_[contact], contact};
    if (!(entry < QueueEntry{nodes_[body], noted_[body]})) return;
    nodes_[body] = entry.delta;
    noted_[body] = contact;
    arranged_ = false;
}

void TournamentQueue::arrange() {
    for (std::size_t level = 0; level + 1 < level_begin_.size(); ++level) {
        const double* below = &nodes_[level_begin_[level]];
        double* nodes = &nodes_[level_begin_[level + 1]];
        const std::size_t families = (level_begin_[level + 1] - level_begin_[level]) / fan_out;
        for (std::size_t i = 0; i < families; ++i) nodes[i] = smallestOfFamily(below + i * fan_out);
    }
    smallest_ = smallestOfFamily(&nodes_[level_begin_.back()]);
    arranged_ = true;
}

void TournamentQueue::bodyChanged(std::uint32_t body) {
    double smallest = infinity;
    std::uint32_t contact = no_contact;
    for (const std::uint32_t i : (*lists_)[body]) {
        const double delta = delta_[i];
        contact = delta < smallest ? i : contact;
        smallest = delta < smallest ? delta : smallest;
    }
    noted_[body] = contact;
    carryUp(body, smallest);
}

/// Compares a note with the smallest of its neighbours, level by level. The neighbours are looked at without the note,
/// which is known last, so that a processor can be ahead with that.
void TournamentQueue::carryUp(std::uint32_t body, double smallest) {
    std::size_t node = body;
    for (const std::size_t begin : level_begin_) {
        double* family = &nodes_[begin + node / fan_out * fan_out];
        double& place = family[node % fan_out];
        place = infinity;
        const double neighbours = smallestOfFamily(family);
        place = smallest;
        smallest = smallest < neighbours ? smallest : neighbours;
        node /= fan_out;
    }
    smallest_ = smallest;
}

std::uint32_t TournamentQueue::next() {
    if (!arranged_) arrange();
    while (true) {
        if (!(smallest_ < threshold_)) return no_contact;
        const std::uint32_t contact = searchFamily(level_begin_.size() - 1, 0, smallest_);
        if (outdated_.empty()) return contact;
        for (const std::uint32_t body : outdated_) bodyChanged(body);
        outdated_.clear();
    }
}

/// Goes down to all notes of a value: usually the two bodies of one contact. @return the lowest contact that has it
std::uint32_t TournamentQueue::searchFamily(std::size_t level, std::size_t family, double smallest) {
    std::uint32_t lowest = no_contact;
    unsigned members = membersWith(&nodes_[level_begin_[level] + family * fan_out], smallest);
    for (; members != 0; members &= members - 1) {
        const std::size_t member = family * fan_out + static_cast<std::size_t>(std::countr_zero(members));
        if (level > 0) {
            lowest = std::min(lowest, searchFamily(level - 1, member, smallest));
        } else if (delta_[noted_[member]] == smallest) {
            lowest = std::min(lowest, noted_[member]);
        } else {
            outdated_.push_back(static_cast<std::uint32_t>(member));
        }
    }
    return lowest;
}

}  // namespace cairn
