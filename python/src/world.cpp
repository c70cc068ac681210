/// The world but for its bodies' state.
#include "arrays.h"
#include "native.h"
#include "owner.h"
#include "parts.h"
#include "record.h"
#include "world_class.h"

namespace cairn::python {

namespace {

PyWorld worldOf(World world) {
    return {std::make_shared<Owner>(std::move(world))};
}

PyWorld restoredWorld(const py::buffer& snapshot) {
    const py::bytes copy = contiguous(snapshot);
    return worldOf(World::restore(bytesIn(copy)));
}

/// Takes position and orientation besides a pose.
BodyId addBody(const PyWorld& self, const py::args& args, py::kwargs kwargs) {
    if (kwargs.contains("position") || kwargs.contains("orientation")) {
        if (kwargs.contains("pose"))
            throw py::type_error("a pose was given twice: as pose and as position or orientation");
        py::dict pose;
        for (const char* part : {"position", "orientation"}) {
            if (kwargs.contains(part)) pose[part] = kwargs.attr("pop")(part);
        }
        kwargs["pose"] = py::type::of<Pose>()(**pose);
    }
    return self.use().addBody(recordFrom<BodyDescription>(args, kwargs));
}

void bindMaterials(WorldClass& world) {
    world
        .def(
            "add_material",
            [](const PyWorld& self, const py::args& args, const py::kwargs& kwargs) {
                return self.use().addMaterial(recordFrom<Material>(args, kwargs));
            },
            "Adds a Material, or one of a name and a density [kg/m³]. Raises InputError.")
        .def_property_readonly(
            "materials",
            [](const PyWorld& self) {
                const auto all = self.use().materials();
                return py::tuple(py::cast(std::vector<Material>(all.begin(), all.end())));
            },
            "All materials, in the order of their ids.")
        .def(
            "set_default_pair_properties",
            [](const PyWorld& self, const py::args& args, const py::kwargs& kwargs) {
                self.use().setDefaultPairProperties(recordFrom<PairProperties>(args, kwargs));
            },
            "Properties of pairs that have none of their own. Raises InputError.")
        .def(
            "set_pair_properties",
            [](const PyWorld& self, MaterialId a, MaterialId b, const py::args& args, const py::kwargs& kwargs) {
                self.use().setPairProperties(a, b, recordFrom<PairProperties>(args, kwargs));
            },
            py::arg("a"), py::arg("b"), "Properties where a touches b and b touches a. Raises InputError.")
        .def("pair_properties", on(&World::pairProperties), py::arg("a"), py::arg("b"), "Raises InputError.")
        .def(
            "set_pair_law",
            [](const PyWorld& self, MaterialId a, MaterialId b, const py::args& args, const py::kwargs& kwargs) {
                self.use().setPairLaw(a, b, recordFrom<PairLaw>(args, kwargs));
            },
            py::arg("a"), py::arg("b"),
            "Lets properties where a touches b depend on the velocity there. Raises InputError.")
        .def("pair_law", on(&World::pairLaw), py::arg("a"), py::arg("b"),
             "Without curves unless it was set. Raises InputError.");
}

void bindTies(WorldClass& world) {
    world
        .def(
            "add_spring",
            [](const PyWorld& self, const py::args& args, const py::kwargs& kwargs) {
                return self.use().addSpring(recordFrom<SpringDescription>(args, kwargs));
            },
            "Adds the spring that a SpringDescription, or its fields, describe. Raises InputError, StaleIdError.")
        .def("remove_spring", on(&World::removeSpring), py::arg("id"), "Raises StaleIdError.")
        .def("set_spring_anchor", on(&World::setSpringAnchor), py::arg("id"), py::arg("anchor_b"),
             "Moves the second anchor [m, frame of B or W] and wakes its bodies. Raises StaleIdError, InputError.")
        .def(
            "add_joint",
            [](const PyWorld& self, const py::args& args, const py::kwargs& kwargs) {
                return self.use().addJoint(recordFrom<JointDescription>(args, kwargs));
            },
            "Joins bodies as they stand now, as a JointDescription, or its fields, say. Raises InputError, "
            "StaleIdError.")
        .def("remove_joint", on(&World::removeJoint), py::arg("id"), "Wakes its bodies. Raises StaleIdError.")
        .def("joints", on(&World::joints), "Ids of all joints, in ascending order of index.")
        .def("joint", on(&World::joint), py::arg("id"), "As it was after the last step. Raises StaleIdError.")
        .def(
            "set_joint_motor",
            [](const PyWorld& self, JointId id, const py::args& args, const py::kwargs& kwargs) {
                self.use().setJointMotor(id, recordFrom<JointMotor>(args, kwargs));
            },
            py::arg("id"),
            "Of hinges, sliders and screws; a limit of 0 switches it off. Raises InputError, StaleIdError.")
        .def("set_joint_limits", on(&World::setJointLimits), py::arg("id"), py::arg("lower"), py::arg("upper"),
             "Of hinges and screws [rad] and sliders [m]. Raises InputError, StaleIdError.")
        .def(
            "set_joint_servo",
            [](const PyWorld& self, JointId id, const py::args& args, const py::kwargs& kwargs) {
                self.use().setJointServo(id, recordFrom<JointServo>(args, kwargs));
            },
            py::arg("id"),
            "Of hinges, sliders and screws: what it drives to from now on. Raises InputError, StaleIdError.")
        .def("set_joint_axis", on(&World::setJointAxis), py::arg("id"), py::arg("index"), py::arg("axis"),
             "All that acts along a free axis from now on. Raises InputError, StaleIdError.")
        .def("__contains__", [](const PyWorld& self, BodyId id) { return self.use().contains(id); })
        .def("__contains__", [](const PyWorld& self, JointId id) { return self.use().contains(id); });
}

PyObject* step(PyObject* self, PyObject* const* arguments, Py_ssize_t count, PyObject* names) {
    try {
        const std::int64_t steps = countIn(arguments, count, names, "step", "steps", 1);
        const PyWorld& held = heldBy<PyWorld>(self);
        World& world = held.use();
        stepOften(*held.owner, steps, [&] { world.step(); });
        return py::none().release().ptr();
    } catch (...) {
        return raised();
    }
}

py::object bodiesOf(PyWorld& self) {
    if (!self.bodies) self.bodies = py::cast(PyBodies{self.owner});
    return self.bodies;
}

void bindTime(WorldClass& world) {
    bindMethod(world, "step", step,
               "step($self, steps=1)\n--\n\n"
               "So many time steps, without the interpreter's lock. Raises InvariantError.");
    world
        .def_property(
            "gravity", on(&World::gravity),
            [](const PyWorld& self, const Vec3& gravity) { self.use().setGravity(gravity); },
            "[m/s², W]; a change wakes every body and ends a law. Raises InputError.")
        .def("set_gravity", on(&World::setGravity), py::arg("gravity"), py::arg("law") = std::nullopt,
             "Gravity now [m/s², W], and a law whose displacement, in m/s² in place of m, is added to it from now on; "
             "while it changes nobody falls asleep. Raises InputError.")
        .def_property_readonly("gravity_law", on(&World::gravityLaw), "None = gravity stays.")
        .def_property("global_acceleration", on(&World::globalAcceleration), on(&World::setGlobalAcceleration),
                      "A second acceleration of all bodies [m/s², W]. Raises InputError.")
        .def_property_readonly("time", on(&World::time), "Simulated time [s].")
        .def_property_readonly("steps_per_second_by_size", on(&World::stepsPerSecondBySize),
                               "Time steps per second that the sizes of the bodies that move ask for [1/s].")
        .def_property_readonly("step_count", on(&World::stepCount), "Time steps done.")
        .def_property("settings", on(&World::settings), on(&World::setSettings),
                      "Takes effect at the next step. Raises InputError.")
        .def("set_checks", on(&World::setChecks), py::arg("checks"), "What every step checks from now on.");
}

void bindSnapshots(WorldClass& world) {
    world
        .def(
            "save", [](const PyWorld& self) { return bytesOf(self.use().save()); },
            "Everything that the world is, so that it goes on bit by bit as it would have.")
        .def_static("restore", &restoredWorld, py::arg("snapshot"), "A world as it was saved. Raises InputError.")
        .def(
            "load", [](const PyWorld& self, const RollbackState& state) { self.use().load(state); }, py::arg("state"),
            "Becomes what was kept or saved. Raises InputError.")
        .def(
            "load",
            [](const PyWorld& self, const py::buffer& snapshot) {
                const py::bytes copy = contiguous(snapshot);
                self.use().load(bytesIn(copy));
            },
            py::arg("snapshot"))
        .def("keep", on(&World::keep), py::arg("state"), "Overwrites a kept state with what the world is.")
        .def(py::pickle([](const PyWorld& self) { return bytesOf(self.use().save()); },
                        [](const py::bytes& snapshot) { return restoredWorld(snapshot); }));
}

void bindAfterStep(WorldClass& world) {
    world
        .def(
            "contacts", [](const PyWorld& self) { return contactArray(self.use().contacts()); },
            "Of the last step, by (a, b): an array of contact_dtype.")
        .def("batches", on(&World::batches), "Of the last step, by their lowest body.")
        .def_property_readonly("statistics", on(&World::statistics), "Of the last step.")
        .def_property_readonly(
            "faults", [](const PyWorld& self) { return py::tuple(py::cast(self.use().faults())); }, "All so far.")
        .def("set_tracing", on(&World::setTracing), py::arg("tracing"), "Of the following steps; off at first.")
        .def("trace", on(&World::trace), py::arg("id"), "What the last step did with a body. Raises StaleIdError.")
        .def_property("event_level", on(&World::eventLevel), on(&World::setEventLevel),
                      "Which events the following steps collect; none at first.")
        .def(
            "events", [](const PyWorld& self) { return eventArray(self.use().events()); },
            "What happened in the last step: an array of event_dtype.")
        .def("kinetic_energy", on(&World::kineticEnergy), "[J]")
        .def("potential_energy", on(&World::potentialEnergy), "[J], zero at the origin.")
        .def("linear_momentum", on(&World::linearMomentum), "Of all dynamic bodies [N·s, W].")
        .def("angular_momentum", on(&World::angularMomentum), "Of all dynamic bodies about the origin [N·m·s, W].")
        .def("state_hash", on(&World::stateHash), "Equal states have equal hashes.")
        .def("__repr__", [](const PyWorld& self) {
            const World& w = self.use();
            return "<cairn.World: " + std::to_string(w.bodyCount()) + " bodies, " + std::to_string(w.time()) + " s>";
        });
}

}  // namespace

void bindWorld(py::module_& module) {
    py::class_<RollbackState>(module, "RollbackState", "A world at one time, in memory only. Empty until World.keep().")
        .def(py::init<>());
    WorldClass world(module, "World",
                     "A simulated world: right-handed, SI units, world frame W unless named. One thread at a time may "
                     "use it.");
    world
        .def(py::init([](const std::optional<Settings>& settings) {
                 return worldOf(settings ? World(*settings) : World());
             }),
             py::arg("settings") = py::none(), "settings: those of the preset performance if None. Raises InputError.")
        .def("add_body", &addBody, "Adds the body that a BodyDescription, or its fields, describe. Raises InputError.")
        .def("remove_body", on(&World::removeBody), py::arg("id"),
             "Wakes the sleeping bodies that touched it; its springs and joints go with it. Raises StaleIdError.")
        .def_property_readonly("body_count", on(&World::bodyCount), "Bodies in the world.")
        .def_property_readonly("layout_version", on(&World::layoutVersion),
                               "Another number as soon as arrays of the bodies are to be taken anew.");
    bindGetter<PyWorld, bodiesOf>(world, "bodies", "The state of all bodies in arrays.");
    bindMaterials(world);
    bindTies(world);
    bindTime(world);
    bindSnapshots(world);
    bindAfterStep(world);
    bindBodyCalls(world);
    bindQueries(world);
    bindFiltersAndMotions(world);
}

}  // namespace cairn::python
