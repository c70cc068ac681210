#include "sharing/realms.h"

#include <algorithm>
#include <cmath>

namespace cairn {

namespace {

/// Boxes go farther where nobody is by this part of their largest extent, at least.
constexpr double part_ahead = 0.25;

bool isEmpty(const Bounds& bounds) {
    return !(bounds.lower.x() <= bounds.upper.x());
}

/// How two boxes lie beside each other.
struct Gap {
    int axis;       ///< across which they are farthest apart
    double width;   ///< there; below 0 = they overlap [m]
    bool is_after;  ///< the second comes after the first
};

Gap gapOf(const Bounds& one, const Bounds& other) {
    Gap widest{0, -std::numeric_limits<double>::infinity(), true};
    for (int axis = 0; axis < 3; ++axis) {
        const double after = other.lower[axis] - one.upper[axis];
        const double before = one.lower[axis] - other.upper[axis];
        if (std::max(after, before) > widest.width) widest = {axis, std::max(after, before), after >= before};
    }
    return widest;
}

/// How much farther a box goes on each side [m].
struct Margins {
    Vec3 below, above;
};

/// Two boxes meet in the middle between them; where they overlap they go only little farther towards each other.
void limit(Margins& one, Margins& other, const Gap& gap, double beside) {
    const double half = gap.width < 0 ? beside : gap.width / 2;
    double& first = gap.is_after ? one.above[gap.axis] : one.below[gap.axis];
    double& second = gap.is_after ? other.below[gap.axis] : other.above[gap.axis];
    first = std::min(first, half);
    second = std::min(second, half);
}

/// Takes the part away that another box has, on one side.
void cutOff(Bounds& core, const Bounds& other) {
    if (!core.overlaps(other)) return;
    const Gap gap = gapOf(core, other);
    // A place at the border would be in both.
    constexpr double far = std::numeric_limits<double>::infinity();
    if (gap.is_after) {
        core.upper[gap.axis] = std::nextafter(other.lower[gap.axis], -far);
    } else {
        core.lower[gap.axis] = std::nextafter(other.upper[gap.axis], far);
    }
}

}  // namespace

Realms::Realms(std::span<const Reach> reach, std::size_t own, double ahead) {
    std::vector<Margins> margins;
    for (const auto& [box, beside] : reach) {
        all_.push_back(box);
        const double farther = isEmpty(box) ? 0 : ahead + part_ahead * (box.upper - box.lower).maxCoeff();
        margins.push_back({Vec3::Constant(farther), Vec3::Constant(farther)});
    }
    for (std::size_t r = 0; r < reach.size(); ++r) {
        for (std::size_t s = r + 1; s < reach.size(); ++s) {
            const auto& [box, beside] = reach[r];
            const auto& [other, other_beside] = reach[s];
            if (isEmpty(box) || isEmpty(other)) continue;
            limit(margins[r], margins[s], gapOf(box, other), std::max(beside, other_beside));
        }
    }
    for (std::size_t r = 0; r < reach.size(); ++r) {
        all_[r].lower -= margins[r].below;
        all_[r].upper += margins[r].above;
    }
    own_ = all_[own];
    core_ = own_;
    for (std::size_t r = 0; r < reach.size(); ++r) {
        if (r == own || isEmpty(reach[r].box) || !own_.overlaps(all_[r])) continue;
        beside_.push_back(all_[r]);
        cutOff(core_, all_[r]);
    }
}

bool Realms::isFree(const Bounds& place) const {
    return own_.contains(place) && !reachesOthers(place);
}

bool Realms::reachesOthers(const Bounds& place) const {
    return std::ranges::any_of(beside_, [&](const Bounds& box) { return box.overlaps(place); });
}

}  // namespace cairn
