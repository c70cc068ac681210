/// Joins convex parts again that fit into one hull.
#include <algorithm>
#include <limits>

#include "geometry/convex_part.h"

namespace cairn {

namespace {

constexpr double no_hull = std::numeric_limits<double>::infinity();

/// By which part an estimate may be too large.
constexpr double rounding = 1e-9;

/// Parts whose bounds are farther apart than this part of their size are joined only where there are too many.
constexpr double near_part = 1e-3;

Bounds boundsOf(const ConvexPart& part) {
    Bounds bounds{part.corners.front(), part.corners.front()};
    for (const Vec3& c : part.corners) bounds = {bounds.lower.cwiseMin(c), bounds.upper.cwiseMax(c)};
    return bounds;
}

bool isNear(const Bounds& a, const Bounds& b) {
    const double size = std::max((a.upper - a.lower).maxCoeff(), (b.upper - b.lower).maxCoeff());
    return a.grown(near_part * size).overlaps(b);
}

/// What the joined part would be, without its solid.
ConvexPart joined(const ConvexPart& a, const ConvexPart& b) {
    ConvexPart both;
    both.corners = a.corners;
    both.corners.insert(both.corners.end(), b.corners.begin(), b.corners.end());
    both.volume = a.volume + b.volume;
    std::optional<HullData> hull = hullOf(both.corners);
    both.error = hull ? std::max(0.0, hull->mass.volume - both.volume) : no_hull;
    if (hull) both.corners = std::move(hull->corners);
    return both;
}

class Joiner {
  public:
    Joiner(std::vector<ConvexPart>& parts, double limit, std::size_t most_parts)
        : parts_(parts), limit_(limit), most_(most_parts) {}

    void join() {
        for (const ConvexPart& part : parts_) {
            error_ += part.error;
            bounds_.push_back(boundsOf(part));
        }
        fill();
        for (;;) {
            const auto [a, b, cost, is_exact] = cheapest();
            if (!is_exact && cost < no_hull) {
                cost_[a][b] = {costOf(a, b), true};
                continue;
            }
            if (!(cost < no_hull)) {
                if (parts_.size() <= most_ || all_pairs_) return;
                all_pairs_ = true;
                fill();
                continue;
            }
            if (parts_.size() <= most_ && error_ + cost > limit_) return;
            merge(a, b, cost);
        }
    }

  private:
    struct Pair {
        std::size_t a, b;
        double cost;
        bool is_exact;
    };
    /// What joining adds, or no more than that.
    struct Cost {
        double value = no_hull;
        bool is_exact = false;
    };

    double costOf(std::size_t a, std::size_t b) const {
        return joined(parts_[a], parts_[b]).error - parts_[a].error - parts_[b].error;
    }

    /// A bound is enough for most pairs: only the cheapest is looked at.
    Cost boundOf(std::size_t a, std::size_t b) const {
        if (!all_pairs_ && !isNear(bounds_[a], bounds_[b])) return {};
        std::vector<Vec3> corners = parts_[a].corners;
        corners.insert(corners.end(), parts_[b].corners.begin(), parts_[b].corners.end());
        const double error = volumeWithin(farthestOf(std::move(corners))) - parts_[a].volume - parts_[b].volume;
        return {(1 - rounding) * std::max(0.0, error) - parts_[a].error - parts_[b].error, false};
    }

    void fill() {
        cost_.assign(parts_.size(), {});
        for (std::size_t a = 0; a < parts_.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) cost_[a].push_back(boundOf(a, b));
        }
    }

    /// The first of the cheapest pairs.
    Pair cheapest() const {
        Pair best{0, 0, no_hull, false};
        for (std::size_t a = 0; a < parts_.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                const auto [value, is_exact] = cost_[a][b];
                if (value < best.cost) best = {a, b, value, is_exact};
            }
        }
        return best;
    }

    /// @pre b < a
    void merge(std::size_t a, std::size_t b, double cost) {
        error_ += cost;
        parts_[b] = joined(parts_[a], parts_[b]);
        bounds_[b] = boundsOf(parts_[b]);
        const auto at = static_cast<std::ptrdiff_t>(a);
        parts_.erase(parts_.begin() + at);
        bounds_.erase(bounds_.begin() + at);
        cost_.erase(cost_.begin() + at);
        for (std::size_t i = a; i < cost_.size(); ++i) cost_[i].erase(cost_[i].begin() + at);
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (i != b) cost_[std::max(i, b)][std::min(i, b)] = boundOf(std::max(i, b), std::min(i, b));
        }
    }

    std::vector<ConvexPart>& parts_;
    double limit_;
    std::size_t most_;
    double error_ = 0;
    bool all_pairs_ = false;
    std::vector<Bounds> bounds_;
    std::vector<std::vector<Cost>> cost_;  ///< of each part with those before it [m³]
};

}  // namespace

void joinParts(std::vector<ConvexPart>& parts, double limit, std::size_t most_parts) {
    Joiner(parts, limit, most_parts).join();
}

}  // namespace cairn
