#include "geometry/principal_axes.h"

#include <Eigen/Eigenvalues>

namespace cairn {

PrincipalInertia principalInertia(const Mat3& inertia) {
    constexpr double rounding = 1e-13;
    const double scale = inertia.diagonal().cwiseAbs().maxCoeff();
    const Vec3 beside(inertia(0, 1), inertia(0, 2), inertia(1, 2));
    if (beside.cwiseAbs().maxCoeff() <= rounding * scale) return {inertia.diagonal(), Quat::Identity()};
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia / scale);
    Mat3 axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
    return {scale * solver.eigenvalues(), Quat(axes).normalized()};
}

}  // namespace cairn
