#include <limits>

#include "cairn/recording.h"

namespace cairn {

Frame captureFrame(const SceneRun& run, const Statistics& statistics) {
    const World& world = run.world();
    const std::vector<BodyId>& ids = run.ids();
    Frame frame;
    frame.time = world.time();
    frame.position.assign(ids.size(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
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
    return frame;
}

}  // namespace cairn
