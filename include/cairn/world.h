/// @file The world: bodies, materials, springs, joints and the time step. Right-handed, SI units, world frame W unless
/// named.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cairn/bodies.h"
#include "cairn/events.h"
#include "cairn/filter.h"
#include "cairn/joint.h"
#include "cairn/material.h"
#include "cairn/motion.h"
#include "cairn/query.h"
#include "cairn/ranks.h"
#include "cairn/settings.h"
#include "cairn/shape.h"
#include "cairn/statistics.h"
#include "cairn/types.h"

namespace cairn {

/// What one rank saved.
struct SavedPart {
    std::vector<std::byte> bytes;  ///< of World::savePart(), or of World::saveCommon() or SceneRun::saveCommon()
    std::string source;            ///< for messages, such as the name of its file
};
/// Brings what a rank saved. @param rank which
using ReadPart = std::function<SavedPart(std::size_t rank)>;

/// Sums over all bodies, and over the contacts of the last step. They are rounded once, so that they have the same bits
/// on any number of ranks.
struct WorldSums {
    double kinetic_energy = 0;             ///< [J]
    double potential_energy = 0;           ///< [J], in the sum of the global accelerations, zero at the origin
    Vec3 linear_momentum = Vec3::Zero();   ///< of all dynamic bodies [N·s, W]
    Vec3 angular_momentum = Vec3::Zero();  ///< of all dynamic bodies about the origin [N·m·s, W]
    double mean_overlap = 0;               ///< over the overlapping contacts [m]
    std::int64_t asleep = 0;               ///< bodies
    std::uint64_t state_hash = 0;          ///< World::stateHash()
};

/// How a body begins.
struct BodyDescription {
    Shape shape = Sphere{};                ///< in its own frame
    MaterialId material{};                 ///< must exist in the world
    std::optional<double> mass{};          ///< [kg], > 0; otherwise density times volume
    std::optional<Vec3> centre_of_mass{};  ///< [m, frame of the shape]; otherwise that of the uniform solid
    std::optional<Mat3> inertia{};  ///< about the centre of mass [kg·m², axes of the shape's frame]; otherwise that
                                    ///< of the uniform solid about its own centre, with the body's mass
    Pose pose{};                    ///< of the shape's frame in W; the quaternion is normalised, it must not be zero
    Vec3 linear_velocity = Vec3::Zero();   ///< of the centre of mass [m/s, W]
    Vec3 angular_velocity = Vec3::Zero();  ///< [rad/s, W]
    bool fixed = false;                    ///< never moves, infinite mass; half-spaces must be fixed
    bool asleep = false;                   ///< begins asleep (velocities must be zero)
    std::string name{};                    ///< free, for messages and viewers
    std::vector<GroupId> groups{};         ///< any number; none = touches the bodies of all groups
    bool sensor = false;                   ///< touches nobody; World::sensed() and events say who is inside
    double gravity_factor = 1;             ///< of the global accelerations that it feels, −1e3 to 1e3; 0 = weightless
    double linear_damping = 0;             ///< rate at which the linear velocity decays [1/s], 0 to 1e6
    double angular_damping = 0;            ///< rate at which the angular velocity decays [1/s], 0 to 1e6
    std::uint64_t user_data = 0;           ///< the user's own, kept in snapshots
    std::optional<Motion> motion{};        ///< of a fixed body: as World::setMotion()
    Vec3 pivot = Vec3::Zero();             ///< of the motion [m, frame of the shape]
    Vec3 surface_velocity = Vec3::Zero();  ///< of a fixed body: as World::setSurfaceVelocity()
    std::vector<JointAlong> locked{};      ///< of a dynamic body: as World::setLocked()
};

/// A damped spring between two points. @source pe engine's springs, by behaviour
struct SpringDescription {
    BodyId a{};                    ///< first body
    Vec3 anchor_a = Vec3::Zero();  ///< [m, frame of A's pose]
    std::optional<BodyId> b{};     ///< second body; none = a point of the world
    Vec3 anchor_b = Vec3::Zero();  ///< [m, frame of B's pose, or W without a second body]
    double stiffness = 0;          ///< [N/m], ≥ 0
    double damping = 0;            ///< along the spring [N·s/m], ≥ 0
    double rest_length = 0;        ///< [m], ≥ 0
};

/// A contact as it was after the last step.
struct ContactInfo {
    BodyId a, b;           ///< a has the smaller index
    Vec3 point;            ///< [m, W]
    Vec3 normal;           ///< unit, from B to A, W
    double distance;       ///< along the normal [m]; negative = overlap
    Vec3 impulse;          ///< that A received in the step [N·s, W]; B received the opposite
    Vec3 angular_impulse;  ///< of rolling and spinning friction, likewise [N·m·s, W]
    std::uint32_t batch;   ///< index of its batch
};

/// A group of bodies connected by contacts, fixed bodies being barriers.
struct BatchInfo {
    std::vector<BodyId> bodies;  ///< in ascending order of id
    std::size_t contacts = 0;
};

/// Whether steps note for every body what the response did with it; costs a little time in every step.
enum class Tracing { off, on };

/// What the last step did with a body, for viewers.
struct BodyTrace {
    Vec3 bounds_lower = Vec3::Zero();  ///< bounds as the broad phase saw them [m, W]; infinite for half-spaces
    Vec3 bounds_upper = Vec3::Zero();  ///< [m, W]
    int level = -1;                    ///< in the hierarchy of the broad phase; −1 = outside it
    Vec3 correction = Vec3::Zero();    ///< displacement by the penetration correction [m, W]; needs Tracing::on
    int shock_stage = -1;              ///< subset of the shock propagation, from 0; −1 = none; needs Tracing::on
};

/// A body that left the finite numbers was fixed where it last was finite.
struct FaultInfo {
    BodyId body;            ///< which one
    std::int64_t step = 0;  ///< number of the time step, from 1
    std::string what;
};

/// Whether a step checks itself; switched off it costs nothing.
enum class Checks : std::uint8_t {
    off,
    state,  ///< all but the energy, which extreme mass ratios may raise a little
    on,
};

struct WorldState;
struct RollbackData;

/// A world at one time, in memory only: what rollback keeps in every step. Empty until World::keep().
class RollbackState {
  public:
    RollbackState();  ///< holds nothing yet
    ~RollbackState();
    RollbackState(RollbackState&&) noexcept;
    RollbackState& operator=(RollbackState&&) noexcept;

  private:
    friend class World;
    std::unique_ptr<RollbackData> state_;
};

/// A simulated world. Not copyable; one thread at a time may use it (its own threads are inside step()). Only questions
/// may be asked by several threads at once, while none changes the world.
class World {
  public:
    /// @throws InputError if the settings are out of range or contradict each other
    explicit World(const Settings& settings = Settings::preset(Preset::performance));
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    // --- materials ---
    /// @throws InputError for an empty or used name or a density that is not positive and finite
    MaterialId addMaterial(const Material& material);
    std::span<const Material> materials() const;
    /// Properties of a pair that has none of its own. @throws InputError out of range or kinetic > static
    void setDefaultPairProperties(const PairProperties& properties);
    /// Properties where a touches b (and b touches a). @throws InputError as above or for an unknown material
    void setPairProperties(MaterialId a, MaterialId b, const PairProperties& properties);
    PairProperties pairProperties(MaterialId a, MaterialId b) const;
    /// Lets properties where a touches b and b touches a depend on the velocity there, from now on. @throws InputError
    /// for an unknown material or curves that are not ascending or out of range
    void setPairLaw(MaterialId a, MaterialId b, const PairLaw& law);
    PairLaw pairLaw(MaterialId a, MaterialId b) const;  ///< without curves unless it was set @throws InputError

    // --- bodies ---
    /// @throws InputError names the member, its value and what is allowed
    BodyId addBody(const BodyDescription& description);
    /// Wakes the sleeping bodies that touched it; its springs and joints go with it. @throws StaleIdError
    void removeBody(BodyId id);
    bool contains(BodyId id) const noexcept;
    /// All bodies, in ascending order of index.
    std::vector<BodyId> bodies() const;
    std::size_t bodyCount() const noexcept;

    /// Reading; all throw StaleIdError.
    const Shape& shape(BodyId id) const;
    const std::string& name(BodyId id) const;
    MaterialId material(BodyId id) const;
    Pose pose(BodyId id) const;            ///< of the shape's frame in W [m]
    Vec3 centreOfMass(BodyId id) const;    ///< [m, W]; of spheres, boxes, capsules and cylinders the origin of the pose
                                           ///< unless the description gave another
    Vec3 linearVelocity(BodyId id) const;  ///< of the centre of mass [m/s, W]
    Vec3 angularVelocity(BodyId id) const;   ///< [rad/s, W]
    double mass(BodyId id) const;            ///< [kg]; infinite for fixed bodies
    Vec3 principalInertia(BodyId id) const;  ///< about the centre of mass [kg·m², B]; infinite for fixed bodies
    Quat principalAxes(BodyId id) const;     ///< of the principal inertia: B to W
    bool isFixed(BodyId id) const;
    bool isAsleep(BodyId id) const;

    /// Writing; each wakes the body (wake condition 1). All throw StaleIdError, and InputError for non-finite values.
    void setPose(BodyId id, const Pose& pose);
    void setLinearVelocity(BodyId id, const Vec3& v);   ///< [m/s, W]; a fixed body refuses it
    void setAngularVelocity(BodyId id, const Vec3& w);  ///< [rad/s, W]; a fixed body refuses it
    void setFixed(BodyId id, bool fixed);               ///< a half-space refuses to be dynamic
    void wake(BodyId id);
    /// Adds a force at the centre of mass for the next step. @param force [N, W]
    void applyForce(BodyId id, const Vec3& force);
    /// Adds a force at a point for the next step. @param force [N, W] @param point [m, W]
    void applyForceAt(BodyId id, const Vec3& force, const Vec3& point);
    void applyTorque(BodyId id, const Vec3& torque);    ///< for the next step [N·m, W]
    void applyImpulse(BodyId id, const Vec3& impulse);  ///< at once, at the centre of mass [N·s, W]
    /// At once. @param impulse [N·s, W] @param point [m, W]
    void applyImpulseAt(BodyId id, const Vec3& impulse, const Vec3& point);
    void applyAngularImpulse(BodyId id, const Vec3& impulse);  ///< at once [N·m·s, W]
    void setConstantForce(BodyId id, const Vec3& force);       ///< in every step from now on [N, W]
    void setConstantTorque(BodyId id, const Vec3& torque);     ///< in every step from now on [N·m, W]

    void setGravityFactor(BodyId id, double factor);  ///< as that of the description @throws InputError out of range
    double gravityFactor(BodyId id) const;            ///< as that of the description
    /// Rates at which its velocities decay [1/s]. @throws InputError out of range
    void setDamping(BodyId id, double linear, double angular);
    double linearDamping(BodyId id) const;   ///< [1/s]
    double angularDamping(BodyId id) const;  ///< [1/s]
    /// Along and about which axes of W a body does not move, whatever pushes it: its centre of mass stays on lines or
    /// planes, its angular velocity has no such components. It stands where it does now. @param axes of W; none = it is
    /// free @throws InputError for a fixed body or an axis given twice
    void setLocked(BodyId id, std::span<const JointAlong> axes);
    std::vector<JointAlong> locked(BodyId id) const;  ///< ascending
    void setUserData(BodyId id, std::uint64_t data);  ///< the world itself never reads it
    std::uint64_t userData(BodyId id) const;          ///< 0 unless it was set

    // --- filters and sensors ---
    /// @throws InputError for an empty or used name, or beyond most_groups
    GroupId addGroup(const std::string& name);
    std::span<const std::string> groupNames() const;  ///< of all groups, by id
    /// Whether bodies of two groups (or of one, a = b) touch; at first all do. @throws InputError for an unknown group
    void setGroupsTouch(GroupId a, GroupId b, Touch touch);
    Touch groupsTouch(GroupId a, GroupId b) const;  ///< @throws InputError for an unknown group
    /// Puts a body into these groups and no others. @throws StaleIdError, InputError for an unknown group
    void setGroups(BodyId id, std::span<const GroupId> groups);
    std::vector<GroupId> groups(BodyId id) const;  ///< ascending @throws StaleIdError
    /// An exception of two bodies from what their groups say, until one of them is removed; none = no exception.
    /// Jointed bodies and sensors do not touch in any case. @throws StaleIdError, InputError if a is b
    void setPairTouch(BodyId a, BodyId b, std::optional<Touch> touch);
    std::optional<Touch> pairTouch(BodyId a, BodyId b) const;  ///< @throws StaleIdError
    bool isSensor(BodyId id) const;                            ///< @throws StaleIdError
    /// Who was inside which sensor in the last step, by sensor and body: bodies that are no sensors, that its groups
    /// touch, and of which one or the sensor can move.
    std::span<const Sensed> sensed() const;

    // --- motion by a law ---
    /// Moves a fixed body by a law from now on, in place of an earlier one. It pushes and carries what it touches like
    /// a body of infinite mass; Diagnostics::energy_drives is its work. @param pivot about which it turns [m, frame of
    /// the shape] @throws StaleIdError, InputError for a dynamic or jointed body or a law out of range
    void setMotion(BodyId id, const Motion& motion, const Vec3& pivot = Vec3::Zero());
    void stopMotion(BodyId id);                     ///< it stays where it is @throws StaleIdError
    std::optional<Motion> motion(BodyId id) const;  ///< @throws StaleIdError
    /// Lets the surface of a fixed body run over it, like a belt: what touches it is dragged along the surface as if
    /// the body moved, which it does not. @param velocity [m/s, frame of the shape] @throws StaleIdError, InputError
    void setSurfaceVelocity(BodyId id, const Vec3& velocity);
    Vec3 surfaceVelocity(BodyId id) const;  ///< [m/s, frame of the shape] @throws StaleIdError
    /// Lets the frame of the world move by a law from now on: all bodies feel the opposite of its acceleration, as
    /// those on a shaken ground do whose places are measured on that ground. None = it rests. A world whose ground
    /// moves gives the same motion. @throws InputError for a law out of range or one that turns
    void setFrameMotion(const std::optional<Motion>& motion);
    std::optional<Motion> frameMotion() const;  ///< none = it rests

    // --- many bodies at once: at the cost of a loop over arrays, with the checks and wakings of the calls above ---
    /// The state of all bodies, without a copy; it follows the world until layoutVersion() changes. @throws InputError
    /// if the world is divided among ranks: gather() first
    BodyViews bodyViews() const;
    /// Another number as soon as bodies were added or removed or a state was loaded, so that views are to be taken
    /// anew.
    std::uint64_t layoutVersion() const noexcept;
    /// What pose() says of every slot, into a vector whose memory is used again; entries of holes mean nothing.
    /// @throws InputError as bodyViews()
    void posesTo(std::vector<Pose>& poses) const;
    /// Writing: one value per body, a later one of the same body after an earlier one. If one is refused, nothing is
    /// written. @throws StaleIdError, InputError as the call for one body, and unless there are as many values as ids
    void setPoses(std::span<const BodyId> ids, std::span<const Pose> poses);
    void setLinearVelocities(std::span<const BodyId> ids, std::span<const Vec3> v);          ///< [m/s, W]
    void setAngularVelocities(std::span<const BodyId> ids, std::span<const Vec3> w);         ///< [rad/s, W]
    void wake(std::span<const BodyId> ids);                                                  ///< as for one body
    void applyForces(std::span<const BodyId> ids, std::span<const Vec3> forces);             ///< [N, W]
    void applyTorques(std::span<const BodyId> ids, std::span<const Vec3> torques);           ///< [N·m, W]
    void applyImpulses(std::span<const BodyId> ids, std::span<const Vec3> impulses);         ///< [N·s, W]
    void applyAngularImpulses(std::span<const BodyId> ids, std::span<const Vec3> impulses);  ///< [N·m·s, W]
    void setConstantForces(std::span<const BodyId> ids, std::span<const Vec3> forces);       ///< [N, W]
    void setConstantTorques(std::span<const BodyId> ids, std::span<const Vec3> torques);     ///< [N·m, W]

    // --- springs ---
    /// @throws InputError, StaleIdError
    SpringId addSpring(const SpringDescription& description);
    void removeSpring(SpringId id);  ///< @throws StaleIdError
    /// Moves the second anchor of a spring, wakes its bodies. @param anchor_b [m, frame of B or W] @throws as above
    void setSpringAnchor(SpringId id, const Vec3& anchor_b);

    // --- joints ---
    /// Joins bodies as they stand now. They no longer touch each other unless the description says so.
    /// @throws InputError names the member, its value and what is allowed; StaleIdError
    JointId addJoint(const JointDescription& description);
    void removeJoint(JointId id);  ///< wakes its bodies @throws StaleIdError
    bool contains(JointId id) const noexcept;
    std::vector<JointId> joints() const;  ///< all of them, in ascending order of index
    JointInfo joint(JointId id) const;    ///< @throws StaleIdError
    /// Of hinges, sliders and screws; a limit of 0 switches the motor off. Wakes the bodies. @throws as addJoint
    void setJointMotor(JointId id, const JointMotor& motor);
    /// Of hinges and screws [rad] and sliders [m]. Wakes the bodies. @throws as addJoint
    void setJointLimits(JointId id, std::optional<double> lower, std::optional<double> upper);
    /// Of hinges, sliders and screws: what it drives to from now on. Wakes the bodies. @throws as addJoint
    void setJointServo(JointId id, const JointServo& servo);
    /// All that acts along a free axis from now on. Wakes the bodies. @param index of the axis, as in
    /// JointInfo::positions @throws as addJoint
    void setJointAxis(JointId id, std::size_t index, const JointAxis& axis);

    // --- global accelerations; a change wakes every body ---
    /// @param gravity now [m/s², W] @param law how it changes from now on: its displacement in m/s² in place of m is
    /// added to `gravity`; each time step takes the value at its middle, and while it changes nobody falls asleep.
    /// None = it stays. @throws InputError if not finite, contradicting the settings (3.2.5), or for a law out of range
    /// or one that turns
    void setGravity(const Vec3& gravity, const std::optional<Motion>& law = {});
    Vec3 gravity() const;                      ///< of the last step, or as it was set since [m/s², W]
    std::optional<Motion> gravityLaw() const;  ///< none = it stays
    /// A second acceleration of all bodies, such as a vehicle's; gravity is not changed. @throws as setGravity
    void setGlobalAcceleration(const Vec3& acceleration);
    Vec3 globalAcceleration() const;

    // --- time ---
    /// One time step. @source thesis Algorithm 6 @throws InvariantError if setChecks asked for checks
    void step();
    double time() const;             ///< simulated time [s]
    std::int64_t stepCount() const;  ///< time steps done
    const Settings& settings() const;
    /// Time steps per second that the default of Settings::steps_per_second takes for the bodies that move now, or took
    /// when the world took its first step with such bodies [1/s]; a quarter of them is what piles have been tried with.
    double stepsPerSecondBySize() const;
    /// Takes effect at the next step. @throws InputError as the constructor
    void setSettings(const Settings& settings);

    /// From now on every step checks: finite state, unit quaternions, inertias, contacts, batches, energy. Costs about
    /// a tenth of a step. After an InvariantError the world must not be used any more.
    void setChecks(Checks checks);

    // --- ranks: one world on several of them, see docs/ranks.md ---
    /// Shares the world with other ranks, each of which has made the same one by the same calls. From the next step on
    /// every rank has a part of the bodies that move, with the bits that one rank would have; between steps it knows
    /// these and the fixed bodies only, and calls that change bodies or need all of them throw an InputError until
    /// gather() is called, but setConstantForce() and the like where the body is, and setters of joints on all ranks.
    /// stateHash(), kineticEnergy() and the like, contacts() and statistics() are then of what this rank has; sums(),
    /// events() and the diagnostics of statistics() are of the whole world, on all ranks.
    /// @param ranks must outlive the world @throws InputError for a grid that is not one for so many ranks
    void share(Ranks& ranks, const Partition& partition = {});
    /// The same for a world without bodies: of those added before the next step a rank keeps the fixed ones and those
    /// of its region. All ranks add the same in the same order. Materials, groups and the like come before.
    /// @param places where the bodies will be [m, W], or as many of them as show where they are many: only how evenly
    ///        they are divided depends on it
    /// @throws InputError as above, for a world that has bodies, and for places beyond the limit; addBody() then throws
    ///         for bodies that move and are hulls, compounds or locked
    void share(Ranks& ranks, const Partition& partition, std::span<const Vec3> places);
    /// Gives all ranks all bodies, with contacts, statistics and faults of the whole world, until the next step; to be
    /// called by all of them, who may then do what they want as on one rank, if all do the same. Costs as much as
    /// sending the world to every rank. Does nothing in a world that is not divided.
    void gather();
    bool isDivided() const noexcept;  ///< whether bodies are missing that other ranks have
    Ranks* ranks() const noexcept;    ///< that share the world; null = it is on one
    /// Whether a body, or a joint, is here, and counts as this rank's: of what is on all ranks the first one's. Each is
    /// own on one rank; without other ranks what is there is own.
    bool isOwn(BodyId id) const noexcept;
    bool isOwn(JointId id) const noexcept;

    // --- snapshots ---
    /// Everything that the world is, so that it goes on bit by bit as it would have. @source docs/snapshots.md
    std::vector<std::byte> save() const;
    /// What this rank has of a divided world: the parts of all ranks, and what they have in common, are the world.
    /// @param append takes the next bytes @throws InputError for a world that is not divided; what append throws
    void savePart(const std::function<void(std::span<const std::byte>)>& append) const;
    std::vector<std::byte> savePart() const;  ///< the same, all in memory
    /// What all ranks have of a divided world; to be called by the first one. @throws InputError as savePart()
    std::vector<std::byte> saveCommon() const;
    /// A whole world from the parts of all ranks; it may be shared again with any number of ranks.
    /// @throws InputError naming part and offset if they are damaged or not those of one moment
    static World restoreParts(const SavedPart& common, const ReadPart& read);
    /// The same on any number of ranks: each reads some of the parts, and has nothing else, where the world could have
    /// been dealt out (share() with places); others are read by all. @throws as above, maybe on some of the ranks only
    static World restoreParts(const SavedPart& common, const ReadPart& read, Ranks& ranks,
                              const Partition& partition = {});
    /// As save(), into a buffer whose memory is used again.
    void saveTo(std::vector<std::byte>& buffer) const;
    /// A world as it was saved. @throws InputError with the offset, for bytes that are truncated, damaged or too new
    static World restore(std::span<const std::byte> snapshot);
    /// Becomes what was saved; ids of that time are valid again. Unchanged if it throws. @throws as restore()
    void load(std::span<const std::byte> snapshot);
    /// Overwrites a state with what save() would write, at a fraction of its cost when the state's memory is there
    /// already: bodies, shapes and materials are shared as long as none is added, removed or changed by a call.
    void keep(RollbackState& state) const;
    /// Becomes what was kept, of this or another world, as load() of a snapshot does. @throws InputError if it is empty
    void load(const RollbackState& state);

    // --- questions: about the bodies where they are now, also before the first step ---
    /// The nearest body that a ray hits; of several at one distance that with the lowest id, and its lowest part.
    /// @throws InputError for a ray that is not finite or has no direction
    std::optional<RayHit> castRay(const Ray& ray, const QueryFilter& filter = {}) const;
    /// All parts of bodies that a ray hits, by distance, body and part. @throws as castRay
    std::vector<RayHit> castRayThrough(const Ray& ray, const QueryFilter& filter = {}) const;
    /// As castRay() for each ray, on the threads of the world. @throws as castRay
    std::vector<std::optional<RayHit>> castRays(std::span<const Ray> rays, const QueryFilter& filter = {}) const;
    /// The first body that a shape meets which moves without turning; of several as castRay(). @param pose where it
    /// begins @param way [m, W], not zero @throws InputError as the function of this name in query.h
    std::optional<BodyHit> castShape(const Shape& shape, const Pose& pose, const Vec3& way,
                                     const QueryFilter& filter = {}) const;
    /// The parts of bodies that have a point in common with a shape, by body and part. @throws InputError as above
    std::vector<Overlap> overlap(const Shape& shape, const Pose& pose, const QueryFilter& filter = {}) const;
    /// The same for a box along the axes of W. @param lower, upper its corners [m, W] @throws InputError as above
    std::vector<Overlap> overlap(const Vec3& lower, const Vec3& upper, const QueryFilter& filter = {}) const;
    /// The bodies within reach of a shape, by distance and body. @param reach [m], ≥ 0 @throws InputError as above
    std::vector<NearBody> closestPoints(const Shape& shape, const Pose& pose, double reach,
                                        const QueryFilter& filter = {}) const;
    /// Of two bodies. @throws StaleIdError, InputError for two half-spaces
    ClosestPoints closestPoints(BodyId a, BodyId b) const;

    // --- after a step ---
    std::vector<ContactInfo> contacts() const;  ///< of the last step, by (a, b)
    /// As contacts(), into a vector whose memory is used again.
    void contactsTo(std::vector<ContactInfo>& contacts) const;
    std::vector<BatchInfo> batches() const;        ///< of the last step, by their lowest body
    const Statistics& statistics() const;          ///< of the last step
    const std::vector<FaultInfo>& faults() const;  ///< all so far
    /// Whether the following steps trace what they do with each body; off at first.
    void setTracing(Tracing tracing);
    /// What the last step did with a body. @throws StaleIdError
    BodyTrace trace(BodyId id) const;
    /// Which events the following steps collect; none at first.
    void setEventLevel(EventLevel level);
    EventLevel eventLevel() const;
    /// What happened in the last step, in an order that does not depend on threads: contacts by (a, b), then sensors by
    /// (sensor, body), then bodies that woke and fell asleep, by id, then faults as in faults(), then joints that
    /// broke, by id. Valid until the next step. Of the whole world on all ranks that share it, which takes a message to
    /// each in every step.
    std::span<const Event> events() const;
    double kineticEnergy() const;    ///< [J]
    double potentialEnergy() const;  ///< [J], in the sum of the global accelerations, zero at the origin
    Vec3 linearMomentum() const;     ///< of all dynamic bodies [N·s, W]
    Vec3 angularMomentum() const;    ///< of all dynamic bodies about the origin [N·m·s, W]
    /// A hash of the poses, velocities and sleeping states of all bodies; equal states have equal hashes.
    std::uint64_t stateHash() const;
    /// Of a divided world those of all ranks, to be called by all of them; nothing but the sums is sent.
    WorldSums sums() const;
    /// WorldSums::mean_overlap alone, likewise [m].
    double meanOverlap() const;

  private:
    explicit World(std::unique_ptr<WorldState> state);

    std::unique_ptr<WorldState> state_;
};

}  // namespace cairn
