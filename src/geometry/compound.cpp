#include <fmt/core.h>
#include <algorithm>

#include <cmath>

#include "geometry/bounds_tree.h"
#include "geometry/compound_mass.h"
#include "geometry/principal_axes.h"
#include "geometry/shape_entry.h"

namespace cairn {

namespace {

/// @param name of the number in the message
void requirePositive(const std::optional<double>& value, std::size_t index, std::string_view name) {
    if (!value || (*value > 0 && std::isfinite(*value))) return;
    throw InputError(
        fmt::format("part {} of a compound has the {} {}; it must be finite and above 0", index, name, *value));
}

void validatePart(const CompoundPart& part, std::size_t index) {
    if (!isSolid(part.shape) || std::holds_alternative<Compound>(part.shape)) {
        throw InputError(
            fmt::format("part {} of a compound is a {}; it must be a sphere, box, capsule, cylinder or hull", index,
                        shapeName(part.shape)));
    }
    validateShape(part.shape);
    const Vec3& p = part.pose.position;
    if (!(p.allFinite() && p.cwiseAbs().maxCoeff() <= largest_dimension)) {
        throw InputError(fmt::format("part {} of a compound is at ({}, {}, {}) m; it must be finite and within ±{} m",
                                     index, p.x(), p.y(), p.z(), largest_dimension));
    }
    const double length = part.pose.orientation.coeffs().stableNorm();
    if (!(std::isfinite(length) && length > 1e-6)) {
        throw InputError(fmt::format(
            "the orientation of part {} of a compound has the length {}; a quaternion must be finite and not "
            "zero",
            index, length));
    }
    requirePositive(part.mass, index, "mass");
    requirePositive(part.density, index, "density");
    if (part.mass && part.density) {
        throw InputError(fmt::format("part {} of a compound has a mass and a density; give one of them", index));
    }
}

/// What a compound stands for has all of the mass.
void validateSolid(const Compound& compound) {
    const SolidProperties& solid = *compound.solid;
    if (!(solid.volume > 0 && std::isfinite(solid.volume))) {
        throw InputError(
            fmt::format("the solid of a compound has the volume {} m³; it must be finite and above 0", solid.volume));
    }
    const Vec3& c = solid.centre;
    if (!(c.allFinite() && c.cwiseAbs().maxCoeff() <= largest_dimension)) {
        throw InputError(
            fmt::format("the solid of a compound has its centre at ({}, {}, {}) m; it must be finite and within ±{} m",
                        c.x(), c.y(), c.z(), largest_dimension));
    }
    requireInertia(solid.inertia, "m⁵");
    for (std::size_t i = 0; i < compound.parts.size(); ++i) {
        if (!compound.parts[i].mass && !compound.parts[i].density) continue;
        throw InputError(fmt::format(
            "part {} of a compound has a mass or density, and the compound the mass of a solid; leave one out", i));
    }
}

void validate(const Compound& compound) {
    if (compound.parts.empty()) {
        throw InputError("a compound without parts has no mass; give it at least one part");
    }
    for (std::size_t i = 0; i < compound.parts.size(); ++i) validatePart(compound.parts[i], i);
    if (compound.solid) validateSolid(compound);
}

UnitMassProperties massProperties(const Compound& compound) {
    if (compound.solid) {
        const auto& [volume, centre, inertia] = *compound.solid;
        const PrincipalInertia principal = principalInertia(0.5 * (inertia + inertia.transpose()));
        return {volume, principal.moments, centre, principal.axes};
    }
    std::vector<PartMass> parts;
    for (const CompoundPart& part : compound.parts) {
        const UnitMassProperties unit = unitMassProperties(part.shape);
        parts.push_back({unit.volume, part, unit});
    }
    return combine(parts);
}

double radius(const Compound& compound) {
    const Vec3 centre = massProperties(compound).centre;
    double farthest = 0;
    for (const CompoundPart& part : compound.parts) {
        const Vec3 middle = part.pose.toOuter(unitMassProperties(part.shape).centre);
        farthest = std::max(farthest, (middle - centre).norm() + largestRadius(part.shape));
    }
    return farthest;
}

double innerRadius(const Compound& compound) {
    double thinnest = std::numeric_limits<double>::infinity();
    for (const CompoundPart& part : compound.parts) thinnest = std::min(thinnest, smallestRadius(part.shape));
    return thinnest;
}

/// Compounds of fewer parts are asked part by part.
constexpr std::size_t fewest_for_tree = 8;

/// Asks of many parts only those that may reach farthest along an axis of W.
void includeFarthest(const Compound& compound, const Pose& pose, Bounds& all) {
    const Mat3 turn = pose.orientation.toRotationMatrix();
    const auto include = [&](std::uint32_t part) {
        const CompoundPart& p = compound.parts[part];
        const Bounds bounds = boundsOf(p.shape, pose.toOuter(p.pose));
        all.lower = all.lower.cwiseMin(bounds.lower);
        all.upper = all.upper.cwiseMax(bounds.upper);
    };
    for (Eigen::Index k = 0; k < 3; ++k) {
        const Vec3 axis = turn.row(k);
        // Rounding leaves out nothing.
        const double slack = 1e-12 * std::abs(pose.position[k]);
        const auto middleOf = [&](const Bounds& b) { return pose.position[k] + axis.dot(0.5 * (b.lower + b.upper)); };
        const auto halfOf = [&](const Bounds& b) { return axis.cwiseAbs().dot(0.5 * (b.upper - b.lower)) + slack; };
        compound.tree->forEachWhere([&](const Bounds& b) { return middleOf(b) + halfOf(b) >= all.upper[k]; }, include);
        compound.tree->forEachWhere([&](const Bounds& b) { return middleOf(b) - halfOf(b) <= all.lower[k]; }, include);
    }
}

Bounds bounds(const Compound& compound, const Pose& pose) {
    const Vec3 endless = Vec3::Constant(std::numeric_limits<double>::infinity());
    Bounds all{endless, -endless};
    if (compound.tree) {
        includeFarthest(compound, pose, all);
        return all;
    }
    for (const CompoundPart& part : compound.parts) {
        const Bounds of_part = boundsOf(part.shape, pose.toOuter(part.pose));
        all.lower = all.lower.cwiseMin(of_part.lower);
        all.upper = all.upper.cwiseMax(of_part.upper);
    }
    return all;
}

Vec3 farthest(const Compound& compound, const Vec3& direction) {
    const Vec3 unit = direction.stableNormalized();
    Vec3 best = Vec3::Zero();
    double reach = -std::numeric_limits<double>::infinity();
    for (const CompoundPart& part : compound.parts) {
        const Vec3 point = part.pose.toOuter(support(part.shape, part.pose.orientation.conjugate() * unit));
        if (!(point.dot(unit) > reach)) continue;
        reach = point.dot(unit);
        best = point;
    }
    return best;
}

std::optional<LocalHit> surface(const Compound& compound, const LocalRay& ray) {
    std::optional<LocalHit> best;
    for (std::size_t i = 0; i < compound.parts.size(); ++i) {
        const std::optional<LocalHit> hit = castRay(compound.parts[i], ray);
        if (!hit || (best && best->distance <= hit->distance)) continue;
        best = hit;
        best->part = static_cast<std::uint32_t>(i);
    }
    return best;
}

constexpr ShapeEntry compound_entry =
    finiteShapeEntry<Compound, validate, massProperties, radius, innerRadius, bounds, surface, farthest>("compound");

/// Centre of mass of a part in the frame of the compound. @param p whose quaternion may have any length
Vec3 centreOf(const PartMass& p) {
    return p.part.pose.position + p.part.pose.orientation.normalized() * p.unit.centre;
}

}  // namespace

std::optional<LocalHit> castRay(const CompoundPart& part, const LocalRay& ray) {
    const Quat back = part.pose.orientation.conjugate();
    std::optional<LocalHit> hit = castRay(part.shape, {part.pose.toInner(ray.origin), back * ray.direction});
    if (hit) hit->normal = part.pose.orientation * hit->normal;
    return hit;
}

void indexParts(Shape& shape) {
    auto* compound = std::get_if<Compound>(&shape);
    if (compound == nullptr) return;
    compound->tree.reset();
    if (compound->parts.size() < fewest_for_tree) return;
    std::vector<Bounds> bounds;
    for (const CompoundPart& part : compound->parts) bounds.push_back(widened(boundsOf(part.shape, part.pose)));
    auto tree = std::make_shared<BoundsTree>();
    tree->build(bounds);
    compound->tree = std::move(tree);
}

Bounds widened(const Bounds& bounds) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Vec3 most = bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs());
    // Bounds without an end have no size that could be rounded.
    const Vec3 slack = most.unaryExpr([](double x) { return x < infinity ? 1e-9 * x : 0.0; });
    return {bounds.lower - slack, bounds.upper + slack};
}

UnitMassProperties combine(std::span<const PartMass> parts) {
    double mass = 0;
    Vec3 moment = Vec3::Zero();
    for (const PartMass& p : parts) {
        mass += p.mass;
        moment += p.mass * centreOf(p);
    }
    const Vec3 centre = moment / mass;
    Mat3 inertia = Mat3::Zero();
    for (const PartMass& p : parts) {
        const Mat3 axes = (p.part.pose.orientation.normalized() * p.unit.axes).toRotationMatrix();
        const Vec3 own = p.mass / p.unit.volume * p.unit.inertia_volume;
        const Vec3 from = centreOf(p) - centre;
        inertia += axes * own.asDiagonal() * axes.transpose() +
                   p.mass * (from.squaredNorm() * Mat3::Identity() - from * from.transpose());  // Steiner
    }
    const PrincipalInertia principal = principalInertia(inertia);
    return {mass, principal.moments, centre, principal.axes};
}

const ShapeEntry& compoundEntry() {
    return compound_entry;
}

}  // namespace cairn
