/// @file Moves jointed bodies so that their joints hold at the end of the step.
#pragma once

#include <span>
#include <vector>

#include "body/contact.h"
#include "cairn/settings.h"
#include "integration/integration.h"
#include "joints/joint_groups.h"
#include "joints/joint_system.h"

namespace cairn {

/// Velocities along a mechanism lead off it by a distance of second order. The impulses that prevent it act at the
/// beginning of the step, in the directions that the joints have there, and stay in the velocities; with the projection
/// of the velocities by the resolution this is the RATTLE method: of second order, symmetric in time and symplectic, so
/// that mechanisms neither gain nor lose energy in the long run.
/// What was off before (bodies that were put somewhere, penetration corrections) is taken back without a trace in the
/// velocities, large errors slowly. @source Andersen, RATTLE, Journal of Computational Physics 52 (1983),
/// doi:10.1016/0021-9991(83)90014-1
///
/// With exact flight half of a step's gravity acts on the flight, which makes the method one of second order. Groups
/// that rest on something, or that friction, springs or servos hold, fly without, or they would be moved against it.
class JointFlight {
  public:
    /// How the bodies of joints move in a step.
    struct Motion {
        IntegrationSettings integration;
        SleepSettings sleep;
        Vec3 acceleration;                    ///< sum of the global accelerations [m/s², W]
        double time_step;                     ///< [s]
        std::span<const Contact> contacts{};  ///< of the last step
    };

    /// Notes where awake groups are before advancePositions().
    void begin(std::span<Joint> joints, const JointGroups& groups, const BodyStorage& bodies, const Motion& motion);
    /// Moves their bodies anew so that the joints hold, after advancePositions().
    void finish(std::span<Joint> joints, const JointGroups& groups, BodyStorage& bodies, const Motion& motion);

  private:
    /// Where a body was.
    struct Start {
        Pose pose;
        Twist velocity;
        Vec3 half_kick;  ///< what half a step of the forces adds to the velocity; with exact flight only [m/s, W]
    };
    /// A group in flight.
    struct Flight {
        std::span<const std::uint32_t> joints;
        std::span<const BodyIndex> bodies;
        std::span<const Start> start;
        std::span<JointBlock> blocks;  ///< at the start
        double time_step;
    };

    /// Whether a contact of the last step pushed and is not parting as after an impact.
    static bool isResting(const Contact& contact, const BodyStorage& bodies, const Motion& motion);
    void saveKicks(std::span<const Joint> joints, const JointGroups& groups, std::size_t group,
                   const BodyStorage& bodies, const Motion& motion);
    void fly(const Flight& flight, std::span<Joint> joints, BodyStorage& bodies);
    void flyWithout(const Flight& flight, BodyStorage& bodies);
    void report(const Flight& flight, const BodyStorage& bodies, std::span<Joint> joints) const;
    void moveAgain(const Flight& flight, BodyStorage& bodies) const;
    double keepBounds(const Flight& flight);
    void addResponse(double impulse);
    void moveBack(const Flight& flight, std::span<const Joint> joints, BodyStorage& bodies);
    void pushBack(const JointBlock& block, const BoundRow& bound, double part);
    void displace(const Flight& flight, BodyStorage& bodies) const;
    void setMasses(const Flight& flight, const BodyStorage& bodies);

    std::vector<Start> start_;          ///< [bodies of groups]
    std::vector<std::uint8_t> pushed_;  ///< [slots] 1 = rests on a contact
    std::vector<JointBlock> blocks_;    ///< [joints of groups]
    std::vector<JointBlock> now_;       ///< [joints of one group]
    std::vector<BodyResponse> response_;
    std::vector<Twist> velocity_;  ///< [bodies of one group] at the start, with the impulses so far
    std::vector<double> start_error_, impulses_, received_;  ///< [rows of one group]
    JointSystem system_;
};

}  // namespace cairn
