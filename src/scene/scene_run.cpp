#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>

#include "cairn/scene.h"
#include "scene/body_title.h"
#include "scene/drives.h"
#include "scene/scene_survey.h"
#include "world/step_rate.h"

namespace cairn {
namespace {

constexpr std::string_view steps_field = "steps_per_second";

/// Steps per second that scene and overrides ask for; 0 = the preset's own.
double stepsPerSecond(const Scene& scene, const SettingOverrides& overrides) {
    Settings scratch;
    scratch.steps_per_second = 0;
    for (const auto& [name, value] : scene.settings) {
        if (name == steps_field) setField(scratch, name, value);
    }
    for (const auto& [name, text] : overrides.fields) {
        if (name != steps_field) continue;
        setFieldFromText(scratch, name, text);
        const double given = scratch.steps_per_second;
        if (overrides.steps_per_second && *overrides.steps_per_second != given) {
            throw InputError(fmt::format("{} is given twice, as {} and as {}; give it once", steps_field,
                                         *overrides.steps_per_second, given));
        }
    }
    if (overrides.steps_per_second) setField(scratch, steps_field, *overrides.steps_per_second);
    return scratch.steps_per_second;
}

/// All gravities that the scene has for long [m/s², W]: not those on the way from one to another.
std::vector<Vec3> gravities(const Scene& scene) {
    std::vector<Vec3> all{firstGravity(scene)};
    for (const SceneEvent& event : scene.events) {
        if (const auto* change = std::get_if<SetGravity>(&event.action)) all.push_back(change->gravity);
    }
    return all;
}

/// Magnitude of the weakest gravity that is not zero [m/s²]; 0 without any.
double weakestGravity(const Scene& scene) {
    double weakest = 0;
    for (const Vec3& gravity : gravities(scene)) {
        const double magnitude = gravity.norm();
        if (magnitude > 0 && (weakest == 0 || magnitude < weakest)) weakest = magnitude;
    }
    return weakest;
}

/// Runs something and puts what it is about before the text of its errors.
/// @param context a text, or what makes it
template <typename Context, typename Action>
auto inContext(const Context& context, Action action) {
    try {
        return action();
    } catch (const InputError& error) {
        if constexpr (std::is_invocable_v<Context>) {
            throw InputError(fmt::format("{}: {}", context(), error.what()));
        } else {
            throw InputError(fmt::format("{}: {}", context, error.what()));
        }
    }
}

using MaterialIds = std::map<std::string, MaterialId, std::less<>>;

MaterialId findMaterial(const MaterialIds& ids, const std::string& name) {
    const auto found = ids.find(name);
    if (found == ids.end()) throw InputError(fmt::format("material '{}' is not one of the scene's materials", name));
    return found->second;
}

MaterialIds addMaterials(const Scene& scene, World& world) {
    MaterialIds ids;
    for (const Material& material : scene.materials) ids.emplace(material.name, world.addMaterial(material));
    world.setDefaultPairProperties(scene.default_pair);
    for (const auto& [names, pair] : scene.pairs) {
        inContext(fmt::format("contacts '{}/{}'", names.first, names.second), [&, &key = names, &properties = pair] {
            world.setPairProperties(findMaterial(ids, key.first), findMaterial(ids, key.second), properties);
        });
    }
    for (const auto& [names, law] : scene.pair_laws) {
        inContext(fmt::format("contacts '{}/{}'", names.first, names.second), [&, &key = names, &its = law] {
            world.setPairLaw(findMaterial(ids, key.first), findMaterial(ids, key.second), its);
        });
    }
    return ids;
}

using GroupIds = std::map<std::string, GroupId, std::less<>>;

GroupId findGroup(const GroupIds& ids, const std::string& name) {
    const auto found = ids.find(name);
    if (found == ids.end()) throw InputError(fmt::format("group '{}' is not one of the scene's groups", name));
    return found->second;
}

GroupIds addGroups(const SceneFilters& filters, World& world) {
    GroupIds ids;
    for (const std::string& name : filters.groups) ids.emplace(name, world.addGroup(name));
    for (const auto& [a, b] : filters.apart) world.setGroupsTouch(findGroup(ids, a), findGroup(ids, b), Touch::never);
    return ids;
}

BodyDescription describe(const SceneBody& body, const MaterialIds& materials, const GroupIds& groups) {
    BodyDescription description;
    description.shape = body.shape;
    description.material = findMaterial(materials, body.material);
    description.mass = body.mass;
    description.centre_of_mass = body.centre_of_mass;
    description.inertia = body.inertia;
    description.pose = {body.position, body.orientation};
    description.linear_velocity = body.linear_velocity;
    description.angular_velocity = body.angular_velocity;
    description.fixed = body.fixed;
    description.asleep = body.asleep;
    description.name = body.name;
    for (const std::string& name : body.groups) description.groups.push_back(findGroup(groups, name));
    description.sensor = body.sensor;
    description.gravity_factor = body.gravity_factor;
    description.linear_damping = body.linear_damping;
    description.angular_damping = body.angular_damping;
    description.user_data = body.user_data;
    description.motion = body.motion;
    description.pivot = body.pivot;
    description.surface_velocity = body.surface_velocity;
    description.locked = body.locked;
    return description;
}

BodyId bodyId(const std::vector<BodyId>& ids, std::size_t index) {
    if (index >= ids.size()) {
        throw InputError(fmt::format("body {} does not exist; the scene has {} bodies", index, ids.size()));
    }
    return ids[index];
}

void addSpring(const SceneSpring& spring, const std::vector<BodyId>& ids, World& world) {
    SpringDescription description;
    description.a = bodyId(ids, spring.a);
    if (spring.b) description.b = bodyId(ids, *spring.b);
    description.anchor_a = spring.anchor_a;
    description.anchor_b = spring.anchor_b;
    description.stiffness = spring.stiffness;
    description.damping = spring.damping;
    description.rest_length = spring.rest_length;
    world.addSpring(description);
}

/// @param before ids of the joints that stand before it in the scene
JointId addJoint(const SceneJoint& joint, const std::vector<BodyId>& ids, const std::vector<JointId>& before,
                 World& world) {
    JointDescription description = joint.joint;
    const auto coupled = [&](const std::optional<std::size_t>& index) {
        if (*index < before.size()) return before[*index];
        throw InputError(fmt::format("joint {} does not stand before this one", *index));
    };
    if (joint.first) description.first = coupled(joint.first);
    if (joint.second) description.second = coupled(joint.second);
    if (joint.first || joint.second) return world.addJoint(description);
    description.a = bodyId(ids, joint.a);
    description.b = joint.b ? std::optional(bodyId(ids, *joint.b)) : std::nullopt;
    return world.addJoint(description);
}

/// True if the action is for a body that is no longer in the world.
template <class Action>
bool isGone(const World& world, const std::vector<BodyId>& ids, const Action& action) {
    if constexpr (requires { action.body; }) {
        return !world.contains(bodyId(ids, action.body));
    } else {
        return false;
    }
}

/// What an event does to a body.
struct BodyAction {
    World& world;
    const std::vector<BodyId>& ids;

    void operator()(const SetGravity& a) const { world.setGravity(a.gravity); }
    void operator()(const SetVelocity& a) const { world.setLinearVelocity(bodyId(ids, a.body), a.velocity); }
    void operator()(const GiveImpulse& a) const { world.applyImpulse(bodyId(ids, a.body), a.impulse); }
    void operator()(const SetForce& a) const { world.setConstantForce(bodyId(ids, a.body), a.force); }
    void operator()(const SetTorque& a) const { world.setConstantTorque(bodyId(ids, a.body), a.torque); }
    void operator()(const RemoveBody& a) const { world.removeBody(bodyId(ids, a.body)); }
};

/// @param exponent what the sizes of the bodies ask for
Settings settingsOf(const Scene& scene, int exponent, const SettingOverrides& overrides) {
    const Preset preset = overrides.preset.value_or(scene.preset.value_or(Preset::performance));
    Settings settings = Settings::preset(preset, stepsPerSecond(scene, overrides), weakestGravity(scene));
    settings = withKnownSteps(settings, exponent);
    for (const auto& [name, value] : scene.settings) {
        if (name != steps_field) setField(settings, name, value);
    }
    for (const auto& [name, text] : overrides.fields) setFieldFromText(settings, name, text);
    // A gravity that comes later is checked now, not in the middle of a run.
    for (const Vec3& gravity : gravities(scene)) validate(settings, gravity);
    return settings;
}

}  // namespace

Settings settingsFor(const Scene& scene, const SettingOverrides& overrides) {
    return settingsOf(scene, surveyOf(scene).step_exponent, overrides);
}

Settings settingsFor(const SceneSource& source, const SettingOverrides& overrides) {
    return settingsOf(source.scene(), source.survey().step_exponent, overrides);
}

SceneRun::SceneRun(SceneSource source, const Settings& settings) : SceneRun(std::move(source), settings, nullptr, {}) {}

SceneRun::SceneRun(SceneSource source, const Settings& settings, Ranks& ranks, const Partition& partition)
    : SceneRun(std::move(source), settings, &ranks, partition) {}

SceneRun::SceneRun(SceneSource source, const Settings& settings, Ranks* ranks, const Partition& partition)
    : source_(std::move(source)),
      world_(withKnownSteps(settings, source_.survey().step_exponent)),
      events_(byTime(scene().events)) {
    const MaterialIds materials = addMaterials(scene(), world_);
    const GroupIds groups = inContext("filters", [&] { return addGroups(scene().filters, world_); });
    inContext("gravity", [&] {
        if (scene().gravity_law) requireFunction(*scene().gravity_law, scene().gravity);
        world_.setGravity(scene().gravity, scene().gravity_law);
    });
    const SceneSurvey& survey = source_.survey();
    const bool deals_out = ranks != nullptr && survey.can_be_dealt_out;
    if (deals_out) world_.share(*ranks, partition, survey.places);
    ids_.reserve(survey.bodies);
    source_.forEachBody([&](const SceneBody& body) {
        inContext([&] { return bodyTitle(body, ids_.size()); },
                  [&] { ids_.push_back(world_.addBody(describe(body, materials, groups))); });
    });
    if (scene().frame_motion) inContext("frame_motion", [&] { world_.setFrameMotion(scene().frame_motion); });
    for (const SceneException& exception : scene().filters.exceptions) {
        inContext("filters",
                  [&] { world_.setPairTouch(bodyId(ids_, exception.a), bodyId(ids_, exception.b), exception.touch); });
    }
    for (std::size_t i = 0; i < scene().springs.size(); ++i) {
        inContext(fmt::format("spring {}", i), [&] { addSpring(scene().springs[i], ids_, world_); });
    }
    std::vector<JointId> joints;
    for (std::size_t i = 0; i < scene().joints.size(); ++i) {
        inContext(fmt::format("joint {}", i),
                  [&] { joints.push_back(addJoint(scene().joints[i], ids_, joints, world_)); });
    }
    takeDrives();
    if (ranks != nullptr && !deals_out) world_.share(*ranks, partition);
}

void SceneRun::takeDrives() {
    for (std::size_t i = 0; i < scene().drives.size(); ++i) {
        inContext(fmt::format("drive {}", i), [&] {
            requireDrive(scene().drives[i], scene());
            curves_.push_back(std::make_shared<const MotionCurve>(scene().drives[i].law));
        });
    }
}

void SceneRun::apply(const EventAction& action) {
    // A body that the user removed (through world()) has no more events; the scene itself cannot name one.
    const bool gone = std::visit([&](const auto& a) { return isGone(world_, ids_, a); }, action);
    if (!gone) std::visit(BodyAction{world_, ids_}, action);
}

void SceneRun::step() {
    // With a tolerance of a billionth of a step: an event at 0.1 s belongs to step 24 of 240, whatever 24/240 is
    // rounded to.
    const double now = world_.time() + 1e-9 * world_.settings().timeStep();
    while (next_event_ < events_.size() && events_[next_event_].time <= now) {
        const SceneEvent& event = events_[next_event_++];
        world_.gather();
        inContext(fmt::format("event at {} s", event.time), [&] { apply(event.action); });
    }
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        inContext(fmt::format("drive {}", i),
                  [&] { applyDrive(scene().drives[i], *curves_[i], scene(), ids_, world_); });
    }
    world_.step();
}

int SceneRun::stepsPerSimulationStep() const {
    // With a tolerance of a millionth: step 8 of 240 ends at 1/30 s, whatever 8/240 is rounded to.
    const double now = world_.time() * simulation_steps_per_second;
    const double next = std::floor(now + 1e-6) + 1;
    const double steps = (next - now) * world_.settings().steps_per_second / simulation_steps_per_second;
    return static_cast<int>(std::max(1.0, std::ceil(steps - 1e-6)));
}

Statistics SceneRun::simulationStep() {
    Statistics sum;
    for (int left = stepsPerSimulationStep(); left > 0; --left) {
        step();
        sum.add(world_.statistics());
    }
    return sum;
}

Statistics SceneRun::simulationStep(std::vector<std::uint64_t>& hashes) {
    Statistics sum;
    hashes.clear();
    for (int left = stepsPerSimulationStep(); left > 0; --left) {
        step();
        sum.add(world_.statistics());
        hashes.push_back(world_.stateHash());
    }
    return sum;
}

}  // namespace cairn
