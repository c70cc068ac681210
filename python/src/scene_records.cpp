/// Scenes: what a run begins with, as data.
#include "parts.h"
#include "record.h"

namespace cairn::python {

namespace {

/// The items of a dict, or of a sequence of pairs.
py::object itemsOf(py::handle value) {
    if (py::isinstance<py::dict>(value)) return py::list(value.attr("items")());
    return py::reinterpret_borrow<py::object>(value);
}

/// A field of pairs that may be given as a dict; it reads as a tuple of pairs.
template <class Type, class Member>
void pairsField(Record<Type>& record, const char* name, Member Type::*member, const char* doc) {
    record.fieldBy(
        name, [member](const Type& self) -> py::object { return py::tuple(py::cast(self.*member)); },
        [member](Type& self, py::handle value) { self.*member = itemsOf(value).cast<Member>(); }, doc);
}

/// The value of a setting as text; switches as the C++ library writes them.
std::string textOf(py::handle value) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
    if (py::isinstance<py::int_>(value) && py::hasattr(value, "name")) return value.attr("name").cast<std::string>();
    return py::str(value).cast<std::string>();
}

void bindSceneBodies(py::module_& module) {
    using B = SceneBody;
    Record<B>(module, "SceneBody", "A body of a scene; its index in Scene.bodies is its number in recordings.")
        .field("shape", &B::shape, "In its own frame.")
        .field("material", &B::material, "Name of one of Scene.materials.")
        .field("name", &B::name, "Unique if not empty.")
        .field("mass", &B::mass, "[kg]")
        .field("centre_of_mass", &B::centre_of_mass, "As that of BodyDescription.")
        .field("inertia", &B::inertia, "As that of BodyDescription.")
        .field("position", &B::position, "Of the shape's frame [m, W].")
        .field("orientation", &B::orientation, "Shape's frame to W: a quaternion (w, x, y, z).")
        .field("linear_velocity", &B::linear_velocity, "[m/s, W]")
        .field("angular_velocity", &B::angular_velocity, "[rad/s, W]")
        .field("fixed", &B::fixed, "Never moves.")
        .field("asleep", &B::asleep, "Begins asleep.")
        .field("groups", &B::groups, "Names of SceneFilters.groups.")
        .field("sensor", &B::sensor, "Touches nobody; World.sensed() and events say who is inside.")
        .field("gravity_factor", &B::gravity_factor,
               "Of the global accelerations that it feels, -1e3 to 1e3; 0 = weightless.")
        .field("linear_damping", &B::linear_damping, "Rate at which the linear velocity decays [1/s], 0 to 1e6.")
        .field("angular_damping", &B::angular_damping, "Rate at which the angular velocity decays [1/s], 0 to 1e6.")
        .field("user_data", &B::user_data, "A number of the user's own, 0 to 2⁶⁴ - 1.")
        .field("motion", &B::motion, "Of a fixed body: the law by which it moves.")
        .field("pivot", &B::pivot, "Of the motion [m, frame of the shape].")
        .field("surface_velocity", &B::surface_velocity,
               "Of a fixed body: with which its surface runs over it [m/s, frame of the shape].")
        .field("locked", &B::locked, "Axes of W along and about which a dynamic body does not move.")
        .finish(2);
    Record<SceneException>(module, "SceneException",
                           "An exception of two bodies of a scene from what their groups say.")
        .field("a", &SceneException::a, "Index in Scene.bodies.")
        .field("b", &SceneException::b, "Index in Scene.bodies.")
        .field("touch", &SceneException::touch, "Whether they do.")
        .finish(2);
    Record<SceneFilters>(module, "SceneFilters", "Which bodies of a scene touch each other.")
        .field("groups", &SceneFilters::groups, "Unique names, at most most_groups.")
        .field("apart", &SceneFilters::apart, "Pairs of groups that never touch.")
        .field("exceptions", &SceneFilters::exceptions, "Of pairs of bodies.")
        .finish()
        .def("is_empty", &SceneFilters::isEmpty, "Whether all bodies touch.");
    Record<SceneJoint>(module, "SceneJoint", "A joint of a scene.")
        .field("a", &SceneJoint::a, "Index in Scene.bodies.")
        .field("b", &SceneJoint::b, "Index in Scene.bodies; None = the world.")
        .field("joint", &SceneJoint::joint, "All else, as the bodies stand at the beginning.")
        .field("first", &SceneJoint::first, "Of gears, racks and mimics: index of an earlier one in Scene.joints.")
        .field("second", &SceneJoint::second, "Likewise: the joint that follows it.")
        .finish(3);
    Record<SceneDrive>(module, "SceneDrive",
                       "Lets something follow a function of time: start plus the displacement of a law of motion.")
        .field("what", &SceneDrive::what, "Of the target: position, speed, force or torque.")
        .field("target", &SceneDrive::target, "Index in Scene.joints or, of forces and torques, in Scene.bodies.")
        .field("axis", &SceneDrive::axis, "Which free axis of the joint.")
        .field("start", &SceneDrive::start, "Its value at the beginning; of joints x counts.")
        .field("law", &SceneDrive::law, "How it changes, in its unit in place of metres; without turns.")
        .finish(2);
    using S = SceneSpring;
    Record<S>(module, "SceneSpring", "A spring of a scene.")
        .field("a", &S::a, "Index of the body.")
        .field("b", &S::b, "Index of the second body; None = a point of the world.")
        .field("anchor_a", &S::anchor_a, "[m, frame of A]")
        .field("anchor_b", &S::anchor_b, "[m, frame of B or W]")
        .field("stiffness", &S::stiffness, "[N/m]")
        .field("damping", &S::damping, "[N·s/m]")
        .field("rest_length", &S::rest_length, "[m]")
        .finish(1);
}

void bindEvents(py::module_& module) {
    Record<SetGravity>(module, "SetGravity", "An event sets gravity.")
        .field("gravity", &SetGravity::gravity, "[m/s², W]")
        .finish(1);
    Record<SetVelocity>(module, "SetVelocity", "An event sets a body's velocity.")
        .field("body", &SetVelocity::body, "Index in Scene.bodies.")
        .field("velocity", &SetVelocity::velocity, "Linear [m/s, W].")
        .finish(2);
    Record<GiveImpulse>(module, "GiveImpulse", "An event gives a body an impulse at its centre of mass.")
        .field("body", &GiveImpulse::body, "Index in Scene.bodies.")
        .field("impulse", &GiveImpulse::impulse, "[N·s, W]")
        .finish(2);
    Record<SetForce>(module, "SetForce", "An event sets a body's constant force.")
        .field("body", &SetForce::body, "Index in Scene.bodies.")
        .field("force", &SetForce::force, "From then on, at the centre of mass [N, W].")
        .finish(2);
    Record<SetTorque>(module, "SetTorque", "An event sets a body's constant torque.")
        .field("body", &SetTorque::body, "Index in Scene.bodies.")
        .field("torque", &SetTorque::torque, "From then on [N·m, W].")
        .finish(2);
    Record<RemoveBody>(module, "RemoveBody", "An event takes a body out of the world.")
        .field("body", &RemoveBody::body, "Index in Scene.bodies.")
        .finish(1);
    Record<SceneEvent>(module, "SceneEvent", "Happens at the first time step that begins at or after its time.")
        .field("time", &SceneEvent::time, "[s], ≥ 0")
        .field("action", &SceneEvent::action, "What it does.")
        .finish(2);
}

void bindScene(py::module_& module) {
    Record<Scene> scene(module, "Scene", "Everything of a scene file, in its order.");
    scene.field("name", &Scene::name, "For messages and recordings.")
        .field("duration", &Scene::duration, "[s], > 0")
        .field("gravity", &Scene::gravity, "[m/s², W]")
        .field("gravity_law", &Scene::gravity_law, "How it changes, as in World.set_gravity; None = it stays.")
        .field("events", &Scene::events, "What happens at times.")
        .field("materials", &Scene::materials, "What bodies are made of.")
        .field("default_pair", &Scene::default_pair, "Of materials that have no pair of their own.");
    pairsField(scene, "pairs", &Scene::pairs, "Names of two materials, and what holds where they touch.");
    pairsField(scene, "pair_laws", &Scene::pair_laws, "Names of two of them, and what depends on speed there.");
    scene.field("filters", &Scene::filters, "Which bodies touch each other.")
        .field("frame_motion", &Scene::frame_motion, "The law by which the frame of the world moves; None = it rests.")
        .field("bodies", &Scene::bodies, "In the order of their numbers.")
        .field("springs", &Scene::springs, "Between bodies, or a body and the world.")
        .field("joints", &Scene::joints, "Between bodies, or a body and the world.")
        .field("drives", &Scene::drives, "What follows functions of time.")
        .field("preset", &Scene::preset, "Where the settings begin; None = performance.");
    pairsField(scene, "settings", &Scene::settings, "Names and values of other settings than the preset's.");
    scene.finish(2);

    Record<Scales>(module, "Scales", "What lengths, times and masses are multiplied by.")
        .field("length", &Scales::length, "> 0")
        .field("time", &Scales::time, "> 0")
        .field("mass", &Scales::mass, "> 0")
        .finish();
    Record<SettingOverrides> overrides(module, "SettingOverrides", "What overrides a scene's own settings.");
    overrides.field("preset", &SettingOverrides::preset, "In place of the scene's.")
        .field("steps_per_second", &SettingOverrides::steps_per_second, "In place of the preset's [1/s].")
        .fieldBy(
            "fields", [](const SettingOverrides& self) -> py::object { return py::tuple(py::cast(self.fields)); },
            [](SettingOverrides& self, py::handle value) {
                self.fields.clear();
                for (const py::handle item : itemsOf(value)) {
                    const auto [name, given] = item.cast<std::pair<std::string, py::object>>();
                    self.fields.emplace_back(name, textOf(given));
                }
            },
            "Names and values of settings; values read as text.")
        .finish();
    py::class_<BuiltInScene>(module, "BuiltInScene", "A built-in scene, or a family of them.")
        .def_readonly("name", &BuiltInScene::name, "As on the command line: 'stacks5', 'tower:N'.")
        .def_readonly("description", &BuiltInScene::description, "One sentence.")
        .def_readonly("example", &BuiltInScene::example, "A name that can be given: 'tower:10'.")
        .def("__repr__", [](const BuiltInScene& self) { return "BuiltInScene('" + std::string(self.name) + "')"; });
}

void bindSceneFunctions(py::module_& module) {
    module.def("read_scene", &readScene, py::arg("file"), "Reads a scene file. Raises InputError, IoError.");
    module.def("parse_scene", &parseScene, py::arg("json"), py::arg("source") = "text",
               "Reads the text of a scene file; source is shown in messages. Raises InputError.");
    module.def("write_scene", &writeScene, py::arg("scene"), py::arg("file"), "Writes a scene file. Raises IoError.");
    module.def("format_scene", py::overload_cast<const Scene&>(&formatScene), py::arg("scene"),
               "The scene as the text of a scene file.");
    module.def(
        "built_in_scenes", [] { return py::tuple(py::cast(builtInScenes())); },
        "All built-in scenes, in the order in which they are shown.");
    module.def("built_in_scene", &builtInScene, py::arg("name"),
               "Such as 'cage384' or 'tower:20'. Raises InputError for an unknown name or a bad number.");
    module.def(
        "scaled", &scaled, py::arg("scene"), py::arg("scales"),
        "The same scene larger, slower and heavier: every value by its unit. Where lengths are multiplied by the\n"
        "square of the time gravity stays, and everything happens alike; with Scales(4**n, 2**n, 64**n) bit for\n"
        "bit after the same number of steps. Raises InputError.");
    module.def("is_built_in_scene", &isBuiltInScene, py::arg("name"), "Whether a built-in scene has the name.");
    module.def(
        "settings_for",
        [](const Scene& scene, const std::optional<SettingOverrides>& overrides) {
            return settingsFor(scene, overrides.value_or(SettingOverrides{}));
        },
        py::arg("scene"), py::arg("overrides") = py::none(),
        "The settings of a run: preset, then the scene's, then the overrides. Raises InputError.");
}

}  // namespace

void bindSceneRecords(py::module_& module) {
    bindSceneBodies(module);
    bindEvents(module);
    bindScene(module);
    bindSceneFunctions(module);
}

}  // namespace cairn::python
