/// Which bodies touch each other, and motion by a law.
#include "arrays.h"
#include "parts.h"
#include "record.h"
#include "world_class.h"

namespace cairn::python {

namespace {

void bindGroupId(py::module_& module) {
    py::class_<GroupId>(module, "GroupId", "The index of a group of bodies of a world.")
        .def(py::init([](std::uint32_t index) { return static_cast<GroupId>(index); }), py::arg("index"))
        .def_property_readonly("index", [](GroupId id) { return static_cast<std::uint32_t>(id); })
        .def(
            "__eq__", [](GroupId a, GroupId b) { return a == b; }, py::is_operator())
        .def("__hash__", [](GroupId id) { return static_cast<py::ssize_t>(id); })
        .def("__repr__", [](GroupId id) { return "GroupId(" + std::to_string(static_cast<std::uint32_t>(id)) + ")"; })
        .def(py::pickle([](GroupId id) { return static_cast<std::uint32_t>(id); },
                        [](std::uint32_t index) { return static_cast<GroupId>(index); }));
}

/// A field of vectors as an array of shape (n, 3); none may be given as an empty sequence.
void rowsField(Record<TableMotion>& record, const char* name, std::vector<Vec3> TableMotion::*member, const char* doc) {
    record.fieldBy(
        name, [member](const TableMotion& self) -> py::object { return readOnly(copied(self.*member)); },
        [member, name](TableMotion& self, py::handle value) {
            self.*member = py::len(value) == 0 ? std::vector<Vec3>{} : vectorsFrom(value, name);
        },
        doc);
}

void bindMotionRecords(py::module_& module) {
    Record<ConstantMotion>(module, "ConstantMotion", "Moves and turns at constant rates, like a roller or a piston.")
        .field("velocity", &ConstantMotion::velocity, "[m/s, W]")
        .field("spin", &ConstantMotion::spin, "[rad/s, W]")
        .finish();
    Record<SineMotion>(module, "SineMotion",
                       "Swings: x(t) = amplitude·(sin(2π·frequency·t + phase) - sin(phase)), so that it begins where "
                       "the body is; with the phase π/2 it begins at rest.")
        .field("amplitude", &SineMotion::amplitude, "Of the displacement [m, W].")
        .field("turn", &SineMotion::turn, "Of the rotation vector [rad, W].")
        .field("frequency", &SineMotion::frequency, "[Hz], > 0")
        .field("phase", &SineMotion::phase, "[rad]")
        .finish();
    Record<TableMotion> table(module, "TableMotion",
                              "Goes through given places at given times, on cubic curves with continuous velocity. "
                              "Displacements and turns count from the first entry.");
    table.fieldBy(
        "times", [](const TableMotion& self) -> py::object { return readOnly(copied(self.times)); },
        [](TableMotion& self, py::handle value) { self.times = numbersFrom<double>(value, "times"); },
        "From the beginning of the motion, ascending, at least two [s], shape (n,).");
    rowsField(table, "displacements", &TableMotion::displacements, "[m, W], shape (n, 3), or none.");
    rowsField(table, "turns", &TableMotion::turns, "Rotation vectors [rad, W], shape (n, 3), or none.");
    rowsField(table, "velocities", &TableMotion::velocities,
              "[m/s, W], shape (n, 3); or none: then those of a smooth curve, at rest at both ends unless the table "
              "repeats.");
    table.field("end", &TableMotion::end, "What comes after the last time.").finish(1);
    module.def(
        "integrate_accelerogram",
        [](double interval, const py::object& accelerations, Baseline baseline) {
            return integrateAccelerogram(interval, vectorsFrom(accelerations, "accelerations"), baseline);
        },
        py::arg("interval"), py::arg("accelerations"), py::arg("baseline"),
        "The motion, from rest, whose acceleration is straight between samples [m/s², W], shape (n, 3), an interval "
        "[s] apart. Raises InputError.");
}

void bindGroups(WorldClass& world) {
    world
        .def("add_group", on(&World::addGroup), py::arg("name"),
             "Raises InputError for an empty or used name, or beyond most_groups.")
        .def_property_readonly(
            "group_names",
            [](const PyWorld& self) {
                const auto names = self.use().groupNames();
                return py::tuple(py::cast(std::vector<std::string>(names.begin(), names.end())));
            },
            "Of all groups, in the order of their ids.")
        .def("set_groups_touch", on(&World::setGroupsTouch), py::arg("a"), py::arg("b"), py::arg("touch"),
             "Whether bodies of two groups, or of one, touch; at first all do. Raises InputError.")
        .def("groups_touch", on(&World::groupsTouch), py::arg("a"), py::arg("b"), "Raises InputError.")
        .def(
            "set_groups",
            [](const PyWorld& self, BodyId id, const std::vector<GroupId>& groups) {
                self.use().setGroups(id, groups);
            },
            py::arg("id"), py::arg("groups"),
            "Puts a body into these groups and no others. Raises InputError, StaleIdError.")
        .def("groups", on(&World::groups), py::arg("id"), "Of a body, ascending. Raises StaleIdError.")
        .def("set_pair_touch", on(&World::setPairTouch), py::arg("a"), py::arg("b"), py::arg("touch"),
             "An exception of two bodies from what their groups say; None = no exception. Raises InputError, "
             "StaleIdError.")
        .def("pair_touch", on(&World::pairTouch), py::arg("a"), py::arg("b"),
             "The exception of two bodies, if there is one. Raises StaleIdError.")
        .def("is_sensor", on(&World::isSensor), py::arg("id"), "Whether it touches nobody. Raises StaleIdError.")
        .def(
            "sensed",
            [](const PyWorld& self) {
                const auto all = self.use().sensed();
                return std::vector<Sensed>(all.begin(), all.end());
            },
            "Who was inside which sensor in the last step, by sensor and body.");
}

void bindBodyProperties(WorldClass& world) {
    world
        .def("set_gravity_factor", on(&World::setGravityFactor), py::arg("id"), py::arg("factor"),
             "Of the global accelerations that it feels, -1e3 to 1e3.")
        .def("gravity_factor", on(&World::gravityFactor), py::arg("id"), "Of the global accelerations that it feels.")
        .def("set_damping", on(&World::setDamping), py::arg("id"), py::arg("linear"), py::arg("angular"),
             "Rates at which its velocities decay [1/s], 0 to 1e6.")
        .def("linear_damping", on(&World::linearDamping), py::arg("id"), "[1/s]")
        .def("angular_damping", on(&World::angularDamping), py::arg("id"), "[1/s]")
        .def(
            "set_locked",
            [](const PyWorld& self, BodyId id, const std::vector<JointAlong>& axes) { self.use().setLocked(id, axes); },
            py::arg("id"), py::arg("axes"),
            "Along and about which axes of W it does not move; none = it is free. Raises InputError, StaleIdError.")
        .def(
            "locked", [](const PyWorld& self, BodyId id) { return py::tuple(py::cast(self.use().locked(id))); },
            py::arg("id"), "Ascending.")
        .def("set_user_data", on(&World::setUserData), py::arg("id"), py::arg("data"),
             "A number of the user's own, 0 to 2⁶⁴ - 1.")
        .def("user_data", on(&World::userData), py::arg("id"), "0 unless it was set.");
}

}  // namespace

void bindFilterAndMotionRecords(py::module_& module) {
    bindGroupId(module);
    module.attr("most_groups") = most_groups;
    Record<Sensed>(module, "Sensed", "A body that a sensor holds.")
        .field("sensor", &Sensed::sensor, "A body that is a sensor.")
        .field("body", &Sensed::body, "One that overlaps it and is no sensor.")
        .finish();
    bindMotionRecords(module);
}

void bindFiltersAndMotions(WorldClass& world) {
    bindGroups(world);
    bindBodyProperties(world);
    world
        .def("set_motion", on(&World::setMotion), py::arg("id"), py::arg("motion"),
             py::arg("pivot") = py::make_tuple(0, 0, 0),
             "Moves a fixed body by a law from now on; pivot: about which it turns [m, frame of the shape]. Raises "
             "InputError, StaleIdError.")
        .def("stop_motion", on(&World::stopMotion), py::arg("id"), "It stays where it is. Raises StaleIdError.")
        .def("motion", on(&World::motion), py::arg("id"), "The law that moves it, if one does. Raises StaleIdError.")
        .def("set_surface_velocity", on(&World::setSurfaceVelocity), py::arg("id"), py::arg("velocity"),
             "Lets the surface of a fixed body run over it, like a belt [m/s, frame of the shape]. Raises InputError, "
             "StaleIdError.")
        .def("surface_velocity", on(&World::surfaceVelocity), py::arg("id"), "[m/s, frame of the shape]")
        .def_property("frame_motion", on(&World::frameMotion), on(&World::setFrameMotion),
                      "The law by which the frame of the world moves; None = it rests. Raises InputError.");
}

}  // namespace cairn::python
