/// @file The fields of a snapshot, each list written once for saving and loading. Their order is the format: changing
/// one needs another snapshot_version. Those of bodies stand in body_fields.
#pragma once

#include "world/byte_stream.h"
#include "world/events.h"
#include "world/saved_shapes.h"
#include "world/world_state.h"

namespace cairn {

template <PlainBytes T>
void field(ByteWriter& out, const T& value) {
    out.put(value);
}
template <PlainBytes T>
void field(ByteReader& in, T& value) {
    value = in.get<T>();
}
inline void field(ByteReader& in, bool& value) {
    const auto byte = in.get<std::uint8_t>();
    if (byte > 1) in.refuse("a switch that is neither on nor off");
    value = byte == 1;
}

template <class Stream, class Id>
requires std::is_same_v<std::remove_const_t<Id>, BodyId> || std::is_same_v<std::remove_const_t<Id>, JointId>
void field(Stream& stream, Id& id) {
    field(stream, id.index);
    field(stream, id.generation);
}

template <PlainBytes T>
void array(ByteWriter& out, const std::vector<T>& values) {
    out.putArray(std::span<const T>(values));
}
template <PlainBytes T>
void array(ByteReader& in, std::vector<T>& values) {
    in.getArray(values);
}

// An array with one entry per slot.
template <PlainBytes T>
void slotArray(ByteWriter& out, const FieldArray<T>& values, std::size_t) {
    out.putArray(std::span<const T>(values));
}
template <PlainBytes T>
void slotArray(ByteReader& in, FieldArray<T>& values, std::size_t slots) {
    in.getArray(values, slots);
}
inline void slotArray(ByteWriter& out, const FieldArray<Shape>& shapes, std::size_t) {
    for (const Shape& shape : shapes) saveShape(shape, out);
}
inline void slotArray(ByteReader& in, FieldArray<Shape>& shapes, std::size_t slots) {
    shapes.resize(slots);
    for (Shape& shape : shapes) shape = loadShape(in);
}
inline void slotArray(ByteWriter& out, const FieldArray<std::string>& names, std::size_t) {
    for (const std::string& name : names) out.putText(name);
}
inline void slotArray(ByteReader& in, FieldArray<std::string>& names, std::size_t slots) {
    names.resize(slots);
    for (std::string& name : names) name = in.getText();
}

/// The count, then every element.
template <class List, class SaveElement>
void saveList(ByteWriter& out, const List& list, const SaveElement& save) {
    out.put(std::uint64_t{list.size()});
    for (const auto& element : list) save(element);
}

// Each Stream is a ByteWriter with a const object or a ByteReader with one to fill.

template <class Stream, class Pair>
void pairFields(Stream& stream, Pair& pair) {
    field(stream, pair.restitution);
    field(stream, pair.static_friction);
    field(stream, pair.kinetic_friction);
    field(stream, pair.rolling_friction);
    field(stream, pair.spinning_friction);
}

template <class Stream, class Curve>
void curveArrays(Stream& stream, Curve& curve) {
    array(stream, curve.speeds);
    array(stream, curve.values);
}

template <class Stream, class World>
void worldFields(Stream& stream, World& world) {
    field(stream, world.gravity);
    field(stream, world.global_acceleration);
    field(stream, world.steps);
    field(stream, world.time);
    field(stream, world.steps_at_start);
    field(stream, world.time_at_start);
    field(stream, world.launched);
    field(stream, world.next_part.units);
    field(stream, world.next_part.wanted);
    field(stream, world.sized);
    field(stream, world.step_exponent);
}

template <class Stream, class Bodies>
void bodyFields(Stream& stream, Bodies& bodies, std::size_t slots) {
    forEachBodyField([&](const auto& row) {
        if (row.isSaved()) slotArray(stream, bodies.*row.array, slots);
    });
}

template <class Stream, class AnySpring>
void springFields(Stream& stream, AnySpring& spring) {
    field(stream, spring.present);
    field(stream, spring.generation);
    field(stream, spring.a);
    field(stream, spring.b);
    field(stream, spring.anchor_a);
    field(stream, spring.anchor_b);
    field(stream, spring.stiffness);
    field(stream, spring.damping);
    field(stream, spring.rest_length);
}

template <class Stream, class AnyAxis>
void freeAxisFields(Stream& stream, AnyAxis& axis) {
    field(stream, axis.along);
    field(stream, axis.lower);
    field(stream, axis.upper);
    field(stream, axis.restitution);
    field(stream, axis.motor_speed);
    field(stream, axis.motor_limit);
    field(stream, axis.servo_position);
    field(stream, axis.servo_speed);
    field(stream, axis.servo_stiffness);
    field(stream, axis.servo_damping);
    field(stream, axis.servo_limit);
    field(stream, axis.spring_stiffness);
    field(stream, axis.spring_rest);
    field(stream, axis.damping);
    field(stream, axis.friction);
    field(stream, axis.rotor_inertia);
    field(stream, axis.position);
}

inline void freeAxes(ByteWriter& out, const std::vector<FreeAxis>& axes) {
    out.put(static_cast<std::uint8_t>(axes.size()));
    for (const FreeAxis& axis : axes) freeAxisFields(out, axis);
}
inline void freeAxes(ByteReader& in, std::vector<FreeAxis>& axes) {
    const auto count = in.get<std::uint8_t>();
    if (count > JointBlock::most_rows) in.refuse("a joint with more free axes than there are");
    axes.resize(count);
    for (FreeAxis& axis : axes) freeAxisFields(in, axis);
}

template <class Stream, class AnyJoint>
void jointFields(Stream& stream, AnyJoint& joint) {
    field(stream, joint.present);
    field(stream, joint.generation);
    field(stream, joint.kind);
    field(stream, joint.a);
    field(stream, joint.b);
    field(stream, joint.anchor_a);
    field(stream, joint.anchor_b);
    field(stream, joint.axis_a);
    field(stream, joint.axis_b);
    field(stream, joint.rest);
    field(stream, joint.frame);
    field(stream, joint.length);
    field(stream, joint.lead);
    field(stream, joint.cone);
    freeAxes(stream, joint.free);
    field(stream, joint.break_force);
    field(stream, joint.break_torque);
    field(stream, joint.collide);
    field(stream, joint.locked);
    field(stream, joint.first);
    field(stream, joint.second);
    field(stream, joint.first_axis);
    field(stream, joint.second_axis);
    field(stream, joint.ratio);
    field(stream, joint.offset);
    field(stream, joint.redundant);
    field(stream, joint.impulse);
    field(stream, joint.angular_impulse);
}

template <class Stream, class AnyContact>
void contactFields(Stream& stream, AnyContact& contact) {
    forLastingMembers(contact, [&](auto& member) { field(stream, member); });
}

template <class Stream, class AnyBatches>
void batchArrays(Stream& stream, AnyBatches& batches) {
    array(stream, batches.bodies);
    array(stream, batches.contacts);
    array(stream, batches.body_begin);
    array(stream, batches.contact_begin);
    array(stream, batches.batch_of_contact);
}

template <class AnyDiagnostics>
void diagnosticsFields(ByteWriter& out, const AnyDiagnostics& diagnostics) {
    Diagnostics copy = diagnostics;
    for (const DiagnosticsField& f : cairn::diagnosticsFields()) out.put(f.of(copy));
}
template <class AnyDiagnostics>
void diagnosticsFields(ByteReader& in, AnyDiagnostics& diagnostics) {
    for (const DiagnosticsField& f : cairn::diagnosticsFields()) f.of(diagnostics) = in.get<double>();
}

/// All but the wall times, which are no part of the state: equal worlds have equal snapshots.
template <class Stream, class AnyStatistics>
void statisticsFields(Stream& stream, AnyStatistics& statistics) {
    field(stream, statistics.contacts);
    field(stream, statistics.penetrating_contacts);
    field(stream, statistics.corrected_contacts);
    field(stream, statistics.uncorrected_contacts);
    field(stream, statistics.displaced_bodies);
    field(stream, statistics.global_iterations);
    field(stream, statistics.shock_iterations);
    field(stream, statistics.shock_batches);
    field(stream, statistics.batches);
    field(stream, statistics.largest_batch);
    field(stream, statistics.asleep);
    field(stream, statistics.woken);
    field(stream, statistics.largest_overlap);
    field(stream, statistics.mean_overlap);
    diagnosticsFields(stream, statistics.diagnostics);
}

template <class Stream, class AnyEvent>
void eventFields(Stream& stream, AnyEvent& event) {
    forEventMembers(event, [&](auto& member) { field(stream, member); });
}

}  // namespace cairn
