/// @file Everything a world holds: the bodies with what acts on them, and every array between the stages of a step.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "activity/selection.h"
#include "batches/batch_motion.h"
#include "batches/batches.h"
#include "batches/follow_progress.h"
#include "batches/schedule.h"
#include "batches/surroundings.h"
#include "body/body_storage.h"
#include "body/contact.h"
#include "body/material_table.h"
#include "broad_phase/hash_grids.h"
#include "cairn/world.h"
#include "correction/correction.h"
#include "geometry/geometry.h"
#include "integration/integration.h"
#include "integration/joint_flight.h"
#include "integration/springs.h"
#include "joints/joint_groups.h"
#include "math/exact_sum.h"
#include "pairs/pair_table.h"
#include "pairs/way_back.h"
#include "parallel/executor.h"
#include "parallel/help_choice.h"
#include "queries/spatial_index.h"
#include "resolution/resolution.h"
#include "sharing/shared_bodies.h"
#include "world/driven_body.h"
#include "world/ties.h"

namespace cairn {

/// A joint that broke in a step.
struct BrokenJoint {
    JointId joint;
    BodyId a, b;
    Vec3 impulse;  ///< on A in the step [N·s, W]
};

/// Between which parts of a step it is measured.
enum class Measured { begin, laws, positions, correction, forces, damping, resolution, completion, sleep };

/// What is summed over the bodies, contacts and joints that a rank has at a point of a step.
struct MeasuredSums {
    Measured point = Measured::begin;
    ExactSum kinetic;                  ///< [J]
    ExactSum potential;                ///< [J]
    ExactVectorSum momentum;           ///< [N·s, W]
    ExactVectorSum angular_momentum;   ///< about the origin [N·m·s, W]
    ExactSum flight, damping, drives;  ///< accounts of Diagnostics: at forces and resolution [J]
    ExactSum friction, restitution;    ///< at the resolution [J]
    ExactVectorSum fixed;              ///< likewise, impulse from fixed bodies [N·s, W]
    ExactVectorSum fixed_angular;      ///< likewise, about the origin [N·m·s, W]
    double signorini = 0;              ///< likewise, the largest of each [J]
    double de_saxce = 0;
    double dissipation = 0;
    bool has_joints = false;  ///< likewise
};

/// What the diagnostics of a step remember between its stages.
struct MeasuredData {
    std::vector<MeasuredSums> sums;  ///< at the points of the step so far
    std::vector<Vec3> v;             ///< [slots] at the last point [m/s, W]
    std::vector<Vec3> w;             ///< [slots] at the last point [rad/s, W]
};

/// Contacts that are resolved once more.
struct FollowedGroup {
    BatchView view;
    bool later;  ///< for an impact that follows the others
};

/// What batches were built of.
struct BatchedFrom {
    std::uint64_t layout = 0;    ///< PairTable::layout()
    std::size_t joints = 0;      ///< removed ones, too
    std::vector<BodyKind> kind;  ///< [slots]
};

/// The arrays that one stage leaves to the next; nothing else travels between stages. Named with their producer.
struct StepData {
    PairTable pairs;                    ///< detection: which contacts are of which two bodies
    std::vector<Contact> contacts;      ///< detection, changed by correction and resolution: sorted by (a, b)
    ContactsOfBodies contacts_of;       ///< batches: [slots] contact indices
    Batches batches;                    ///< batches: groups in canonical order
    BatchScratch batch_scratch;         ///< batches: kept memory
    BatchedFrom batched;                ///< batches: to tell when they stay
    std::vector<BatchView> views;       ///< batches: [batches], and their joints since the resolution
    BatchSchedule schedule;             ///< batches: order of work, large ones first
    Selection selection;                ///< resolution: what of the batches is resolved
    VelocitiesBefore before;            ///< velocities: [slots], with exact_flight or RestitutionSpeed::touching only
    JointGroups joint_groups;           ///< events: joints connected by bodies that can move
    std::vector<std::uint8_t> jointed;  ///< events: [slots] 1 = has a joint; empty without joints
    std::vector<BodyPair> excluded;     ///< events: pairs that joints keep from touching, sorted
    std::vector<Sensed> sensed;         ///< detection: by sensor and body
    std::vector<double> fastest_of;     ///< detection: [threads] kept memory
    std::vector<std::vector<TooDeep>> too_deep;  ///< detection: [threads] kept memory
    Flights flights;                             ///< detection: how far bodies flew
    std::vector<std::uint8_t> stuck;             ///< detection: [slots] 1 = began deep in others
    std::vector<double> go_back_to;              ///< detection: [slots] kept memory
    std::vector<MovedBody> moved;                ///< correction, completion: [slots]
    std::vector<BodyWay> moved_way;              ///< correction, completion: [slots]
    std::vector<Vec3> uncompleted_position;      ///< resolution: [slots] before the completion [m, W]
    std::vector<Quat> uncompleted_orientation;   ///< resolution: [slots] likewise
    std::vector<std::uint8_t> back;              ///< detection: [slots] kept memory
    std::vector<std::uint8_t> stopped;           ///< detection: [slots] 1 = went back; empty = nobody did
    std::vector<double> shortest_of;             ///< detection: [threads] kept memory
    std::vector<std::uint8_t> fast;              ///< [slots] 1 = where it touches others, parts may have to be shorter
    double fastest = 0;                      ///< detection: how fast bodies may be that are struck in the step [m/s]
    std::vector<Vec3> surface;               ///< velocities: [slots] of fixed bodies' surfaces [m/s, W]; or empty
    std::vector<Carried> carried;            ///< velocities: [slots] by a moving law that their batch touches; or empty
    std::vector<std::uint8_t> not_sleeping;  ///< sleeping: [slots] 1 = does not fall asleep by itself
    std::vector<JointBlock> joint_blocks;    ///< resolution: batch after batch, in it group after group
    std::vector<std::uint32_t> joint_begin;  ///< resolution: [batches + 1] offsets into joint_blocks
    std::vector<std::uint32_t> joint_cursor;          ///< resolution: kept memory
    std::vector<BrokenJoint> broken;                  ///< resolution: by slot
    std::vector<std::int32_t> supports;               ///< velocities: [slots] contacts in the direction of gravity
    std::vector<CorrectionCounts> correction_counts;  ///< correction: [threads]
    std::vector<std::uint8_t> deep;                   ///< correction: [batches] 1 = has contacts that are too deep
    ResolutionCounts resolution_counts;               ///< resolution
    std::vector<std::uint32_t> added;                 ///< resolution: contacts that were added, ascending
    std::vector<std::uint32_t> unresolved;            ///< resolution: those that it left closing, ascending
    std::vector<std::uint32_t> closing;  ///< resolution: those at which bodies would get too far, ascending
    std::vector<std::vector<std::uint32_t>> closing_of;  ///< resolution: [threads] kept memory
    std::vector<std::uint32_t> asked;                    ///< resolution: kept memory
    std::vector<std::uint8_t> is_asked;                  ///< [contacts] 1 = in asked; zero outside of who uses it
    std::vector<BodyIndex> changed;                      ///< resolution: who was resolved again last
    FollowProgress progress;                             ///< resolution: of following
    std::vector<std::uint32_t> seeds;                    ///< resolution: all of both, ascending
    Surroundings surroundings;                           ///< resolution: of the seeds
    std::vector<FollowedGroup> followed;                 ///< resolution: the same, group after group
    std::vector<BodyMotion> motions;                     ///< resolution: of their bodies before it went on
    std::vector<BodyMotion> without_contacts;            ///< resolution: [slots] of their sleepers, without the groups
    std::vector<BatchView> gained;                       ///< resolution: groups that are resolved otherwise
    std::vector<Contact> resolved;                       ///< resolution: their contacts before it went on
    std::vector<std::uint32_t> launched;                 ///< positions: batches of launched jointed bodies, ascending
    std::vector<BatchView> launched_views;               ///< positions: the same
    MeasuredData measured;                               ///< every stage: with the setting diagnostics only
    std::vector<std::uint32_t> generation;  ///< output: [slots] generations of the bodies that the contacts name
};

/// What a traced step notes for viewers; empty while tracing is off.
struct TraceData {
    Tracing tracing = Tracing::off;
    std::vector<Vec3> correction;           ///< [slots] displacement by the penetration correction [m, W]
    std::vector<std::int32_t> shock_stage;  ///< [slots] subset of the shock propagation; −1 = none
};

/// Two bodies that touch.
struct Touching {
    BodyId a, b;
};

/// The events of the last step and what finding them takes.
struct EventLog {
    EventLevel level = EventLevel::none;
    std::vector<Event> events;
    std::vector<Touching> touched_before;     ///< by a and b, at the beginning of the step
    std::vector<Sensed> sensed_before;        ///< by sensor and body, at the beginning of the step
    std::vector<std::uint8_t> asleep_before;  ///< [slots] at the beginning of the step
    std::size_t faults_before = 0;            ///< at the beginning of the step
};

/// What a step is divided into: parts of a power of two of units each.
constexpr int step_units = 64;

/// The part of a step that is computed.
struct StepPart {
    int units = step_units;
    int done = 0;             ///< units of the step before this part
    double length = 0;        ///< [s]
    int before = step_units;  ///< units of the part before it

    bool isFirst() const { return done == 0; }
    bool isLast() const { return done + units == step_units; }
};

/// The part that comes after, for which contacts are foreseen.
struct NextPart {
    std::int32_t units = step_units;
    std::int32_t wanted = step_units;  ///< units that it should have had, wherever steps begin
};

struct LastingPart;

/// The back of World.
struct WorldState {
    explicit WorldState(const Settings& settings);

    /// Makes the replaceable parts that the settings name. @pre the settings are valid
    void applySettings(const Settings& new_settings);

    /// Wakes every sleeping body, since a force on all of them changed (condition 1).
    void wakeAll();

    Settings settings;
    Executor executor;
    std::array<HelpChoice, stage_count> help{};  ///< of each stage; measured times, on which no result depends
    HashGrids broad_phase;
    std::vector<std::unique_ptr<Correction>> corrections;  ///< [threads]
    std::unique_ptr<Resolution> resolution;

    MaterialTable materials;
    BodyStorage bodies;
    std::vector<Spring> springs;
    std::vector<Joint> joints;
    TiesOfBodies ties;  ///< lists of both
    JointGrouping joint_grouping;
    JointFlight joint_flight;
    Vec3 gravity = Vec3::Zero();              ///< of this step [m/s², W]
    std::optional<GravityLaw> gravity_law;    ///< none = it stays
    Vec3 global_acceleration = Vec3::Zero();  ///< [m/s², W]
    std::vector<DrivenBody> driven;           ///< ascending by body
    std::optional<FrameMotion> frame;         ///< none = it rests
    Vec3 frame_acceleration = Vec3::Zero();   ///< events: what its motion gives all bodies in this step [m/s², W]

    std::unique_ptr<SharedBodies> shared;  ///< with other ranks; null = the world is on one

    std::vector<double>
        dealt_extents;      ///< middle ones of all bodies that move and were dealt out, until the first step
    StepPart part;          ///< of the step that is computed
    NextPart next_part;     ///< after it, or of the next step
    bool launched = false;  ///< a user gave a body a velocity or a place since the last step
    int still_steps = 0;    ///< last steps that everybody slept through, without a call since
    std::int64_t steps = 0;
    double time = 0;                  ///< [s]
    bool sized = false;               ///< bodies have told how many time steps they need
    std::int32_t step_exponent = 0;   ///< they need 2^this times as many as the usual ones
    std::int64_t steps_at_start = 0;  ///< step count when the present time step length began to hold
    double time_at_start = 0;         ///< time at that step [s]
    StepData data;
    Statistics statistics;
    std::vector<FaultInfo> faults;
    EventLog events;
    TraceData trace;
    Checks checks = Checks::off;
    std::uint64_t places_version = 1;            ///< raised by whatever moves, adds or removes bodies
    CurrentIndex index;                          ///< of the bodies, for questions
    std::mutex asking;                           ///< held by the question that uses the executor
    std::shared_ptr<const LastingPart> lasting;  ///< shared with the state that was kept last; null = it changed since
};

/// One time step. @source thesis Algorithm 6
void stepWorld(WorldState& world);

}  // namespace cairn
