/// @file A tree over bounds: finds those that a box or a ray meets without asking all.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/geometry.h"

namespace cairn {

/// A ray as trees ask for it: a half line that may be as thick as a box.
struct TreeRay {
    Vec3 origin;
    Vec3 direction;             ///< unit
    Vec3 thick = Vec3::Zero();  ///< half extents of what moves along it [m]

    /// One over a component of the direction, finite also where that is 0: then 0 times it is no NaN.
    static double inverse(double component) {
        constexpr double most = 1e300;
        return std::abs(component) * most > 1 ? 1 / component : std::copysign(most, component);
    }
};

/// A binary tree over items named by their index. What it finds depends on the bounds only, its order does not matter:
/// who needs one sorts what is found.
/// @source Wald 2007, On fast construction of SAH-based bounding volume hierarchies, doi:10.1109/RT.2007.4342588
class BoundsTree {
  public:
    /// Begins anew. @param bounds finite, of every item
    void build(std::span<const Bounds> bounds);
    /// Follows bounds that changed and keeps the shape of the tree. @pre as many as were built
    void refit(std::span<const Bounds> bounds);
    /// Whether refits left so much empty space in the tree that building it anew pays.
    bool isWorn() const { return cost_ > worn * built_cost_; }
    std::size_t size() const { return size_; }
    std::size_t bytes() const { return nodes_.capacity() * sizeof(Node) + items_.capacity() * sizeof(std::uint32_t); }

    /// Calls visit(item) for every item whose bounds overlap a box.
    template <class Visit>
    void forEachOverlapping(const Bounds& box, const Visit& visit) const;
    /// Calls visit(item) for every item whose bounds, and all those around it, meet a condition; false for bounds that
    /// hold nothing wanted. @param meets (bounds) → bool, may depend on what was visited
    template <class Meets, class Visit>
    void forEachWhere(const Meets& meets, const Visit& visit) const;
    /// Calls visit(item, other item) for every two items of this tree and another whose bounds, and all those around
    /// them, overlap. @param place bounds of this tree → bounds in the frame of the other one that enclose them
    template <class Place, class Visit>
    void forEachPair(const BoundsTree& other, const Place& place, const Visit& visit) const;
    /// Calls visit(item) for every item whose bounds a ray meets within its reach, roughly from near to far.
    /// @param reach [m]; may be lowered by visit: bounds beyond it are left out, those at it are not
    template <class Visit>
    void forEachAlong(const TreeRay& ray, const double& reach, const Visit& visit) const;

  private:
    /// How much the summed areas may grow by refits.
    static constexpr double worn = 1.5;
    static constexpr std::uint32_t leaf = std::uint32_t{1} << 31U;
    static constexpr std::uint32_t none = UINT32_MAX;
    /// Beyond this depth items are halved, so that no stack overflows.
    static constexpr int deepest_by_area = 48;
    static constexpr std::size_t most_waiting = 96;

    struct Node {
        std::array<Bounds, 2> bounds;
        std::array<std::uint32_t, 2> child{none, none};  ///< a node, or an item with the bit `leaf`
    };
    /// Items that become one child.
    struct Range {
        std::uint32_t begin, end;
        int depth;
    };
    struct Waiting {
        std::uint32_t child;
        double entry;
    };
    /// Two children of trees, with their bounds in the frame of the second.
    struct WaitingPair {
        std::uint32_t first, second;
        Bounds around_first, around_second;

        bool dividesFirst() const;
    };

    std::uint32_t buildRange(const Range& range, std::span<const Bounds> bounds);
    std::uint32_t split(const Range& range, std::span<const Bounds> bounds);
    void update(Node& node, std::size_t side, std::span<const Bounds> bounds);
    static double entryOf(const Bounds& bounds, const TreeRay& ray, const Vec3& inverse);

    std::vector<Node> nodes_;           ///< children after their parents
    std::vector<std::uint32_t> items_;  ///< in the order of the leaves
    std::size_t size_ = 0;
    double cost_ = 0;
    double built_cost_ = 0;
};

/// @return where a ray enters bounds; ∞ if it misses them
inline double BoundsTree::entryOf(const Bounds& bounds, const TreeRay& ray, const Vec3& inverse) {
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < 3; ++k) {
        const double lower = (bounds.lower[k] - ray.thick[k] - ray.origin[k]) * inverse[k];
        const double upper = (bounds.upper[k] + ray.thick[k] - ray.origin[k]) * inverse[k];
        enter = std::max(enter, std::min(lower, upper));
        leave = std::min(leave, std::max(lower, upper));
    }
    return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

template <class Visit>
void BoundsTree::forEachOverlapping(const Bounds& box, const Visit& visit) const {
    forEachWhere([&box](const Bounds& bounds) { return bounds.overlaps(box); }, visit);
}

template <class Meets, class Visit>
void BoundsTree::forEachWhere(const Meets& meets, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, most_waiting> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const Node& node = nodes_[waiting[--count]];
        for (std::size_t side = 0; side < 2; ++side) {
            const std::uint32_t child = node.child[side];
            if (child == none || !meets(node.bounds[side])) continue;
            if ((child & leaf) != 0) {
                visit(child & ~leaf);
            } else {
                waiting[count++] = child;
            }
        }
    }
}

/// The larger one is divided, as long as it is no item.
inline bool BoundsTree::WaitingPair::dividesFirst() const {
    if ((first & leaf) != 0) return false;
    const auto sizeOf = [](const Bounds& bounds) { return (bounds.upper - bounds.lower).sum(); };
    return (second & leaf) != 0 || sizeOf(around_first) >= sizeOf(around_second);
}

template <class Place, class Visit>
void BoundsTree::forEachPair(const BoundsTree& other, const Place& place, const Visit& visit) const {
    if (nodes_.empty() || other.nodes_.empty()) return;
    const Vec3 endless = Vec3::Constant(std::numeric_limits<double>::infinity());
    const Bounds everything{-endless, endless};
    std::array<WaitingPair, 2 * most_waiting> waiting;
    std::size_t count = 0;
    waiting[count++] = {0, 0, everything, everything};
    while (count > 0) {
        const WaitingPair pair = waiting[--count];
        if ((pair.first & pair.second & leaf) != 0) {
            visit(pair.first & ~leaf, pair.second & ~leaf);
            continue;
        }
        const bool first = pair.dividesFirst();
        const Node& node = first ? nodes_[pair.first] : other.nodes_[pair.second];
        for (std::size_t side = 0; side < 2; ++side) {
            const std::uint32_t child = node.child[side];
            if (child == none) continue;
            WaitingPair below = pair;
            (first ? below.first : below.second) = child;
            (first ? below.around_first : below.around_second) = first ? place(node.bounds[side]) : node.bounds[side];
            if (below.around_first.overlaps(below.around_second)) waiting[count++] = below;
        }
    }
}

template <class Visit>
void BoundsTree::forEachAlong(const TreeRay& ray, const double& reach, const Visit& visit) const {
    if (nodes_.empty()) return;
    const Vec3 inverse(TreeRay::inverse(ray.direction.x()), TreeRay::inverse(ray.direction.y()),
                       TreeRay::inverse(ray.direction.z()));
    std::array<Waiting, most_waiting> waiting;
    std::size_t count = 0;
    waiting[count++] = {0, 0};
    while (count > 0) {
        const Waiting next = waiting[--count];
        if (next.entry > reach) continue;
        if ((next.child & leaf) != 0) {
            visit(next.child & ~leaf);
            continue;
        }
        const Node& node = nodes_[next.child];
        const double first = entryOf(node.bounds[0], ray, inverse);
        const double second =
            node.child[1] == none ? std::numeric_limits<double>::infinity() : entryOf(node.bounds[1], ray, inverse);
        const std::size_t near = first <= second ? 0 : 1;
        const double far_entry = near == 0 ? second : first;
        const double near_entry = near == 0 ? first : second;
        // An infinite entry is a miss also where the reach is infinite.
        if (far_entry <= reach && far_entry < std::numeric_limits<double>::infinity()) {
            waiting[count++] = {node.child[1 - near], far_entry};
        }
        if (near_entry <= reach && near_entry < std::numeric_limits<double>::infinity()) {
            waiting[count++] = {node.child[near], near_entry};
        }
    }
}

}  // namespace cairn
