/// @file Every pair of shapes, touching in many poses.
#include <fmt/format.h>

#include <memory>

#include "kernel.h"
#include "narrow_phase/narrow_phase.h"

namespace cairn::kernels {

namespace {

constexpr std::size_t poses = 1024;
constexpr double overlap = 1e-3;  ///< [m]
constexpr double far = 4;         ///< no two of the shapes reach so far [m]
constexpr double margin = 1e-4;   ///< [m]

/// Two posed shapes that overlap a little.
struct Touch {
    Pose a;
    Pose b;
};

/// Corners of a rounded stone.
ConvexHull stone() {
    Random random(7);
    std::vector<Vec3> points;
    for (int i = 0; i < 24; ++i) points.emplace_back(0.5 * random.direction());
    return ConvexHull(std::move(points));
}

std::vector<Shape> shapes() {
    Compound dumbbell;
    dumbbell.parts.push_back({Sphere{0.3}, {Vec3(0, 0, -0.5), Quat::Identity()}});
    dumbbell.parts.push_back({Box{{0.2, 0.2, 1}}, {}});
    dumbbell.parts.push_back({Sphere{0.3}, {Vec3(0, 0, 0.5), Quat::Identity()}});
    return {Sphere{0.5}, Box{{1, 0.8, 0.6}}, Capsule{0.3, 0.6}, HalfSpace{}, Cylinder{0.4, 0.8}, stone(), dumbbell};
}

bool touches(const Shape& a, const Shape& b, const Touch& at) {
    Manifold manifold;
    bool found = false;
    forEachManifold(a, at.a, b, at.b, 0, manifold, [&](const Manifold&) { found = true; });
    return found;
}

/// Moves A away from B until they hardly touch, then back by the overlap.
Touch makeTouch(const Shape& a, const Shape& b, Random& random) {
    const bool on_plane = isInfinite(b);
    Touch at;
    at.a.orientation = random.orientation();
    if (!on_plane) at.b.orientation = random.orientation();
    const Vec3 direction = on_plane ? Vec3(Vec3::UnitZ()) : random.direction();
    double inside = 0;
    double outside = far;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (inside + outside);
        at.a.position = middle * direction;
        (touches(a, b, at) ? inside : outside) = middle;
    }
    at.a.position = (inside - overlap) * direction;
    return at;
}

Pass pairPass(const Shape& a, const Shape& b) {
    Random random(11);
    std::vector<Touch> touching;
    for (std::size_t i = 0; i < poses; ++i) touching.push_back(makeTouch(a, b, random));
    Pass pass;
    pass.items = poses;
    pass.prepare = [] {};
    pass.run = [a, b, touching = std::move(touching)] {
        std::size_t points = 0;
        Manifold manifold;
        for (const Touch& at : touching) {
            forEachManifold(a, at.a, b, at.b, margin, manifold, [&](const Manifold& found) { points += found.size; });
        }
        keep(points);
    };
    return pass;
}

}  // namespace

std::vector<Kernel> narrowPhaseKernels() {
    std::vector<Kernel> kernels;
    const std::vector<Shape> all = shapes();
    for (const Shape& a : all) {
        for (const Shape& b : all) {
            // A half-space stands second, and never against another.
            const bool once = isInfinite(b) ? !isInfinite(a) : !isInfinite(a) && a.index() <= b.index();
            if (!once) continue;
            kernels.push_back({fmt::format("narrow_phase/{}_{}", shapeName(a), shapeName(b)), "pair",
                               [a, b] { return pairPass(a, b); }});
        }
    }
    return kernels;
}

}  // namespace cairn::kernels
