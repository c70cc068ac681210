/// The same input gives bit-identical states on any number of ranks, at every time step, whoever owns what.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "cairn/ranks.h"
#include "cairn/scene.h"
#include "golden/scene_names.h"
#include "golden/scenes.h"

namespace cairn {
namespace {

struct Division {
    std::string name;
    int ranks;
    Partition partition;
    int threads = 1;  ///< of each rank
};

using Kind = PartitionKind;

/// Between them all pairs of numbers of ranks, threads and cuts that differ in what can go wrong: those under which
/// everything is a border, and owners that change in every step.
const std::vector<Division> some_divisions{
    {"two by hash, changing", 2, {.kind = Kind::hash, .restless = true}},
    {"2x2x1", 4, {.kind = Kind::grid, .parts = {2, 2, 1}}},
    {"one", 1, {}},
    {"two along x", 2, {.kind = Kind::x}},
    {"three along y", 3, {.kind = Kind::y}},
    {"four along z", 4, {.kind = Kind::z}},
    {"three by hash", 3, {.kind = Kind::hash}},
    {"four boxes, changing", 4, {.restless = true}},
    {"three boxes, rebalanced", 3, {.rebalance_every = 7}},
    {"seven by hash, changing, two threads", 7, {.kind = Kind::hash, .restless = true}, 2},
    {"2x2x2, two threads", 8, {.kind = Kind::grid, .parts = {2, 2, 2}}, 2},
};

/// With CAIRN_ALL_RANKS in the environment, as `make ranks` has it: every number with every cut.
std::vector<Division> everyDivision() {
    std::vector<Division> all;
    for (const int ranks : {1, 2, 3, 4, 7, 8}) {
        for (const int threads : {1, 2}) {
            const std::vector<std::pair<const char*, Partition>> cuts{
                {"x", {.kind = Kind::x}},
                {"y", {.kind = Kind::y}},
                {"z", {.kind = Kind::z}},
                {"boxes, rebalanced", {.rebalance_every = 7}},
                {"hash, changing", {.kind = Kind::hash, .restless = true}},
                {"2x2x2", {.kind = Kind::grid, .parts = {2, 2, 2}}}};
            for (const auto& [cut, partition] : cuts) {
                if (partition.kind == Kind::grid && ranks != 8) continue;
                all.push_back({std::to_string(ranks) + " ranks of " + std::to_string(threads) + " threads: " + cut,
                               ranks, partition, threads});
            }
        }
    }
    return all;
}

const bool takes_all = std::getenv("CAIRN_ALL_RANKS") != nullptr;

/// With the slower settings fewer will do.
std::vector<Division> divisionsFor(golden::Kind kind) {
    using enum golden::Kind;
    if (takes_all) return kind == performance || kind == accuracy ? everyDivision() : some_divisions;
    if (kind == performance) return some_divisions;
    return {some_divisions[0], some_divisions[1]};
}

/// With CAIRN_LATE_MESSAGES in the environment messages are late by chance.
const bool are_late = std::getenv("CAIRN_LATE_MESSAGES") != nullptr;
const MessageDelay delay = are_late ? MessageDelay{.jitter = 1e-5} : MessageDelay{};

/// What a run on one rank comes to.
struct Expected {
    std::vector<std::uint64_t> hashes;  ///< after every step
    std::vector<Statistics> steps;      ///< likewise
    std::vector<ContactInfo> contacts;  ///< of the last step
};

Expected runAlone(const golden::GoldenScene& scene, golden::Kind kind) {
    golden::GoldenRun run(scene, kind, 1);
    Expected expected;
    while (run.world().stepCount() < scene.hashSteps(kind).back()) {
        run.step();
        expected.hashes.push_back(run.world().stateHash());
        expected.steps.push_back(run.world().statistics());
    }
    expected.contacts = run.world().contacts();
    return expected;
}

void expectEqual(const Statistics& one, const Statistics& other) {
    EXPECT_EQ(one.contacts, other.contacts);
    EXPECT_EQ(one.penetrating_contacts, other.penetrating_contacts);
    EXPECT_EQ(one.corrected_contacts, other.corrected_contacts);
    EXPECT_EQ(one.displaced_bodies, other.displaced_bodies);
    EXPECT_EQ(one.global_iterations, other.global_iterations);
    EXPECT_EQ(one.batches, other.batches);
    EXPECT_EQ(one.largest_batch, other.largest_batch);
    EXPECT_EQ(one.asleep, other.asleep);
    EXPECT_EQ(one.woken, other.woken);
    EXPECT_EQ(one.largest_overlap, other.largest_overlap);
}

void expectEqual(const std::vector<ContactInfo>& some, const std::vector<ContactInfo>& others) {
    ASSERT_EQ(some.size(), others.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
        EXPECT_EQ(some[i].a, others[i].a);
        EXPECT_EQ(some[i].b, others[i].b);
        EXPECT_EQ(some[i].point, others[i].point);
        EXPECT_EQ(some[i].impulse, others[i].impulse);
        EXPECT_EQ(some[i].batch, others[i].batch);
    }
}

class RanksAgree : public testing::TestWithParam<golden::SceneAndKind> {};

TEST_P(RanksAgree, StatesAreThoseOfOneRankAtEveryStep) {
    const std::string_view name = std::get<0>(GetParam());
    const golden::Kind kind = std::get<1>(GetParam());
    const golden::GoldenScene& scene = golden::goldenScene(name);
    const Expected expected = runAlone(scene, kind);
    for (const Division& division : divisionsFor(kind)) {
        SCOPED_TRACE(division.name);
        runRanks(
            division.ranks,
            [&](Ranks& ranks) {
                golden::GoldenRun run(scene, kind, division.threads);
                run.share(ranks, division.partition);
                for (std::size_t i = 0; i < expected.hashes.size(); ++i) {
                    SCOPED_TRACE("time step " + std::to_string(i + 1));
                    run.step();
                    ASSERT_TRUE(run.world().isDivided());
                    ASSERT_EQ(sumOverRanks(ranks, run.world().stateHash()), expected.hashes[i]);
                    expectEqual(sumOverRanks(ranks, run.world().statistics()), expected.steps[i]);
                    if (testing::Test::HasFailure()) return;
                }
                run.gather();
                EXPECT_FALSE(run.world().isDivided());
                EXPECT_EQ(run.world().stateHash(), expected.hashes.back());
                EXPECT_TRUE(run.world().faults().empty());
                expectEqual(run.world().statistics(), expected.steps.back());
                EXPECT_EQ(run.world().statistics().mean_overlap, expected.steps.back().mean_overlap);
                expectEqual(run.world().contacts(), expected.contacts);
            },
            delay);
        if (HasFatalFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RanksAgree, testing::ValuesIn(golden::everySceneWithEveryKind()),
                         golden::nameOfSceneAndKind);

}  // namespace
}  // namespace cairn
