#include "validate/pile_suite.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <numeric>
#include <set>
#include <thread>
#include <utility>

#include "validate/case.h"
#include "validate/random.h"

namespace cairn::validation {

namespace {

constexpr std::size_t fewest_piles = 120;

/// What varies, and how many values it has: shape, sizes, number, depth, impact, steps, extent, friction, restitution.
constexpr std::array<std::size_t, 9> levels = {8, 2, 4, 4, 3, 4, 4, 3, 2};
constexpr std::size_t number_factor = 2, depth_factor = 3;
using Choice = std::array<std::size_t, levels.size()>;

constexpr std::array<std::size_t, 4> numbers = {200, 800, 3200, 8000};
constexpr std::array<int, 4> depths = {1, 30, 10, 3};

Pile pileOf(const Choice& row, std::uint64_t seed) {
    return {.shape = static_cast<PileShape>(row[0]),
            .graded = row[1] != 0,
            .count = numbers.at(row[number_factor]),
            .depth = depths.at(row[depth_factor]),
            .impact = std::array{0.0, 10.0, 40.0}.at(row[4]),
            .step = std::array{1.0, 0.25, 0.5, 2.0}.at(row[5]),
            .extent = std::array{0.1, 1e-3, 1e-2, 10.0}.at(row[6]),
            .friction = std::array{0.2, 0.0, 0.8}.at(row[7]),
            .restitution = row[8] != 0 ? 0.5 : 0,
            .seed = seed};
}

/// A shaft one body wide has 200 of them.
bool isPossible(const Choice& row) {
    return depths.at(row[depth_factor]) != 1 || numbers.at(row[number_factor]) == 200;
}

std::size_t below(Random& random, std::size_t n) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
}

/// Large piles take most of the time: they are drawn seldom.
Choice anyRow(Random& random) {
    constexpr std::array<std::size_t, 8> often = {0, 0, 0, 0, 0, 1, 1, 2};
    Choice row{};
    do {
        for (std::size_t f = 0; f < row.size(); ++f) row[f] = below(random, levels[f]);
        row[number_factor] = often.at(below(random, often.size()));
    } while (!isPossible(row));
    return row;
}

/// Values of two factors: factor and value of the one, factor and value of the other.
using TwoChoices = std::array<std::size_t, 4>;

std::set<TwoChoices> allPairs() {
    std::set<TwoChoices> pairs;
    for (std::size_t f = 0; f < levels.size(); ++f) {
        for (std::size_t h = f + 1; h < levels.size(); ++h) {
            for (std::size_t i = 0; i < levels[f]; ++i) {
                for (std::size_t k = 0; k < levels[h]; ++k) {
                    Choice row{};
                    row[depth_factor] = 1;
                    row[f] = i;
                    row[h] = k;
                    if (isPossible(row)) pairs.insert({f, i, h, k});
                }
            }
        }
    }
    return pairs;
}

void erasePairsOf(const Choice& row, std::set<TwoChoices>& pairs) {
    for (std::size_t f = 0; f < row.size(); ++f) {
        for (std::size_t h = f + 1; h < row.size(); ++h) pairs.erase({f, row[f], h, row[h]});
    }
}

std::size_t countPairsOf(const Choice& row, const std::set<TwoChoices>& pairs) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < row.size(); ++f) {
        for (std::size_t h = f + 1; h < row.size(); ++h) count += pairs.count({f, row[f], h, row[h]});
    }
    return count;
}

/// A row with the first pair that is left and, of many that have it, the one with the most others.
Choice bestRow(Random& random, const std::set<TwoChoices>& left) {
    constexpr int tries = 200;
    const TwoChoices& first = *left.begin();
    Choice best{};
    std::size_t most = 0;
    for (int i = 0; i < tries || most == 0; ++i) {
        Choice row = anyRow(random);
        row[first[0]] = first[1];
        row[first[2]] = first[3];
        if (!isPossible(row)) continue;
        const std::size_t count = countPairsOf(row, left);
        if (count <= most) continue;
        most = count;
        best = row;
    }
    return best;
}

}  // namespace

std::vector<Pile> pileSuite() {
    Random random(1);
    std::vector<Pile> piles;
    std::set<TwoChoices> left = allPairs();
    while (!left.empty() || piles.size() < fewest_piles) {
        const Choice row = left.empty() ? anyRow(random) : bestRow(random, left);
        erasePairsOf(row, left);
        piles.push_back(pileOf(row, piles.size() + 1));
    }
    return piles;
}

std::vector<Pile> quickPiles() {
    std::vector<Pile> piles = pileSuite();
    // Without friction few fall asleep, so such piles take all of their time: a deep one for minutes.
    const auto isLong = [](const Pile& p) { return p.friction == 0 && p.depth != 3; };
    // One that rolls out alone on the floor takes 1.5·v·r/(0.01·d·|g|), longer than a pile may: chance.
    const auto rollsOut = [](const Pile& p) { return p.isRound() && p.depth == 3 && (p.graded || p.friction > 0); };
    std::erase_if(piles, [&](const Pile& p) { return p.count > numbers.front() || isLong(p) || rollsOut(p); });
    piles.resize(std::min<std::size_t>(piles.size(), 24));
    return piles;
}

std::vector<Pile> partOf(const std::vector<Pile>& piles, std::size_t part, std::size_t parts) {
    if (part < 1 || part > parts) {
        throw InputError(fmt::format("part {}/{}; the first number is from 1 to the second", part, parts));
    }
    std::vector<Pile> some;
    for (std::size_t i = part - 1; i < piles.size(); i += parts) some.push_back(piles[i]);
    return some;
}

void runPiles(const std::vector<Pile>& piles, std::size_t threads, const std::function<void()>& alive,
              const std::function<void(std::size_t, const PileResult&)>& done) {
    std::vector<std::size_t> order(piles.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return piles[i].count; });
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> failed = false;
    std::mutex ending;
    std::exception_ptr failure;
    const auto goOn = [&](const World&) {
        if (failed) throw Interrupted{};
        alive();
    };
    const auto work = [&] {
        std::unique_lock lock(ending, std::defer_lock);
        try {
            for (std::size_t i = next++; i < order.size() && !failed; i = next++) {
                const PileResult result = runPile(
                    piles[order[i]], [](Settings&) {}, goOn);
                lock.lock();
                if (failed) return;
                done(order[i], result);
                lock.unlock();
            }
        } catch (...) {
            if (!lock.owns_lock()) lock.lock();
            if (!failed.exchange(true)) failure = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < std::min(threads, piles.size()); ++i) others.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

std::vector<std::string> missedBy(const Pile& pile, const PileResult& result) {
    std::vector<std::string> missed;
    const auto require = [&](bool holds, const char* what) {
        if (!holds) missed.emplace_back(what);
    };
    require(result.gain <= 1e-3, "gain");
    if (pile.friction > 0) {
        require(result.rest_time >= 0 && result.rest_time <= result.allowed_time, "rest");
    } else {
        require(result.motion <= 1e-3, "motion");
    }
    require(result.lost == 0, "lost");
    require(result.rest_overlap <= 0.02, "overlap at rest");
    require(result.fall_overlap <= (result.way > 1 ? 0.2 : 0.1), "overlap in the fall");
    return missed;
}

std::string lineOf(const Pile& pile, const PileResult& result) {
    const std::vector<std::string> missed = missedBy(pile, result);
    return fmt::format(
        "{:<50} gain {:.1e}  rest {:.3g} of {:.3g} s  asleep {:.3f}  lost {}  overlap {:.4f}, falling {:.3f}  {:.2f} "
        "ms  {:.0f} visits  {}",
        nameOf(pile), result.gain, result.rest_time, result.allowed_time, result.asleep, result.lost,
        result.rest_overlap, result.fall_overlap, result.ms, result.visits,
        missed.empty() ? "met" : fmt::format("missed: {}", fmt::join(missed, ", ")));
}

nlohmann::ordered_json rowOf(const Pile& pile, const PileResult& result) {
    return {{"name", nameOf(pile)},
            {"shape", nameOf(pile.shape)},
            {"graded", pile.graded},
            {"count", pile.count},
            {"depth", pile.depth},
            {"impact", pile.impact},
            {"step", pile.step},
            {"extent", pile.extent},
            {"friction", pile.friction},
            {"restitution", pile.restitution},
            {"seed", pile.seed},
            {"gain", result.gain},
            {"rest_seconds", result.rest_time},
            {"allowed_seconds", result.allowed_time},
            {"asleep", result.asleep},
            {"motion", result.motion},
            {"lost", result.lost},
            {"rest_overlap", result.rest_overlap},
            {"fall_overlap", result.fall_overlap},
            {"ms", result.ms},
            {"worst_ms", result.peak_ms},
            {"visits", result.visits},
            {"ns_per_visit", result.ns_per_visit},
            {"steps", result.steps},
            {"missed", missedBy(pile, result)}};
}

}  // namespace cairn::validation
