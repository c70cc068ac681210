/// Small batches that share the lanes of vectors: whoever is beside them, each is solved as if it were alone.
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "resolution/batch_fixture.h"

namespace cairn {
namespace {

using test::Pile;

constexpr double fallen = 10.0 / 240;  // speed that gravity gives in a time step [m/s]

/// Towers of boxes of 1 m beside each other, on body 0.
struct Towers {
    Pile pile;
    std::vector<std::vector<BodyIndex>> bodies;
    std::vector<std::vector<std::uint32_t>> contacts;

    /// @param restless sends its boxes in all directions, else they only fall
    void add(std::size_t boxes, bool restless, test::Random& random) {
        bodies.emplace_back();
        contacts.emplace_back();
        const double aside = 3.0 * static_cast<double>(bodies.size());
        for (std::size_t i = 0; i < boxes; ++i) {
            const auto height = static_cast<double>(i);
            const BodyIndex box = pile.addBox(Vec3(aside, 0, height + 0.5), random.uniform(0.5, 2), Vec3::Ones());
            pile.v[box] = Vec3(0, 0, -fallen) + (restless ? random.vector(0.5) : Vec3(Vec3::Zero()));
            const BodyIndex under = i == 0 ? 0 : box - 1;
            bodies.back().push_back(box);
            for (std::size_t corner = 0; corner < 1 + (i + boxes) % 4; ++corner) {
                contacts.back().push_back(static_cast<std::uint32_t>(pile.contacts.size()));
                const Vec3 point(aside + (corner % 2 == 0 ? -0.5 : 0.5), corner < 2 ? -0.5 : 0.5, height);
                pile.touch(under, box, point, -Vec3::UnitZ(), 0, {0.5, restless ? 0.3 : 0.5});
            }
        }
    }

    /// @param some which towers
    ResolutionCounts resolve(const std::vector<std::size_t>& some, int threads) {
        std::vector<BatchView> batches;
        for (const std::size_t n : some) batches.push_back({bodies[n], contacts[n], {}});
        ResolutionSettings settings = test::exactSettings();
        settings.resolution = ResolutionKind::accelerated_sweeps;
        settings.iterations = 60;
        settings.tolerance = 0.01;
        BodyState state = pile.state();
        state.time_step = 1.0 / 240;
        state.damped_fall = Vec3(0, 0, -fallen);
        const Executor executor(threads);
        return makeResolution(settings.resolution)->resolve({batches, pile.contacts, state, settings, executor});
    }
};

/// @param heights of the towers, of which every third is restless
Towers towersOf(const std::vector<std::size_t>& heights) {
    Towers towers;
    towers.pile.addFixed();
    test::Random random(5);
    for (std::size_t n = 0; n < heights.size(); ++n) towers.add(heights[n], n % 3 == 0, random);
    return towers;
}

void expectAsAlone(const std::vector<std::size_t>& heights) {
    Towers alone = towersOf(heights);
    std::int64_t visits = 0;
    for (std::size_t n = 0; n < heights.size(); ++n) visits += alone.resolve({n}, 1).global_iterations;
    std::vector<std::size_t> all(heights.size());
    std::iota(all.begin(), all.end(), 0U);
    for (const int threads : {1, 2, 4}) {
        Towers together = towersOf(heights);
        EXPECT_EQ(together.resolve(all, threads).global_iterations, visits) << threads;
        for (std::size_t i = 0; i < alone.pile.v.size(); ++i) {
            ASSERT_EQ(together.pile.v[i], alone.pile.v[i]) << threads << " threads, body " << i;
            ASSERT_EQ(together.pile.w[i], alone.pile.w[i]) << threads << " threads, body " << i;
        }
        for (std::size_t i = 0; i < alone.pile.contacts.size(); ++i) {
            ASSERT_EQ(together.pile.contacts[i].impulse, alone.pile.contacts[i].impulse) << threads << " threads";
        }
    }
}

TEST(Relay, SolvesUnequalBatchesAsEachAlone) {
    std::vector<std::size_t> heights;
    for (std::size_t n = 0; n < 90; ++n) heights.push_back(1 + n * n % 23);
    expectAsAlone(heights);
}

TEST(Relay, SolvesFewAndLongChainsAsEachAlone) {
    expectAsAlone({400});
    expectAsAlone({400, 300});
    expectAsAlone({500, 1, 350, 2, 1});
}

}  // namespace
}  // namespace cairn
