#include "sharing/near_groups.h"

#include <gtest/gtest.h>

#include "broad_phase/hash_grids.h"

namespace cairn {
namespace {

/// Bodies in a row, in boxes with their numbers.
struct Row {
    std::vector<BodyKind> kind;
    std::vector<Bounds> cover;
    std::vector<Vec3> position;
    std::vector<Contact> contacts;
    std::vector<BodyPair> tied;
    std::vector<BodyIndex> home;  ///< of part of them; empty = all are there
    HashGrids search;
    Executor executor;
    NearGroups groups;

    /// @param places along x; covers reach 0.6 m
    explicit Row(const std::vector<double>& places) {
        for (const double x : places) {
            kind.push_back(BodyKind::dynamic);
            position.emplace_back(x, 0, 0);
            cover.push_back({Vec3(x - 0.6, -1, -1), Vec3(x + 0.6, 1, 1)});
        }
    }
    NearGroupsInput input() { return {kind, cover, position, contacts, tied, search, home}; }
    /// Leaves to this rank the bodies whose owner it is.
    void keep(const std::vector<int>& owners, int rank) {
        for (std::size_t i = 0; i < kind.size(); ++i) {
            if (owners[i] != rank) kind[i] = BodyKind::hole;
        }
    }
};

TEST(NearGroups, AreOfBodiesWhoseCoversOverlap) {
    Row row({0, 1, 2, 5, 6, 9});
    row.groups.find(row.input(), row.executor);
    for (const BodyIndex i : {0, 1, 2}) EXPECT_EQ(row.groups.groupOf(i), 0U);
    for (const BodyIndex i : {3, 4}) EXPECT_EQ(row.groups.groupOf(i), 3U);
    EXPECT_EQ(row.groups.groupOf(5), 5U);
    EXPECT_EQ(row.groups.middleOf(0), Vec3(1, 0, 0));
    EXPECT_EQ(row.groups.middleOf(3), Vec3(5.5, 0, 0));
}

TEST(NearGroups, KeepWhatTouchedOrIsTied) {
    Row row({0, 3, 6, 9});
    row.contacts.push_back({.a = 0, .b = 2});
    row.tied.push_back({1, 3});
    row.groups.find(row.input(), row.executor);
    EXPECT_EQ(row.groups.groupOf(2), 0U);
    EXPECT_EQ(row.groups.groupOf(3), 1U);
}

TEST(NearGroups, FixedBodiesConnectNobody) {
    Row row({0, 1, 2});
    row.kind[1] = BodyKind::fixed;
    row.contacts.push_back({.a = 0, .b = 1});
    row.contacts.push_back({.a = 1, .b = 2});
    row.groups.find(row.input(), row.executor);
    EXPECT_EQ(row.groups.groupOf(0), 0U);
    EXPECT_EQ(row.groups.groupOf(2), 2U);
}

TEST(NearGroups, ReachOverRanks) {
    // A chain in which neighbours are on different ranks, a pair on one rank, a pair on two.
    const std::vector<double> places{4, 0, 1, 2, 3, 10, 11, 20, 21};
    const std::vector<int> owners{0, 1, 2, 0, 1, 2, 2, 1, 0};
    runRanks(3, [&](Ranks& ranks) {
        Row row(places);
        row.keep(owners, ranks.rank());
        EXPECT_TRUE(row.groups.meetOthers(row.input(), row.executor, ranks));
        row.groups.findAcross(row.input(), row.executor, ranks);
        for (BodyIndex i = 0; i < places.size(); ++i) {
            if (owners[i] != ranks.rank()) continue;
            const BodyIndex group = row.groups.groupOf(i);
            EXPECT_EQ(group, i < 5 ? 0U : i < 7 ? 5U : 7U) << i;
            EXPECT_EQ(row.groups.middleOf(group).x(), i < 5 ? 2 : i < 7 ? 10.5 : 20.5) << i;
        }
    });
}

TEST(NearGroups, ReachOverRanksThatHaveSlotsOnlyOfTheirOwn) {
    const std::vector<double> places{4, 0, 1, 2, 3, 10, 11, 20, 21};
    const std::vector<int> owners{0, 1, 2, 0, 1, 2, 2, 1, 0};
    runRanks(3, [&](Ranks& ranks) {
        std::vector<double> own;
        std::vector<BodyIndex> home;
        for (BodyIndex i = 0; i < places.size(); ++i) {
            if (owners[i] != ranks.rank()) continue;
            own.push_back(places[i]);
            home.push_back(i);
        }
        Row row(own);
        row.home = home;
        EXPECT_TRUE(row.groups.meetOthers(row.input(), row.executor, ranks));
        row.groups.findAcross(row.input(), row.executor, ranks);
        for (BodyIndex i = 0; i < own.size(); ++i) {
            const BodyIndex group = row.groups.groupOf(i);
            EXPECT_EQ(row.groups.nameOf(group), home[i] < 5 ? 0U : home[i] < 7 ? 5U : 7U) << i;
            EXPECT_EQ(row.groups.middleOf(group).x(), home[i] < 5 ? 2 : home[i] < 7 ? 10.5 : 20.5) << i;
        }
    });
}

TEST(NearGroups, TellWhereNoBodiesOfTwoRanksMeet) {
    // The boxes of the ranks overlap, the bodies do not.
    const std::vector<double> places{0, 1, 3, 4, 7, 8};
    const std::vector<int> owners{0, 0, 1, 1, 0, 0};
    runRanks(2, [&](Ranks& ranks) {
        Row row(places);
        row.keep(owners, ranks.rank());
        EXPECT_FALSE(row.groups.meetOthers(row.input(), row.executor, ranks));
        row.groups.findAcross(row.input(), row.executor, ranks);
        for (BodyIndex i = 0; i < places.size(); ++i) {
            if (owners[i] != ranks.rank()) continue;
            EXPECT_EQ(row.groups.groupOf(i), i / 2 * 2);
        }
    });
}

TEST(NearGroups, AreFoundByRanksWithoutBodies) {
    runRanks(3, [&](Ranks& ranks) {
        Row row({0, 1});
        row.keep({0, 1}, ranks.rank());
        EXPECT_TRUE(row.groups.meetOthers(row.input(), row.executor, ranks));
        row.groups.findAcross(row.input(), row.executor, ranks);
        if (ranks.rank() != 1) return;
        EXPECT_EQ(row.groups.groupOf(1), 0U);
    });
}

}  // namespace
}  // namespace cairn
