#include "geometry/body_mass.h"

#include <fmt/core.h>

#include <cmath>

#include "geometry/compound_mass.h"
#include "geometry/principal_axes.h"
#include "geometry/shape_entry.h"

namespace cairn {

namespace {

/// A solid whose moments are for some mass, and the mass that it has by itself.
struct Solid {
    UnitMassProperties moments;  ///< for a mass of as many kilograms as its volume says
    double mass;
};

Solid solidOf(const Shape& shape, double density) {
    const auto* compound = std::get_if<Compound>(&shape);
    if (compound == nullptr || compound->solid) {
        const UnitMassProperties unit = unitMassProperties(shape);
        return {unit, density * unit.volume};
    }
    std::vector<PartMass> parts;
    for (const CompoundPart& part : compound->parts) {
        const UnitMassProperties unit = unitMassProperties(part.shape);
        parts.push_back({part.mass.value_or(part.density.value_or(density) * unit.volume), part, unit});
    }
    const UnitMassProperties all = combine(parts);
    return {all, all.volume};
}

}  // namespace

BodyMass bodyMass(const Shape& shape, double density, const GivenMass& given) {
    const auto& [solid, own_mass] = solidOf(shape, density);
    const double mass = given.mass.value_or(own_mass);
    BodyMass result{mass, solid.inertia_volume * (mass / solid.volume), {solid.centre, solid.axes}};
    if (given.centre) {
        const Vec3& c = *given.centre;
        if (!(c.allFinite() && c.cwiseAbs().maxCoeff() <= largest_dimension)) {
            throw InputError(fmt::format("centre_of_mass is ({}, {}, {}) m; it must be finite and within ±{} m", c.x(),
                                         c.y(), c.z(), largest_dimension));
        }
        result.body_in_shape.position = c;
    }
    if (given.inertia) {
        requireInertia(*given.inertia, "kg·m²");
        const PrincipalInertia principal = principalInertia(0.5 * (*given.inertia + given.inertia->transpose()));
        result.inertia = principal.moments;
        result.body_in_shape.orientation = principal.axes;
    }
    return result;
}

}  // namespace cairn
