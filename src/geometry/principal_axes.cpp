#include "geometry/principal_axes.h"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>

namespace cairn {

PrincipalInertia principalInertia(const Mat3& inertia) {
    constexpr double unevenness = 1e-13;
    const double scale = inertia.diagonal().cwiseAbs().maxCoeff();
    const Vec3 beside(inertia(0, 1), inertia(0, 2), inertia(1, 2));
    if (beside.cwiseAbs().maxCoeff() <= unevenness * scale) return {inertia.diagonal(), Quat::Identity()};
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia / scale);
    Mat3 axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
    return {scale * solver.eigenvalues(), Quat(axes).normalized()};
}

void requireInertia(const Mat3& inertia, std::string_view unit) {
    const auto refuse = [&](std::string_view why) {
        throw InputError(fmt::format("inertia with the moments {}, {}, {} and the products {}, {}, {} {} {}",
                                     inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2),
                                     inertia(1, 2), unit, why));
    };
    if (!inertia.allFinite()) refuse("is not finite");
    const double scale = inertia.cwiseAbs().maxCoeff();
    if (!((inertia - inertia.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * scale)) refuse("must be symmetric");
    const Vec3 moments = principalInertia(inertia).moments;
    if (!(moments.minCoeff() > 0)) refuse("must have principal moments above 0");
    if (!(2 * moments.maxCoeff() <= moments.sum() * (1 + 1e-9))) {
        refuse("is that of no body: no principal moment may be larger than the sum of the other two");
    }
}

}  // namespace cairn
