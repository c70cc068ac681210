/// Any sequence of calls is carried out or refused with InputError, and no step breaks an invariant. A copy from a
/// snapshot goes on in the same way, and going back to a moment undoes everything. Usual worlds without restitution are
/// also held to their energy.
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "cairn/world.h"
#include "fuzz/bytes.h"

namespace {

using namespace cairn;

constexpr std::size_t most_bodies = 24;

void setPair(World& world, fuzz::Bytes& in) {
    PairProperties pair{
        .restitution = 0, .static_friction = std::abs(in.number(2)), .kinetic_friction = std::abs(in.number(2))};
    // Restitution and friction of one skew impact may together raise the energy, as Newton's law of impact does.
    if (in.range() == fuzz::Range::any) pair.restitution = in.number(1);
    world.setDefaultPairProperties(pair);
}

/// What the calls so far made.
struct Made {
    std::vector<BodyId> bodies;
    std::vector<SpringId> springs;
    std::vector<JointId> joints;
    RollbackState moment;
    std::vector<std::byte> moment_saved;  ///< the world of the moment; empty before there is one

    static constexpr std::size_t most_joints = 16;
};

/// One of them, or an id of nothing.
template <class Id>
Id anyOf(const std::vector<Id>& ids, fuzz::Bytes& in) {
    return ids.empty() ? Id{} : ids[in.below(static_cast<std::uint32_t>(ids.size()))];
}

void addJoint(World& world, fuzz::Bytes& in, Made& made) {
    if (made.joints.size() >= Made::most_joints) return;
    JointDescription d{.kind = static_cast<JointKind>(in.below(15)), .a = anyOf(made.bodies, in)};
    if (in.below(2) == 0) d.b = anyOf(made.bodies, in);
    d.anchor = in.vector(2);
    if (d.kind == JointKind::distance || d.kind == JointKind::rope) d.anchor_b = in.vector(2);
    if (in.below(2) == 0) d.axis = in.vector(1);
    if (in.below(4) == 0) d.length = std::abs(in.number(2));
    if (in.below(4) == 0) d.lower = in.number(1);
    if (in.below(4) == 0) d.upper = in.number(1);
    if (in.below(4) == 0) d.motor = JointMotor{in.number(10), std::abs(in.number(100))};
    if (in.below(4) == 0) d.break_force = std::abs(in.number(1e3));
    if (in.below(4) == 0) d.break_torque = std::abs(in.number(1e3));
    d.collide = in.below(2) == 0;
    if (in.below(4) == 0) d.axis_2 = in.vector(1);
    if (in.below(4) == 0) d.cone = in.number(2);
    if (d.kind == JointKind::screw) d.lead = in.number(1);
    if (in.below(4) == 0)
        d.servo = JointServo{in.number(2), in.number(2), in.number(1e6), in.number(1e6), in.number(1e3)};
    if (in.below(4) == 0) d.spring = JointSpring{in.number(1e6), in.number(1)};
    if (in.below(4) == 0) d.damping = in.number(1e3);
    if (in.below(4) == 0) d.friction = in.number(1e2);
    if (in.below(4) == 0) d.rotor_inertia = in.number(10);
    for (std::uint32_t left = in.below(4); left > 0; --left) {
        d.axes.push_back({.along = static_cast<JointAlong>(in.below(7)), .friction = in.number(10)});
    }
    if (d.kind >= JointKind::gear) {
        d = {.kind = d.kind, .first = anyOf(made.joints, in), .second = anyOf(made.joints, in), .ratio = in.number(5)};
    }
    made.joints.push_back(world.addJoint(d));
}

/// Keeps a moment, or goes back to it.
void travel(World& world, fuzz::Bytes& in, Made& made) {
    if (in.below(2) == 0) {
        world.keep(made.moment);
        world.saveTo(made.moment_saved);
    } else {
        world.load(made.moment);
        fuzz::require(world.save() == made.moment_saved);
    }
}

Motion anyMotion(fuzz::Bytes& in) {
    switch (in.below(3)) {
        case 0:
            return ConstantMotion{in.vector(3), in.vector(3)};
        case 1:
            return SineMotion{in.vector(1), in.vector(1), std::abs(in.number(5)), in.number(3)};
        default:
            TableMotion table;
            for (std::uint32_t left = in.below(5); left > 0; --left) {
                table.times.push_back((table.times.empty() ? 0 : table.times.back()) + in.number(1));
                table.displacements.push_back(in.vector(1));
                if (in.below(4) != 0) table.turns.push_back(in.vector(1));
            }
            table.end = static_cast<TableEnd>(in.below(2));
            return table;
    }
}

/// Motions by laws, and who touches whom.
void actOnLaws(World& world, fuzz::Bytes& in, Made& made) {
    const BodyId id = anyOf(made.bodies, in);
    const auto group = [&] { return static_cast<GroupId>(in.below(4)); };
    const auto touch = [&] { return static_cast<Touch>(in.below(2)); };
    switch (in.below(11)) {
        case 0:
            return world.setMotion(id, anyMotion(in), in.vector(1));
        case 1:
            return world.stopMotion(id);
        case 2:
            return world.setFrameMotion(in.below(2) == 0 ? std::nullopt : std::optional(anyMotion(in)));
        case 3:
            return world.setSurfaceVelocity(id, in.vector(3));
        case 4:
            world.addGroup(std::string(1 + in.below(4), 'g'));
            return;
        case 5:
            return world.setGroupsTouch(group(), group(), touch());
        case 6: {
            const GroupId groups[] = {group(), group()};
            return world.setGroups(id, groups);
        }
        case 7:
            return world.setPairTouch(id, anyOf(made.bodies, in), touch());
        case 8:
            return world.setGravityFactor(id, in.number(3));
        case 9:
            return world.setGravity(in.vector(10), anyMotion(in));
        default:
            return world.setDamping(id, in.number(10), in.number(10));
    }
}

void ask(const World& world, fuzz::Bytes& in) {
    const auto hit = world.castRay({in.vector(5), in.vector(1)});
    const auto all = world.castRayThrough({in.vector(5), in.vector(1)});
    const Pose pose{in.vector(3), fuzz::rotation(in)};
    const auto met = world.castShape(Sphere{0.1}, pose, in.vector(5));
    fuzz::require(!met || std::isfinite(met->distance));
    fuzz::require(!hit || std::isfinite(hit->distance));
    for (std::size_t i = 1; i < all.size(); ++i) fuzz::require(all[i - 1].distance <= all[i].distance);
    fuzz::require(world.overlap(Box{}, pose).size() <= 4 * world.bodyCount());
}

/// One call with arguments from the bytes, good or bad.
void act(World& world, fuzz::Bytes& in, Made& made) {
    std::vector<BodyId>& ids = made.bodies;
    std::vector<SpringId>& springs = made.springs;
    const BodyId id = anyOf(ids, in);
    switch (in.below(32)) {
        case 0:
        case 1:
        case 2:
        case 3: {
            if (world.bodyCount() >= most_bodies) return;
            BodyDescription d;
            d.shape = fuzz::anyShape(in);
            d.material = static_cast<MaterialId>(in.below(3));
            d.pose = {in.vector(2), fuzz::rotation(in)};
            d.fixed = in.below(4) == 0 || std::holds_alternative<HalfSpace>(d.shape);
            if (in.range() == fuzz::Range::any && in.below(4) == 0) d.mass = std::abs(in.number(1e6));
            if (in.below(4) == 0) d.linear_velocity = in.vector(30);
            if (in.below(4) == 0) d.angular_velocity = in.vector(30);
            d.asleep = in.below(4) == 0;
            d.sensor = in.below(16) == 0;
            ids.push_back(world.addBody(d));
            return;
        }
        case 4:
            return world.removeBody(id);
        case 5:
            return world.setPose(id, {in.vector(3), fuzz::rotation(in)});
        case 6:
            return world.setLinearVelocity(id, in.vector(1e3));
        case 7:
            return world.setAngularVelocity(id, in.vector(1e3));
        case 8:
            return world.setFixed(id, in.below(2) == 0);
        case 9:
            return world.wake(id);
        case 10:
            return world.applyForce(id, in.vector(1e4));
        case 11:
            return world.applyForceAt(id, in.vector(1e4), in.vector(3));
        case 12:
            return world.applyImpulse(id, in.vector(1e3));
        case 13:
            return world.applyImpulseAt(id, in.vector(1e3), in.vector(3));
        case 14:
            return world.applyAngularImpulse(id, in.vector(10));
        case 15:
            return world.setConstantForce(id, in.vector(100));
        case 16:
            return world.setConstantTorque(id, in.vector(10));
        case 17: {
            SpringDescription d{.a = id, .stiffness = std::abs(in.number(1e5)), .damping = std::abs(in.number(100))};
            if (in.below(2) == 0 && !ids.empty()) d.b = anyOf(ids, in);
            springs.push_back(world.addSpring(d));
            return;
        }
        case 18:
            return world.setGravity(in.vector(20));
        case 19:
            return world.setGlobalAcceleration(in.vector(20));
        case 20: {
            Settings s = world.settings();
            constexpr std::array kinds = {ResolutionKind::impulse_queue, ResolutionKind::sweep,
                                          ResolutionKind::accelerated_sweeps, ResolutionKind::none};
            s.resolution.resolution = kinds[in.below(kinds.size())];
            s.sleep.sleeping = in.below(2) == 0;
            ResolutionKind& kind = s.resolution.resolution;
            if (in.below(2) == 1 && kind == ResolutionKind::impulse_queue) kind = ResolutionKind::arbitrary_order;
            s.steps_per_second = 30 + 300 * std::abs(in.within(1));
            return world.setSettings(s);
        }
        case 21:
            return setPair(world, in);
        case 22:
            return world.removeSpring(anyOf(springs, in));
        case 23:
        case 24:
            return addJoint(world, in, made);
        case 25:
            return world.removeJoint(anyOf(made.joints, in));
        case 26:
            return world.setJointMotor(anyOf(made.joints, in), {in.number(10), std::abs(in.number(100))});
        case 27: {
            const JointId joint = anyOf(made.joints, in);
            const double lower = in.number(2);
            return world.setJointLimits(joint, lower, lower + std::abs(in.number(1)));
        }
        case 28:
            return travel(world, in, made);
        case 29:
            return actOnLaws(world, in, made);
        case 30:
            return ask(world, in);
        default:
            world.step();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes in(data, size < 2000 ? size : 2000);
    World world;
    world.addMaterial({"oak", 800});
    world.addMaterial({"steel", 7800});
    in.setRange(in.below(2) == 0 ? fuzz::Range::usual : fuzz::Range::any);
    const bool usual = in.range() == fuzz::Range::usual;
    world.setChecks(usual ? Checks::on : Checks::state);
    // What may bounce by Newton's law is not held to its energy.
    if (usual) world.setDefaultPairProperties({.restitution = 0});
    world.setEventLevel(EventLevel::all);
    Made made;
    while (!in.empty()) {
        try {
            act(world, in, made);
        } catch (const InputError&) {
            // Bad arguments are part of the game; the world must be as it was, which the checks of the next step show.
        }
    }
    const std::vector<std::byte> snapshot = world.save();
    World copy = World::restore(snapshot);
    for (int i = 0; i < 5; ++i) {
        world.step();
        copy.step();
        fuzz::require(world.stateHash() == copy.stateHash());
    }
    return 0;
}
