#include "broad_phase/grid_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace cairn {

namespace {

constexpr int mantissa_bits = 52;
constexpr std::uint64_t mantissa_mask = (std::uint64_t{1} << mantissa_bits) - 1;

/// Levels with at most this many bodies are not worth a lookup by all finer bodies: one lookup visits about 8 cells.
constexpr std::uint32_t sparse_level = 8;

/// Edges are this much larger than the body, which covers the rounding of cell coordinates: a coordinate x/edge is at
/// most 2^40 (see below), hence off by at most 2^-12.
constexpr double edge_slack = 1.0 + 0x1p-10;
/// An edge is at least this part of the body's distance from the origin, so that cell coordinates stay far within 64
/// bit and their rounding stays small. (1 mm at a distance of 10⁹ m.)
constexpr double finest_edge = 0x1p-40;
/// Edges in [m] stay in a range in which neither they nor their inverses overflow.
constexpr double smallest_edge = 0x1p-900;
constexpr double farthest_coordinate = 0x1p1000;

/// @return smallest cell edge for these bounds; infinite if they belong apart
double neededEdge(const Bounds& bounds) {
    const Vec3 extent = bounds.upper - bounds.lower;
    const double farthest = std::max(bounds.lower.cwiseAbs().maxCoeff(), bounds.upper.cwiseAbs().maxCoeff());
    // Written so that a NaN fails.
    const bool proper = extent.x() >= 0 && extent.y() >= 0 && extent.z() >= 0 && farthest < farthest_coordinate;
    if (!proper) return std::numeric_limits<double>::infinity();
    const double largest = std::max(std::max(extent.x(), extent.y()), extent.z());
    return std::max(std::max(largest, farthest * finest_edge) * edge_slack, smallest_edge);
}

std::uint64_t mantissaOf(double x) {
    return std::bit_cast<std::uint64_t>(x) & mantissa_mask;
}
std::size_t exponentOf(double x) {
    return std::bit_cast<std::uint64_t>(x) >> mantissa_bits;
}
double compose(std::size_t exponent, std::uint64_t mantissa) {
    return std::bit_cast<double>((static_cast<std::uint64_t>(exponent) << mantissa_bits) | mantissa);
}
/// In [1, 2).
double significand(std::uint64_t mantissa) {
    return compose(1023, mantissa);
}

/// Biased exponent of the smallest edge β·2^k ≥ size.
std::size_t edgeExponent(double size, std::uint64_t beta) {
    return exponentOf(size) + (mantissaOf(size) > beta ? 1 : 0);
}

}  // namespace

void GridLevels::choose(const BroadPhaseInput& input) {
    measure(input);
    const std::uint64_t beta = bestMantissa();

    count_.fill(0);
    for (const double size : size_) {
        if (size > 0 && std::isfinite(size)) ++count_[edgeExponent(size, beta)];
    }
    pickLevels(beta);

    level_.resize(size_.size());
    for (std::size_t i = 0; i < size_.size(); ++i) {
        if (size_[i] == 0) {
            level_[i] = hole;
        } else {
            level_[i] = std::isfinite(size_[i]) ? level_of_exponent_[edgeExponent(size_[i], beta)] : apart;
        }
    }
}

void GridLevels::measure(const BroadPhaseInput& input) {
    bins_.fill({});
    size_.resize(input.kind.size());
    for (std::size_t i = 0; i < size_.size(); ++i) {
        size_[i] = input.kind[i] == BodyKind::hole ? 0.0 : neededEdge(input.bounds[i]);
        if (size_[i] == 0 || !std::isfinite(size_[i])) continue;
        const std::uint64_t mantissa = mantissaOf(size_[i]);
        Bin& bin = bins_[mantissa >> (mantissa_bits - std::bit_width(bins - 1))];
        ++bin.count;
        bin.largest = std::max(bin.largest, mantissa);
    }
}

std::uint64_t GridLevels::bestMantissa() const {
    std::uint64_t best = 0;
    double lowest_cost = std::numeric_limits<double>::infinity();
    for (const Bin& candidate : bins_) {
        if (candidate.count == 0) continue;
        const double beta = significand(candidate.largest);
        // The number of tests of a body grows with the volume of its cell relative to its own.
        double cost = 0;
        for (const Bin& bin : bins_) {
            if (bin.count == 0) continue;
            const double ratio = (bin.largest <= candidate.largest ? beta : 2 * beta) / significand(bin.largest);
            cost += bin.count * ratio * ratio * ratio;
        }
        if (cost < lowest_cost) {
            lowest_cost = cost;
            best = candidate.largest;
        }
    }
    return best;
}

void GridLevels::pickLevels(std::uint64_t mantissa) {
    const auto isLevel = [&](std::size_t exponent, std::size_t found) {
        return count_[exponent] > sparse_level || (found == 0 && count_[exponent] > 0);
    };
    std::size_t found = 0;
    for (std::size_t exponent = 0; exponent < exponents; ++exponent) found += isLevel(exponent, found) ? 1 : 0;
    const std::size_t surplus = found > max_levels ? found - max_levels : 0;

    edge_inv_.clear();
    level_of_exponent_.fill(apart);
    found = 0;
    for (std::size_t exponent = 0; exponent < exponents; ++exponent) {
        if (!isLevel(exponent, found)) continue;
        level_of_exponent_[exponent] = static_cast<std::int8_t>(found > surplus ? found - surplus : 0);
        if (found >= surplus) edge_inv_.push_back(1.0 / compose(exponent, mantissa));
        ++found;
    }
}

}  // namespace cairn
