/// What bodies, shapes, materials, joints and springs are described with.
#include "arrays.h"
#include "parts.h"
#include "record.h"

namespace cairn::python {

namespace {

/// Names that never name anything else: hashable and in order.
template <class Id>
void bindId(py::module_& module, const char* name, const char* doc) {
    Record<Id> record(module, name, doc);
    record.field("index", &Id::index, "Slot in the world.")
        .field("generation", &Id::generation, "How many others lived in the slot before.")
        .finish()
        .def("__lt__", [](const Id& a, const Id& b) { return a < b; })
        .def("__hash__", [](const Id& id) { return py::hash(py::make_tuple(id.index, id.generation)); });
}

void bindMaterialId(py::module_& module) {
    py::class_<MaterialId>(module, "MaterialId", "The index of a material of a world.")
        .def(py::init([](std::uint32_t index) { return static_cast<MaterialId>(index); }), py::arg("index"))
        .def_property_readonly("index", [](MaterialId id) { return static_cast<std::uint32_t>(id); })
        .def(
            "__eq__", [](MaterialId a, MaterialId b) { return a == b; }, py::is_operator())
        .def("__hash__", [](MaterialId id) { return static_cast<py::ssize_t>(id); })
        .def("__repr__",
             [](MaterialId id) { return "MaterialId(" + std::to_string(static_cast<std::uint32_t>(id)) + ")"; })
        .def(py::pickle([](MaterialId id) { return static_cast<std::uint32_t>(id); },
                        [](std::uint32_t index) { return static_cast<MaterialId>(index); }));
}

void bindPose(py::module_& module) {
    Record<Pose> record(module, "Pose", "Position and orientation of a frame F in another frame.");
    record.field("position", &Pose::position, "Origin of F [m], shape (3,).")
        .field("orientation", &Pose::orientation, "Rotation from F: a quaternion (w, x, y, z).")
        .finish()
        .def("to_outer", py::overload_cast<const Vec3&>(&Pose::toOuter, py::const_), py::arg("p"),
             "Maps a point [m] or a pose of the posed frame into the outer frame.")
        .def("to_outer", py::overload_cast<const Pose&>(&Pose::toOuter, py::const_), py::arg("p"))
        .def("to_inner", &Pose::toInner, py::arg("p"), "Maps a point of the outer frame [m] into the posed frame.")
        .def("inverse", &Pose::inverse, "The pose of the outer frame in the posed one.");
}

void bindHull(py::module_& module) {
    py::class_<ConvexHull> hull(module, "ConvexHull",
                                "The smallest convex solid that holds some points, in any frame and order.");
    hull.def(py::init([](const py::object& points) { return ConvexHull(vectorsFrom(points, "points")); }),
             py::arg("points"))
        .def_property_readonly(
            "points",
            [](const ConvexHull& self) {
                return readOnly(copied(std::vector<Vec3>(self.points().begin(), self.points().end())));
            },
            "As given [m], shape (n, 3).")
        .def_property_readonly(
            "corners",
            [](const ConvexHull& self) {
                return readOnly(copied(std::vector<Vec3>(self.corners().begin(), self.corners().end())));
            },
            "The points that are corners of the solid [m], shape (m, 3).");
    finishRecord(hull, {"points"});
}

void bindShapes(py::module_& module) {
    Record<Sphere>(module, "Sphere", "A ball about the origin of its frame.")
        .field("radius", &Sphere::radius, "[m], > 0")
        .finish();
    Record<Box>(module, "Box", "A cuboid about the origin of its frame, its edges along the axes.")
        .field("size", &Box::size, "Full edge lengths [m], each > 0.")
        .finish();
    Record<Capsule>(module, "Capsule", "A cylinder along z with a half ball on each end.")
        .field("radius", &Capsule::radius, "[m], > 0")
        .field("length", &Capsule::length, "Of the cylindrical part, without the half balls [m], > 0.")
        .finish();
    Record<Cylinder>(module, "Cylinder", "A cylinder about the origin of its frame, its axis along z.")
        .field("radius", &Cylinder::radius, "[m], > 0")
        .field("length", &Cylinder::length, "Along the axis [m], > 0.")
        .finish();
    Record<HalfSpace>(module, "HalfSpace", "All points p with normal·p ≤ offset are solid; always fixed, has no mass.")
        .field("normal", &HalfSpace::normal, "Outward, of any length > 0.")
        .field("offset", &HalfSpace::offset, "Distance of the plane from the origin along the normal [m].")
        .finish();
    bindHull(module);
    Record<SolidProperties>(module, "SolidProperties", "Volume, centre and inertia of a solid of density 1.")
        .field("volume", &SolidProperties::volume, "[m³], > 0")
        .field("centre", &SolidProperties::centre, "Of mass [m, frame of the shape], shape (3,).")
        .field("inertia", &SolidProperties::inertia, "About the centre [m⁵], shape (3, 3).")
        .finish(3);
    Record<CompoundPart> part(module, "CompoundPart", "A shape of a compound.");
    Record<Compound> compound(module, "Compound", "Several shapes that move as one body.");
    part.field("shape", &CompoundPart::shape, "Any solid but compounds.")
        .field("pose", &CompoundPart::pose, "Of the shape in the compound's frame.")
        .field("mass", &CompoundPart::mass, "[kg], > 0")
        .field("density", &CompoundPart::density,
               "In place of a mass [kg/m³], > 0; without either that of the material.")
        .finish(1);
    compound.field("parts", &Compound::parts, "At least one.")
        .field("solid", &Compound::solid, "What the parts stand for, whose mass counts in place of theirs.")
        .finish(1);
}

void bindMaterials(py::module_& module) {
    Record<Material>(module, "Material", "What a body is made of.")
        .field("name", &Material::name, "Unique in a world, not empty.")
        .field("density", &Material::density, "[kg/m³], > 0")
        .finish(2);
    Record<PairProperties>(module, "PairProperties", "Contact properties of a pair of materials.")
        .field("restitution", &PairProperties::restitution, "Coefficient of restitution, 0 to 1.")
        .field("static_friction", &PairProperties::static_friction, "Coulomb's µs, ≥ 0.")
        .field("kinetic_friction", &PairProperties::kinetic_friction, "Coulomb's µk, 0 to µs.")
        .field("rolling_friction", &PairProperties::rolling_friction,
               "Greatest torque against rolling over the normal force [m], ≥ 0.")
        .field("spinning_friction", &PairProperties::spinning_friction,
               "Likewise for the torque about the normal [m], ≥ 0.")
        .finish();
    Record<SpeedCurve>(module, "SpeedCurve",
                       "A value that depends on a speed: on straight lines between points, constant beyond them.")
        .field("speeds", &SpeedCurve::speeds, "[m/s], ≥ 0, ascending; none = the property does not depend on speed.")
        .field("values", &SpeedCurve::values, "As many.")
        .finish();
    Record<PairLaw>(module, "PairLaw", "How properties of a pair depend on the velocity at a contact.")
        .field("restitution", &PairLaw::restitution, "Over the speed with which they close; values 0 to 1.")
        .field("friction", &PairLaw::friction, "Kinetic friction over the speed with which they slide.")
        .finish();
}

void bindDescriptions(py::module_& module) {
    Record<BodyDescription>(module, "BodyDescription", "How a body begins.")
        .field("shape", &BodyDescription::shape, "In its own frame.")
        .field("material", &BodyDescription::material, "Must exist in the world.")
        .field("mass", &BodyDescription::mass, "[kg], > 0; otherwise density times volume.")
        .field("centre_of_mass", &BodyDescription::centre_of_mass,
               "[m, frame of the shape]; otherwise that of the uniform solid.")
        .field("inertia", &BodyDescription::inertia,
               "About the centre of mass [kg·m², axes of the shape's frame], shape (3, 3).")
        .field("pose", &BodyDescription::pose, "Of the shape's frame in W.")
        .field("linear_velocity", &BodyDescription::linear_velocity, "Of the centre of mass [m/s, W].")
        .field("angular_velocity", &BodyDescription::angular_velocity, "[rad/s, W]")
        .field("fixed", &BodyDescription::fixed, "Never moves, infinite mass; half-spaces must be fixed.")
        .field("asleep", &BodyDescription::asleep, "Begins asleep; its velocities must be zero.")
        .field("name", &BodyDescription::name, "Free, for messages and viewers.")
        .field("groups", &BodyDescription::groups, "Any number; none = touches the bodies of all groups.")
        .field("sensor", &BodyDescription::sensor, "Touches nobody; World.sensed() and events say who is inside.")
        .field("gravity_factor", &BodyDescription::gravity_factor,
               "Of the global accelerations that it feels, -1e3 to 1e3; 0 = weightless.")
        .field("linear_damping", &BodyDescription::linear_damping,
               "Rate at which the linear velocity decays [1/s], 0 to 1e6.")
        .field("angular_damping", &BodyDescription::angular_damping,
               "Rate at which the angular velocity decays [1/s], 0 to 1e6.")
        .field("user_data", &BodyDescription::user_data, "A number of the user's own, 0 to 2⁶⁴ - 1.")
        .field("motion", &BodyDescription::motion, "Of a fixed body: the law by which it moves.")
        .field("pivot", &BodyDescription::pivot, "Of the motion [m, frame of the shape].")
        .field("surface_velocity", &BodyDescription::surface_velocity,
               "Of a fixed body: with which its surface runs over it [m/s, frame of the shape].")
        .field("locked", &BodyDescription::locked, "Axes of W along and about which a dynamic body does not move.")
        .finish();
    Record<SpringDescription>(module, "SpringDescription", "A damped spring between two points.")
        .field("a", &SpringDescription::a, "First body.")
        .field("anchor_a", &SpringDescription::anchor_a, "[m, frame of A's pose]")
        .field("b", &SpringDescription::b, "Second body; None = a point of the world.")
        .field("anchor_b", &SpringDescription::anchor_b, "[m, frame of B's pose, or W without a second body]")
        .field("stiffness", &SpringDescription::stiffness, "[N/m], ≥ 0")
        .field("damping", &SpringDescription::damping, "Along the spring [N·s/m], ≥ 0.")
        .field("rest_length", &SpringDescription::rest_length, "[m], ≥ 0")
        .finish(1);
}

void bindJointAxes(py::module_& module) {
    Record<JointMotor>(module, "JointMotor", "Drives a free axis at a speed, as far as its force reaches.")
        .field("speed", &JointMotor::speed, "Of A relative to B about or along the axis [rad/s or m/s].")
        .field("limit", &JointMotor::limit, "Largest torque or force [N·m or N], ≥ 0.")
        .finish();
    Record<JointServo>(module, "JointServo",
                       "Drives a free axis to a position, at a speed, or both; stable whatever the gains are.")
        .field("position", &JointServo::position, "Wanted [rad or m].")
        .field("speed", &JointServo::speed, "Wanted [rad/s or m/s].")
        .field("stiffness", &JointServo::stiffness,
               "Gain of the position [N·m/rad or N/m], 0 to 1e30; 0 = it drives a speed only.")
        .field("damping", &JointServo::damping, "Gain of the speed [N·m·s/rad or N·s/m], 0 to 1e30.")
        .field("limit", &JointServo::limit, "Largest torque or force [N·m or N], ≥ 0.")
        .finish()
        .attr("no_limit") = JointServo::no_limit;
    Record<JointSpring>(module, "JointSpring", "Pulls a free axis to a position; stable whatever the stiffness is.")
        .field("stiffness", &JointSpring::stiffness, "[N·m/rad or N/m], 0 to 1e30")
        .field("rest", &JointSpring::rest, "Position without force [rad or m].")
        .finish();
    Record<JointAxis>(module, "JointAxis", "What acts along or about one free axis of a joint.")
        .field("along", &JointAxis::along, "Of generic joints: which axis is free.")
        .field("lower", &JointAxis::lower, "Least position [rad or m].")
        .field("upper", &JointAxis::upper, "Greatest position [rad or m], ≥ lower.")
        .field("restitution", &JointAxis::restitution, "Part of the speed with which a limit throws back, 0 to 1.")
        .field("motor", &JointAxis::motor, "Drives at a speed; an axis has a motor or a servo.")
        .field("servo", &JointAxis::servo, "Drives to a position or at a speed.")
        .field("spring", &JointAxis::spring, "Pulls to a position.")
        .field("damping", &JointAxis::damping, "Force per speed [N·m·s/rad or N·s/m], 0 to 1e30.")
        .field("friction", &JointAxis::friction, "Largest torque or force of dry friction [N·m or N], ≥ 0.")
        .field("rotor_inertia", &JointAxis::rotor_inertia, "Of what turns with the axis [kg·m² or kg], 0 to 1e30.")
        .finish();
}

void bindJoints(py::module_& module) {
    bindJointAxes(module);
    Record<JointDescription>(module, "JointDescription", "How a joint begins, in W as the bodies stand then.")
        .field("kind", &JointDescription::kind, "What it keeps.")
        .field("a", &JointDescription::a, "First body.")
        .field("b", &JointDescription::b, "Second body; None = the world itself.")
        .field("anchor", &JointDescription::anchor,
               "Where they are joined, of distances and ropes the point of A [m, W].")
        .field("anchor_b", &JointDescription::anchor_b, "Of distances and ropes: the point of B or the world [m, W].")
        .field("axis", &JointDescription::axis, "Of any length above 0 [W]; of planar joints the normal.")
        .field("axis_2", &JointDescription::axis_2,
               "Of universal, planar, generic and ball joints: not along axis [W].")
        .field("length", &JointDescription::length,
               "Of distances and ropes [m], > 0; otherwise the distance at the beginning.")
        .field("lead", &JointDescription::lead, "Of screws: displacement per turn [m].")
        .field("lower", &JointDescription::lower, "Of hinges, sliders and screws, as in JointAxis.")
        .field("upper", &JointDescription::upper, "Of hinges, sliders and screws, as in JointAxis.")
        .field("restitution", &JointDescription::restitution, "Of hinges, sliders and screws, as in JointAxis.")
        .field("motor", &JointDescription::motor, "Of hinges, sliders and screws, as in JointAxis.")
        .field("servo", &JointDescription::servo, "Of hinges, sliders and screws, as in JointAxis.")
        .field("spring", &JointDescription::spring, "Of hinges, sliders and screws, as in JointAxis.")
        .field("damping", &JointDescription::damping, "Of hinges, sliders and screws, as in JointAxis.")
        .field("friction", &JointDescription::friction, "Of hinges, sliders and screws, as in JointAxis.")
        .field("rotor_inertia", &JointDescription::rotor_inertia, "Of hinges, sliders and screws, as in JointAxis.")
        .field("cone", &JointDescription::cone, "Of balls: largest angle between the axes of A and B [rad], 0 to π.")
        .field("axes", &JointDescription::axes,
               "What acts along the free axes of other joints; of generic ones which are free.")
        .field("break_force", &JointDescription::break_force,
               "Above which the joint breaks [N], > 0; of couplings along a displacement of the second.")
        .field("break_torque", &JointDescription::break_torque,
               "Above which it breaks [N·m], > 0; of couplings about an angle of the second.")
        .field("collide", &JointDescription::collide, "Whether the two bodies may touch each other.")
        .field("first", &JointDescription::first, "Of gears, racks and mimics: a joint.")
        .field("second", &JointDescription::second, "The joint that follows it.")
        .field("first_axis", &JointDescription::first_axis, "Which free axis of the first.")
        .field("second_axis", &JointDescription::second_axis, "Which free axis of the second.")
        .field("ratio", &JointDescription::ratio,
               "Of gears: opposite turns per turn; of racks [m/rad] and mimics: position per position.")
        .finish()
        .attr("infinite") = JointDescription::infinite;
    Record<JointInfo>(module, "JointInfo", "A joint as it was after the last step.")
        .field("kind", &JointInfo::kind, "What it keeps.")
        .field("a", &JointInfo::a, "First body; of gears, racks and mimics that of the first joint.")
        .field("b", &JointInfo::b,
               "Second body, None = the world; of gears, racks and mimics the second joint's first.")
        .field("anchor_a", &JointInfo::anchor_a, "The point of A [m, W].")
        .field("anchor_b", &JointInfo::anchor_b, "The point of B or of the world [m, W].")
        .field("axis", &JointInfo::axis, "That of B: unit, W.")
        .field("position", &JointInfo::position,
               "Of the first free axis; of distances and ropes their length [rad or m].")
        .field("speed", &JointInfo::speed, "Its rate [rad/s or m/s].")
        .field("error", &JointInfo::error, "How far the joint is from what it keeps [m or rad].")
        .field("impulse", &JointInfo::impulse, "That A received at its point in the step [N·s, W].")
        .field("angular_impulse", &JointInfo::angular_impulse, "That A received besides [N·m·s, W].")
        .field("force", &JointInfo::force, "The impulse divided by the time step [N, W].")
        .field("torque", &JointInfo::torque, "The angular impulse divided by the time step [N·m, W].")
        .field("positions", &JointInfo::positions, "Of the free axes [rad or m]; angles count on over turns.")
        .field("speeds", &JointInfo::speeds, "Their rates [rad/s or m/s].")
        .field("redundant", &JointInfo::redundant,
               "How many of its conditions followed from those of others in the last step.")
        .finish(16);
}

}  // namespace

void bindBodyRecords(py::module_& module) {
    bindId<BodyId>(module, "BodyId", "A stable name of a body: it never names another body.");
    bindId<SpringId>(module, "SpringId", "A stable name of a spring.");
    bindId<JointId>(module, "JointId", "A stable name of a joint.");
    bindMaterialId(module);
    bindPose(module);
    bindShapes(module);
    bindMaterials(module);
    bindDescriptions(module);
    bindJoints(module);
}

}  // namespace cairn::python
