/// The list of a body's fields names every array once.
#include "body/body_fields.h"

#include <gtest/gtest.h>

#include <set>

#include "body/body_storage.h"

namespace cairn {
namespace {

TEST(BodyFields, NameEveryArrayOnce) {
    const BodyArrays arrays;
    std::set<const void*> places;
    std::set<std::string_view> names;
    forEachBodyField([&](const auto& field) {
        EXPECT_TRUE(places.insert(&(arrays.*field.array)).second) << field.name;
        EXPECT_TRUE(names.insert(field.name).second) << field.name;
    });
    EXPECT_EQ(places.size() * sizeof(FieldArray<double>), sizeof arrays);
}

TEST(BodyFields, GrowTogetherAndBeginAsTheirRowSays) {
    BodyStorage bodies;
    for (int i = 0; i < 3; ++i) bodies.allocate(BodyKind::dynamic);
    forEachBodyField([&](const auto& field) { EXPECT_EQ((bodies.*field.array).size(), 3U) << field.name; });
    EXPECT_EQ(bodies.supports[2], -1);
    EXPECT_EQ(bodies.orientation[2].coeffs(), Quat::Identity().coeffs());
    EXPECT_EQ(bodies.inertiaInv_W[2], Mat3::Zero());
}

TEST(BodyFields, ANumberIsNeverUsedAgain) {
    BodyStorage bodies;
    for (int i = 0; i < 3; ++i) bodies.allocate(BodyKind::dynamic);
    bodies.release(1);
    const BodyIndex again = bodies.allocate(BodyKind::fixed);
    EXPECT_EQ(again, 1U);
    EXPECT_EQ(bodies.number[0], 0U);
    EXPECT_EQ(bodies.number[1], 3U);
    EXPECT_EQ(bodies.number[2], 2U);
    EXPECT_EQ(bodies.nextNumber(), 4U);
}

}  // namespace
}  // namespace cairn
