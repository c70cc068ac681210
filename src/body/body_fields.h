/// @file The one list of a body's fields. Storage, growth, reset, snapshots and rollback follow it; so a new field is a
/// member of BodyArrays and a row of body_fields.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "body/field_array.h"
#include "cairn/bodies.h"
#include "cairn/events.h"
#include "cairn/shape.h"
#include "cairn/types.h"

namespace cairn {

/// Index of a body's slot.
using BodyIndex = std::uint32_t;

/// What acts on the bodies of a batch besides gravity.
enum class Load : std::uint8_t {
    none,
    carried,  ///< moving fixed bodies
    pulled    ///< forces, of users, springs and joints, or drag
};

/// Structure of arrays with one entry per slot; a hole's entries are those of its last body, its kind is hole.
struct BodyArrays {
    FieldArray<BodyKind> kind;
    FieldArray<std::uint32_t> generation;  ///< how often a body left the slot
    FieldArray<std::uint64_t> number;      ///< of the body in its world, ascending as bodies are added; never reused
    FieldArray<Shape> shape;
    FieldArray<std::uint32_t> material;
    FieldArray<std::string> name;
    FieldArray<Vec3> position;              ///< centre of mass [m, W]
    FieldArray<Quat> orientation;           ///< B to W
    FieldArray<Vec3> detected_position;     ///< where the body was when its contacts were found [m, W]; NaN = never
    FieldArray<Quat> detected_orientation;  ///< likewise
    FieldArray<Vec3> v;                     ///< [m/s, W]
    FieldArray<Vec3> w;                     ///< [rad/s, W]
    FieldArray<Vec3> p_BS;                  ///< origin of the shape's frame S, which World::pose() is about [m, B]
    FieldArray<Quat> R_BS;                  ///< S to B
    FieldArray<double> mass;                ///< [kg], of the description also for fixed bodies
    FieldArray<Vec3> inertia_B;             ///< principal moments [kg·m², B]
    FieldArray<double> mass_inv;            ///< [1/kg]; 0 = fixed
    FieldArray<Vec3> inertiaInv_B;          ///< [1/(kg·m²), B]; 0 = fixed
    FieldArray<Mat3> inertiaInv_W;          ///< [1/(kg·m²), W]; follows the orientation
    FieldArray<double> r_max;               ///< largest distance of a surface point from the centre [m]
    FieldArray<double> r_min;               ///< radius of a ball that fits into it [m]: half of its smallest extent
    FieldArray<Vec3> linear_step;           ///< ℓ: displacement by the linear velocity in this time step [m, W]
    FieldArray<Vec3> force, torque;         ///< for the next step [N], [N·m, W]
    FieldArray<Vec3> constant_force, constant_torque;  ///< in every step [N], [N·m, W]
    FieldArray<std::uint32_t> place;                   ///< among the bodies of its batch
    FieldArray<std::uint8_t> asleep;                   ///< 1 = asleep
    FieldArray<std::uint8_t> held;                     ///< 1 = it hardly got anywhere on its last flight
    FieldArray<WakeReason> woken;                      ///< why it woke in this step
    FieldArray<Vec3> mean_v, mean_w;    ///< recency-weighted averages of the velocities [m/s, W], [rad/s, W]
    FieldArray<double> motion;          ///< rwa: recency-weighted average of the squared motion [m²/s²] (3.2.4)
    FieldArray<Load> load;              ///< of its batch: beside one, gravity is not damped
    FieldArray<std::int32_t> supports;  ///< contacts in the direction of gravity in the last step; −1 = unknown
    FieldArray<std::uint64_t> groups;   ///< bits of the groups that it is in
    FieldArray<std::uint8_t> sensor;    ///< 1 = reports who is inside and touches nobody
    FieldArray<double> gravity_factor;  ///< of the global accelerations that it feels
    FieldArray<double> linear_damping, angular_damping;  ///< rates at which its velocities decay [1/s]
    FieldArray<Vec3> surface_velocity;                   ///< of a fixed body [m/s, frame of the shape]
    FieldArray<std::uint64_t> user_data;                 ///< the user's own
};

/// What changes a field.
enum class Change : std::uint8_t {
    calls,  ///< calls from outside and faults only: it lasts over many steps
    steps,  ///< steps
    anew,   ///< every step computes it before reading it, so it is no part of the state and is not saved
};

/// The value of a field of a new body unless its row says otherwise.
template <class Type>
Type blank() {
    if constexpr (std::is_same_v<Type, Quat>) {
        return Quat::Identity();
    } else if constexpr (std::is_same_v<Type, Vec3> || std::is_same_v<Type, Mat3>) {
        return Type::Zero();
    } else {
        return Type{};
    }
}

/// A place that is equal to none.
inline Vec3 nowhere() {
    return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// A row of the list.
template <class Type>
struct BodyField {
    using Initial = Type (*)();

    constexpr BodyField(FieldArray<Type> BodyArrays::*of, std::string_view called, std::string_view in,
                        Change changed_by, std::type_identity_t<Initial> begins_with = &blank<Type>)
        : array(of), name(called), unit(in), change(changed_by), initial(begins_with) {}

    constexpr bool isSaved() const { return change != Change::anew; }

    FieldArray<Type> BodyArrays::*array;
    std::string_view name;
    std::string_view unit;  ///< SI; 1 = a number without unit, empty = no number
    Change change;
    Initial initial;  ///< of a body that takes a slot; null = the slot keeps the field
};

/// All fields, in the order of snapshots: changing order or rows needs another snapshot_version.
inline constexpr auto body_fields = std::tuple{
    BodyField{&BodyArrays::kind, "kind", "", Change::calls},
    BodyField{&BodyArrays::generation, "generation", "1", Change::calls, nullptr},
    BodyField{&BodyArrays::number, "number", "1", Change::calls},
    BodyField{&BodyArrays::shape, "shape", "", Change::calls},
    BodyField{&BodyArrays::material, "material", "", Change::calls},
    BodyField{&BodyArrays::name, "name", "", Change::calls},
    BodyField{&BodyArrays::position, "position", "m", Change::steps},
    BodyField{&BodyArrays::orientation, "orientation", "1", Change::steps},
    BodyField{&BodyArrays::detected_position, "detected_position", "m", Change::steps, &nowhere},
    BodyField{&BodyArrays::detected_orientation, "detected_orientation", "1", Change::steps},
    BodyField{&BodyArrays::v, "v", "m/s", Change::steps},
    BodyField{&BodyArrays::w, "w", "rad/s", Change::steps},
    BodyField{&BodyArrays::p_BS, "p_BS", "m", Change::calls},
    BodyField{&BodyArrays::R_BS, "R_BS", "1", Change::calls},
    BodyField{&BodyArrays::mass, "mass", "kg", Change::calls},
    BodyField{&BodyArrays::inertia_B, "inertia_B", "kg·m²", Change::calls},
    BodyField{&BodyArrays::mass_inv, "mass_inv", "1/kg", Change::calls},
    BodyField{&BodyArrays::inertiaInv_B, "inertiaInv_B", "1/(kg·m²)", Change::calls},
    BodyField{&BodyArrays::inertiaInv_W, "inertiaInv_W", "1/(kg·m²)", Change::steps},
    BodyField{&BodyArrays::r_max, "r_max", "m", Change::calls},
    BodyField{&BodyArrays::r_min, "r_min", "m", Change::calls},
    BodyField{&BodyArrays::linear_step, "linear_step", "m", Change::anew},
    BodyField{&BodyArrays::force, "force", "N", Change::steps},
    BodyField{&BodyArrays::torque, "torque", "N·m", Change::steps},
    BodyField{&BodyArrays::constant_force, "constant_force", "N", Change::calls},
    BodyField{&BodyArrays::constant_torque, "constant_torque", "N·m", Change::calls},
    BodyField{&BodyArrays::place, "place", "1", Change::anew},
    BodyField{&BodyArrays::asleep, "asleep", "", Change::steps},
    BodyField{&BodyArrays::held, "held", "", Change::steps},
    BodyField{&BodyArrays::woken, "woken", "", Change::steps},
    BodyField{&BodyArrays::mean_v, "mean_v", "m/s", Change::steps},
    BodyField{&BodyArrays::mean_w, "mean_w", "rad/s", Change::steps},
    BodyField{&BodyArrays::motion, "motion", "m²/s²", Change::steps},
    BodyField{&BodyArrays::load, "load", "", Change::steps},
    BodyField{&BodyArrays::supports, "supports", "1", Change::steps, [] { return -1; }},
    BodyField{&BodyArrays::groups, "groups", "", Change::calls},
    BodyField{&BodyArrays::sensor, "sensor", "", Change::calls},
    BodyField{&BodyArrays::gravity_factor, "gravity_factor", "1", Change::calls, [] { return 1.0; }},
    BodyField{&BodyArrays::linear_damping, "linear_damping", "1/s", Change::calls},
    BodyField{&BodyArrays::angular_damping, "angular_damping", "1/s", Change::calls},
    BodyField{&BodyArrays::surface_velocity, "surface_velocity", "m/s", Change::calls},
    BodyField{&BodyArrays::user_data, "user_data", "", Change::calls},
};

static_assert(sizeof(BodyArrays) == std::tuple_size_v<decltype(body_fields)> * sizeof(FieldArray<Vec3>),
              "a member of BodyArrays has no row in body_fields");

/// Calls visit(const BodyField<Type>&) for every row.
template <class Visit>
constexpr void forEachBodyField(Visit&& visit) {
    std::apply([&](const auto&... field) { (visit(field), ...); }, body_fields);
}

}  // namespace cairn
