#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "batches/batches.h"

namespace {

std::atomic<std::size_t> allocations{0};  // counted by the operators below, which replace those of the whole program

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
    ++allocations;
    if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

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
    std::vector<std::uint32_t> order;
    const auto step = [&] {
        const std::size_t before = allocations;
        buildBatches(kind, contacts, scratch, batches);
        listContacts(kind, contacts, lists);
        scheduleBatches(batches, 2, order);
        return allocations - before;
    };
    EXPECT_GT(step(), 0u) << "the counter must work";
    EXPECT_EQ(step(), 0u);
    EXPECT_EQ(batches.size(), 100u);
    EXPECT_EQ(order.size(), 100u);
}

}  // namespace
}  // namespace cairn
