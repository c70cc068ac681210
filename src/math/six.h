/// @file Linear and angular parts together: three numbers each.
#pragma once

#include <Eigen/Core>

namespace cairn {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

}  // namespace cairn
