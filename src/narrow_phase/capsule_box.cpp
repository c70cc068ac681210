#include <algorithm>
#include <cmath>
#include <limits>

#include "math/tolerances.h"
#include "narrow_phase/features.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

namespace {

/// Sine of the largest angle between the axis and a face or edge on which a capsule can lie.
constexpr double lying_sine = 0.1;

/// Largest component across a face or edge of the direction of contact with it.
constexpr double across_part = 0.05;

/// How much farther apart than the closest points the nearer end of a lying capsule may be, as a part of its length.
constexpr double lying_part = 1e-5;

/// How far beside the direction of contact an end of a lying capsule may have its closest points, beyond the margin, as
/// a part of the overlap.
constexpr double beside_part = 0.1;

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

/// A part of the axis, by its parameters.
struct Part {
    double lower = -1;
    double upper = 1;

    /// Cuts away what is not between two opposite faces of the box.
    void cut(const AxisInBox& in, Eigen::Index side) {
        const double centre = in.axis.centre[side];
        const double half = in.axis.half[side];
        if (std::abs(half) <= tiny_part * in.axis.half.norm()) {
            if (std::abs(centre) > in.half[side]) upper = lower;  // all of it is on one side
            return;
        }
        const double to_lower = (-in.half[side] - centre) / half;
        const double to_upper = (in.half[side] - centre) / half;
        lower = std::max(lower, std::min(to_lower, to_upper));
        upper = std::min(upper, std::max(to_lower, to_upper));
    }
};

void setSingle(const Vec3& on_box, double distance, Found& found) {
    found.points.size = 1;
    found.points.points[0] = {on_box + 0.5 * distance * found.normal, distance};
}

/// A capsule that lies on a face or along an edge touches at both ends of the part beside it, if both ends are within
/// the margin. No end can be nearer, along the direction of contact, than the closest points. @return whether it lies
bool addLying(const AxisInBox& in, double closest, Found& found) {
    const double length = in.axis.half.norm();
    if (std::abs(in.axis.half.dot(found.normal)) > lying_sine * length) return false;
    Part part;
    int sides = 0;
    Eigen::Index along = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
        if (std::abs(found.normal[i]) > across_part) continue;
        part.cut(in, i);
        along = i;
        ++sides;
    }
    const double straight = (1 - lying_sine * lying_sine) * length * length;
    if (sides == 0 || (sides == 1 && in.axis.half[along] * in.axis.half[along] < straight)) return false;
    if ((part.upper - part.lower) * length <= 2 * merge_part * std::min(length, in.half[along])) return false;
    const double limit = in.radius + in.margin;
    double nearest = limit;
    found.points.size = 0;
    for (const double end : {part.lower, part.upper}) {
        const Vec3 on_axis = in.axis.at(end);
        const Vec3 on_box = on_axis.cwiseMax(-in.half).cwiseMin(in.half);
        if (!((on_axis - on_box).squaredNorm() <= limit * limit)) return false;
        const double apart = (on_axis - on_box).dot(found.normal);
        const double distance = apart - in.radius;
        const double beside = in.margin + beside_part * std::max(0.0, -distance);
        if ((on_axis - on_box - apart * found.normal).squaredNorm() > beside * beside) return false;
        nearest = std::min(nearest, distance);
        found.points.points[found.points.size++] = {0.5 * (on_axis + on_box - in.radius * found.normal), distance};
    }
    return nearest <= closest + lying_part * (in.radius + length);
}

/// The axis passes outside the box.
void addOutside(const AxisInBox& in, const Vec3& on_box, const Vec3& outward, double outside, Found& found) {
    found.normal = outward / outside;
    const double distance = outside - in.radius;
    if (!addLying(in, distance, found)) setSingle(on_box, distance, found);
}

/// The ends of the part of the axis between the sides of a face of the box.
void addFace(const AxisInBox& in, Eigen::Index face, double sign, Found& found) {
    const Eigen::Index u = (face + 1) % 3;
    const Eigen::Index v = (face + 2) % 3;
    Part part;
    part.cut(in, u);
    part.cut(in, v);
    found.normal = sign * Vec3::Unit(face);
    found.points.size = 0;
    if (!(part.lower < part.upper)) return;
    const double edge = std::min({in.half[u], in.half[v], in.axis.half.norm()});
    const FaceCollector collector{{found.normal, in.half[face] + in.radius}, in.margin, 2 * merge_part * edge};
    collector.add(in.axis.at(part.lower), found.points);
    collector.add(in.axis.at(part.upper), found.points);
    for (std::size_t i = 0; i < found.points.size; ++i) {
        FacePoint& end = found.points.points[i];
        end.point -= (in.radius + 0.5 * end.height) * found.normal;
    }
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
    if (outside > tiny_part * (in.half.maxCoeff() + a.length)) {
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
