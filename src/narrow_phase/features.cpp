#include "narrow_phase/features.h"

#include <algorithm>
#include <cmath>

namespace cairn {

double closestOnSegment(const Segment& segment, const Vec3& p) {
    const double squared = segment.half.squaredNorm();
    if (!(squared > 0)) return 0;
    return std::clamp((p - segment.centre).dot(segment.half) / squared, -1.0, 1.0);
}

SegmentParameters closestOnSegments(const Segment& a, const Segment& b) {
    const Vec3 r = a.centre - b.centre;
    const double aa = a.half.squaredNorm();
    const double bb = b.half.squaredNorm();
    const double ab = a.half.dot(b.half);
    const double ar = a.half.dot(r);
    const double br = b.half.dot(r);
    // |r + s·a − t·b|² has its smallest value on the infinite lines at this s; for parallel lines every s will do.
    const double determinant = aa * bb - ab * ab;
    double s = 0;
    if (determinant > 1e-14 * aa * bb) s = std::clamp((ab * br - bb * ar) / determinant, -1.0, 1.0);
    const double t = (ab * s + br) / bb;
    if (t >= -1 && t <= 1) return {s, t};
    const double end = t < 0 ? -1.0 : 1.0;
    return {std::clamp((ab * end - ar) / aa, -1.0, 1.0), end};
}

void clip(ConvexPolygon& polygon, const Plane& plane, double slack) {
    std::array<double, ConvexPolygon::capacity> height;
    bool cut = false;
    for (std::size_t i = 0; i < polygon.size; ++i) {
        height[i] = plane.height(polygon.corners[i]);
        cut = cut || height[i] > slack;
    }
    if (!cut) return;
    ConvexPolygon kept;
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const std::size_t next = i + 1 < polygon.size ? i + 1 : 0;
        const bool inside = height[i] <= slack;
        if (inside) kept.add(polygon.corners[i]);
        if (inside == (height[next] <= slack)) continue;
        const double part = std::clamp(height[i] / (height[i] - height[next]), 0.0, 1.0);
        kept.add(polygon.corners[i] + part * (polygon.corners[next] - polygon.corners[i]));
    }
    polygon.size = kept.size;
    std::copy_n(kept.corners.begin(), kept.size, polygon.corners.begin());
}

void FaceCollector::add(const Vec3& point, FacePoints& points) const {
    const double height = face.height(point);
    if (!(height <= margin)) return;
    for (std::size_t i = 0; i < points.size; ++i) {
        FacePoint& other = points.points[i];
        const Vec3 apart = point - other.point;
        const double rise = height - other.height;
        if (apart.squaredNorm() - rise * rise > merge_distance * merge_distance) continue;
        if (rise < 0) other = {point, height};
        return;
    }
    points.points[points.size++] = {point, height};
}

void simplify(ConvexPolygon& polygon, const Plane& face, double tolerance) {
    for (std::size_t i = 0; i < polygon.size && polygon.size > 2;) {
        const Vec3& before = polygon.corners[i > 0 ? i - 1 : polygon.size - 1];
        const Vec3& corner = polygon.corners[i];
        const Vec3& after = polygon.corners[i + 1 < polygon.size ? i + 1 : 0];
        const Segment chord{0.5 * (before + after), 0.5 * (after - before)};
        const double beside = (corner - chord.at(closestOnSegment(chord, corner))).squaredNorm();
        const double lower = std::min(face.height(before), face.height(after)) - face.height(corner);
        if (beside > tolerance * tolerance || lower > 1e-3 * tolerance) {
            ++i;
            continue;
        }
        std::copy(polygon.corners.begin() + i + 1, polygon.corners.begin() + polygon.size, polygon.corners.begin() + i);
        --polygon.size;
    }
}

void collectFaceContact(const FaceCollector& collector, std::span<const Plane> sides, ConvexPolygon& incident,
                        FacePoints& points) {
    const double slack = 1e-6 * collector.merge_distance;
    const std::size_t corners = incident.size;
    for (const Plane& side : sides) clip(incident, side, slack);
    if (incident.size > corners) simplify(incident, collector.face, collector.merge_distance);
    for (std::size_t i = 0; i < incident.size; ++i) collector.add(incident.corners[i], points);
}

double faceAxisBonus(double face_separation, double size) {
    return 0.02 * std::abs(face_separation) + 1e-3 * size;
}

}  // namespace cairn
