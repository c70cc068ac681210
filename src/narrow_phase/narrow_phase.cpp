#include "narrow_phase/narrow_phase.h"

#include "narrow_phase/convex_contact.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

namespace {

using Tester = void (*)(const Shape&, const Pose&, const Shape&, const Pose&, double, Manifold&);

template <class S, class T>
using TypedTester = void (*)(const S&, const Pose&, const T&, const Pose&, double, Manifold&);

template <class S, class T, TypedTester<S, T> tester>
void inOrder(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double margin, Manifold& out) {
    tester(*std::get_if<S>(&a), pose_a, *std::get_if<T>(&b), pose_b, margin, out);
}

template <class S, class T, TypedTester<S, T> tester>
void swapped(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double margin, Manifold& out) {
    tester(*std::get_if<S>(&b), pose_b, *std::get_if<T>(&a), pose_a, margin, out);
    out.normal = -out.normal;
}

/// Negative, zero or positive, as x is less than, equal to or greater than y in lexicographic order.
template <class Derived, class Other>
int compare(const Eigen::MatrixBase<Derived>& x, const Eigen::MatrixBase<Other>& y) {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        if (x[i] < y[i]) return -1;
        if (x[i] > y[i]) return 1;
    }
    return 0;
}

Vec3 dimensions(const Sphere& sphere) {
    return {sphere.radius, 0, 0};
}
Vec3 dimensions(const Box& box) {
    return box.size;
}
Vec3 dimensions(const Capsule& capsule) {
    return {capsule.radius, capsule.length, 0};
}
Vec3 dimensions(const Cylinder& cylinder) {
    return {cylinder.radius, cylinder.length, 0};
}

template <class S>
int compareSizes(const S& a, const S& b) {
    return compare(dimensions(a), dimensions(b));
}
int compareSizes(const ConvexHull& a, const ConvexHull& b) {
    const auto p = a.corners();
    const auto q = b.corners();
    if (p.size() != q.size()) return p.size() < q.size() ? -1 : 1;
    int order = 0;
    for (std::size_t i = 0; i < p.size() && order == 0; ++i) order = compare(p[i], q[i]);
    return order;
}

/// Two shapes of one kind are handed to their tester in an order that depends on them alone, so that swapping them
/// cannot change a single bit.
template <class S, TypedTester<S, S> tester>
void canonical(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double margin, Manifold& out) {
    int order = compare(pose_a.position, pose_b.position);
    if (order == 0) order = compareSizes(*std::get_if<S>(&a), *std::get_if<S>(&b));
    if (order == 0) order = compare(pose_a.orientation.coeffs(), pose_b.orientation.coeffs());
    if (order > 0) {
        swapped<S, S, tester>(a, pose_a, b, pose_b, margin, out);
    } else {
        inOrder<S, S, tester>(a, pose_a, b, pose_b, margin, out);
    }
}

/// Two half-spaces are both fixed.
void never(const Shape&, const Pose&, const Shape&, const Pose&, double, Manifold&) {}

/// Testers by the kinds of both shapes.
class TesterTable {
  public:
    template <class S, class T, TypedTester<S, T> tester>
    constexpr void add() {
        set<S, T>(inOrder<S, T, tester>);
        set<T, S>(swapped<S, T, tester>);
    }
    template <class S, TypedTester<S, S> tester>
    constexpr void addSame() {
        set<S, S>(canonical<S, tester>);
    }
    template <class S>
    constexpr void addNever() {
        set<S, S>(never);
    }
    /// Whether every pair has its tester.
    constexpr bool complete() const { return entries_ == kinds * kinds; }
    Tester at(const Shape& a, const Shape& b) const { return testers_[a.index()][b.index()]; }

  private:
    /// Compounds, which meet others by their parts, and surfaces come after them.
    static constexpr std::size_t kinds = 6;
    static_assert(std::is_same_v<std::variant_alternative_t<kinds, Shape>, Compound>);

    template <class S, std::size_t kind = 0>
    static constexpr std::size_t kindOf() {
        if constexpr (std::is_same_v<S, std::variant_alternative_t<kind, Shape>>) {
            return kind;
        } else {
            return kindOf<S, kind + 1>();
        }
    }

    template <class S, class T>
    constexpr void set(Tester tester) {
        testers_[kindOf<S>()][kindOf<T>()] = tester;
        ++entries_;
    }

    std::array<std::array<Tester, kinds>, kinds> testers_{};
    std::size_t entries_ = 0;
};

constexpr TesterTable makeTable() {
    TesterTable table;
    table.addSame<Sphere, sphereSphere>();
    table.add<Sphere, Box, sphereBox>();
    table.add<Sphere, Capsule, sphereCapsule>();
    table.add<Sphere, HalfSpace, sphereHalfSpace>();
    table.addSame<Box, boxBox>();
    table.add<Box, HalfSpace, boxHalfSpace>();
    table.add<Capsule, Box, capsuleBox>();
    table.addSame<Capsule, capsuleCapsule>();
    table.add<Capsule, HalfSpace, capsuleHalfSpace>();
    table.addNever<HalfSpace>();
    table.add<Sphere, Cylinder, sphereCylinder>();
    table.add<Cylinder, Box, convexPair<Cylinder, Box>>();
    table.add<Cylinder, Capsule, convexPair<Cylinder, Capsule>>();
    table.add<Cylinder, HalfSpace, cylinderHalfSpace>();
    table.addSame<Cylinder, convexPair<Cylinder, Cylinder>>();
    table.add<ConvexHull, Sphere, convexPair<ConvexHull, Sphere>>();
    table.add<ConvexHull, Box, convexPair<ConvexHull, Box>>();
    table.add<ConvexHull, Capsule, convexPair<ConvexHull, Capsule>>();
    table.add<ConvexHull, HalfSpace, hullHalfSpace>();
    table.add<ConvexHull, Cylinder, convexPair<ConvexHull, Cylinder>>();
    table.addSame<ConvexHull, convexPair<ConvexHull, ConvexHull>>();
    return table;
}

constexpr TesterTable table = makeTable();
static_assert(table.complete(), "every pair of shapes needs a tester");

}  // namespace

void collide(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b, const Pose& pose_b, double margin,
             Manifold& manifold) {
    manifold.size = 0;
    table.at(shape_a, shape_b)(shape_a, pose_a, shape_b, pose_b, margin, manifold);
}

}  // namespace cairn
