#include "narrow_phase/box_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrow_phase/features.h"

namespace cairn {

namespace {

/// Sine below which two edges count as parallel: their cross product would be rounding. Above it the error of the
/// separation stays below 1e-8 of the size.
constexpr double parallel_sine = 1e-7;

bool findEdgeAxis(const BoxPair& pair, const Mat3& abs_C, double margin, EdgeAxis& best) {
    best.separation = -std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < 3; ++i) {
        const Eigen::Index i1 = (i + 1) % 3;
        const Eigen::Index i2 = (i + 2) % 3;
        for (Eigen::Index j = 0; j < 3; ++j) {
            const Eigen::Index j1 = (j + 1) % 3;
            const Eigen::Index j2 = (j + 2) % 3;
            // Edge i of A × edge j of B has the components 0, −C(i2, j), C(i1, j) in A; its components along B's axes
            // are, up to sign, 0, C(i, j2), C(i, j1).
            const double c1 = pair.C(i1, j);
            const double c2 = pair.C(i2, j);
            const double length_squared = c1 * c1 + c2 * c2;
            if (length_squared < parallel_sine * parallel_sine) continue;
            const double along = pair.t[i2] * c1 - pair.t[i1] * c2;
            const double reach = pair.a[i1] * abs_C(i2, j) + pair.a[i2] * abs_C(i1, j) + pair.b[j1] * abs_C(i, j2) +
                                 pair.b[j2] * abs_C(i, j1);
            const double length = std::sqrt(length_squared);
            const double separation = (std::abs(along) - reach) / length;
            if (!(separation <= margin)) return false;
            if (!(separation > best.separation)) continue;
            const double scale = (along < 0 ? -1 : 1) / length;
            best.edge_a = i;
            best.edge_b = j;
            best.separation = separation;
            best.normal[i] = 0;
            best.normal[i1] = -c2 * scale;
            best.normal[i2] = c1 * scale;
        }
    }
    return true;
}

}  // namespace

bool findAxes(const BoxPair& pair, double margin, BoxAxes& axes) {
    const Mat3 abs_C = pair.C.cwiseAbs();
    const Vec3 of_a = pair.t.cwiseAbs() - pair.a - abs_C * pair.b;
    Eigen::Index axis_a = 0;
    const double best_a = of_a.maxCoeff(&axis_a);
    if (!(best_a <= margin)) return false;
    const Vec3 t_B = pair.C.transpose() * pair.t;
    const Vec3 of_b = t_B.cwiseAbs() - pair.b - abs_C.transpose() * pair.a;
    Eigen::Index axis_b = 0;
    const double best_b = of_b.maxCoeff(&axis_b);
    if (!(best_b <= margin)) return false;
    if (best_b > best_a + faceAxisBonus(best_a, pair.smallest())) {
        // Seen from B, A lies in the direction of −t.
        axes.face = {BoxOwner::b, axis_b, t_B[axis_b] > 0 ? -1.0 : 1.0, best_b};
    } else {
        axes.face = {BoxOwner::a, axis_a, pair.t[axis_a] < 0 ? -1.0 : 1.0, best_a};
    }
    return findEdgeAxis(pair, abs_C, margin, axes.edge);
}

}  // namespace cairn
