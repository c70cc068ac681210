/// @file Hash grids: entering bodies, looking up cells, and all pairs of a pile.
#include <cmath>
#include <memory>

#include "broad_phase/block_table.h"
#include "broad_phase/hash_grids.h"
#include "kernel.h"

namespace cairn::kernels {

namespace {

constexpr std::size_t bodies = 20000;
constexpr double smallest = 0.03;  ///< half edges [m]
constexpr double largest = 0.08;
constexpr double edge = 0.16;  ///< of a cell [m]
constexpr double room = 0.14;  ///< edge of the cube that a body has to itself [m]

struct Cloud {
    std::vector<BodyKind> kind;
    std::vector<Bounds> bounds;
};

/// Bodies as dense as in a pile.
Cloud makeCloud() {
    Random random(3);
    Cloud cloud;
    const double half = 0.5 * room * std::cbrt(static_cast<double>(bodies));
    for (std::size_t i = 0; i < bodies; ++i) {
        const double x = random.uniform(-half, half);
        const double y = random.uniform(-half, half);
        const double z = random.uniform(-half, half);
        const Vec3 size = Vec3::Constant(random.uniform(smallest, largest));
        cloud.kind.push_back(BodyKind::dynamic);
        cloud.bounds.push_back({Vec3(x, y, z) - size, Vec3(x, y, z) + size});
    }
    return cloud;
}

std::vector<BlockKey> keysOf(const Cloud& cloud) {
    std::vector<BlockKey> keys;
    for (const Bounds& bounds : cloud.bounds) {
        const Vec3 block = (bounds.lower / (4 * edge)).array().floor();
        keys.push_back({static_cast<std::int64_t>(block.x()), static_cast<std::int64_t>(block.y()),
                        static_cast<std::int64_t>(block.z()), 0});
    }
    return keys;
}

Pass insertPass() {
    const auto table = std::make_shared<BlockTable>();
    Pass pass;
    pass.items = bodies;
    pass.prepare = [] {};
    pass.run = [table, keys = keysOf(makeCloud())] {
        table->reset();
        for (const BlockKey& key : keys) table->enter(key);
        keep(*table);
    };
    return pass;
}

Pass queryPass() {
    const auto table = std::make_shared<BlockTable>();
    std::vector<BlockKey> keys = keysOf(makeCloud());
    table->reset();
    for (const BlockKey& key : keys) table->enter(key);
    // Neighbours, of which some exist and some do not, as in a search.
    for (BlockKey& key : keys) ++key.x;
    Pass pass;
    pass.items = bodies;
    pass.prepare = [] {};
    pass.run = [table, keys = std::move(keys)] {
        std::size_t found = 0;
        for (const BlockKey& key : keys) found += table->find(key) != nullptr ? 1U : 0U;
        keep(found);
    };
    return pass;
}

Pass pairsPass() {
    const auto cloud = std::make_shared<Cloud>(makeCloud());
    const auto grids = std::make_shared<HashGrids>();
    Pass pass;
    pass.items = bodies;
    pass.prepare = [] {};
    pass.run = [cloud, grids, pairs = std::make_shared<std::vector<BodyPair>>()] {
        grids->findPairs({cloud->kind, cloud->bounds}, Executor{}, *pairs);
        keep(*pairs);
    };
    return pass;
}

}  // namespace

std::vector<Kernel> broadPhaseKernels() {
    return {{"broad_phase/insert", "body", insertPass},
            {"broad_phase/query", "look-up", queryPass},
            {"broad_phase/find_pairs", "body", pairsPass}};
}

}  // namespace cairn::kernels
