/// @file The separating axes of two boxes.
#pragma once

#include <algorithm>

#include "cairn/types.h"

namespace cairn {

/// Two boxes in the frame of A.
struct BoxPair {
    Vec3 a;  ///< half extents of A [m]
    Vec3 b;  ///< half extents of B [m]
    Vec3 t;  ///< from A's centre to B's [m, A]
    Mat3 C;  ///< from B's frame to A's

    double smallest() const { return std::min(a.minCoeff(), b.minCoeff()); }
};

enum class BoxOwner { a, b };

/// The best of the six face normals.
struct FaceAxis {
    BoxOwner owner = BoxOwner::a;
    Eigen::Index axis = 0;
    double sign = 1;        ///< of the face, in the owner's frame
    double separation = 0;  ///< of the boxes along the normal [m]; negative = overlap
};

/// The best of the nine cross products of edges.
struct EdgeAxis {
    Eigen::Index edge_a = 0;
    Eigen::Index edge_b = 0;
    Vec3 normal = Vec3::Zero();  ///< unit, from A to B [A]
    double separation = 0;       ///< [m]; −∞ if no two edges differ in direction
};

/// What the separating axis test found.
struct BoxAxes {
    FaceAxis face;
    EdgeAxis edge;
};

/// Tests all 15 axes. Among the face axes those of A are preferred a little, so that nearly equal ones do not take
/// turns. @return false as soon as an axis separates the boxes by more than the margin
bool findAxes(const BoxPair& pair, double margin, BoxAxes& axes);

}  // namespace cairn
