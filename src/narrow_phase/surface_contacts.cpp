// Contacts of a solid shape with a surface of triangles. Everything happens in the frame of the surface.
//
// What stops a body that slides over triangles are contacts that a triangle alone would have and its neighbours do not
// allow. So triangles in one plane are met as one face, by the tester of the shape with the plane, of whose points
// those count that are over a triangle of the face. Only near the border of a face single triangles are asked; from
// them come the points at the border and the contacts with edges and corners, where no neighbour is nearer in the
// direction of the contact.
#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/surface_data.h"
#include "narrow_phase/convex_contact.h"
#include "narrow_phase/parts_near_triangles.h"
#include "narrow_phase/surface_points.h"

namespace cairn {

namespace {

/// 1 − cosine of the angle between the directions of one contact: that of a face, or of an edge found twice.
constexpr double same_direction = 1e-9;

/// Part of the shape within which a point is at an edge or corner of a triangle.
constexpr double at_edge_part = 1e-6;

/// Part of the shape by which points may lie outside the triangles of their face.
constexpr double on_face_part = 1e-9;

/// Part of what the shape is thick by which it is deep in the surface.
constexpr double deep_part = 0.02;

struct SurfaceManifold {
    Manifold manifold;
    bool behind = false;  ///< the middle of the shape is behind the surface

    double deepest() const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < manifold.size; ++i) least = std::min(least, manifold.points[i].distance);
        return least;
    }
};

/// The face as the shape meets it: of a surface of two sides, the one on which the middle of the shape is.
SurfaceFace turnedTo(const SurfaceData& surface, std::uint32_t index, const Vec3& centre) {
    const SurfaceFace& face = surface.faces[index];
    const bool turned = surface.sides == SurfaceSides::two && face.height(centre) < 0;
    return turned ? SurfaceFace{-face.normal, -face.offset} : face;
}

class SurfaceMeeting {
  public:
    SurfaceMeeting(const Shape& shape, const Pose& pose, const SurfaceData& surface, double margin)
        : shape_(shape),
          pose_(pose),
          surface_(surface),
          margin_(margin),
          convex_(convexOf(shape, pose, pose.position)),
          centre_(pose.position + convex_.centre()),
          size_(convex_.reach() + convex_.rounding()),
          near_(boundsOf(shape, pose).grown(margin)) {}

    std::vector<SurfaceManifold>& find();
    /// The same. @param triangles that the shape may be near, all of them
    std::vector<SurfaceManifold>& findAmong(std::span<const std::uint32_t> triangles);

  private:
    void meetTriangles();
    void meetFace(std::span<const std::uint32_t> triangles);
    void addPointsOnFace(const SurfaceFace& face, std::span<const std::uint32_t> triangles);
    void meetTriangle(const SurfaceFace& face, std::uint32_t triangle);
    bool isShallowerElsewhere(const SurfaceFace& face, const ManifoldPoint& point) const;
    void addFace(const SurfaceFace& face, bool behind);
    void meetBall(const Sphere& ball, std::span<const std::uint32_t> triangles);
    void addEdge(const Vec3& normal, const ManifoldPoint& point);
    void meetDeepest();
    Manifold contactWith(const SurfaceFace& face, std::uint32_t triangle) const;
    bool joinFace(const Manifold& edge);
    void dropBehind();
    bool isNearBorder(std::uint32_t triangle) const;
    std::optional<std::uint32_t> triangleAt(const SurfaceFace& face, std::span<const std::uint32_t> triangles,
                                            const Vec3& point) const;

    const Shape& shape_;
    Pose pose_;
    const SurfaceData& surface_;
    double margin_;
    Convex convex_;  ///< with the origin of the shape's frame as its origin
    Vec3 centre_;
    double size_;
    Bounds near_;
    std::vector<std::uint32_t> triangles_;               ///< near the shape, by face
    std::vector<std::span<const std::uint32_t>> faces_;  ///< those of each face
    std::vector<SurfaceManifold> found_;
    std::vector<SurfaceManifold> edges_;  ///< of edges and corners, which follow those
    // Of the face that is met.
    FacePointList over_;      ///< points of the shape over its triangles
    FacePointList beside_;    ///< points that triangles at its border have in its direction
    double least_aside_ = 0;  ///< deepest contact in another direction of a triangle at its border [m]
    bool any_aside_ = false;  ///< whether there is one
};

std::vector<SurfaceManifold>& SurfaceMeeting::find() {
    surface_.tree.forEachOverlapping(near_, [&](std::uint32_t triangle) { triangles_.push_back(triangle); });
    meetTriangles();
    return found_;
}

std::vector<SurfaceManifold>& SurfaceMeeting::findAmong(std::span<const std::uint32_t> triangles) {
    for (const std::uint32_t triangle : triangles) {
        if (near_.overlaps(surface_.boundsOf(triangle))) triangles_.push_back(triangle);
    }
    meetTriangles();
    return found_;
}

void SurfaceMeeting::meetTriangles() {
    std::ranges::sort(triangles_, [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(surface_.face_of[a], a) < std::pair(surface_.face_of[b], b);
    });
    const std::span<const std::uint32_t> all(triangles_);
    for (std::size_t begin = 0; begin < all.size();) {
        std::size_t end = begin + 1;
        while (end < all.size() && surface_.face_of[all[end]] == surface_.face_of[all[begin]]) ++end;
        faces_.push_back(all.subspan(begin, end - begin));
        begin = end;
    }
    const auto* ball = std::get_if<Sphere>(&shape_);
    for (const auto& triangles : faces_) {
        if (ball != nullptr) {
            meetBall(*ball, triangles);
        } else {
            meetFace(triangles);
        }
    }
    for (const SurfaceManifold& edge : edges_) {
        if (!joinFace(edge.manifold)) found_.push_back(edge);
    }
    const auto touches = [](const SurfaceManifold& m) { return m.deepest() <= 0; };
    if (std::ranges::none_of(found_, touches)) meetDeepest();
    dropBehind();
}

void SurfaceMeeting::meetFace(std::span<const std::uint32_t> triangles) {
    const SurfaceFace face = turnedTo(surface_, surface_.face_of[triangles.front()], centre_);
    const bool behind = face.height(centre_) < 0;
    const auto reach = [&](const Vec3& direction) { return face.height(pose_.position + convex_.support(direction)); };
    if (reach(-face.normal) - convex_.rounding() > margin_) return;
    if (behind && reach(face.normal) + convex_.rounding() < 0) return;  // it went through
    over_.clear();
    beside_.clear();
    any_aside_ = false;
    addPointsOnFace(face, triangles);
    for (const std::uint32_t triangle : triangles) {
        if (isNearBorder(triangle)) meetTriangle(face, triangle);
    }
    addFace(face, behind);
}

/// Points of the contact with the plane that are over the face.
void SurfaceMeeting::addPointsOnFace(const SurfaceFace& face, std::span<const std::uint32_t> triangles) {
    Manifold plane;
    collide(shape_, pose_, HalfSpace{face.normal, face.offset}, Pose{}, margin_, plane);
    for (std::size_t i = 0; i < plane.size; ++i) {
        ManifoldPoint& point = plane.points[i];
        const std::optional<std::uint32_t> triangle = triangleAt(face, triangles, point.point);
        if (!triangle) continue;
        point.triangle = *triangle;
        if (!isShallowerElsewhere(face, point)) over_.push_back(point);
    }
}

/// Whether a point that is in the surface is less deep below another face that it is over, too, and that stands back
/// behind this one, as behind an edge that stands out. Between faces that face each other what is round meets both.
bool SurfaceMeeting::isShallowerElsewhere(const SurfaceFace& face, const ManifoldPoint& point) const {
    if (!(point.distance < 0)) return false;
    const Vec3 core = point.point + (0.5 * point.distance + convex_.rounding()) * face.normal;
    for (const auto& triangles : faces_) {
        const SurfaceFace other = turnedTo(surface_, surface_.face_of[triangles.front()], centre_);
        const double height = other.height(core);
        const double distance = height - convex_.rounding();
        const bool shallower = distance < 0 && distance > point.distance + on_face_part * size_;
        if (!shallower || face.height(core - height * other.normal) >= 0) continue;
        if (triangleAt(other, triangles, core)) return true;
    }
    return false;
}

/// @param point above or below the face
std::optional<std::uint32_t> SurfaceMeeting::triangleAt(const SurfaceFace& face,
                                                        std::span<const std::uint32_t> triangles,
                                                        const Vec3& point) const {
    for (const std::uint32_t triangle : triangles) {
        const std::array<Vec3, 3> corners = surface_.corners(triangle);
        const double turn = face.normal.dot((corners[1] - corners[0]).cross(corners[2] - corners[0]));
        bool within = true;
        for (std::size_t k = 0; k < 3 && within; ++k) {
            const Vec3 edge = corners[(k + 1) % 3] - corners[k];
            const double inside = std::copysign(1.0, turn) * face.normal.dot(edge.cross(point - corners[k]));
            within = inside >= -on_face_part * size_ * edge.norm();
        }
        if (within) return triangle;
    }
    return {};
}

bool SurfaceMeeting::isNearBorder(std::uint32_t triangle) const {
    for (std::size_t k = 0; k < 3; ++k) {
        if (!surface_.isBorder(triangle, k)) continue;
        if (meetsSegment(near_, surface_.corner(triangle, k), surface_.corner(triangle, (k + 1) % 3))) return true;
    }
    return false;
}

Manifold SurfaceMeeting::contactWith(const SurfaceFace& face, std::uint32_t triangle) const {
    const std::array<Vec3, 3> corners = surface_.corners(triangle);
    const Vec3& origin = pose_.position;
    ConvexTriangle local{{corners[0] - origin, corners[1] - origin, corners[2] - origin}, face.normal};
    const Vec3 turn = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (turn.dot(face.normal) < 0) std::swap(local.corners[1], local.corners[2]);
    Manifold contact;
    convexContact(convex_, Convex(local), origin, margin_, contact);
    return contact;
}

/// The contact with a single triangle at the border of its face.
void SurfaceMeeting::meetTriangle(const SurfaceFace& face, std::uint32_t triangle) {
    const std::array<Vec3, 3> corners = surface_.corners(triangle);
    Manifold contact = contactWith(face, triangle);
    if (contact.size == 0) return;
    const bool along_face = contact.normal.dot(face.normal) > 1 - same_direction;
    for (std::size_t i = 0; i < contact.size; ++i) {
        ManifoldPoint& point = contact.points[i];
        const Vec3 foot = point.point - 0.5 * point.distance * contact.normal;
        const TriangleFeature feature = featureAt(corners, foot, at_edge_part * size_);
        // At an edge within the face nothing ends: what was cut off there goes on over the next triangle.
        const bool inside = along_face && feature.kind == TriangleFeature::Kind::inside;
        if (!inside && isWithinFace(surface_, triangle, feature)) continue;
        if (along_face) {
            point.triangle = triangle;
            if (!isShallowerElsewhere(face, point)) beside_.push_back(point);
            continue;
        }
        if (!isOutward(surface_, triangle, feature, contact.normal)) continue;
        point.triangle = triangle;
        addEdge(contact.normal, point);
        least_aside_ = any_aside_ ? std::min(least_aside_, point.distance) : point.distance;
        any_aside_ = true;
    }
}

void SurfaceMeeting::addFace(const SurfaceFace& face, bool behind) {
    double deepest = std::numeric_limits<double>::infinity();
    for (const ManifoldPoint& point : over_) deepest = std::min(deepest, point.distance);
    // Of a shape that lies across an edge, corners may be far behind a face that it does not touch at all.
    const bool elsewhere = any_aside_ && least_aside_ > deepest + faceAxisBonus(deepest, convex_.smallest());
    if (elsewhere) over_.clear();
    if (!beside_.empty()) {
        const double together = merge_part * convex_.smallest();
        for (const ManifoldPoint& point : beside_) addApart(over_, point, together);
        keepOutermost(over_, face.normal, together);
    }
    if (over_.empty()) return;
    SurfaceManifold& added = found_.emplace_back();
    added.behind = behind;
    added.manifold.normal = face.normal;
    for (const ManifoldPoint& point : over_) added.manifold.add(point.point, point.distance, point.triangle);
}

/// A ball touches in the nearest point of each triangle.
void SurfaceMeeting::meetBall(const Sphere& ball, std::span<const std::uint32_t> triangles) {
    const SurfaceFace face = turnedTo(surface_, surface_.face_of[triangles.front()], centre_);
    const double height = face.height(centre_);
    if (std::abs(height) > ball.radius + margin_) return;
    bool is_over = false;
    for (const std::uint32_t triangle : triangles) {
        const ClosestOnTriangle closest = closestOnTriangle(surface_.corners(triangle), centre_);
        const Vec3 towards = centre_ - closest.point;
        const double apart = towards.norm();
        if (apart > ball.radius + margin_) continue;
        // Over a corner within the face a neighbour may be nearer.
        const bool across = std::abs(towards.dot(face.normal)) >= (1 - same_direction) * apart;
        if (isWithinFace(surface_, triangle, closest.feature)) {
            if (is_over || !across) continue;
            is_over = true;
            SurfaceManifold& added = found_.emplace_back();
            added.behind = height < 0;
            collide(shape_, pose_, HalfSpace{face.normal, face.offset}, Pose{}, margin_, added.manifold);
            if (added.manifold.size == 0) {
                found_.pop_back();
            } else {
                added.manifold.points[0].triangle = triangle;
            }
            continue;
        }
        if (!(apart > 0)) continue;
        const Vec3 normal = towards / apart;
        if (!isOutward(surface_, triangle, closest.feature, normal)) continue;
        const double distance = apart - ball.radius;
        addEdge(normal, {centre_ - (ball.radius + 0.5 * distance) * normal, distance, triangle});
    }
}

/// A shape that has got deep into triangles that are small beside it may lie with no corner over any of them, and its
/// least overlap with each be aside, where a neighbour contradicts it. It still crosses the surface: it meets the face
/// that it is deepest in.
void SurfaceMeeting::meetDeepest() {
    ManifoldPoint deepest{Vec3::Zero(), -deep_part * convex_.smallest(), 0};
    bool any = false;
    const Bounds touching = near_.grown(-margin_);
    for (const std::uint32_t triangle : triangles_) {
        if (!touching.overlaps(surface_.boundsOf(triangle))) continue;
        const SurfaceFace face = turnedTo(surface_, surface_.face_of[triangle], centre_);
        const Manifold contact = contactWith(face, triangle);
        for (std::size_t i = 0; i < contact.size; ++i) {
            if (!(contact.points[i].distance < deepest.distance)) continue;
            deepest = contact.points[i];
            deepest.triangle = triangle;
            any = true;
        }
    }
    if (!any) return;
    const SurfaceFace face = turnedTo(surface_, surface_.face_of[deepest.triangle], centre_);
    SurfaceManifold& added = found_.emplace_back();
    added.behind = face.height(centre_) < 0;
    added.manifold.normal = face.normal;
    added.manifold.add(deepest.point, deepest.distance, deepest.triangle);
}

/// Takes a contact with an edge or a corner, which all triangles around it may find.
void SurfaceMeeting::addEdge(const Vec3& normal, const ManifoldPoint& point) {
    const double together = merge_part * convex_.smallest();
    SurfaceManifold* place = nullptr;
    for (SurfaceManifold& other : edges_) {
        if (other.manifold.normal.dot(normal) < 1 - same_direction) continue;
        for (std::size_t i = 0; i < other.manifold.size; ++i) {
            if ((other.manifold.points[i].point - point.point).squaredNorm() <= together * together) return;
        }
        if (other.manifold.size < Manifold::capacity) place = &other;
    }
    if (place == nullptr) {
        place = &edges_.emplace_back();
        place->manifold.normal = normal;
    }
    place->behind = place->behind || normal.dot(centre_ - point.point) < 0;
    place->manifold.add(point.point, point.distance, point.triangle);
}

/// Adds contacts with edges to those of a face in whose direction they are. @return false if there is none
bool SurfaceMeeting::joinFace(const Manifold& edge) {
    const double together = merge_part * convex_.smallest();
    const auto heightOf = [&](const ManifoldPoint& p) { return edge.normal.dot(p.point) - 0.5 * p.distance; };
    const auto looks_there = [&](const SurfaceManifold& m) {
        return m.manifold.normal.dot(edge.normal) > 1 - same_direction &&
               std::abs(heightOf(m.manifold.points[0]) - heightOf(edge.points[0])) <= together;
    };
    const auto face = std::ranges::find_if(found_, looks_there);
    if (face == found_.end()) return false;
    Manifold& manifold = face->manifold;
    over_.assign(manifold.points.begin(), manifold.points.begin() + manifold.size);
    for (std::size_t i = 0; i < edge.size; ++i) addApart(over_, edge.points[i], together);
    if (over_.size() > manifold.size) keepOutermost(over_, manifold.normal, together);
    manifold.size = 0;
    for (const ManifoldPoint& point : over_) manifold.add(point.point, point.distance, point.triangle);
    return true;
}

/// What got behind the surface is brought out by the shortest way; where its middle is still in front, the front
/// decides.
void SurfaceMeeting::dropBehind() {
    const auto touches = [](const SurfaceManifold& m) { return !m.behind && m.deepest() <= 0; };
    const bool front = std::ranges::any_of(found_, touches);
    double shallowest = -std::numeric_limits<double>::infinity();
    for (const SurfaceManifold& m : found_) {
        if (m.behind && m.deepest() <= 0) shallowest = std::max(shallowest, m.deepest());
    }
    std::erase_if(found_, [&](const SurfaceManifold& m) { return m.behind && (front || m.deepest() < shallowest); });
}

/// Hands on what was found, in W.
void useFound(std::span<SurfaceManifold> all, const Pose& surface_pose, FunctionRef<void(Manifold&)> use) {
    for (SurfaceManifold& found : all) {
        Manifold& manifold = found.manifold;
        manifold.normal = surface_pose.orientation * manifold.normal;
        for (std::size_t i = 0; i < manifold.size; ++i) {
            manifold.points[i].point = surface_pose.toOuter(manifold.points[i].point);
        }
        use(manifold);
    }
}

}  // namespace

void collideSurface(const SurfacePair& pair, double margin, FunctionRef<void(Manifold&)> use) {
    const Pose pose = pair.surface_pose.inverse().toOuter(pair.pose);
    SurfaceMeeting meeting(pair.shape, pose, pair.surface, margin);
    useFound(meeting.find(), pair.surface_pose, use);
}

void collideParts(const Compound& compound, const Pose& pose, const SurfaceData& surface, const Pose& surface_pose,
                  double margin, FunctionRef<void(Manifold&)> use) {
    const Pose to_surface = surface_pose.inverse();
    const Vec3 farthest = pose.position.cwiseAbs().cwiseMax(surface_pose.position.cwiseAbs());
    const double rounding = 1e-12 * farthest.maxCoeff();
    const std::vector<PartNearTriangle> near =
        partsNearTriangles(compound, to_surface.toOuter(pose), surface, margin + rounding);
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 0; i < near.size();) {
        const CompoundPart& part = compound.parts[near[i].part];
        triangles.clear();
        for (const std::uint32_t index = near[i].part; i < near.size() && near[i].part == index; ++i) {
            triangles.push_back(near[i].triangle);
        }
        SurfaceMeeting meeting(part.shape, to_surface.toOuter(pose.toOuter(part.pose)), surface, margin);
        useFound(meeting.findAmong(triangles), surface_pose, use);
    }
}

}  // namespace cairn
