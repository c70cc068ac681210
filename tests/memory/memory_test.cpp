/// What a world takes from the heap, counted by replacing the operators of this test program.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "cairn/ranks.h"
#include "cairn/scene.h"

namespace {

/// What the program asked the heap for.
struct Heap {
    std::atomic<std::int64_t> allocations{0};
    std::atomic<std::int64_t> bytes{0};  ///< in use
    std::atomic<std::int64_t> peak{0};   ///< largest bytes, not exact while several threads allocate
};

Heap& heap() {
    static Heap counts;
    return counts;
}

void* take(std::size_t size, std::size_t alignment) {
    void* memory = alignment == 0 ? std::malloc(size == 0 ? 1 : size)
                                  : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    ++heap().allocations;
    const auto size_in_use = static_cast<std::int64_t>(malloc_usable_size(memory));
    const std::int64_t bytes = heap().bytes += size_in_use;
    if (bytes > heap().peak) heap().peak = bytes;
    return memory;
}

void giveBack(void* memory) {
    if (memory != nullptr) heap().bytes -= static_cast<std::int64_t>(malloc_usable_size(memory));
    std::free(memory);
}

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
    return take(size, 0);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    return take(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    giveBack(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    giveBack(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    giveBack(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    giveBack(memory);
}

namespace cairn {
namespace {

struct Case {
    ResolutionKind resolution;
    std::int64_t threads;
    EventLevel events;
};

class SteadyStep : public testing::TestWithParam<Case> {};

TEST_P(SteadyStep, TakesNothingFromTheHeap) {
    const Scene scene = builtInScene("wall:10");
    Settings settings = settingsFor(scene);
    settings.resolution.resolution = GetParam().resolution;
    settings.parallel = {GetParam().threads, true};
    settings.sleep.sleeping = false;
    SceneRun run(scene, settings);
    run.world().setEventLevel(GetParam().events);
    // Long enough that every array has had its largest size.
    for (int i = 0; i < 250; ++i) run.step();
    std::int64_t taken = 0;
    for (int i = 0; i < 50; ++i) {
        const std::int64_t before = heap().allocations;
        run.step();
        taken += heap().allocations - before;
    }
    EXPECT_GT(run.world().statistics().contacts, 100);
    EXPECT_EQ(taken, 0);
}

INSTANTIATE_TEST_SUITE_P(Worlds, SteadyStep,
                         testing::Values(Case{ResolutionKind::impulse_queue, 1, EventLevel::none},
                                         Case{ResolutionKind::impulse_queue, 2, EventLevel::none},
                                         Case{ResolutionKind::impulse_queue, 1, EventLevel::all},
                                         Case{ResolutionKind::sweep, 1, EventLevel::none},
                                         Case{ResolutionKind::accelerated_sweeps, 2, EventLevel::none}));

TEST(Rollback, SavingIntoTheSameBufferTakesNoMemoryForTheState) {
    const Scene scene = builtInScene("wall:10");
    SceneRun run(scene, settingsFor(scene));
    std::vector<std::byte> buffer;
    for (int i = 0; i < 60; ++i) {
        run.step();
        run.world().saveTo(buffer);
    }
    const std::int64_t before = heap().allocations;
    run.world().saveTo(buffer);
    // The names of choices among the settings are texts, of which the long ones need the heap for a moment.
    EXPECT_LE(heap().allocations - before, 4);
    EXPECT_EQ(buffer, run.world().save());
}

TEST(Rollback, KeepingAndLoadingMomentsTakesNothingFromTheHeap) {
    SceneRun run(builtInScene("wall:10"), settingsFor(builtInScene("wall:10")));
    std::vector<RollbackState> ring(10);
    const auto go = [&](std::size_t steps) {
        for (std::size_t i = 0; i < steps; ++i) {
            run.world().keep(ring[i % ring.size()]);
            run.world().step();
        }
    };
    go(100);
    const std::int64_t before = heap().allocations;
    for (int i = 0; i < 3; ++i) {
        run.world().load(ring[0]);
        go(10);
    }
    EXPECT_EQ(heap().allocations - before, 0);
}

TEST(Memory, IsGivenBackWithTheWorld) {
    const auto live = [] {
        const std::int64_t before = heap().bytes;
        {
            const Scene scene = builtInScene("heap:300");
            SceneRun run(scene, settingsFor(scene));
            for (int i = 0; i < 60; ++i) run.step();
            EXPECT_GT(heap().bytes - before, 300 * 400);
        }
        return heap().bytes - before;
    };
    live();  // what is made once and kept for the program, such as the table of settings
    EXPECT_EQ(live(), 0);
}

/// Bytes in use after some steps with so many bodies.
std::int64_t bytesFor(int bodies) {
    const std::int64_t before = heap().bytes;
    const Scene scene = builtInScene("heap:" + std::to_string(bodies));
    SceneRun run(scene, settingsFor(scene));
    for (int i = 0; i < 20; ++i) run.step();
    return heap().bytes - before;
}

TEST(Memory, GrowsLinearlyWithTheBodies) {
    const std::int64_t small = bytesFor(2000);
    const std::int64_t large = bytesFor(8000);
    EXPECT_LT(large, 4 * small * 5 / 4);
    RecordProperty("bytes_per_body", static_cast<int>(large / 8000));
    EXPECT_LT(large / 8000, 8000) << "bytes per body";
}

TEST(Memory, AHundredThousandBodiesLoadAndStepWithinFourGigabytes) {
    const std::int64_t before = heap().bytes;
    heap().peak = before;
    const Scene scene = builtInScene("heap:100000");
    SceneRun run(scene, settingsFor(scene));
    for (int i = 0; i < 3; ++i) run.step();
    EXPECT_GT(run.world().bodyCount(), 100000U);
    EXPECT_LT(heap().peak - before, std::int64_t{4} << 30U);
    RecordProperty("megabytes", static_cast<int>((heap().peak - before) >> 20U));
}

TEST(Memory, PouringAndRemovingForeverNeedsNoMore) {
    World world;
    const MaterialId oak = world.addMaterial({"oak", 800});
    world.setGravity(Vec3(0, 0, -10));
    world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
    std::vector<BodyId> alive;
    const auto pour = [&](int steps) {
        for (int i = 0; i < steps; ++i) {
            const Vec3 place(0.12 * (i % 5), 0.12 * (i / 5 % 5), 0.3 + 0.12 * (i % 3));
            alive.push_back(world.addBody({.shape = Sphere{0.05}, .material = oak, .pose = {place, Quat(1, 0, 0, 0)}}));
            if (alive.size() > 100) {
                world.removeBody(alive.front());
                alive.erase(alive.begin());
            }
            world.step();
        }
    };
    pour(600);
    const std::int64_t before = heap().bytes;
    pour(2400);
    EXPECT_LT(static_cast<double>(heap().bytes), 1.1 * static_cast<double>(before));
    EXPECT_LE(world.bodies().back().index, 110U) << "slots are used again";
}

Vec3 placeInGas(int i) {
    constexpr int edge = 30;
    return 2.0 * Vec3(i % edge, i / edge % edge, i / edge / edge);
}

/// Largest number of bytes in use while so many ranks share a gas of balls, from its first body on.
std::int64_t peakOfGas(int ranks, int balls) {
    std::vector<Vec3> places;
    for (int i = 0; i < balls; ++i) places.push_back(placeInGas(i));
    const std::int64_t before = heap().bytes;
    heap().peak = before;
    runRanks(ranks, [&](Ranks& own) {
        World world;
        const MaterialId oak = world.addMaterial({"oak", 800});
        world.share(own, {}, places);
        for (int i = 0; i < balls; ++i) {
            const Pose pose{placeInGas(i), Quat::Identity()};
            const Vec3 velocity(i * 7919 % 101 - 50, i * 104729 % 101 - 50, i * 7907 % 101 - 50);
            world.addBody({.shape = Sphere{0.25}, .material = oak, .pose = pose, .linear_velocity = velocity / 50});
        }
        for (int i = 0; i < 20; ++i) world.step();
    });
    return heap().peak - before;
}

TEST(Memory, OfRanksThatDealOutAGasIsLittleMoreThanOfOne) {
    constexpr int balls = 27000;
    const std::int64_t alone = peakOfGas(1, balls);
    const std::int64_t together = peakOfGas(4, balls);
    RecordProperty("percent_of_one_rank", static_cast<int>(100 * together / alone));
    EXPECT_LT(together, alone * 13 / 10);
}

}  // namespace
}  // namespace cairn
