#include <cmath>
#include <unordered_map>

#include "cairn/recording.h"
#include "record/layout.h"

namespace cairn {
namespace {

/// @tparam AnyFrame Frame or FramePart
template <class AnyFrame>
void captureContacts(const SceneRun& run, AnyFrame& frame) {
    const std::vector<BodyId>& ids = run.ids();
    std::unordered_map<std::uint32_t, std::size_t> index;  // of the scene, by slot
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (run.world().contains(ids[i])) index.emplace(ids[i].index, i);
    }
    for (const ContactInfo& contact : run.world().contacts()) {
        const auto a = index.find(contact.a.index);
        const auto b = index.find(contact.b.index);
        // Bodies that were added by other means have no number in the recording.
        if (a == index.end() || b == index.end()) continue;
        frame.contact_a.push_back(static_cast<std::int64_t>(a->second));
        frame.contact_b.push_back(static_cast<std::int64_t>(b->second));
        frame.contact_point.push_back(contact.point);
        frame.contact_normal.push_back(contact.normal);
        frame.contact_distance.push_back(contact.distance);
        frame.contact_impulse.push_back(contact.impulse);
    }
}

void captureJoints(const SceneRun& run, Frame& frame) {
    for (std::size_t i = 0; i < run.scene().joints.size(); ++i) {
        // The first joints of a world are numbered as they were added.
        const JointId id{static_cast<std::uint32_t>(i), 0};
        const bool there = run.world().contains(id);
        const JointInfo joint = there ? run.world().joint(id) : JointInfo{};
        frame.joint_point.push_back(there ? joint.anchor_a : layout::nowhere);
        frame.joint_force.push_back(there ? joint.force : layout::nowhere);
        frame.joint_torque.push_back(there ? joint.torque : layout::nowhere);
    }
}

}  // namespace

bool isFrameDue(const SceneRun& run, double frame_rate) {
    // With a tolerance of a millionth of a frame: step 8 of 240 ends at 1/30 s, whatever 8/240 is rounded to.
    const auto frames = [&](double time) { return std::floor(time * frame_rate + 1e-6); };
    const double step = run.world().settings().timeStep();
    return frames(run.world().time()) > frames(run.world().time() - step);
}

Frame captureFrame(const SceneRun& run, const Statistics& statistics, const RecordingOptions& what) {
    const World& world = run.world();
    const std::vector<BodyId>& ids = run.ids();
    Frame frame;
    frame.time = world.time();
    frame.position.assign(ids.size(), layout::nowhere);
    frame.orientation.assign(ids.size(), Quat::Identity());
    frame.linear_velocity.assign(ids.size(), Vec3::Zero());
    frame.angular_velocity.assign(ids.size(), Vec3::Zero());
    frame.asleep.assign(ids.size(), 0);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const BodyId id = ids[i];
        if (!world.contains(id)) continue;
        const Pose pose = world.pose(id);
        frame.position[i] = pose.position;
        frame.orientation[i] = pose.orientation;
        frame.linear_velocity[i] = world.linearVelocity(id);
        frame.angular_velocity[i] = world.angularVelocity(id);
        frame.asleep[i] = world.isAsleep(id) ? 1 : 0;
    }
    frame.statistics = statistics;
    frame.kinetic_energy = world.kineticEnergy();
    frame.potential_energy = world.potentialEnergy();
    if (what.contacts) captureContacts(run, frame);
    if (what.joints) captureJoints(run, frame);
    return frame;
}

FramePart captureFramePart(const SceneRun& run, const RecordingOptions& what) {
    const World& world = run.world();
    if (world.ranks() == nullptr)
        throw InputError("a part of a frame is of a run that ranks share; use captureFrame()");
    FramePart part;
    part.time = world.time();
    for (std::size_t i = 0; i < run.ids().size(); ++i) {
        const BodyId id = run.ids()[i];
        if (!world.isOwn(id)) continue;
        const Pose pose = world.pose(id);
        part.body.push_back(static_cast<std::int64_t>(i));
        part.position.push_back(pose.position);
        part.orientation.push_back(pose.orientation);
        part.linear_velocity.push_back(world.linearVelocity(id));
        part.angular_velocity.push_back(world.angularVelocity(id));
        part.asleep.push_back(world.isAsleep(id) ? 1 : 0);
    }
    if (what.contacts && (world.isDivided() || world.ranks()->rank() == 0)) captureContacts(run, part);
    for (std::size_t j = 0; what.joints && j < run.scene().joints.size(); ++j) {
        const JointId id{static_cast<std::uint32_t>(j), 0};
        if (!world.isOwn(id)) continue;
        const JointInfo joint = world.joint(id);
        part.joint.push_back(static_cast<std::int64_t>(j));
        part.joint_point.push_back(joint.anchor_a);
        part.joint_force.push_back(joint.force);
        part.joint_torque.push_back(joint.torque);
    }
    return part;
}

}  // namespace cairn
