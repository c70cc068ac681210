#include <algorithm>
#include <cmath>
#include <limits>

#include "narrow_phase/box_axes.h"
#include "narrow_phase/features.h"
#include "narrow_phase/pair_testers.h"

namespace cairn {

namespace {

/// Cosine of the angle below which an edge axis points in the direction of a face axis: the face then gives the same
/// direction and more points, and their heights are as honest.
constexpr double aligned_cosine = 0.995;

/// A contact in the frame of one of the boxes.
struct BoxContact {
    Vec3 normal;        ///< from the owner of the frame to the other box
    FacePoints points;  ///< halfway between the surfaces, with distances in place of heights
};

/// The same pair seen from B.
BoxPair reversed(const BoxPair& pair) {
    return {pair.b, pair.a, -(pair.C.transpose() * pair.t), pair.C.transpose()};
}

/// The face of B that looks against a direction.
ConvexPolygon incidentFace(const BoxPair& pair, const Vec3& direction) {
    const Vec3 in_B = pair.C.transpose() * direction;
    Eigen::Index k = 0;
    in_B.cwiseAbs().maxCoeff(&k);
    const Eigen::Index u = (k + 1) % 3;
    const Eigen::Index v = (k + 2) % 3;
    const Vec3 centre = pair.t - std::copysign(pair.b[k], in_B[k]) * pair.C.col(k);
    const Vec3 along_u = pair.b[u] * pair.C.col(u);
    const Vec3 along_v = pair.b[v] * pair.C.col(v);
    ConvexPolygon polygon;
    polygon.add(centre - along_u - along_v);
    polygon.add(centre + along_u - along_v);
    polygon.add(centre + along_u + along_v);
    polygon.add(centre - along_u + along_v);
    return polygon;
}

/// Contact with a face of A: none if no point of B's nearest face is above it within the margin.
void faceContact(const BoxPair& pair, Eigen::Index axis, double sign, double margin, BoxContact& contact) {
    const Eigen::Index u = (axis + 1) % 3;
    const Eigen::Index v = (axis + 2) % 3;
    contact.normal = sign * Vec3::Unit(axis);
    ConvexPolygon incident = incidentFace(pair, contact.normal);
    const std::array<Plane, 4> sides = {Plane{Vec3::Unit(u), pair.a[u]}, Plane{-Vec3::Unit(u), pair.a[u]},
                                        Plane{Vec3::Unit(v), pair.a[v]}, Plane{-Vec3::Unit(v), pair.a[v]}};
    const double edge = 2 * std::min({pair.a[u], pair.a[v], pair.b.minCoeff()});
    contact.points.size = 0;
    collectFaceContact({{contact.normal, pair.a[axis]}, margin, merge_part * edge}, sides, incident, contact.points);
    for (std::size_t i = 0; i < contact.points.size; ++i) {
        FacePoint& point = contact.points.points[i];
        point.point -= 0.5 * point.height * contact.normal;
    }
}

void setSingle(const Vec3& on_a, const Vec3& on_b, double distance, BoxContact& contact) {
    contact.points.size = 1;
    contact.points.points[0] = {0.5 * (on_a + on_b), distance};
}

/// The edge of a box in a direction. @param along its axis
Segment edgeTowards(const Vec3& half, Eigen::Index along, const Vec3& direction) {
    Segment edge;
    for (Eigen::Index k = 0; k < 3; ++k) edge.centre[k] = std::copysign(half[k], direction[k]);
    edge.centre[along] = 0;
    edge.half = half[along] * Vec3::Unit(along);
    return edge;
}

Segment toFrameOfA(const BoxPair& pair, const Segment& in_B) {
    return {pair.t + pair.C * in_B.centre, pair.C * in_B.half};
}

/// Contact of two crossing edges. @return false if the boxes are apart and their edges do not cross
bool edgeContact(const BoxPair& pair, const EdgeAxis& axis, BoxContact& contact) {
    const Vec3 against = -(pair.C.transpose() * axis.normal);
    const Segment edge_a = edgeTowards(pair.a, axis.edge_a, axis.normal);
    const Segment edge_b = toFrameOfA(pair, edgeTowards(pair.b, axis.edge_b, against));
    const SegmentParameters closest = closestOnSegments(edge_a, edge_b);
    const Vec3 on_a = edge_a.at(closest.a);
    const Vec3 on_b = edge_b.at(closest.b);
    if (axis.separation > 0) {
        const Vec3 apart = on_b - on_a;
        const double aside = (apart - apart.dot(axis.normal) * axis.normal).norm();
        if (aside > 1e-6 * pair.smallest()) return false;
    }
    contact.normal = axis.normal;
    setSingle(on_a, on_b, axis.separation, contact);
    return true;
}

/// Closest points of two boxes that are apart.
struct Closest {
    Vec3 on_a = Vec3::Zero();
    Vec3 on_b = Vec3::Zero();
    double squared = std::numeric_limits<double>::infinity();

    void offer(const Vec3& a, const Vec3& b) {
        const double candidate = (a - b).squaredNorm();
        if (!(candidate < squared)) return;
        on_a = a;
        on_b = b;
        squared = candidate;
    }
};

Vec3 corner(const Vec3& half, unsigned index) {
    return {(index & 1U) != 0 ? half.x() : -half.x(), (index & 2U) != 0 ? half.y() : -half.y(),
            (index & 4U) != 0 ? half.z() : -half.z()};
}

/// The edge with a number from 0 to 11: its axis and, in the other two directions, its side.
Segment edgeOf(const Vec3& half, unsigned index) {
    const Eigen::Index along = index / 4;
    Vec3 side = Vec3::Ones();
    if ((index & 1U) != 0) side[(along + 1) % 3] = -1;
    if ((index & 2U) != 0) side[(along + 2) % 3] = -1;
    return edgeTowards(half, along, side);
}

/// Tries every corner against the other box and every pair of edges; needed only where two boxes pass each other
/// within the margin corner to corner or corner to edge.
Closest closestFeatures(const BoxPair& pair) {
    Closest best;
    for (unsigned i = 0; i < 8; ++i) {
        const Vec3 of_b = pair.t + pair.C * corner(pair.b, i);
        best.offer(of_b.cwiseMax(-pair.a).cwiseMin(pair.a), of_b);
        const Vec3 of_a = corner(pair.a, i);
        const Vec3 in_B = pair.C.transpose() * (of_a - pair.t);
        best.offer(of_a, pair.t + pair.C * in_B.cwiseMax(-pair.b).cwiseMin(pair.b));
    }
    for (unsigned i = 0; i < 12; ++i) {
        const Segment edge_a = edgeOf(pair.a, i);
        for (unsigned j = 0; j < 12; ++j) {
            const Segment edge_b = toFrameOfA(pair, edgeOf(pair.b, j));
            const SegmentParameters closest = closestOnSegments(edge_a, edge_b);
            best.offer(edge_a.at(closest.a), edge_b.at(closest.b));
        }
    }
    return best;
}

/// The direction of the best axis, in the frame of A, from A to B.
Vec3 bestDirection(const BoxPair& pair, const BoxAxes& axes) {
    if (axes.edge.separation > axes.face.separation) return axes.edge.normal;
    if (axes.face.owner == BoxOwner::a) return axes.face.sign * Vec3::Unit(axes.face.axis);
    return -axes.face.sign * pair.C.col(axes.face.axis);
}

/// Neither a face nor an edge gave a point. Boxes that are apart pass each other corner to corner or corner to edge;
/// of overlapping ones take the deepest corner.
void cornerContact(const BoxPair& pair, const BoxAxes& axes, double margin, BoxContact& contact) {
    contact.normal = bestDirection(pair, axes);
    const double separation = std::max(axes.face.separation, axes.edge.separation);
    if (separation > 0) {
        const Closest closest = closestFeatures(pair);
        const double distance = std::sqrt(closest.squared);
        if (!(distance <= margin)) return;
        if (distance > 1e-9 * pair.smallest()) contact.normal = (closest.on_b - closest.on_a) / distance;
        setSingle(closest.on_a, closest.on_b, distance, contact);
        return;
    }
    const Vec3 in_B = pair.C.transpose() * contact.normal;
    Vec3 deepest = pair.t;
    for (Eigen::Index k = 0; k < 3; ++k) deepest -= std::copysign(pair.b[k], in_B[k]) * pair.C.col(k);
    setSingle(deepest - separation * contact.normal, deepest, separation, contact);
}

/// Whether a face contact tells how far the boxes are apart. Where they are close beside the face instead, its points
/// are too high.
bool isNearest(const BoxPair& pair, const BoxAxes& axes, const FacePoints& points) {
    const double separation = std::max(axes.face.separation, axes.edge.separation);
    if (separation <= 0 && axes.edge.separation <= axes.face.separation) return points.size > 0;
    const double limit = separation + faceAxisBonus(separation, pair.smallest());
    for (std::size_t i = 0; i < points.size; ++i) {
        if (points.points[i].height <= limit) return true;
    }
    return false;
}

/// The face on the side of an axis that tells more. Where boxes cross with a lever, the separation along the face's own
/// normal is far from what it is where they meet, and may have the other sign.
double signTowards(const FaceAxis& face, const Vec3& face_normal, const Vec3& to_b) {
    const double along = (face.owner == BoxOwner::a ? 1 : -1) * to_b.dot(face_normal);
    return along < 0 ? -1 : 1;
}

/// @return whether the contact was found in the frame of A or of B
BoxOwner findContact(const BoxPair& pair, const BoxAxes& axes, double margin, BoxContact& contact) {
    const FaceAxis& face = axes.face;
    const EdgeAxis& edge = axes.edge;
    const Vec3 face_normal = face.owner == BoxOwner::a ? Vec3(Vec3::Unit(face.axis)) : Vec3(pair.C.col(face.axis));
    const bool face_tells_most = edge.separation <= face.separation + faceAxisBonus(face.separation, pair.smallest());
    if (face_tells_most || std::abs(edge.normal.dot(face_normal)) > aligned_cosine) {
        const double sign = face_tells_most ? face.sign : signTowards(face, face_normal, edge.normal);
        if (face.owner == BoxOwner::a) {
            faceContact(pair, face.axis, sign, margin, contact);
        } else {
            faceContact(reversed(pair), face.axis, sign, margin, contact);
        }
        if (isNearest(pair, axes, contact.points)) return face.owner;
    }
    contact.points.size = 0;
    if (edge.separation <= face.separation || !edgeContact(pair, edge, contact)) {
        cornerContact(pair, axes, margin, contact);
    }
    return BoxOwner::a;
}

}  // namespace

void boxBox(const Box& a, const Pose& pose_a, const Box& b, const Pose& pose_b, double margin, Manifold& manifold) {
    const Vec3 from_a = pose_b.position - pose_a.position;
    const double reach = 0.5 * (a.size.norm() + b.size.norm()) + margin;
    if (!(from_a.squaredNorm() <= reach * reach)) return;
    const Mat3 R_A = pose_a.orientation.toRotationMatrix();
    const Mat3 R_B = pose_b.orientation.toRotationMatrix();
    const BoxPair pair{0.5 * a.size, 0.5 * b.size, R_A.transpose() * from_a, R_A.transpose() * R_B};
    BoxAxes axes;
    if (!findAxes(pair, margin, axes)) return;
    BoxContact contact;
    const BoxOwner owner = findContact(pair, axes, margin, contact);
    const Mat3& R = owner == BoxOwner::a ? R_A : R_B;
    const Vec3& origin = owner == BoxOwner::a ? pose_a.position : pose_b.position;
    manifold.normal = R * (owner == BoxOwner::a ? -contact.normal : contact.normal);
    for (std::size_t i = 0; i < contact.points.size; ++i) {
        const FacePoint& point = contact.points.points[i];
        manifold.add(origin + R * point.point, point.height);
    }
}

}  // namespace cairn
