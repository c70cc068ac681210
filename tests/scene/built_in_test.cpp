#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>

#include "geometry/geometry.h"
#include "scene_testing.h"

namespace cairn {
namespace {

using testing::messageOf;

/// FNV-1a. @source RFC draft-eastlake-fnv
std::uint64_t hashOf(const std::string& text) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : text) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3U;
    }
    return hash;
}

std::size_t dynamicBodies(const Scene& scene) {
    std::size_t count = 0;
    for (const SceneBody& body : scene.bodies) count += body.fixed ? 0U : 1U;
    return count;
}

// The hashes are those of the published scene files, which the formatted scenes equal byte by byte.
TEST(BuiltInScenes, OfTheThesisEqualThePublishedFiles) {
    const std::map<std::string, std::uint64_t> published{
        {"stacks5", 0x898eea442fab5f6fU}, {"stacks8", 0xc094e3efe8d4de58U}, {"well324", 0x59f28b0e74e3b8e5U},
        {"well392", 0x597a0fc938257aceU}, {"cage384", 0xafc4840ab429827eU}, {"cage2816", 0xe7da621a0261de26U},
    };
    for (const auto& [name, hash] : published) EXPECT_EQ(hashOf(formatScene(builtInScene(name))), hash) << name;
}

// Samples copied from the published files, so that a wrong hash can be understood.
TEST(BuiltInScenes, OfTheThesisHaveTheirBodies) {
    const Scene stacks = builtInScene("stacks5");
    ASSERT_EQ(stacks.bodies.size(), 277U);
    EXPECT_TRUE(stacks.bodies[56].position.isApprox(Vec3(0.5, -0.495, 0.05), 1e-9));
    EXPECT_TRUE(stacks.bodies[56].asleep);
    EXPECT_EQ(stacks.bodies[276].material, "iron");
    EXPECT_NEAR(stacks.bodies[276].angular_velocity.y(), 90.9090909, 1e-9);
    const Scene well = builtInScene("well324");
    ASSERT_EQ(well.bodies.size(), 329U);
    EXPECT_TRUE(well.bodies[5].position.isApprox(Vec3(-0.380768594, -0.384636596, 0.465027698), 1e-9));
    EXPECT_TRUE(well.bodies[328].position.isApprox(Vec3(0.379742127, 0.384538016, 1.68729862), 1e-9));
    const Scene cage = builtInScene("cage2816");
    ASSERT_EQ(cage.bodies.size(), 2822U);
    EXPECT_TRUE(cage.bodies[6].linear_velocity.isApprox(Vec3(-0.220340503, -0.966423411, 0.801521361), 1e-9));
    EXPECT_TRUE(cage.bodies[2821].position.isApprox(Vec3(1.5515625, 1.5515625, 2.205), 1e-9));
    EXPECT_EQ(dynamicBodies(builtInScene("stacks8")), 441U);
    EXPECT_EQ(dynamicBodies(builtInScene("well392")), 392U);
    EXPECT_EQ(dynamicBodies(builtInScene("cage384")), 384U);
}

TEST(BuiltInScenes, ExamplesAreReadBackAsTheyAre) {
    for (const BuiltInScene& entry : builtInScenes()) {
        EXPECT_FALSE(entry.description.empty());
        EXPECT_TRUE(isBuiltInScene(entry.example)) << entry.example;
        const Scene scene = builtInScene(entry.example);
        EXPECT_EQ(scene.name, entry.example);
        const std::string text = formatScene(scene);
        EXPECT_EQ(formatScene(parseScene(text, entry.example)), text) << entry.example;
    }
}

TEST(BuiltInScenes, OfAnySizeHaveTheRightNumberOfBodies) {
    EXPECT_EQ(dynamicBodies(builtInScene("catapult7")), 1U + 7U + 1U);
    EXPECT_EQ(dynamicBodies(builtInScene("catapult15")), 1U + 15U + 1U);
    EXPECT_EQ(dynamicBodies(builtInScene("cradle")), 5U);
    EXPECT_EQ(dynamicBodies(builtInScene("cradle:7")), 7U);
    EXPECT_EQ(dynamicBodies(builtInScene("tower:12")), 12U);
    EXPECT_EQ(dynamicBodies(builtInScene("wall:10")), 55U);
    EXPECT_EQ(dynamicBodies(builtInScene("wall:30")), 465U);
    for (const std::size_t n : {std::size_t{1}, std::size_t{2}, std::size_t{777}, std::size_t{100000}}) {
        EXPECT_EQ(dynamicBodies(builtInScene("heap:" + std::to_string(n))), n);
    }
}

TEST(BuiltInScenes, CradleBallsTouchAndTheMovingOnesAreApart) {
    const Scene scene = builtInScene("cradle:5:2");
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(scene.bodies[i].linear_velocity.x(), i < 2 ? 1 : 0);
        if (i == 0) continue;
        const double gap = scene.bodies[i].position.x() - scene.bodies[i - 1].position.x() -
                           2 * std::get<Sphere>(scene.bodies[i].shape).radius;
        EXPECT_NEAR(gap, i == 2 ? 0.1 : 0, 1e-12);
    }
    EXPECT_EQ(scene.gravity, Vec3::Zero());
    EXPECT_EQ(scene.default_pair.restitution, 1);
}

TEST(BuiltInScenes, WallsAndTowersTouchAwake) {
    const Scene wall = builtInScene("wall:3");
    EXPECT_TRUE(wall.bodies[1].position.isApprox(Vec3(0, -0.11, 0.05), 1e-12));
    EXPECT_TRUE(wall.bodies[6].position.isApprox(Vec3(0, 0, 0.25), 1e-12));
    EXPECT_FALSE(wall.bodies[1].asleep);
    EXPECT_EQ(wall.default_pair.restitution, 0);
    EXPECT_EQ(wall.default_pair.static_friction, 0.5);
    const Scene tower = builtInScene("tower:2");
    EXPECT_TRUE(tower.bodies[2].position.isApprox(Vec3(0, 0, 0.15), 1e-12));
}

TEST(BuiltInScenes, BodiesOfHeapsAndPitsStartApartBetweenTheWalls) {
    for (const std::string name : {"heap:1", "heap:10", "heap:2000", "pit:1", "pit:900"}) {
        const Scene scene = builtInScene(name);
        const double half = scene.bodies[3].position.y() + std::get<Box>(scene.bodies[3].shape).size.y() / 2;
        double top = 0;
        for (const SceneBody& wall : scene.bodies) {
            if (const auto* box = std::get_if<Box>(&wall.shape); box != nullptr && wall.fixed) {
                top = std::max(top, box->size.z());
            }
        }
        std::array<int, 4> kinds{};
        for (std::size_t i = 5; i < scene.bodies.size(); ++i) {
            const SceneBody& a = scene.bodies[i];
            const double radius = largestRadius(a.shape);
            ++kinds[a.shape.index()];
            EXPECT_LT(std::abs(a.position.x()) + radius, -half);
            EXPECT_LT(std::abs(a.position.y()) + radius, -half);
            EXPECT_GT(a.position.z(), radius);
            EXPECT_LT(a.position.z() + radius, top);
            for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
                const SceneBody& b = scene.bodies[j];
                ASSERT_GT((a.position - b.position).norm(), radius + largestRadius(b.shape)) << i << " " << j;
            }
        }
        if (scene.bodies.size() > 1000) {
            for (int kind = 0; kind < 3; ++kind) EXPECT_GT(kinds[static_cast<std::size_t>(kind)], 500);
        }
    }
}

TEST(BuiltInScenes, HeapGrowsInWidthAsInHeight) {
    const Scene scene = builtInScene("heap:100000");
    double top = 0;
    double side = 0;
    for (const SceneBody& body : scene.bodies) {
        top = std::max(top, body.position.z());
        side = std::max(side, 2 * body.position.x());
    }
    EXPECT_LT(top, 1.1 * side);
    EXPECT_GT(top, 0.9 * side);
}

TEST(BuiltInScenes, RefuseBadNamesAndNumbers) {
    const std::map<std::string, std::string> refused{
        {"stacks6", "stacks5"},
        {"", "built in are"},
        {"stacks5:1", "too many parts"},
        {"tower", "tower:N"},
        {"tower:", "whole number from 1 to 10000"},
        {"tower:0", "whole number from 1 to 10000"},
        {"tower:-3", "whole number"},
        {"tower:10001", "whole number"},
        {"tower:99999999999999999999", "whole number"},
        {"tower:3.5", "whole number"},
        {"tower: 3", "whole number"},
        {"tower:3:4", "too many parts"},
        {"wall:401", "1 to 400"},
        {"heap:100001", "1 to 100000"},
        {"pit:20001", "1 to 20000"},
        {"cradle:1", "2 to 1000"},
        {"cradle:5:5", "1 to 4"},
        {"cradle:5:0", "1 to 4"},
    };
    for (const auto& [name, said] : refused) {
        const std::string message = messageOf([&key = name] { builtInScene(key); });
        EXPECT_NE(message.find(said), std::string::npos) << name << ": " << message;
        EXPECT_NE(message.find(name), std::string::npos) << message;
    }
    EXPECT_TRUE(isBuiltInScene("tower"));
    EXPECT_FALSE(isBuiltInScene("tower.json"));
    EXPECT_FALSE(isBuiltInScene(""));
}

}  // namespace
}  // namespace cairn
