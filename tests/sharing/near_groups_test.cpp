#include "sharing/near_groups.h"

#include <gtest/gtest.h>

#include "broad_phase/hash_grids.h"

namespace cairn {
namespace {

/// Bodies of a row, in boxes with their numbers.
struct Row {
    std::vector<CoveredBody> bodies;  ///< of this rank
    std::vector<CoveredBody> others;
    std::vector<Vec3> position;
    std::vector<BodyPair> joined;
    HashGrids search;
    Executor executor;
    NearGroups groups;

    /// @param places along x; covers reach 0.6 m @param owners of the bodies; empty = all are of this rank
    explicit Row(const std::vector<double>& places, const std::vector<int>& owners = {}, int rank = 0) {
        for (BodyIndex i = 0; i < places.size(); ++i) {
            const double x = places[i];
            const CoveredBody body{i, {Vec3(x - 0.6, -1, -1), Vec3(x + 0.6, 1, 1)}};
            const bool is_own = owners.empty() || owners[i] == rank;
            (is_own ? bodies : others).push_back(body);
            if (is_own) position.emplace_back(x, 0, 0);
        }
    }
    void find() { groups.find({bodies, position, joined, search, executor}); }
    void meet() { groups.meet(bodies, others, search, executor); }
};

TEST(NearGroups, AreOfBodiesWhoseCoversOverlap) {
    Row row({0, 1, 2, 5, 6, 9});
    row.find();
    for (const BodyIndex i : {0, 1, 2}) EXPECT_EQ(row.groups.groupOf(i), 0U);
    for (const BodyIndex i : {3, 4}) EXPECT_EQ(row.groups.groupOf(i), 3U);
    EXPECT_EQ(row.groups.groupOf(5), 5U);
    EXPECT_EQ(row.groups.middleOf(0), Vec3(1, 0, 0));
    EXPECT_EQ(row.groups.middleOf(3), Vec3(5.5, 0, 0));
}

TEST(NearGroups, KeepWhatIsJoined) {
    Row row({0, 3, 6, 9});
    row.joined = {{0, 2}, {1, 3}};
    row.find();
    EXPECT_EQ(row.groups.groupOf(2), 0U);
    EXPECT_EQ(row.groups.groupOf(3), 1U);
}

TEST(NearGroups, MeetWhereBodiesOfTwoRanksDo) {
    Row row({0, 1, 2, 5, 6, 7, 9}, {0, 0, 1, 0, 1, 1, 1});
    row.meet();
    // The second and the third of this rank.
    EXPECT_EQ(std::vector(row.groups.met().begin(), row.groups.met().end()), (std::vector<std::uint32_t>{1, 2}));
    // The boxes of the ranks overlap, the bodies do not.
    Row apart({0, 1, 3, 4, 7, 8}, {0, 0, 1, 1, 0, 0});
    apart.meet();
    EXPECT_TRUE(apart.groups.met().empty());
}

TEST(NearGroups, ReachOverRanks) {
    // A chain in which neighbours are on different ranks, a pair on one rank, a pair on two.
    const std::vector<double> places{4, 0, 1, 2, 3, 10, 11, 20, 21};
    const std::vector<int> owners{0, 1, 2, 0, 1, 2, 2, 1, 0};
    runRanks(3, [&](Ranks& ranks) {
        Row row(places, owners, ranks.rank());
        row.meet();
        row.find();
        row.groups.joinAcross(ranks);
        for (BodyIndex n = 0; n < row.bodies.size(); ++n) {
            const BodyIndex i = row.bodies[n].home;
            const BodyIndex group = row.groups.groupOf(n);
            EXPECT_EQ(row.groups.nameOf(group), i < 5 ? 0U : i < 7 ? 5U : 7U) << i;
            EXPECT_EQ(row.groups.middleOf(group).x(), i < 5 ? 2 : i < 7 ? 10.5 : 20.5) << i;
        }
    });
}

TEST(NearGroups, AreFoundByRanksWithoutBodies) {
    runRanks(3, [&](Ranks& ranks) {
        Row row({0, 1}, {0, 1}, ranks.rank());
        row.meet();
        row.find();
        row.groups.joinAcross(ranks);
        if (ranks.rank() == 2) return;
        EXPECT_EQ(row.groups.nameOf(row.groups.groupOf(0)), 0U);
        EXPECT_EQ(row.groups.middleOf(row.groups.groupOf(0)).x(), 0.5);
    });
}

}  // namespace
}  // namespace cairn
