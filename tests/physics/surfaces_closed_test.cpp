/// Bodies on boxes and cylinders of triangles: they move as on the planes of their faces, and as on box and cylinder.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cairn/world.h"
#include "surface_maker.h"
#include "surface_motion.h"

namespace cairn {
namespace {

using testing::difference;
using testing::Falling;
using testing::heightOf;
using testing::lying;
using testing::OnSurface;
using testing::PlacedGround;
using testing::Prism;
using testing::Start;

/// A ground as the shape that it is, and as triangles.
struct Twin {
    std::string name;
    PlacedGround plain, triangles;
};

/// Grounds 12 m wide whose tops are the plane z = 0: the face of a box, that of a box on another side and turned, the
/// cap of a cylinder.
const std::vector<Twin>& flatTwins() {
    static const std::vector<Twin> all = [] {
        const Pose below{Vec3(0, 0, -0.5)};
        const Pose on_side{below.position, Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ())) * Quat(0.5, -0.5, -0.5, -0.5)};
        const Vec3 wide(12, 12, 1);
        const Vec3 high(1, 12, 12);
        const Prism prism{6, 1, 120};
        return std::vector<Twin>{
            {"box", {Box{wide}, below}, {testing::fineBoxMesh(wide, {90, 80, 8}, 3), below}},
            {"box on its side", {Box{high}, on_side}, {testing::fineBoxMesh(high, {8, 80, 90}, 4), on_side}},
            {"cap", {Cylinder{prism.radius, prism.length}, below}, {prism.mesh(2, 8, 50, 5), below}}};
    }();
    return all;
}

/// Of a cylinder that lies along y: its top is the middle of a facet, or the line that is as high.
Twin lyingTwin(const Prism& prism) {
    const Pose pose{Vec3(0, 0, -prism.inscribed()), Quat(0.5, -0.5, -0.5, -0.5)};
    return {"side", {Cylinder{prism.inscribed(), prism.length}, pose}, {prism.mesh(3, 100, 3, 6), pose}};
}

/// The contacts of two shapes with another shape may stand in another order, so that the sweeps end elsewhere within
/// their tolerance. They agree where nothing is left of it.
Settings swept() {
    Settings settings = Settings::preset(Preset::accuracy);
    settings.resolution.tolerance = 0;
    settings.resolution.resolution_threshold = 1e-12;
    settings.resolution.iterations = 1e5;
    return settings;
}

Start sliding(const Shape& shape) {
    return {{Vec3(-1.4, -0.3, heightOf(shape))}, Vec3(1.6, 0.7, 0), Vec3::Zero(), 0.05};
}

Start resting(const Shape& shape) {
    return {{Vec3(0.3, -0.2, heightOf(shape) + 0.01), Quat(Eigen::AngleAxisd(0.4, Vec3::UnitZ()))}};
}

Start tumbling() {
    return {{Vec3(-3.5, -1.7, 1), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))},
            Vec3(1.4, 0.7, 0),
            Vec3(3, -4, 2)};
}

double rollingRadius(const Shape& shape) {
    return std::holds_alternative<Sphere>(shape) ? 0.2 : 0.15;
}

Start rolling(const Shape& shape) {
    const double radius = rollingRadius(shape);
    const Vec3 axis = lying() * Vec3::UnitZ();
    const Vec3 v = 1.7 * axis.cross(Vec3::UnitZ());
    return {{Vec3(4, 1.3, radius), lying()}, v, Vec3::UnitZ().cross(v) / radius};
}

std::vector<Shape> roundSolids() {
    return {Sphere{0.2}, Capsule{0.15, 0.3}, Cylinder{0.15, 0.4}};
}

void expectSameForFiveSeconds(const Twin& twin, const Settings& settings) {
    for (const auto& [name, shape] : testing::solids()) {
        if (std::string_view(name) == "compound") continue;
        EXPECT_LT(difference(shape, sliding(shape), twin.plain, twin.triangles, 5, settings), 1e-9)
            << name << " slides on " << twin.name;
        EXPECT_LT(difference(shape, resting(shape), twin.plain, twin.triangles, 5, settings), 1e-9)
            << name << " rests on " << twin.name;
    }
    for (const Shape& shape : roundSolids()) {
        EXPECT_LT(difference(shape, rolling(shape), twin.plain, twin.triangles, 5, settings), 1e-9)
            << shape.index() << " rolls on " << twin.name;
    }
}

void expectSameUntilThirdImpact(const char* name, const Shape& shape, const Start& start, const Twin& twin,
                                double bound) {
    Falling on_plain(twin.plain, shape, start, swept());
    Falling on_triangles(twin.triangles, shape, start, swept());
    while (on_plain.impacts < 3 && on_plain.world.time() < 3) {
        on_plain.step();
        on_triangles.step();
        ASSERT_LE(testing::apart(on_plain, on_triangles), bound)
            << name << " on " << twin.name << ", " << on_plain.world.time() << " s, impact " << on_plain.impacts;
    }
    EXPECT_EQ(on_plain.impacts, 3) << name << " on " << twin.name;
}

TEST(ClosedSurfaces, BodiesMoveAsOnThePlanesOfTheFaces) {
    for (const Twin& twin : flatTwins()) {
        const Twin plane{twin.name, {HalfSpace{}}, twin.triangles};
        expectSameForFiveSeconds(plane, Settings::preset(Preset::accuracy));
        for (const auto& [name, shape] : testing::solids()) {
            testing::expectSameTumbling(name, shape, tumbling(), plane.plain, plane.triangles, 5);
        }
    }
}

TEST(ClosedSurfaces, BodiesSlideRollAndRestAsOnBoxesAndCaps) {
    for (const Twin& twin : flatTwins()) expectSameForFiveSeconds(twin, swept());
}

/// What comes later depends on how impulses are shared by four corners that strike at once, for which there is more
/// than one way: there a box on the face of a box differs from one on its plane, too.
TEST(ClosedSurfaces, BodiesTumbleAsOnBoxesAndCaps) {
    for (const Twin& twin : flatTwins()) {
        for (const auto& [name, shape] : testing::solids()) {
            expectSameUntilThirdImpact(name, shape, tumbling(), twin, 1e-9);
        }
    }
}

TEST(ClosedSurfaces, ABallRollsOverTheEdgeOfABox) {
    const Twin& box = flatTwins().front();
    const Start start{{Vec3(5.4, 0.037, 0.2)}, Vec3(0.8, 0.11, 0), Vec3(-0.55, 4, 0)};
    Falling on_plain(box.plain, Sphere{0.2}, start);
    Falling on_triangles(box.triangles, Sphere{0.2}, start);
    while (on_plain.world.pose(on_plain.body).position.z() > -2 && on_plain.world.time() < 3) {
        on_plain.step();
        on_triangles.step();
        ASSERT_LT(testing::apart(on_plain, on_triangles), 1e-9) << on_plain.world.time();
    }
    EXPECT_LT(on_plain.world.time(), 2);
}

/// Along its axis a triangulated cylinder is as even as the cylinder that touches its facets from inside. (Round bodies
/// that lie across it touch it in one point, which is known to a millionth only.)
TEST(ClosedSurfaces, BodiesSlideRollAndRestAlongACylinder) {
    const Twin twin = lyingTwin({8, 12, 250});
    const auto apart = [&](const Shape& shape, const Start& start) {
        return difference(shape, start, twin.plain, twin.triangles, 5, swept());
    };
    for (const auto& [name, shape] : testing::solids()) {
        if (std::string_view(name) == "hull" || std::string_view(name) == "compound") continue;  // they tumble
        const double height = heightOf(shape);
        EXPECT_LT(apart(shape, {{Vec3(0, -1.5, height)}, Vec3(0, 1.7, 0), Vec3::Zero(), 0.05}), 1e-9)
            << name << " slides";
        EXPECT_LT(apart(shape, {{Vec3(0, 0.2, height)}}), 1e-9) << name << " rests";
    }
    EXPECT_LT(apart(Sphere{0.2}, {{Vec3(0, -4, 0.2)}, Vec3(0, 1.7, 0), Vec3(-8.5, 0, 0)}), 1e-9);
}

/// Of few facets it is the prism that it looks like.
TEST(ClosedSurfaces, BodiesMoveOverFacetsAsOnTheirHull) {
    const Prism prism{3, 12, 24};
    const Pose pose{Vec3(0, 0, -prism.inscribed()), Quat(0.5, -0.5, -0.5, -0.5)};
    const Twin twin{"prism", {ConvexHull(prism.corners()), pose}, {prism.mesh(6, 80, 12, 7), pose}};
    const Start tumbling{{Vec3(0.1, -0.6, 1), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))},
                         Vec3(0.4, 0.5, 0),
                         Vec3(1, -2, 1)};
    const auto apart = [&](const Shape& shape, const Start& start) {
        return difference(shape, start, twin.plain, twin.triangles, 5, swept());
    };
    for (const auto& [name, shape] : testing::solids()) {
        if (std::string_view(name) == "compound") continue;
        const double height = heightOf(shape);
        EXPECT_LT(apart(shape, {{Vec3(0, -1.5, height)}, Vec3(0, 1.7, 0), Vec3::Zero(), 0.05}), 1e-9)
            << name << " slides";
        if (std::string_view(name) != "hull") {  // which tumbles for long
            EXPECT_LT(apart(shape, {{Vec3(0, 0.2, height)}}), 1e-9) << name << " rests";
        }
        // The direction in which the side of a cylinder overlaps an edge is known to the square root of the depth's
        // error.
        expectSameUntilThirdImpact(name, shape, tumbling, twin, std::string_view(name) == "cylinder" ? 1e-5 : 1e-9);
    }
    const Quat across(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));
    for (const Shape& shape : roundSolids()) {
        const double radius = rollingRadius(shape);
        EXPECT_LT(apart(shape, {{Vec3(0, -4, radius), across}, Vec3(0, 1.7, 0), Vec3(-1.7 / radius, 0, 0)}), 1e-9)
            << shape.index() << " rolls";
    }
}

/// Across the edges between its facets a ball rolls down as on the cylinder, as far as they are one.
TEST(ClosedSurfaces, ABallRollsDownACylinderOfManyFacets) {
    const Prism prism{5, 2, 720};
    const Twin twin = lyingTwin(prism);
    const double sagitta = prism.radius - prism.inscribed();
    const Start start{{Vec3(0, 0.03, 0.2)}, Vec3(0.6, 0, 0), Vec3(0, 3, 0)};
    Falling on_plain(twin.plain, Sphere{0.2}, start);
    Falling on_triangles(twin.triangles, Sphere{0.2}, start);
    while (on_plain.world.time() < 1.5) {
        on_plain.step();
        on_triangles.step();
        const Vec3 p = on_plain.world.pose(on_plain.body).position;
        const Vec3 q = on_triangles.world.pose(on_triangles.body).position;
        ASSERT_LT((p - q).norm(), 20 * sagitta) << on_plain.world.time();
        // Whatever the facets do, it stays on them.
        ASSERT_LT((q - twin.triangles.pose.position).cwiseProduct(Vec3(1, 0, 1)).norm(), prism.radius + 0.2 + sagitta);
    }
    EXPECT_GT(on_plain.world.pose(on_plain.body).position.x(), 1.4) << "over about thirty facets";
}

TEST(ClosedSurfaces, SlidingOverThemLosesNoEnergy) {
    Settings settings = swept();  // what is left of the first touch would count, too
    settings.sleep.sleeping = false;
    settings.sleep.damping = 0;
    const Twin side = lyingTwin({8, 12, 250});
    for (const auto& [name, shape] : testing::solids()) {
        if (std::string_view(name) == "hull" || std::string_view(name) == "compound") continue;  // they tumble
        const auto expectKept = [&, name = name, shape = shape](const Twin& twin, const Vec3& from, const Vec3& v) {
            // A capsule lies, since it would not stand for long.
            const bool lies = std::holds_alternative<Capsule>(shape);
            const double height = lies ? 0.15 : heightOf(shape);
            const Quat turn = lies ? Quat::FromTwoVectors(Vec3::UnitZ(), v) : Quat::Identity();
            OnSurface surface(twin.triangles, 0, settings);
            const BodyId id = surface.world.addBody({.shape = shape,
                                                     .material = surface.oak,
                                                     .pose = {from + Vec3(0, 0, height), turn},
                                                     .linear_velocity = v});
            surface.run(5);
            EXPECT_NEAR(surface.world.linearVelocity(id).head<2>().squaredNorm() / v.squaredNorm(), 1, 1e-12)
                << name << " on " << twin.name;
            EXPECT_LT((surface.world.pose(id).position - from - 5 * v).norm(), height + 0.01) << name;
        };
        for (const Twin& twin : flatTwins()) expectKept(twin, Vec3(-4.2, -3.3, 0), Vec3(1.7, 1.4, 0));
        expectKept(side, Vec3(0, -5, 0), Vec3(0, 2, 0));
    }
}

}  // namespace
}  // namespace cairn
