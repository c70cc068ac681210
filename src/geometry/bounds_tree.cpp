#include "geometry/bounds_tree.h"

#include <algorithm>
#include <numeric>

namespace cairn {

namespace {

/// Places at which a range may be split.
constexpr std::size_t bin_count = 16;

Bounds nothing() {
    Bounds bounds;
    std::swap(bounds.lower, bounds.upper);
    return bounds;
}

void include(Bounds& bounds, const Bounds& other) {
    bounds.lower = bounds.lower.cwiseMin(other.lower);
    bounds.upper = bounds.upper.cwiseMax(other.upper);
}

double areaOf(const Bounds& bounds) {
    const Vec3 size = (bounds.upper - bounds.lower).cwiseMax(0.0);
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

/// Twice the middle of bounds: only comparisons of middles matter.
double middleOf(const Bounds& bounds, Eigen::Index axis) {
    return bounds.lower[axis] + bounds.upper[axis];
}

struct Bin {
    Bounds bounds = nothing();
    std::size_t count = 0;
};

/// The bins left of the best place to split, or 0 if there is none.
std::size_t bestSplit(const std::array<Bin, bin_count>& bins) {
    std::array<double, bin_count> right_cost{};
    Bin right;
    for (std::size_t i = bin_count - 1; i > 0; --i) {
        include(right.bounds, bins[i].bounds);
        right.count += bins[i].count;
        right_cost[i] = areaOf(right.bounds) * static_cast<double>(right.count);
    }
    Bin left;
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    const std::size_t total = right.count + bins[0].count;
    for (std::size_t i = 1; i < bin_count; ++i) {
        include(left.bounds, bins[i - 1].bounds);
        left.count += bins[i - 1].count;
        if (left.count == 0 || left.count == total) continue;
        const double cost = areaOf(left.bounds) * static_cast<double>(left.count) + right_cost[i];
        if (!(cost < least)) continue;
        least = cost;
        best = i;
    }
    return best;
}

}  // namespace

void BoundsTree::build(std::span<const Bounds> bounds) {
    size_ = bounds.size();
    nodes_.clear();
    cost_ = 0;
    items_.resize(size_);
    std::iota(items_.begin(), items_.end(), std::uint32_t{0});
    if (size_ == 0) return;
    nodes_.reserve(size_);
    if (size_ == 1) {
        nodes_.emplace_back().child[0] = leaf;
    } else {
        buildRange({0, static_cast<std::uint32_t>(size_), 0}, bounds);
    }
    refit(bounds);
    built_cost_ = cost_;
}

std::uint32_t BoundsTree::buildRange(const Range& range, std::span<const Bounds> bounds) {
    if (range.end - range.begin == 1) return items_[range.begin] | leaf;
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    const std::uint32_t middle = split(range, bounds);
    const std::uint32_t first = buildRange({range.begin, middle, range.depth + 1}, bounds);
    const std::uint32_t second = buildRange({middle, range.end, range.depth + 1}, bounds);
    nodes_[index].child = {first, second};
    return index;
}

/// Orders the items of a range so that it can be cut. @return where
std::uint32_t BoundsTree::split(const Range& range, std::span<const Bounds> bounds) {
    const auto begin = items_.begin() + range.begin;
    const auto end = items_.begin() + range.end;
    Bounds middles = nothing();
    for (auto item = begin; item != end; ++item) {
        const Vec3 middle = bounds[*item].lower + bounds[*item].upper;
        include(middles, {middle, middle});
    }
    Eigen::Index axis = 0;
    const double extent = (middles.upper - middles.lower).maxCoeff(&axis);
    if (extent > 0 && range.depth < deepest_by_area) {
        const double scale = static_cast<double>(bin_count) / extent;
        const auto binOf = [&](std::uint32_t item) {
            const double place = (middleOf(bounds[item], axis) - middles.lower[axis]) * scale;
            return std::min(static_cast<std::size_t>(place), bin_count - 1);
        };
        std::array<Bin, bin_count> bins;
        for (auto item = begin; item != end; ++item) {
            Bin& bin = bins[binOf(*item)];
            include(bin.bounds, bounds[*item]);
            ++bin.count;
        }
        if (const std::size_t best = bestSplit(bins); best > 0) {
            const auto cut = std::partition(begin, end, [&](std::uint32_t item) { return binOf(item) < best; });
            return static_cast<std::uint32_t>(cut - items_.begin());
        }
    }
    const auto half = begin + (end - begin) / 2;
    std::nth_element(begin, half, end, [&](std::uint32_t x, std::uint32_t y) {
        const double at_x = middleOf(bounds[x], axis);
        const double at_y = middleOf(bounds[y], axis);
        return at_x < at_y || (at_x == at_y && x < y);
    });
    return static_cast<std::uint32_t>(half - items_.begin());
}

void BoundsTree::update(Node& node, std::size_t side, std::span<const Bounds> bounds) {
    const std::uint32_t child = node.child[side];
    if (child == none) return;
    Bounds& own = node.bounds[side];
    if ((child & leaf) != 0) {
        own = bounds[child & ~leaf];
    } else {
        const Node& below = nodes_[child];
        own = below.bounds[0];
        include(own, below.bounds[1]);
    }
    cost_ += areaOf(own);
}

void BoundsTree::refit(std::span<const Bounds> bounds) {
    cost_ = 0;
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        update(nodes_[i], 0, bounds);
        update(nodes_[i], 1, bounds);
    }
}

}  // namespace cairn
