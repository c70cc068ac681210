#include <algorithm>
#include <cmath>
#include <limits>

#include "math/tolerances.h"
#include "narrow_phase/features.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

namespace {

/// Cosine of the largest angle between the direction of contact and a face that is taken for contact with the face.
constexpr double face_cosine = 0.999;

/// The axis of a capsule in the frame of a box.
struct AxisInBox {
    Segment axis;
    double radius;
    Vec3 half;  ///< extents of the box
    double margin;
};

/// A contact in the frame of the box, its normal outward.
struct Found {
    Vec3 normal;
    FacePoints points;  ///< halfway between the surfaces, with distances in place of heights
};

/// The parameter of the point of the axis closest to the box. Half the derivative of the squared distance,
/// Σ half_i·excess_i(s), grows with s and is linear between the places where the axis crosses a face plane.
double closestToBox(const AxisInBox& in) {
    const Segment& axis = in.axis;
    const auto slope = [&](double s) {
        const Vec3 p = axis.at(s);
        return axis.half.dot(p - p.cwiseMax(-in.half).cwiseMin(in.half));
    };
    double lower = -1;
    double upper = 1;
    double slope_lower = slope(lower);
    double slope_upper = slope(upper);
    if (slope_lower >= 0) return lower;
    if (slope_upper <= 0) return upper;
    for (Eigen::Index i = 0; i < 3; ++i) {
        for (const double face : {-in.half[i], in.half[i]}) {
            const double crossing = (face - axis.centre[i]) / axis.half[i];
            if (!(crossing > lower && crossing < upper)) continue;
            const double slope_here = slope(crossing);
            (slope_here < 0 ? lower : upper) = crossing;
            (slope_here < 0 ? slope_lower : slope_upper) = slope_here;
        }
    }
    return lower + (upper - lower) * slope_lower / (slope_lower - slope_upper);
}

/// The ends of the part of the axis above a face of the box.
void addFace(const AxisInBox& in, Eigen::Index face, double sign, Found& found) {
    double lower = -1;
    double upper = 1;
    for (const Eigen::Index side : {(face + 1) % 3, (face + 2) % 3}) {
        const double centre = in.axis.centre[side];
        const double half = in.axis.half[side];
        if (std::abs(half) <= tiny_length) continue;  // the axis stays on one side
        const double to_lower = (-in.half[side] - centre) / half;
        const double to_upper = (in.half[side] - centre) / half;
        lower = std::max(lower, std::min(to_lower, to_upper));
        upper = std::min(upper, std::max(to_lower, to_upper));
    }
    if (!(lower <= upper)) return;
    const double edge = std::min({in.half[(face + 1) % 3], in.half[(face + 2) % 3], in.axis.half.norm()});
    found.normal = sign * Vec3::Unit(face);
    FacePoints ends;
    const FaceCollector collector{{found.normal, in.half[face] + in.radius}, in.margin, 2 * merge_part * edge};
    collector.add(in.axis.at(lower), ends);
    collector.add(in.axis.at(upper), ends);
    for (std::size_t i = 0; i < ends.size; ++i) {
        const FacePoint& end = ends.points[i];
        ends.points[i].point -= (in.radius + 0.5 * end.height) * found.normal;
    }
    found.points = ends;
}

void setSingle(const Vec3& on_box, double distance, Found& found) {
    found.points.size = 1;
    found.points.points[0] = {on_box + 0.5 * distance * found.normal, distance};
}

/// The axis passes outside the box.
void addOutside(const AxisInBox& in, const Vec3& on_box, const Vec3& outward, double outside, Found& found) {
    const Vec3 normal = outward / outside;
    Eigen::Index face = 0;
    if (normal.cwiseAbs().maxCoeff(&face) > face_cosine) {
        addFace(in, face, normal[face] < 0 ? -1 : 1, found);
        if (found.points.size == 2) return;
    }
    found.normal = normal;
    setSingle(on_box, outside - in.radius, found);
}

/// The axis enters the box: out along the axis of least overlap, of the faces or of an edge and the capsule's axis.
void addPiercing(const AxisInBox& in, Found& found) {
    const Segment& axis = in.axis;
    Eigen::Index face = 0;
    const double face_separation = (axis.centre.cwiseAbs() - axis.half.cwiseAbs() - in.half).maxCoeff(&face);
    double edge_separation = -std::numeric_limits<double>::infinity();
    Vec3 edge_normal = Vec3::Zero();
    Eigen::Index edge = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
        const Vec3 across = Vec3::Unit(i).cross(axis.half);
        const double length = across.norm();
        if (length <= 1e-7 * axis.half.norm()) continue;
        const double along = axis.centre.dot(across);
        const double separation = (std::abs(along) - in.half.dot(across.cwiseAbs())) / length;
        if (!(separation > edge_separation)) continue;
        edge_separation = separation;
        edge_normal = (along < 0 ? -1 : 1) * across / length;
        edge = i;
    }
    if (edge_separation <= face_separation + faceAxisBonus(face_separation, in.half.minCoeff())) {
        addFace(in, face, axis.centre[face] < 0 ? -1 : 1, found);
        if (found.points.size > 0) return;
    }
    Segment box_edge;
    for (Eigen::Index i = 0; i < 3; ++i) box_edge.centre[i] = std::copysign(in.half[i], edge_normal[i]);
    box_edge.centre[edge] = 0;
    box_edge.half = in.half[edge] * Vec3::Unit(edge);
    const SegmentParameters closest = closestOnSegments(axis, box_edge);
    const double distance = edge_separation - in.radius;
    found.normal = edge_normal;
    setSingle(axis.at(closest.a) - (in.radius + distance) * edge_normal, distance, found);
}

}  // namespace

void capsuleBox(const Capsule& a, const Pose& pose_a, const Box& b, const Pose& pose_b, double margin,
                Manifold& manifold) {
    const Mat3 R = pose_b.orientation.toRotationMatrix();
    const Vec3 axis = pose_a.orientation * Vec3::UnitZ();
    const AxisInBox in{{R.transpose() * (pose_a.position - pose_b.position), 0.5 * a.length * (R.transpose() * axis)},
                       a.radius,
                       0.5 * b.size,
                       margin};
    const double limit = a.radius + margin;
    const Vec3 gap = in.axis.centre.cwiseAbs() - in.axis.half.cwiseAbs() - in.half;
    if (!(gap.maxCoeff() <= limit)) return;
    const Vec3 on_axis = in.axis.at(closestToBox(in));
    const Vec3 on_box = on_axis.cwiseMax(-in.half).cwiseMin(in.half);
    const double outside = (on_axis - on_box).norm();
    if (!(outside <= limit)) return;
    Found found;
    found.points.size = 0;
    if (outside > tiny_length * (1 + in.half.maxCoeff() + a.length)) {
        addOutside(in, on_box, on_axis - on_box, outside, found);
    } else {
        addPiercing(in, found);
    }
    manifold.normal = R * found.normal;
    for (std::size_t i = 0; i < found.points.size; ++i) {
        const FacePoint& point = found.points.points[i];
        manifold.add(pose_b.position + R * point.point, point.height);
    }
}

}  // namespace cairn
