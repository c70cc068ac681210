/// The tree finds what asking all bounds finds.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/bounds_tree.h"
#include "narrow_phase/pair_random.h"

namespace cairn {
namespace {

using testing::Random;

std::vector<Bounds> randomBoxes(Random& random, std::size_t count, double size) {
    std::vector<Bounds> boxes(count);
    for (Bounds& box : boxes) {
        const Vec3 centre = random.vector(10);
        const Vec3 half = random.vector(size).cwiseAbs();
        box = {centre - half, centre + half};
    }
    return boxes;
}

void expectLikeAll(const BoundsTree& tree, const std::vector<Bounds>& boxes, Random& random) {
    for (int i = 0; i < 50; ++i) {
        const Bounds box = randomBoxes(random, 1, 5).front();
        std::vector<std::uint32_t> found;
        tree.forEachOverlapping(box, [&](std::uint32_t item) { found.push_back(item); });
        std::ranges::sort(found);
        std::vector<std::uint32_t> all;
        for (std::uint32_t k = 0; k < boxes.size(); ++k) {
            if (boxes[k].overlaps(box)) all.push_back(k);
        }
        ASSERT_EQ(found, all);
    }
}

/// Along an axis, where a ray may lie in the sides of boxes, and along any direction.
void expectRaysLikeAll(const BoundsTree& tree, const std::vector<Bounds>& boxes, Random& random) {
    for (int i = 0; i < 50; ++i) {
        const Vec3 direction = i % 2 == 0 ? Vec3(Vec3::Unit(random.below(3))) : random.direction();
        const TreeRay ray{random.vector(12), direction, i % 5 == 0 ? Vec3(0.5, 0.2, 0.1) : Vec3(0, 0, 0)};
        const double reach = random.uniform(0, 20);
        std::vector<std::uint32_t> found;
        tree.forEachAlong(ray, reach, [&](std::uint32_t item) { found.push_back(item); });
        std::ranges::sort(found);
        EXPECT_TRUE(std::ranges::adjacent_find(found) == found.end());
        for (std::uint32_t k = 0; k < boxes.size(); ++k) {
            bool is_met = false;
            for (int s = 0; s <= 1000 && !is_met; ++s) {
                const Vec3 p = ray.origin + reach * s / 1000.0 * direction;
                is_met = boxes[k].overlaps({p - ray.thick, p + ray.thick});
            }
            ASSERT_TRUE(!is_met || std::ranges::binary_search(found, k));
        }
        for (const std::uint32_t item : found) {
            // Nothing is found that is far from the ray.
            const Vec3 centre = 0.5 * (boxes[item].lower + boxes[item].upper);
            const double radius = 0.5 * (boxes[item].upper - boxes[item].lower).norm() + ray.thick.norm();
            const double along = std::clamp((centre - ray.origin).dot(direction), 0.0, reach);
            ASSERT_LE((centre - ray.origin - along * direction).norm(), radius + 1e-9);
        }
    }
}

TEST(BoundsTree, FindsWhatAskingAllFinds) {
    Random random(31);
    for (const std::size_t count : {0, 1, 2, 3, 10, 100, 1000}) {
        std::vector<Bounds> boxes = randomBoxes(random, count, 1);
        BoundsTree tree;
        tree.build(boxes);
        EXPECT_EQ(tree.size(), count);
        expectLikeAll(tree, boxes, random);
        expectRaysLikeAll(tree, boxes, random);
        boxes = randomBoxes(random, count, 1);
        tree.refit(boxes);
        expectLikeAll(tree, boxes, random);
    }
}

TEST(BoundsTree, FindsThePairsOfTwoTreesThatAskingAllFinds) {
    Random random(8);
    const Vec3 moved(1, -2, 0.5);
    for (const auto& [count, others] : {std::pair(1, 1), std::pair(1, 90), std::pair(70, 1), std::pair(120, 300)}) {
        const auto boxes = randomBoxes(random, static_cast<std::size_t>(count), 3);
        const auto other_boxes = randomBoxes(random, static_cast<std::size_t>(others), 1);
        BoundsTree tree;
        BoundsTree other;
        tree.build(boxes);
        other.build(other_boxes);
        const auto place = [&](const Bounds& b) { return Bounds{b.lower + moved, b.upper + moved}; };
        std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
        tree.forEachPair(other, place, [&](std::uint32_t i, std::uint32_t k) { found.emplace_back(i, k); });
        std::ranges::sort(found);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            for (std::uint32_t k = 0; k < other_boxes.size(); ++k) {
                if (place(boxes[i]).overlaps(other_boxes[k])) all.emplace_back(i, k);
            }
        }
        EXPECT_EQ(found, all) << count << " " << others;
    }
    const BoundsTree none;
    none.forEachPair(
        none, [](const Bounds& b) { return b; }, [](std::uint32_t, std::uint32_t) { FAIL(); });
}

TEST(BoundsTree, BearsEqualAndExtremeBoxes) {
    Random random(32);
    BoundsTree tree;
    std::vector<Bounds> equal(5000, Bounds{Vec3::Zero(), Vec3::Ones()});
    tree.build(equal);
    std::size_t found = 0;
    tree.forEachOverlapping({Vec3::Ones(), Vec3::Ones()}, [&](std::uint32_t) { ++found; });
    EXPECT_EQ(found, equal.size());
    // Each twice as far as the one before: areas alone would cut them off one by one.
    std::vector<Bounds> far;
    for (int i = 0; i < 900; ++i) {
        const Vec3 at = std::ldexp(1.0, i / 2 - 200) * Vec3::Ones();
        far.push_back({at, 1.0001 * at});
    }
    tree.build(far);
    expectLikeAll(tree, far, random);
    found = 0;
    tree.forEachAlong({Vec3::Zero(), Vec3::Ones().normalized()}, std::numeric_limits<double>::infinity(),
                      [&](std::uint32_t) { ++found; });
    EXPECT_EQ(found, far.size());
}

TEST(BoundsTree, IsWornWhenItsItemsHaveLeft) {
    Random random(33);
    std::vector<Bounds> boxes = randomBoxes(random, 500, 0.2);
    BoundsTree tree;
    tree.build(boxes);
    EXPECT_FALSE(tree.isWorn());
    tree.refit(boxes);
    EXPECT_FALSE(tree.isWorn());
    tree.refit(randomBoxes(random, 500, 0.2));
    EXPECT_TRUE(tree.isWorn());
}

TEST(BoundsTree, LowersItsReachAsItGoes) {
    Random random(34);
    const std::vector<Bounds> boxes = randomBoxes(random, 2000, 0.3);
    BoundsTree tree;
    tree.build(boxes);
    double reach = 1000;
    std::size_t visited = 0;
    tree.forEachAlong({Vec3(-20, 0, 0), Vec3::UnitX()}, reach, [&](std::uint32_t) {
        ++visited;
        reach = 0;
    });
    EXPECT_EQ(visited, 1U);
}

}  // namespace
}  // namespace cairn
