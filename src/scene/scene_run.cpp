#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cairn/scene.h"
#include "scene/body_title.h"
#include "scene/drives.h"
#include "sharing/body_records.h"
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
    std::vector<Vec3> all{scene.gravity};
    if (scene.gravity_law) {
        const MotionCurve curve(*scene.gravity_law);
        if (const auto end = curve.end()) all.front() += curve.at(*end).displacement;
    }
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

/// What the sizes of the scene's bodies ask for.
int stepExponent(const Scene& scene) {
    std::vector<double> extents;
    for (const SceneBody& body : scene.bodies) {
        if (!body.fixed && !body.motion) extents.push_back(middleExtent(body.shape));
    }
    return cairn::stepExponent(extents, gravities(scene).front().norm());
}

/// Runs something and puts what it is about before the text of its errors.
template <typename Action>
auto inContext(const std::string& context, Action action) {
    try {
        return action();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", context, error.what()));
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

/// Whether ranks can get their bodies one by one: nothing that all must know names a body that moves.
bool canBeDealtOut(const Scene& scene) {
    const bool is_tied = !scene.springs.empty() || !scene.joints.empty() || !scene.drives.empty() ||
                         !scene.filters.exceptions.empty() || scene.frame_motion.has_value();
    const auto isDealable = [](const SceneBody& body) {
        const bool is_fixed = body.fixed || body.motion.has_value();
        return body.position.allFinite() && (is_fixed || (isSent(body.shape) && body.locked.empty()));
    };
    return !is_tied && std::ranges::all_of(scene.bodies, isDealable);
}

/// Where the bodies that move are [m, W].
std::vector<Vec3> placesIn(const Scene& scene) {
    std::vector<Vec3> places;
    for (const SceneBody& body : scene.bodies) {
        if (!body.fixed && !body.motion) places.push_back(body.position);
    }
    return places;
}

}  // namespace

Settings settingsFor(const Scene& scene, const SettingOverrides& overrides) {
    const Preset preset = overrides.preset.value_or(scene.preset.value_or(Preset::performance));
    Settings settings = Settings::preset(preset, stepsPerSecond(scene, overrides), weakestGravity(scene));
    settings = withKnownSteps(settings, stepExponent(scene));
    for (const auto& [name, value] : scene.settings) {
        if (name != steps_field) setField(settings, name, value);
    }
    for (const auto& [name, text] : overrides.fields) setFieldFromText(settings, name, text);
    // A gravity that comes later is checked now, not in the middle of a run.
    for (const Vec3& gravity : gravities(scene)) validate(settings, gravity);
    return settings;
}

SceneRun::SceneRun(Scene scene, const Settings& settings) : SceneRun(std::move(scene), settings, nullptr, {}) {}

SceneRun::SceneRun(Scene scene, const Settings& settings, Ranks& ranks, const Partition& partition)
    : SceneRun(std::move(scene), settings, &ranks, partition) {}

SceneRun::SceneRun(Scene scene, const Settings& settings, Ranks* ranks, const Partition& partition)
    : scene_(std::move(scene)), world_(withKnownSteps(settings, stepExponent(scene_))) {
    std::stable_sort(scene_.events.begin(), scene_.events.end(),
                     [](const SceneEvent& a, const SceneEvent& b) { return a.time < b.time; });
    const MaterialIds materials = addMaterials(scene_, world_);
    const GroupIds groups = inContext("filters", [&] { return addGroups(scene_.filters, world_); });
    inContext("gravity", [&] {
        if (scene_.gravity_law) requireFunction(*scene_.gravity_law, scene_.gravity);
        world_.setGravity(scene_.gravity, scene_.gravity_law);
    });
    const bool deals_out = ranks != nullptr && canBeDealtOut(scene_);
    if (deals_out) world_.share(*ranks, partition, placesIn(scene_));
    ids_.reserve(scene_.bodies.size());
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
        inContext(bodyTitle(scene_, i),
                  [&] { ids_.push_back(world_.addBody(describe(scene_.bodies[i], materials, groups))); });
    }
    if (scene_.frame_motion) inContext("frame_motion", [&] { world_.setFrameMotion(scene_.frame_motion); });
    for (const SceneException& exception : scene_.filters.exceptions) {
        inContext("filters",
                  [&] { world_.setPairTouch(bodyId(ids_, exception.a), bodyId(ids_, exception.b), exception.touch); });
    }
    for (std::size_t i = 0; i < scene_.springs.size(); ++i) {
        inContext(fmt::format("spring {}", i), [&] { addSpring(scene_.springs[i], ids_, world_); });
    }
    std::vector<JointId> joints;
    for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
        inContext(fmt::format("joint {}", i),
                  [&] { joints.push_back(addJoint(scene_.joints[i], ids_, joints, world_)); });
    }
    takeDrives();
    if (ranks != nullptr && !deals_out) world_.share(*ranks, partition);
}

void SceneRun::takeDrives() {
    for (std::size_t i = 0; i < scene_.drives.size(); ++i) {
        inContext(fmt::format("drive {}", i), [&] {
            requireDrive(scene_.drives[i], scene_);
            curves_.push_back(std::make_shared<const MotionCurve>(scene_.drives[i].law));
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
    while (next_event_ < scene_.events.size() && scene_.events[next_event_].time <= now) {
        const SceneEvent& event = scene_.events[next_event_++];
        world_.gather();
        inContext(fmt::format("event at {} s", event.time), [&] { apply(event.action); });
    }
    if (!curves_.empty()) world_.gather();
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        inContext(fmt::format("drive {}", i), [&] { applyDrive(scene_.drives[i], *curves_[i], scene_, ids_, world_); });
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
