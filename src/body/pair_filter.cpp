#include "body/pair_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace cairn {

namespace {

bool isBefore(const PairException& x, const PairException& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
}

}  // namespace

GroupId PairFilter::addGroup(const std::string& name) {
    if (name.empty()) throw InputError("a group has no name; give it one");
    if (std::ranges::find(names_, name) != names_.end()) {
        throw InputError(fmt::format("the group '{}' exists already; use another name", name));
    }
    if (names_.size() == most_groups) {
        throw InputError(fmt::format("the group '{}' is one too many; a world has at most {}", name, most_groups));
    }
    names_.push_back(name);
    return static_cast<GroupId>(names_.size() - 1);
}

std::size_t PairFilter::indexOf(GroupId group) const {
    const auto index = static_cast<std::size_t>(group);
    if (index < names_.size()) return index;
    throw InputError(fmt::format("group {} is unknown; the world has {} groups", index, names_.size()));
}

void PairFilter::setGroups(GroupId a, GroupId b, Touch touch) {
    const std::size_t i = indexOf(a);
    const std::size_t k = indexOf(b);
    for (const auto& [one, other] : {std::pair(i, k), std::pair(k, i)}) {
        const std::uint64_t bit = std::uint64_t{1} << other;
        apart_[one] = touch == Touch::never ? apart_[one] | bit : apart_[one] & ~bit;
    }
}

Touch PairFilter::ofGroups(GroupId a, GroupId b) const {
    const std::uint64_t bit = std::uint64_t{1} << indexOf(b);
    return (apart_[indexOf(a)] & bit) != 0 ? Touch::never : Touch::always;
}

std::uint64_t PairFilter::maskOf(std::span<const GroupId> groups) const {
    std::uint64_t mask = 0;
    for (const GroupId group : groups) mask |= std::uint64_t{1} << indexOf(group);
    return mask;
}

void PairFilter::setPair(BodyIndex a, BodyIndex b, std::optional<Touch> touch) {
    const PairException exception{std::min(a, b), std::max(a, b), touch.value_or(Touch::always)};
    const auto place = std::ranges::lower_bound(exceptions_, exception, isBefore);
    const bool exists = place != exceptions_.end() && !isBefore(exception, *place);
    if (!touch) {
        if (exists) exceptions_.erase(place);
    } else if (exists) {
        place->touch = *touch;
    } else {
        exceptions_.insert(place, exception);
    }
}

std::optional<Touch> PairFilter::ofPair(BodyIndex a, BodyIndex b) const {
    const PairException sought{std::min(a, b), std::max(a, b), Touch::always};
    const auto place = std::ranges::lower_bound(exceptions_, sought, isBefore);
    if (place == exceptions_.end() || isBefore(sought, *place)) return {};
    return place->touch;
}

void PairFilter::rename(const SlotMove& move) {
    for (PairException& exception : exceptions_) {
        exception.a = move(exception.a);
        exception.b = move(exception.b);
    }
}

void PairFilter::forget(BodyIndex body) {
    std::erase_if(exceptions_, [&](const PairException& e) { return e.a == body || e.b == body; });
}

}  // namespace cairn
