#include <gtest/gtest.h>

#include <limits>

#include "broad_phase/hash_grids.h"
#include "broad_phase/neighbour_list.h"
#include "broad_phase/scenes.h"

namespace cairn {
namespace {

using namespace broad_phase_tests;

/// Counts how often it is asked.
class CountedGrids final : public BroadPhase {
  public:
    void findPairs(const BroadPhaseInput& input, const Executor& executor, std::vector<BodyPair>& pairs) override {
        ++searches;
        grids_.findPairs(input, executor, pairs);
    }
    int level(BodyIndex body) const override { return grids_.level(body); }

    int searches = 0;

  private:
    HashGrids grids_;
};

/// Bodies that move, and what near pairs are told of them.
struct Moving {
    Bodies bodies;
    std::vector<Vec3> v;
    std::vector<std::uint8_t> still;

    void add(const Vec3& centre, double half, const Vec3& velocity, BodyKind kind = BodyKind::dynamic) {
        bodies.add(centre, Vec3::Constant(half), kind);
        v.push_back(velocity);
        still.push_back(0);
    }
    void move(BodyIndex i, double time) {
        const Vec3 way = time * v[i];
        bodies.bounds[i].lower += way;
        bodies.bounds[i].upper += way;
        still[i] = way.isZero(0) ? 1 : 0;
    }
    NeighbourListInput input() const { return {bodies.kind, bodies.bounds, v, still}; }

    std::vector<BodyPair> overlapping() const {
        std::vector<BodyPair> pairs;
        for (BodyIndex a = 0; a < bodies.size(); ++a) {
            for (BodyIndex b = a + 1; b < bodies.size(); ++b) {
                if (bodies.kind[a] == BodyKind::hole || bodies.kind[b] == BodyKind::hole) continue;
                if (bodies.kind[a] == BodyKind::fixed && bodies.kind[b] == BodyKind::fixed) continue;
                if (bodies.bounds[a].overlaps(bodies.bounds[b])) pairs.push_back({a, b});
            }
        }
        return pairs;
    }
    std::vector<BodyPair> overlappingOf(std::span<const ContactPair> near) const {
        std::vector<BodyPair> pairs;
        for (const BodyPair& pair : near) {
            if (bodies.bounds[pair.a].overlaps(bodies.bounds[pair.b])) pairs.push_back(pair);
        }
        return pairs;
    }
};

constexpr double step = 1.0 / 240;

Moving cloud(Random& random, std::size_t count, double speed) {
    Moving cloud;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 centre = random.inBox(2);
        cloud.add(centre, random.uniform(0.1, 0.3), random.inBox(speed));
    }
    return cloud;
}

TEST(NeighbourList, NoPairIsEverMissing) {
    Random random(7);
    Moving moving = cloud(random, 150, 1);
    for (int i = 0; i < 20; ++i) moving.add(random.inBox(2), 0.3, Vec3::Zero(), BodyKind::fixed);
    moving.bodies.add(Bounds{}, BodyKind::fixed);
    moving.v.push_back(Vec3::Zero());
    moving.still.push_back(1);
    CountedGrids grids;
    NeighbourList near;
    for (int n = 0; n < 300; ++n) {
        for (BodyIndex i = 0; i < moving.bodies.size(); ++i) moving.move(i, step);
        const auto i = static_cast<BodyIndex>(random.below(moving.bodies.size() - 1));
        if (n % 3 == 0) moving.v[i] = random.inBox(5);
        if (n % 5 == 0) moving.v[i].setZero();
        if (n % 7 == 0) moving.bodies.kind[i] = BodyKind::hole;
        if (n % 11 == 0) moving.bodies.kind[i] = BodyKind::fixed;
        if (n % 13 == 0) moving.add(random.inBox(2), 0.2, random.inBox(1));
        if (n % 17 == 0) moving.bodies.kind[i] = BodyKind::dynamic;
        near.update(moving.input(), grids, Executor(1 + n % 2));
        EXPECT_TRUE(std::ranges::is_sorted(near.pairs()));
        EXPECT_EQ(std::ranges::adjacent_find(near.pairs()), near.pairs().end());
        ASSERT_EQ(moving.overlappingOf(near.pairs()), moving.overlapping()) << n;
    }
}

TEST(NeighbourList, AreSearchedRarelyWhileBodiesMoveOn) {
    Random random(8);
    Moving moving = cloud(random, 200, 1);
    CountedGrids grids;
    NeighbourList near;
    for (int n = 0; n < 80; ++n) {
        for (BodyIndex i = 0; i < moving.bodies.size(); ++i) moving.move(i, step);
        near.update(moving.input(), grids, Executor(1));
    }
    EXPECT_LE(grids.searches, 10);
    const int searches = grids.searches;
    for (int n = 0; n < 80; ++n) near.update(moving.input(), grids, Executor(1));
    EXPECT_EQ(grids.searches, searches) << "nobody moves";
}

TEST(NeighbourList, KeepTheirContactsUntilTheyPart) {
    Moving moving;
    moving.add(Vec3::Zero(), 0.5, Vec3(1, 0, 0));
    moving.add(Vec3(0.9, 0, 0), 0.5, Vec3(1, 0, 0));
    moving.add(Vec3(-0.9, 0, 0), 0.5, Vec3(-9, 0, 0));
    CountedGrids grids;
    NeighbourList near;
    near.update(moving.input(), grids, Executor(1));
    ASSERT_EQ(near.pairs().size(), 2);
    EXPECT_FALSE(near.pairs()[0].isTested());
    near.pairs()[0].count = 7;
    for (int n = 0; n < 60; ++n) {
        for (BodyIndex i = 0; i < moving.bodies.size(); ++i) moving.move(i, step);
        near.update(moving.input(), grids, Executor(1));
    }
    EXPECT_GT(grids.searches, 1);
    ASSERT_EQ(near.pairs().size(), 1) << "the last body left";
    EXPECT_EQ(near.pairs()[0].count, 7) << "found again, it is the same pair";
}

TEST(NeighbourList, BeginWithThePairsOfContacts) {
    Moving moving;
    for (int i = 0; i < 3; ++i) moving.add(Vec3(0.9 * i, 0, 0), 0.5, Vec3::Zero());
    const std::vector<Contact> contacts = {{.a = 0, .b = 1}, {.a = 1, .b = 2}, {.a = 1, .b = 2}};
    CountedGrids grids;
    NeighbourList near;
    near.begin(contacts);
    near.update(moving.input(), grids, Executor(1));
    ASSERT_EQ(near.pairs().size(), 2);
    EXPECT_EQ(near.pairs()[0].count, 1);
    EXPECT_EQ(near.pairs()[1].first, 1);
    EXPECT_EQ(near.pairs()[1].count, 2);
}

TEST(NeighbourList, OfBodiesThatAreOthersBeginAnew) {
    Moving moving;
    for (int i = 0; i < 4; ++i) moving.add(Vec3(0.9 * i, 0, 0), 0.5, Vec3::Zero());
    CountedGrids grids;
    NeighbourList near;
    near.update(moving.input(), grids, Executor(1));
    ASSERT_EQ(near.pairs().size(), 3);
    near.pairs()[0].count = 1;
    near.drop(std::vector<std::uint8_t>{0, 1, 0, 0});
    EXPECT_EQ(near.pairs().size(), 1);
    near.update(moving.input(), grids, Executor(1));
    ASSERT_EQ(near.pairs().size(), 3);
    EXPECT_FALSE(near.pairs()[0].isTested());
}

TEST(NeighbourList, BodiesOfNoNumberAreSearchedAnew) {
    Moving moving;
    moving.add(Vec3::Zero(), 0.5, Vec3::Zero());
    moving.add(Vec3(0.5, 0, 0), 0.5, Vec3::Zero());
    CountedGrids grids;
    NeighbourList near;
    near.update(moving.input(), grids, Executor(1));
    moving.bodies.bounds[0].lower.x() = std::numeric_limits<double>::quiet_NaN();
    near.update(moving.input(), grids, Executor(1));
    near.update(moving.input(), grids, Executor(1));
    EXPECT_EQ(grids.searches, 3);
    EXPECT_EQ(moving.overlappingOf(near.pairs()), moving.overlapping());
}

}  // namespace
}  // namespace cairn
