#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "correction/contact_scene.h"
#include "counted_new.h"

namespace cairn::test {
namespace {

TEST(PropagatedCorrection, AllocatesNothingOnceItHasSearchedAsFar) {
    // A pyramid of touching bodies in which every layer pushes the next through gaps of different size.
    ContactScene scene;
    scene.settings.penetration_threshold = 1e-3;
    std::vector<BodyIndex> below{scene.addFixed()};
    for (int layer = 0; layer < 20; ++layer) {
        std::vector<BodyIndex> bodies;
        for (int i = 0; i < 5; ++i) {
            bodies.push_back(scene.addBody({i * 0.1, 0, layer * 0.1}));
            for (std::size_t k = 0; k < below.size(); ++k) {
                const double gap = 1e-5 * static_cast<double>((7 * k + 3 * static_cast<std::size_t>(i)) % 5);
                scene.touch(bodies.back(), below[k], Vec3::UnitZ(), layer == 0 ? -0.05 : -5e-4 + gap);
            }
        }
        below = bodies;
    }
    const ContactScene start = scene;
    std::vector<std::uint32_t> indices(scene.contacts.size());
    std::iota(indices.begin(), indices.end(), 0U);
    const std::vector<BodyIndex> moving = scene.movingBodies();
    const ContactsOfBodies table = scene.contactsOfBodies();
    const auto correction = makeCorrection(CorrectionKind::propagated);
    const auto step = [&] {
        std::copy(start.contacts.begin(), start.contacts.end(), scene.contacts.begin());
        const std::size_t before = allocations;
        const CorrectionCounts counts =
            correction->correct({moving, indices}, table, scene.contacts, scene.state(), scene.remaining_part);
        EXPECT_EQ(counts.corrected, 5);
        EXPECT_GE(counts.displaced, 100);
        return allocations - before;
    };
    EXPECT_GT(step(), 0u);
    // There are two searches that change places.
    step();
    EXPECT_EQ(step(), 0u);
    EXPECT_EQ(step(), 0u);
}

TEST(PositionSweeps, AllocateNothingOnceTheyKnowTheBatch) {
    ContactScene scene;
    scene.settings.penetration_threshold = 0.01;
    scene.addFixed();
    std::vector<BodyIndex> bodies;
    std::vector<std::uint32_t> indices;
    for (BodyIndex i = 1; i <= 40; ++i) {
        bodies.push_back(scene.addBody(Vec3(0, 0, 0.1 * i)));
        indices.push_back(scene.touch(i, i - 1, Vec3::UnitZ(), -0.012));
    }
    const std::vector<Contact> start = scene.contacts;
    const auto correction = makeCorrection(CorrectionKind::position_sweeps);
    const auto step = [&] {
        std::ranges::copy(start, scene.contacts.begin());
        const auto position = scene.position;
        const auto orientation = scene.orientation;
        const std::size_t before = allocations;
        CorrectionCounts counts =
            correction->correct({bodies, indices}, {}, scene.contacts, scene.state(), scene.remaining_part);
        counts.add(correction->settle({bodies, indices}, scene.contacts, scene.state(), {position, orientation}));
        EXPECT_GT(counts.displaced, 0);
        return allocations - before;
    };
    EXPECT_GT(step(), 0u);
    EXPECT_EQ(step(), 0u);
}

}  // namespace
}  // namespace cairn::test
