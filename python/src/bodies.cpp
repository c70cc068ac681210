/// The state of bodies: of one by its id, of all in arrays.
#include "arrays.h"
#include "native.h"
#include "parts.h"
#include "world_class.h"

namespace cairn::python {

namespace {

/// A view of a field, with as many columns as an entry has numbers. The array holds the view, and the view its block.
template <class Number, class Element>
py::array arrayOf(const BodyView<Element>& view) {
    constexpr std::size_t columns = sizeof(Element) / sizeof(Number);
    const py::capsule owner(new BodyView<Element>(view),
                            [](void* held) { delete static_cast<BodyView<Element>*>(held); });
    return shown(reinterpret_cast<const Number*>(view.data()), view.size(), columns > 1 ? columns : 0, owner);
}

/// A property that is an array of a field. @param number of the field, below 8
template <class Number, auto field, std::size_t number>
void bindView(py::class_<PyBodies>& bodies, const char* name, const char* doc) {
    constexpr auto get = [](const PyBodies& self) {
        const World& world = self.use();
        return self.owner->arrays().get(number, world.layoutVersion(),
                                        [&] { return arrayOf<Number>(world.bodyViews().*field); });
    };
    bindGetter<PyBodies, get>(bodies, name, doc);
}

py::array idsOfSlots(const PyBodies& self) {
    const BodyViews views = self.use().bodyViews();
    std::vector<BodyId> ids(views.slots());
    for (std::size_t slot = 0; slot < ids.size(); ++slot) ids[slot] = views.id(slot);
    return idArray(ids);
}

py::tuple posesOf(const PyBodies& self) {
    std::vector<Pose> poses;
    self.use().posesTo(poses);
    std::vector<Vec3> positions(poses.size());
    std::vector<Quat> orientations(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        positions[i] = poses[i].position;
        orientations[i] = poses[i].orientation;
    }
    return py::make_tuple(copied(positions), copied(orientations));
}

/// A call that gives each of some bodies a vector.
template <auto method>
void bindVectors(WorldClass& world, const char* name, const char* values, const char* doc) {
    world.def(
        name,
        [values](const PyWorld& self, const py::object& ids, const py::object& given) {
            (self.use().*method)(idsFrom(ids), vectorsFrom(given, values));
        },
        py::arg("ids"), py::arg(values), doc);
}

void setPoses(const PyWorld& self, const py::object& ids, const py::object& positions, const py::object& orientations) {
    const std::vector<Vec3> p = vectorsFrom(positions, "positions");
    const std::vector<Quat> q = quaternionsFrom(orientations, "orientations");
    if (p.size() != q.size()) {
        throw InputError(std::to_string(p.size()) + " positions came with " + std::to_string(q.size()) +
                         " orientations; give one of each for every body");
    }
    std::vector<Pose> poses(p.size());
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = {p[i], q[i]};
    self.use().setPoses(idsFrom(ids), poses);
}

void bindReading(WorldClass& world) {
    world.def("shape", on(&World::shape), py::arg("id"), "In its own frame.")
        .def("name", on(&World::name), py::arg("id"), "As the description said.")
        .def("material", on(&World::material), py::arg("id"), "What it is made of.")
        .def("pose", on(&World::pose), py::arg("id"), "Of the shape's frame in W [m].")
        .def("centre_of_mass", on(&World::centreOfMass), py::arg("id"), "[m, W]")
        .def("linear_velocity", on(&World::linearVelocity), py::arg("id"), "Of the centre of mass [m/s, W].")
        .def("angular_velocity", on(&World::angularVelocity), py::arg("id"), "[rad/s, W]")
        .def("mass", on(&World::mass), py::arg("id"), "[kg]; infinite for fixed bodies.")
        .def("principal_inertia", on(&World::principalInertia), py::arg("id"),
             "About the centre of mass [kg·m², B]; infinite for fixed bodies.")
        .def("principal_axes", on(&World::principalAxes), py::arg("id"), "B to W: a quaternion (w, x, y, z).")
        .def("is_fixed", on(&World::isFixed), py::arg("id"), "Whether it never moves.")
        .def("is_asleep", on(&World::isAsleep), py::arg("id"), "Whether it sleeps.");
}

void bindWriting(WorldClass& world) {
    world.def("set_pose", on(&World::setPose), py::arg("id"), py::arg("pose"), "Of the shape's frame in W [m].")
        .def("set_linear_velocity", on(&World::setLinearVelocity), py::arg("id"), py::arg("v"), "[m/s, W]")
        .def("set_angular_velocity", on(&World::setAngularVelocity), py::arg("id"), py::arg("w"), "[rad/s, W]")
        .def("set_fixed", on(&World::setFixed), py::arg("id"), py::arg("fixed"), "A half-space stays fixed.")
        .def(
            "wake", [](const PyWorld& self, BodyId id) { self.use().wake(id); }, py::arg("id"),
            "Wakes a body, or all of some ids.")
        .def(
            "wake", [](const PyWorld& self, const py::object& ids) { self.use().wake(idsFrom(ids)); }, py::arg("ids"))
        .def("apply_force", on(&World::applyForce), py::arg("id"), py::arg("force"),
             "At the centre of mass for the next step [N, W].")
        .def("apply_force_at", on(&World::applyForceAt), py::arg("id"), py::arg("force"), py::arg("point"),
             "For the next step [N, W] at a point [m, W].")
        .def("apply_torque", on(&World::applyTorque), py::arg("id"), py::arg("torque"), "For the next step [N·m, W].")
        .def("apply_impulse", on(&World::applyImpulse), py::arg("id"), py::arg("impulse"),
             "At once, at the centre of mass [N·s, W].")
        .def("apply_impulse_at", on(&World::applyImpulseAt), py::arg("id"), py::arg("impulse"), py::arg("point"),
             "At once [N·s, W] at a point [m, W].")
        .def("apply_angular_impulse", on(&World::applyAngularImpulse), py::arg("id"), py::arg("impulse"),
             "At once [N·m·s, W].")
        .def("set_constant_force", on(&World::setConstantForce), py::arg("id"), py::arg("force"),
             "In every step from now on [N, W].")
        .def("set_constant_torque", on(&World::setConstantTorque), py::arg("id"), py::arg("torque"),
             "In every step from now on [N·m, W].");
}

void bindManyBodies(WorldClass& world) {
    world.def("set_poses", &setPoses, py::arg("ids"), py::arg("positions"), py::arg("orientations"),
              "Positions (n, 3) [m, W] and quaternions (w, x, y, z) (n, 4). If one is refused, nothing is written.");
    bindVectors<&World::setLinearVelocities>(world, "set_linear_velocities", "v", "[m/s, W], shape (n, 3).");
    bindVectors<&World::setAngularVelocities>(world, "set_angular_velocities", "w", "[rad/s, W], shape (n, 3).");
    bindVectors<&World::applyForces>(world, "apply_forces", "forces", "[N, W], shape (n, 3).");
    bindVectors<&World::applyTorques>(world, "apply_torques", "torques", "[N·m, W], shape (n, 3).");
    bindVectors<&World::applyImpulses>(world, "apply_impulses", "impulses", "[N·s, W], shape (n, 3).");
    bindVectors<&World::applyAngularImpulses>(world, "apply_angular_impulses", "impulses", "[N·m·s, W], shape (n, 3).");
    bindVectors<&World::setConstantForces>(world, "set_constant_forces", "forces", "[N, W], shape (n, 3).");
    bindVectors<&World::setConstantTorques>(world, "set_constant_torques", "torques", "[N·m, W], shape (n, 3).");
}

}  // namespace

void bindBodyCalls(WorldClass& world) {
    bindReading(world);
    bindWriting(world);
    bindManyBodies(world);
}

void bindBodies(py::module_& module) {
    py::class_<PyBodies> bodies(module, "Bodies",
                                "The state of all bodies. Row i of an array is that of the body with index i; rows of "
                                "removed bodies, whose kind is hole, mean nothing.");
    bindView<std::uint8_t, &BodyViews::kind, 0>(bodies, "kind", "Numbers of BodyKind, shape (slots,).");
    bindView<std::uint32_t, &BodyViews::generation, 1>(bodies, "generation", "Of the slot, shape (slots,).");
    bindView<double, &BodyViews::centre_of_mass, 2>(bodies, "centre_of_mass", "[m, W], shape (slots, 3).");
    bindView<double, &BodyViews::principal_axes, 3>(
        bodies, "principal_axes_xyzw",
        "Of the principal inertia, B to W: quaternions in the order of memory (x, y, z, w), shape (slots, 4).");
    bindView<double, &BodyViews::linear_velocity, 4>(bodies, "linear_velocity",
                                                     "Of the centre of mass [m/s, W], shape (slots, 3).");
    bindView<double, &BodyViews::angular_velocity, 5>(bodies, "angular_velocity", "[rad/s, W], shape (slots, 3).");
    bindView<double, &BodyViews::mass, 6>(bodies, "mass",
                                          "[kg], shape (slots,); of fixed bodies what it were if they moved.");
    bindView<bool, &BodyViews::asleep, 7>(bodies, "asleep", "Whether it sleeps, shape (slots,).");
    bodies
        .def_property_readonly(
            "slots", [](const PyBodies& self) { return self.use().bodyViews().slots(); }, "Rows of every array.")
        .def_property_readonly("id", &idsOfSlots, "A copy as an array of body_id_dtype, shape (slots,).")
        .def("poses", &posesOf,
             "Copies of the poses of the shapes' frames in W: positions [m], shape (slots, 3), and quaternions "
             "(w, x, y, z), shape (slots, 4).")
        .def("__len__", [](const PyBodies& self) { return self.use().bodyCount(); })
        .def("__iter__", [](const PyBodies& self) { return py::iter(py::cast(self.use().bodies())); })
        .def("__contains__", [](const PyBodies& self, BodyId id) { return self.use().contains(id); })
        .def("__repr__",
             [](const PyBodies& self) { return "<cairn.Bodies: " + std::to_string(self.use().bodyCount()) + ">"; });
}

}  // namespace cairn::python
