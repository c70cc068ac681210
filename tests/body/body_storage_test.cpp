#include "body/body_storage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "body/material_table.h"

namespace cairn {
namespace {

TEST(BodyStorage, StaleIdIsRefusedAndNeverNamesTheBodyThatTookTheSlot) {
    BodyStorage bodies;
    const BodyId first = bodies.idOf(bodies.allocate(BodyKind::dynamic));
    bodies.release(first.index);
    EXPECT_THROW(bodies.indexOf(first), StaleIdError);
    const BodyId second = bodies.idOf(bodies.allocate(BodyKind::dynamic));
    EXPECT_EQ(second.index, first.index);
    EXPECT_NE(second, first);
    EXPECT_FALSE(bodies.contains(first));
    EXPECT_EQ(bodies.indexOf(second), second.index);
    EXPECT_THROW(bodies.indexOf(BodyId{}), StaleIdError);
}

TEST(BodyStorage, LowestHoleIsFilledFirst) {
    BodyStorage bodies;
    for (int i = 0; i < 5; ++i) bodies.allocate(BodyKind::dynamic);
    bodies.release(3);
    bodies.release(1);
    bodies.release(4);
    EXPECT_EQ(bodies.allocate(BodyKind::dynamic), 1U);
    EXPECT_EQ(bodies.allocate(BodyKind::dynamic), 3U);
    EXPECT_EQ(bodies.allocate(BodyKind::dynamic), 4U);
    EXPECT_EQ(bodies.allocate(BodyKind::dynamic), 5U);
    EXPECT_EQ(bodies.count(), 6U);
}

TEST(BodyStorage, AReusedSlotStartsFresh) {
    BodyStorage bodies;
    const BodyIndex i = bodies.allocate(BodyKind::dynamic);
    bodies.v[i] = bodies.constant_force[i] = Vec3(1, 2, 3);
    bodies.asleep[i] = 1;
    bodies.supports[i] = 7;
    bodies.release(i);
    ASSERT_EQ(bodies.allocate(BodyKind::fixed), i);
    EXPECT_EQ(bodies.v[i], Vec3::Zero());
    EXPECT_EQ(bodies.constant_force[i], Vec3::Zero());
    EXPECT_EQ(bodies.asleep[i], 0);
    EXPECT_EQ(bodies.supports[i], -1);
}

TEST(BodyStorage, FixedBodiesHaveNoInverseMass) {
    BodyStorage bodies;
    const BodyIndex i = bodies.allocate(BodyKind::dynamic);
    bodies.mass[i] = 4;
    bodies.inertia_B[i] = Vec3(1, 2, 8);
    bodies.orientation[i] = Quat(Eigen::AngleAxisd(1.5707963267948966, Vec3::UnitZ()));
    bodies.updateMassProperties(i);
    EXPECT_DOUBLE_EQ(bodies.mass_inv[i], 0.25);
    // A quarter turn about z swaps the moments about x and y.
    EXPECT_TRUE(bodies.inertiaInv_W[i].isApprox(Mat3(Vec3(0.5, 1, 0.125).asDiagonal()), 1e-12));
    bodies.kind[i] = BodyKind::fixed;
    bodies.updateMassProperties(i);
    EXPECT_EQ(bodies.mass_inv[i], 0);
    EXPECT_TRUE(bodies.inertiaInv_W[i].isZero(0));
}

TEST(MaterialTable, PairsAreSymmetricAndSurviveLaterMaterials) {
    MaterialTable table;
    const MaterialId oak = table.add({"oak", 800});
    const MaterialId iron = table.add({"iron", 7874});
    table.setPair(iron, oak, {.restitution = 0.5, .static_friction = 0.4, .kinetic_friction = 0.3});
    table.add({"granite", 2800});
    EXPECT_EQ(table.pair(0, 1).restitution, 0.5);
    EXPECT_EQ(table.pair(1, 0).restitution, 0.5);
    EXPECT_EQ(table.pair(0, 2).restitution, PairProperties{}.restitution);
    table.setDefault({.restitution = 0, .static_friction = 1, .kinetic_friction = 1});
    EXPECT_EQ(table.pair(2, 2).static_friction, 1);
    EXPECT_EQ(table.pair(0, 1).static_friction, 0.4);
}

TEST(MaterialTable, BadPropertiesAreRefusedWithTheReason) {
    MaterialTable table;
    table.add({"oak", 800});
    EXPECT_THROW(table.add({"oak", 700}), InputError);
    EXPECT_THROW(table.add({"", 700}), InputError);
    EXPECT_THROW(table.add({"air", 0}), InputError);
    EXPECT_THROW(table.add({"void", std::nan("")}), InputError);
    EXPECT_THROW(table.setDefault({.restitution = 1.1}), InputError);
    EXPECT_THROW(table.setDefault({.restitution = 0, .static_friction = 0.2, .kinetic_friction = 0.3}), InputError);
    EXPECT_THROW(table.setDefault({.static_friction = -1, .kinetic_friction = -1}), InputError);
    EXPECT_THROW(table.setPair(MaterialId{0}, MaterialId{5}, {}), InputError);
}

/// Entries of slots that came and went.
std::vector<std::string> rearranged(std::vector<std::string> values, const SlotMove& move) {
    FieldArray<std::string> field;
    field.assign(values.begin(), values.end());
    rearrange(values, move, "new");
    rearrange(field, move, "new");
    EXPECT_TRUE(std::ranges::equal(values, field));
    return values;
}

TEST(SlotMove, BringsEntriesToWhereTheirSlotsAre) {
    using Texts = std::vector<std::string>;
    const SlotMove come{{0, no_slot, 1, 2, no_slot, 3}, {0, 2, 3, 5}};
    EXPECT_EQ(rearranged({"a", "b", "c", "d"}, come), (Texts{"a", "new", "b", "c", "new", "d"}));
    EXPECT_EQ(rearranged({"a", "b"}, come), (Texts{"a", "new", "b", "new", "new", "new"})) << "of slots that are newer";
    EXPECT_EQ(rearranged({}, come), Texts{}) << "an array that is not used";
    EXPECT_EQ(rearranged({}, {{no_slot, no_slot}, {}}), (Texts{"new", "new"}));
    EXPECT_EQ(rearranged({"a", "b", "c", "d"}, {{0, 2, 3}, {0, no_slot, 1, 2}}), (Texts{"a", "c", "d"}));
    EXPECT_EQ(rearranged({"a", "b", "c", "d"}, {{3}, {no_slot, no_slot, no_slot, 0}}), Texts{"d"});
    EXPECT_EQ(rearranged({"a", "b", "c"}, {{0, 2, 3}, {0, no_slot, 1, 2}}), (Texts{"a", "c", "new"}));
    EXPECT_EQ(come(3), 5U);
    EXPECT_EQ(come(UINT32_MAX), UINT32_MAX);
}

TEST(BodyStorage, OfAPartNamesBodiesAsTheWholeWorldDoes) {
    BodyStorage bodies;
    std::vector<BodyId> ids;
    for (int i = 0; i < 6; ++i) {
        ids.push_back(bodies.idOf(bodies.allocate(BodyKind::dynamic)));
        bodies.position[static_cast<std::size_t>(i)].x() = i;
    }
    bodies.filter.setPair(1, 4, Touch::never);
    bodies.beginPart();
    for (const BodyIndex i : {0, 2, 3, 5}) bodies.kind[i] = BodyKind::hole;
    const SlotMove dropped = bodies.takeHomes({1, 3, 4});
    EXPECT_EQ(dropped.from, (std::vector<BodyIndex>{1, 3, 4}));
    EXPECT_EQ(dropped.to, (std::vector<BodyIndex>{no_slot, 0, no_slot, 1, 2, no_slot}));
    EXPECT_EQ(bodies.slots(), 3U);
    EXPECT_EQ(bodies.wholeSlots(), 6U);
    EXPECT_EQ(bodies.count(), 2U);
    EXPECT_EQ(bodies.position[2].x(), 4);
    EXPECT_EQ(bodies.idOf(2), ids[4]);
    EXPECT_EQ(bodies.indexOf(ids[4]), 2U);
    EXPECT_EQ(bodies.slotOf(5), no_slot);
    EXPECT_EQ(bodies.filter.ofPair(0, 2), Touch::never);
    EXPECT_TRUE(bodies.contains(ids[1]));
    for (const std::size_t elsewhere : {0, 3, 5}) {
        EXPECT_FALSE(bodies.contains(ids[elsewhere]));
        EXPECT_THROW(bodies.indexOf(ids[elsewhere]), StaleIdError);
    }
    const SlotMove added = bodies.takeHomes({0, 1, 2, 3, 4, 5});
    EXPECT_EQ(added.from, (std::vector<BodyIndex>{no_slot, 0, no_slot, 1, 2, no_slot}));
    EXPECT_EQ(bodies.kind[0], BodyKind::hole);
    bodies.endPart();
    EXPECT_EQ(bodies.position[4].x(), 4);
    EXPECT_EQ(bodies.filter.ofPair(1, 4), Touch::never);
}

}  // namespace
}  // namespace cairn
