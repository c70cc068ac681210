#include "live_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "describe.h"

namespace cairn::view {

using nlohmann::json;

namespace {

/// A scene that a viewer fills by hand stays usable.
constexpr std::size_t most_bodies = 50000;

/// Materials that can always be thrown; a scene's own of the same name come first.
constexpr std::array<std::pair<const char*, double>, 3> common_materials = {
    {{"oak", 800}, {"iron", 7874}, {"granite", 2800}}};

// A grabbed body follows like a critically damped oscillator of this frequency: firm, without kicking a pile apart.
constexpr double grip_frequency = 20;  // [rad/s]
constexpr double grip_damping = 1.0;   // part of critical

/// A spring of a scene as a line; none if a body of it is gone.
std::optional<SpringLine> lineOf(const SceneRun& run, const SceneSpring& spring) {
    const World& world = run.world();
    const BodyId a = run.ids()[spring.a];
    if (!world.contains(a)) return std::nullopt;
    SpringLine line{world.pose(a).toOuter(spring.anchor_a), spring.anchor_b};
    if (spring.b) {
        const BodyId b = run.ids()[*spring.b];
        if (!world.contains(b)) return std::nullopt;
        line.to = world.pose(b).toOuter(spring.anchor_b);
    }
    return line;
}

}  // namespace

LiveWorld::LiveWorld(Scene scene, std::string title, const Settings& settings)
    : scene_(std::move(scene)), title_(std::move(title)), ends_(dialEnds(scene_)) {
    begin(settings);
}

void LiveWorld::begin(const Settings& settings) {
    auto run = std::make_unique<SceneRun>(scene_, settings);
    World& world = run->world();
    for (const auto& [name, density] : common_materials) {
        const auto known = world.materials();
        if (std::ranges::none_of(known, [&, name = name](const Material& m) { return m.name == name; })) {
            world.addMaterial({name, density});
        }
    }
    run_ = std::move(run);
    grips_.clear();
    sum_ = {};
    next_sample_ = 1 / simulation_steps_per_second;
    bodies_ = world.bodies();
    ++epoch_;
    dial_.reset();
    for (const double end : {0.0, 1.0}) {
        if (sameApartFromThreads(settings, settingsAt(ends_, end, settings))) dial_ = end;
    }
}

void LiveWorld::load(Scene scene, std::string title) {
    Settings settings = settingsFor(scene);
    settings.parallel = world().settings().parallel;
    LiveWorld next(std::move(scene), std::move(title), settings);
    next.epoch_ += epoch_;
    *this = std::move(next);
}

void LiveWorld::reset() {
    const Settings settings = world().settings();
    const std::optional<double> dial = dial_;
    begin(settings);
    dial_ = dial;
}

std::optional<Sample> LiveWorld::step() {
    run_->step();
    sum_.add(world().statistics());
    // Half a step of tolerance: the time is rounded, and simulation steps need not be whole.
    if (world().time() < next_sample_ - 0.5 * world().settings().timeStep()) return std::nullopt;
    Sample sample{world().time(), sum_, world().kineticEnergy(), world().potentialEnergy()};
    sum_ = {};
    next_sample_ = (std::floor(world().time() * simulation_steps_per_second + 0.5) + 1) / simulation_steps_per_second;
    return sample;
}

void LiveWorld::setDial(double value) {
    world().setSettings(settingsAt(ends_, value, world().settings()));
    dial_ = value;
}

void LiveWorld::setField(const SetField& field) {
    Settings settings = world().settings();
    cairn::setField(settings, field.name, field.value);
    world().setSettings(settings);
    if (dial_ && !sameApartFromThreads(settings, settingsAt(ends_, *dial_, settings))) dial_.reset();
}

MaterialId LiveWorld::material(const std::string& name) const {
    const auto all = world().materials();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].name == name) return static_cast<MaterialId>(i);
    }
    throw InputError(fmt::format("there is no material '{}' in this world", name));
}

BodyId LiveWorld::addBody(const BodyDescription& description) {
    if (world().bodyCount() >= most_bodies) {
        throw InputError(fmt::format("the world has {} bodies; viewers can add no more", world().bodyCount()));
    }
    return world().addBody(description);
}

BodyId LiveWorld::throwBall(const ThrowBall& ball) {
    BodyDescription description;
    description.shape = Sphere{ball.radius};
    description.material = material(ball.material);
    description.pose.position = ball.origin;
    description.linear_velocity = ball.velocity;
    return addBody(description);
}

BodyId LiveWorld::add(const AddBody& body) {
    BodyDescription description;
    description.shape = body.shape;
    description.material = material(body.material);
    description.pose.position = body.position;
    return addBody(description);
}

void LiveWorld::remove(BodyId body) {
    world().removeBody(body);
}

void LiveWorld::freeze(const FreezeBody& freeze) {
    world().setFixed(freeze.body, freeze.fixed);
}

void LiveWorld::grab(ClientId client, const GrabBody& grab) {
    release(client);
    const double mass = world().mass(grab.body);
    if (!std::isfinite(mass)) throw InputError("a fixed body cannot be pulled; unfreeze it first");
    SpringDescription spring;
    spring.a = grab.body;
    spring.anchor_a = world().pose(grab.body).toInner(grab.point);
    spring.anchor_b = grab.point;
    spring.stiffness = mass * grip_frequency * grip_frequency;
    spring.damping = 2 * grip_damping * mass * grip_frequency;
    grips_[client] = {world().addSpring(spring), grab.body, spring.anchor_a, grab.point};
}

void LiveWorld::drag(ClientId client, const DragBody& drag) {
    const auto grip = grips_.find(client);
    if (grip == grips_.end()) throw InputError("no body is grabbed");
    if (!world().contains(grip->second.body)) {
        grips_.erase(grip);
        throw InputError("the grabbed body is gone");
    }
    grip->second.target = drag.target;
    world().setSpringAnchor(grip->second.spring, drag.target);
}

void LiveWorld::release(ClientId client) {
    const auto grip = grips_.find(client);
    if (grip == grips_.end()) return;
    // The springs of a removed body went with it.
    if (world().contains(grip->second.body)) world().removeSpring(grip->second.spring);
    grips_.erase(grip);
}

RosterChange LiveWorld::updateRoster() {
    std::vector<BodyId> now = world().bodies();
    RosterChange change;
    std::ranges::set_difference(now, bodies_, std::back_inserter(change.added));
    std::vector<BodyId> gone;
    std::ranges::set_difference(bodies_, now, std::back_inserter(gone));
    for (const BodyId id : gone) change.removed.push_back(id.index);
    if (!change.added.empty() || !gone.empty()) {
        bodies_ = std::move(now);
        ++epoch_;
    }
    return change;
}

std::vector<SpringLine> LiveWorld::springLines() const {
    std::vector<SpringLine> lines;
    for (const SceneSpring& spring : scene_.springs) {
        if (const auto line = lineOf(*run_, spring)) lines.push_back(*line);
    }
    for (const auto& [client, grip] : grips_) {
        if (!world().contains(grip.body)) continue;
        lines.push_back({world().pose(grip.body).toOuter(grip.anchor), grip.target});
    }
    return lines;
}

std::optional<double> LiveWorld::dial() const {
    return dial_;
}

json LiveWorld::describeWorld() const {
    json bodies = json::array();
    for (const BodyId id : bodies_) bodies.push_back(describeBody(world(), id));
    return {{"type", "world"},
            {"epoch", epoch_},
            {"title", title_},
            {"materials", toJson(world().materials())},
            {"bodies", std::move(bodies)}};
}

json LiveWorld::describeChange(const RosterChange& change) const {
    json added = json::array();
    for (const BodyId id : change.added) added.push_back(describeBody(world(), id));
    return {{"type", "bodies"},
            {"epoch", epoch_},
            {"materials", toJson(world().materials())},
            {"added", std::move(added)},
            {"removed", change.removed}};
}

json LiveWorld::describeSelection(BodyId body) const {
    const World& w = world();
    const Pose pose = w.pose(body);
    json contacts = json::array();
    std::optional<std::uint32_t> batch;
    for (const ContactInfo& contact : w.contacts()) {
        if (contact.a != body && contact.b != body) continue;
        batch = contact.batch;
        const double sign = contact.a == body ? 1 : -1;
        contacts.push_back({{"other", bodyTitle(w, contact.a == body ? contact.b : contact.a)},
                            {"point", toJson(contact.point)},
                            {"normal", toJson(Vec3(sign * contact.normal))},
                            {"distance", contact.distance},
                            {"impulse", toJson(Vec3(sign * contact.impulse))}});
    }
    json joints = json::array();
    for (const JointId id : w.joints()) {
        const JointInfo joint = w.joint(id);
        if (joint.a != body && joint.b != body) continue;
        const std::optional<BodyId> other = joint.a == body ? joint.b : joint.a;
        joints.push_back({{"kind", static_cast<std::uint32_t>(joint.kind)},
                          {"other", other ? bodyTitle(w, *other) : "the world"},
                          {"position", joint.position},
                          {"force", joint.force.norm()},
                          {"torque", joint.torque.norm()}});
    }
    const double mass = w.mass(body);
    json selection = {{"type", "selection"},
                      {"body", {{"slot", body.index}, {"generation", body.generation}}},
                      {"name", bodyTitle(w, body)},
                      {"shape", describeShape(w.shape(body))},
                      {"material", w.materials()[static_cast<std::size_t>(w.material(body))].name},
                      {"mass", std::isfinite(mass) ? json(mass) : json(nullptr)},
                      {"position", toJson(pose.position)},
                      {"orientation", toJson(pose.orientation)},
                      {"velocity", toJson(w.linearVelocity(body))},
                      {"spin", toJson(w.angularVelocity(body))},
                      {"asleep", w.isAsleep(body)},
                      {"fixed", w.isFixed(body)},
                      {"batch", nullptr},
                      {"contacts", std::move(contacts)},
                      {"joints", std::move(joints)}};
    const std::vector<BatchInfo> batches = w.batches();
    if (batch && *batch < batches.size() && !w.isFixed(body)) {
        const BatchInfo& info = batches[*batch];
        selection["batch"] = {{"index", *batch}, {"bodies", info.bodies.size()}, {"contacts", info.contacts}};
    }
    return selection;
}

}  // namespace cairn::view
