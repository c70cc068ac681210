/// Compounds and jointed bodies that fly low against a ridge of triangles which is narrower than their way in a step.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <vector>

#include "cairn/world.h"
#include "surface_maker.h"

namespace cairn {
namespace {

using testing::Random;

constexpr double ridge_height = 0.16;

/// A ridge along y on a plane. What flies low has its nearest point on the plane, or on the valley at the ridge's foot,
/// where nothing can touch.
Mesh ridge() {
    constexpr std::array x = {-9.0, -0.125, 0.0, 0.125, 9.0};
    constexpr std::array z = {0.0, 0.0, ridge_height, 0.0, 0.0};
    std::vector<Vec3> vertices;
    std::vector<TriangleCorners> triangles;
    for (std::uint32_t j = 0; j <= 20; ++j) {
        for (std::size_t i = 0; i < 5; ++i) vertices.emplace_back(x[i], 0.4 * j - 4, z[i]);
        if (j == 0) continue;
        for (std::uint32_t a = 5 * (j - 1); a < 5 * j - 1; ++a) {
            triangles.push_back({a, a + 1, a + 6});
            triangles.push_back({a, a + 6, a + 5});
        }
    }
    return Mesh(vertices, triangles);
}

/// Makes something about a place that flies as it says.
using Thrown = std::function<std::vector<BodyId>(World& world, const BodyDescription& at)>;

/// Bodies in a row that a joint holds together.
Thrown joined(JointKind kind, const Shape& shape, int count) {
    return [=](World& world, const BodyDescription& at) {
        std::vector<BodyId> bodies;
        for (int i = 0; i < count; ++i) {
            BodyDescription d = at;
            d.shape = shape;
            d.pose.position += at.pose.orientation * Vec3(0, 0.2 * i - 0.1 * (count - 1), 0);
            bodies.push_back(world.addBody(d));
            if (i == 0) continue;
            JointDescription joint;
            joint.kind = kind;
            joint.a = bodies[bodies.size() - 2];
            joint.b = bodies.back();
            joint.anchor = d.pose.position - at.pose.orientation * Vec3(0, 0.1, 0);
            joint.axis = at.pose.orientation * Vec3::UnitZ();
            world.addJoint(joint);
        }
        return bodies;
    };
}

/// A bar of small parts.
Compound bar() {
    Compound made;
    for (int i = 0; i < 4; ++i) made.parts.push_back({Box{{0.08, 0.16, 0.08}}, {Vec3(0, 0.16 * i - 0.24, 0)}, {}, {}});
    made.parts.push_back({Sphere{0.05}, {Vec3(0, 0.37, 0)}, {}, {}});
    return made;
}

/// Nobody passes under the top of the ridge.
/// @param before it, where they begin: a step leads them 0.63 to 0.7 m on [m]
void expectStopped(const char* name, double before, const Thrown& thrown) {
    const Mesh ground = ridge();
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Settings settings = Settings::preset(Preset::performance, 60);
        settings.sleep.sleeping = false;
        World world(settings);
        const MaterialId oak = world.addMaterial({"oak", 800});
        world.setDefaultPairProperties({0.1, 0.3, 0.3});
        world.setGravity(Vec3(0, 0, -10));
        world.addBody({.shape = ground, .material = oak, .fixed = true});
        Random random(seed);
        BodyDescription at;
        at.material = oak;
        at.pose = {Vec3(random.uniform(-before, 0.15 - before), random.uniform(-1, 1), 0.075),
                   Quat(Eigen::AngleAxisd(random.uniform(-0.3, 0.3), Vec3::UnitZ()))};
        at.linear_velocity = Vec3(random.uniform(38, 42), random.uniform(-3, 3), 0);
        const std::vector<BodyId> bodies = thrown(world, at);
        std::vector<Vec3> last;
        for (const BodyId body : bodies) last.push_back(world.pose(body).position);
        for (int step = 0; step < 10; ++step) {
            world.step();
            for (std::size_t i = 0; i < bodies.size(); ++i) {
                const Vec3 p = world.pose(bodies[i]).position;
                if (last[i].x() < 0 && p.x() > 0) {
                    const double over = last[i].z() - (p.z() - last[i].z()) * last[i].x() / (p.x() - last[i].x());
                    ASSERT_GT(over, ridge_height) << name << ", seed " << seed << ", step " << step;
                }
                last[i] = p;
            }
        }
    }
}

/// They come to the ridge in the step in which they were thrown, or in the second one.
void expectStopped(const char* name, const Thrown& thrown) {
    expectStopped(name, 0.65, thrown);
    expectStopped(name, 1.25, thrown);
}

TEST(NarrowRidge, StopsCompounds) {
    expectStopped("bar", [](World& world, const BodyDescription& at) {
        BodyDescription d = at;
        d.shape = bar();
        return std::vector<BodyId>{world.addBody(d)};
    });
}

TEST(NarrowRidge, StopsJointedBodies) {
    const Box box{{0.08, 0.16, 0.1}};
    expectStopped("hinge", joined(JointKind::hinge, box, 2));
    expectStopped("ball", joined(JointKind::ball, Sphere{0.06}, 3));
    expectStopped("fixed", joined(JointKind::fixed, Capsule{0.05, 0.08}, 3));
    expectStopped("slider", joined(JointKind::slider, box, 2));
}

}  // namespace
}  // namespace cairn
