/// Any bytes behind a right checksum are a world or are refused with InputError; a world is saved as the same.
#include <algorithm>

#include "cairn/scene.h"
#include "fuzz/bytes.h"
#include "world/byte_stream.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cairn;
    std::vector<std::byte> bytes(size);
    std::transform(data, data + size, bytes.begin(), [](std::uint8_t byte) { return std::byte{byte}; });
    try {
        static_cast<void>(SceneRun::restore(bytes));
    } catch (const InputError&) {
    }
    // Without this the checksums would refuse all but the seeds.
    if (bytes.size() < frameHeadSize() + 16) return 0;
    sealFrame(bytes, FrameKind::world, snapshot_version);
    try {
        World world = World::restore(bytes);
        fuzz::require(World::restore(world.save()).save() == world.save());
        Settings settings = world.settings();
        fuzz::boundWork(settings);
        world.setSettings(settings);
        if (world.bodyCount() > 200) return 0;
        for (int i = 0; i < 2; ++i) world.step();
        for (const BodyId id : world.bodies()) fuzz::require(world.pose(id).position.allFinite());
        for (const BodyId id : world.bodies()) world.removeBody(id);
        world.step();
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
