#include <gtest/gtest.h>

#include "batches/schedule.h"
#include "counted_new.h"

namespace cairn {
namespace {

TEST(BatchesMemory, AWarmStepAllocatesNothing) {
    const std::vector<BodyKind> kind(300, BodyKind::dynamic);
    std::vector<Contact> contacts;  // a hundred groups of three bodies
    for (BodyIndex i = 0; i < 300; i += 3) {
        contacts.push_back({.a = i, .b = i + 1});
        contacts.push_back({.a = i + 1, .b = i + 2});
    }
    BatchScratch scratch;
    Batches batches;
    ContactsOfBodies lists;
    std::vector<BatchView> views;
    BatchSchedule schedule;
    const auto step = [&] {
        const std::size_t before = test::allocations;
        buildBatches(kind, contacts, scratch, batches);
        listContacts(kind, contacts, lists);
        views.resize(batches.size());
        for (std::size_t i = 0; i < views.size(); ++i) views[i] = batches[i];
        schedule.arrange(views);
        return test::allocations - before;
    };
    EXPECT_GT(step(), 0u) << "the counter must work";
    EXPECT_EQ(step(), 0u);
    EXPECT_EQ(batches.size(), 100u);
    EXPECT_EQ(schedule.order().size(), 100u);
}

}  // namespace
}  // namespace cairn
