#include "quality.h"

#include <algorithm>
#include <cmath>

namespace cairn::bench {

namespace {

constexpr double farthest = 1e6;           ///< a body beyond is lost [m]
constexpr std::size_t moving_frames = 10;  ///< a third of a second
constexpr double moving_speed = 0.01;      ///< [m/s]
constexpr double turning_speed = 0.1;      ///< [rad/s]

bool isSane(const Pose& pose) {
    return pose.position.allFinite() && pose.orientation.coeffs().allFinite() &&
           pose.position.cwiseAbs().maxCoeff() < farthest;
}

/// The rotation from one orientation to another as axis times angle, up to π [rad, W].
Vec3 rotationBetween(const Quat& from, const Quat& to) {
    Quat turn = to * from.conjugate();
    if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
    const double sine = turn.vec().norm();
    if (sine == 0) return Vec3::Zero();
    return turn.vec() * (2 * std::atan2(sine, turn.w()) / sine);
}

/// A world that simulates nothing: it only finds the contacts of the poses it is given.
class OverlapMeter {
  public:
    explicit OverlapMeter(const Scene& scene) : run_(bareScene(scene), bareSettings()), gone_(run_.ids().size(), 0) {}

    /// @return the statistics with the overlaps
    const Statistics& measure(const RigidScene& scene, const std::vector<Pose>& poses) {
        World& world = run_.world();
        for (std::size_t i = 0; i < poses.size(); ++i) {
            if (scene.bodies()[i].fixed || gone_[i] != 0) continue;
            if (isSane(poses[i])) {
                world.setPose(run_.ids()[i], poses[i]);
            } else {
                world.removeBody(run_.ids()[i]);
                gone_[i] = 1;
            }
        }
        run_.step();
        return world.statistics();
    }

  private:
    /// Without anything that moves or sleeps.
    static Scene bareScene(Scene scene) {
        scene.events.clear();
        scene.gravity.setZero();
        for (SceneBody& body : scene.bodies) {
            body.asleep = false;
            body.linear_velocity.setZero();
            body.angular_velocity.setZero();
        }
        return scene;
    }
    static Settings bareSettings() {
        Settings settings;
        settings.detection.contact_margin = 0;
        settings.correction.correction = CorrectionKind::none;
        settings.resolution.resolution = ResolutionKind::none;
        settings.sleep.sleeping = false;
        settings.sleep.damping = 0;
        return settings;
    }

    SceneRun run_;
    std::vector<std::uint8_t> gone_;  ///< per body; 1 = its pose was not finite once
};

/// Mechanical energy in the middle of a simulation step, with the mean velocities of the step. Over a single time step
/// the way by which an engine moves overlapping bodies apart would look like a velocity that nobody has.
double energyOf(const RigidScene& scene, const std::vector<Pose>& before, const std::vector<Pose>& after,
                const Vec3& gravity) {
    double energy = 0;
    for (std::size_t i = 0; i < scene.bodies().size(); ++i) {
        const RigidBody& body = scene.bodies()[i];
        const Pose& from = before[i];
        const Pose& to = after[i];
        if (body.fixed || !isSane(from) || !isSane(to)) continue;
        const Vec3 v = (to.position - from.position) * simulation_steps_per_second;
        const Vec3 turn = rotationBetween(from.orientation, to.orientation);
        const Vec3 w = from.orientation.conjugate() * (turn * simulation_steps_per_second);
        energy += 0.5 * body.mass * v.squaredNorm() + 0.5 * w.dot(body.principal_inertia.cwiseProduct(w)) -
                  body.mass * gravity.dot(0.5 * (from.position + to.position));
    }
    return energy;
}

double startEnergyOf(const RigidScene& scene, const Vec3& gravity) {
    double energy = 0;
    for (const RigidBody& body : scene.bodies()) {
        if (body.fixed) continue;
        const Vec3 w = body.pose.orientation.conjugate() * body.angular_velocity;
        energy += 0.5 * body.mass * body.linear_velocity.squaredNorm() +
                  0.5 * w.dot(body.principal_inertia.cwiseProduct(w)) - body.mass * gravity.dot(body.pose.position);
    }
    return energy;
}

/// Zero of the potential energy: all bodies at the height of the lowest one.
double groundEnergyOf(const RigidScene& scene, const std::vector<Pose>& poses, const Vec3& gravity) {
    double most = -1e300;  // along gravity
    double mass = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (scene.bodies()[i].fixed || !isSane(poses[i])) continue;
        most = std::max(most, gravity.dot(poses[i].position));
        mass += scene.bodies()[i].mass;
    }
    return mass > 0 ? -mass * most : 0;
}

std::vector<Pose> startPoses(const RigidScene& scene) {
    std::vector<Pose> poses;
    for (const RigidBody& body : scene.bodies()) poses.push_back(body.pose);
    return poses;
}

/// Gains over the reference, which begins anew whenever gravity changes.
void measureEnergy(const RigidScene& scene, const Trajectory& trajectory, double time_step, Quality& quality) {
    const std::vector<Pose> start = startPoses(scene);
    Vec3 gravity = scene.gravityAt(0, time_step);
    double reference = startEnergyOf(scene, gravity);
    double scale = reference - groundEnergyOf(scene, start, gravity);
    for (std::size_t i = 0; i < trajectory.size(); ++i) {
        const std::vector<Pose>& before = i == 0 ? start : trajectory[i - 1];
        const double end = static_cast<double>(i + 1) / simulation_steps_per_second;
        // No energy is kept while gravity changes.
        if (scene.gravityAt(end - time_step, time_step) == gravity) {
            const double gain = energyOf(scene, before, trajectory[i], gravity) - reference;
            quality.energy_gain = std::max(quality.energy_gain, gain);
            if (scale > 0) quality.energy_gain_part = std::max(quality.energy_gain_part, gain / scale);
        }
        const Vec3& next = scene.gravityAt(end, time_step);
        if (next == gravity) continue;
        gravity = next;
        reference = energyOf(scene, before, trajectory[i], gravity);
        scale = reference - groundEnergyOf(scene, trajectory[i], gravity);
    }
}

std::size_t countMoving(const RigidScene& scene, const Trajectory& frames) {
    const std::size_t back = std::min(moving_frames, frames.size() - 1);
    if (back == 0) return 0;
    const std::vector<Pose>& earlier = frames[frames.size() - 1 - back];
    const double time = static_cast<double>(back) / simulation_steps_per_second;
    std::size_t moving = 0;
    for (std::size_t i = 0; i < scene.bodies().size(); ++i) {
        if (scene.bodies()[i].fixed) continue;
        const Pose& from = earlier[i];
        const Pose& to = frames.back()[i];
        const bool slow = (to.position - from.position).norm() <= moving_speed * time &&
                          rotationBetween(from.orientation, to.orientation).norm() <= turning_speed * time;
        if (!slow) ++moving;  // a pose that is not finite is not slow
    }
    return moving;
}

bool isBehind(const RigidBody& plane, const Vec3& p_W) {
    const auto* half_space = std::get_if<HalfSpace>(&plane.shape);
    if (half_space == nullptr) return false;
    return half_space->normal.normalized().dot(plane.pose.toInner(p_W)) < half_space->offset;
}

std::size_t countLost(const RigidScene& scene, const std::vector<Pose>& poses) {
    std::size_t lost = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (scene.bodies()[i].fixed) continue;
        const bool behind = std::any_of(scene.bodies().begin(), scene.bodies().end(),
                                        [&](const RigidBody& body) { return isBehind(body, poses[i].position); });
        if (!isSane(poses[i]) || behind) ++lost;
    }
    return lost;
}

void measureEnd(const RigidScene& scene, const std::vector<Pose>& poses, Quality& quality) {
    const Vec3& gravity = scene.gravity().back().gravity;
    const Vec3 up = gravity.isZero(0) ? Vec3(Vec3::UnitZ()) : Vec3(-gravity.normalized());
    bool first = true;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const RigidBody& body = scene.bodies()[i];
        if (body.fixed || !isSane(poses[i])) continue;
        const double height = up.dot(poses[i].position);
        quality.highest = first ? height : std::max(quality.highest, height);
        quality.drift = std::max(quality.drift, (poses[i].position - body.pose.position).norm());
        first = false;
    }
    quality.lost = countLost(scene, poses);
}

}  // namespace

Quality measureQuality(const Scene& scene, const RigidScene& rigid, const Trajectory& trajectory, double time_step) {
    Quality quality;
    OverlapMeter meter(scene);
    for (const std::vector<Pose>& poses : trajectory) {
        const Statistics& found = meter.measure(rigid, poses);
        quality.largest_overlap = std::max(quality.largest_overlap, found.largest_overlap);
        quality.mean_overlap += found.mean_overlap;
        quality.resting_largest = found.largest_overlap;
        quality.resting_mean = found.mean_overlap;
    }
    quality.mean_overlap /= static_cast<double>(trajectory.size());
    measureEnergy(rigid, trajectory, time_step, quality);
    quality.moving = countMoving(rigid, trajectory);
    measureEnd(rigid, trajectory.back(), quality);
    return quality;
}

}  // namespace cairn::bench
