/// @file Scenes: initial states with materials, events and settings; read from and written to JSON, or built in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "cairn/world.h"

namespace cairn {

/// A body of a scene; its index in Scene::bodies is its number in recordings and events.
struct SceneBody {
    Shape shape = Sphere{};                ///< in its own frame
    std::string material;                  ///< name of one of Scene::materials
    std::string name;                      ///< unique if not empty
    std::optional<double> mass;            ///< [kg]
    std::optional<Vec3> centre_of_mass;    ///< as that of BodyDescription
    std::optional<Mat3> inertia;           ///< as that of BodyDescription
    Vec3 position = Vec3::Zero();          ///< of the shape's frame [m, W]
    Quat orientation = Quat::Identity();   ///< shape's frame to W
    Vec3 linear_velocity = Vec3::Zero();   ///< [m/s, W]
    Vec3 angular_velocity = Vec3::Zero();  ///< [rad/s, W]
    bool fixed = false;
    bool asleep = false;
    std::vector<std::string> groups;  ///< names of SceneFilters::groups
    bool sensor = false;              ///< as that of BodyDescription, and so below
    double gravity_factor = 1;
    double linear_damping = 0;   ///< [1/s]
    double angular_damping = 0;  ///< [1/s]
    std::uint64_t user_data = 0;
    std::optional<Motion> motion;          ///< with it the body is fixed
    Vec3 pivot = Vec3::Zero();             ///< of the motion [m, frame of the shape]
    Vec3 surface_velocity = Vec3::Zero();  ///< [m/s, frame of the shape]
    std::vector<JointAlong> locked;        ///< as that of BodyDescription
};

/// An exception of two bodies of a scene from what their groups say.
struct SceneException {
    std::size_t a = 0;            ///< index in Scene::bodies
    std::size_t b = 0;            ///< index in Scene::bodies
    Touch touch = Touch::always;  ///< whether they do
};

/// Which bodies of a scene touch each other.
struct SceneFilters {
    std::vector<std::string> groups;                         ///< unique names, at most most_groups
    std::vector<std::pair<std::string, std::string>> apart;  ///< groups that never touch
    std::vector<SceneException> exceptions;

    /// Whether all bodies touch.
    bool isEmpty() const { return groups.empty() && exceptions.empty(); }
};

/// A joint of a scene.
struct SceneJoint {
    std::size_t a = 0;                    ///< index in Scene::bodies
    std::optional<std::size_t> b;         ///< index in Scene::bodies; none = the world
    JointDescription joint;               ///< all else, as the bodies stand at the beginning
    std::optional<std::size_t> first{};   ///< of gears, racks and mimics: index of an earlier one in Scene::joints
    std::optional<std::size_t> second{};  ///< likewise
};

/// A spring of a scene.
struct SceneSpring {
    std::size_t a = 0;             ///< index of the body
    std::optional<std::size_t> b;  ///< index of the second body; none = a point of the world
    Vec3 anchor_a = Vec3::Zero();  ///< [m, frame of A]
    Vec3 anchor_b = Vec3::Zero();  ///< [m, frame of B or W]
    double stiffness = 0;          ///< [N/m]
    double damping = 0;            ///< [N·s/m]
    double rest_length = 0;        ///< [m]
};

/// What follows a function of time.
enum class DriveOf : std::uint8_t {
    position,  ///< of a servo [rad or m]; its speed follows as the rate
    speed,     ///< of a motor or a servo [rad/s or m/s]
    force,     ///< on a body, at its centre of mass [N, W]
    torque,    ///< on a body [N·m, W]
};

/// Lets something follow a function of time: at time t it is `start` plus the displacement of a law of motion at t.
struct SceneDrive {
    DriveOf what = DriveOf::position;  ///< of the target
    std::size_t target = 0;            ///< index in Scene::joints or, of forces and torques, in Scene::bodies
    std::size_t axis = 0;              ///< which free axis of the joint
    Vec3 start = Vec3::Zero();         ///< its value at the beginning; of joints x counts
    Motion law = ConstantMotion{};     ///< how it changes, in its unit in place of metres; without turns
};

/// An event sets gravity, which then stays.
struct SetGravity {
    Vec3 gravity;  ///< [m/s², W]
};
/// An event sets a body's velocity.
struct SetVelocity {
    std::size_t body;  ///< index in Scene::bodies
    Vec3 velocity;     ///< linear [m/s, W]
};
/// An event gives a body an impulse at its centre of mass.
struct GiveImpulse {
    std::size_t body;  ///< index in Scene::bodies
    Vec3 impulse;      ///< [N·s, W]
};
/// An event sets a body's constant force.
struct SetForce {
    std::size_t body;  ///< index in Scene::bodies
    Vec3 force;        ///< from then on, at the centre of mass [N, W]
};
/// An event sets a body's constant torque.
struct SetTorque {
    std::size_t body;  ///< index in Scene::bodies
    Vec3 torque;       ///< from then on [N·m, W]
};
/// An event takes a body out of the world.
struct RemoveBody {
    std::size_t body;  ///< index in Scene::bodies
};
/// What an event does.
using EventAction = std::variant<SetGravity, SetVelocity, GiveImpulse, SetForce, SetTorque, RemoveBody>;

/// Happens at the first time step that begins at or after its time.
struct SceneEvent {
    double time = 0;  ///< [s], ≥ 0
    EventAction action = SetGravity{Vec3::Zero()};
};

/// Everything of a scene file, in its order.
struct Scene {
    std::string name;             ///< for messages and recordings
    double duration = 0;          ///< [s], > 0
    Vec3 gravity = Vec3::Zero();  ///< [m/s², W]
    /// How gravity changes, as in World::setGravity(); a table begins with `gravity` and has no velocities.
    std::optional<Motion> gravity_law;
    std::vector<SceneEvent> events;
    std::vector<Material> materials;
    PairProperties default_pair;
    std::vector<std::pair<std::pair<std::string, std::string>, PairProperties>> pairs;
    std::vector<std::pair<std::pair<std::string, std::string>, PairLaw>> pair_laws;  ///< of some of them
    SceneFilters filters;
    std::optional<Motion> frame_motion;  ///< as World::setFrameMotion()
    std::vector<SceneBody> bodies;
    std::vector<SceneSpring> springs;
    std::vector<SceneJoint> joints;
    std::vector<SceneDrive> drives;
    std::optional<Preset> preset;                                ///< of `settings.preset`
    std::vector<std::pair<std::string, SettingValue>> settings;  ///< the other fields of `settings`
};

/// @throws InputError with file, line or JSON path, the value and what is allowed; IoError if it cannot be read
Scene readScene(const std::filesystem::path& file);
/// @param source shown in messages in place of a file name
Scene parseScene(std::string_view json, std::string_view source);
/// @throws IoError
void writeScene(const Scene& scene, const std::filesystem::path& file);
/// The scene as the text of a scene file.
std::string formatScene(const Scene& scene);

/// What lengths, times and masses are multiplied by.
struct Scales {
    double length = 1;  ///< > 0
    double time = 1;    ///< > 0
    double mass = 1;    ///< > 0
};
/// The same scene larger, slower and heavier: every value by its unit, the settings that it gives among them. Where
/// lengths are multiplied by the square of the time, gravity stays what it is and everything happens alike; with
/// {4ⁿ, 2ⁿ, 4³ⁿ}, which lose no digit, bit for bit after the same number of steps.
/// @throws InputError for scales that are not finite or not above 0. What becomes too small or too large is refused
/// where the scene is used.
Scene scaled(Scene scene, const Scales& scales);

/// A built-in scene, or a family of them.
struct BuiltInScene {
    std::string_view name;  ///< as on the command line: "stacks5", "tower:N"
    std::string_view description;
    std::string_view example;  ///< a name that can be given, "tower:10"
};
/// All of them, in the order in which they are shown.
std::vector<BuiltInScene> builtInScenes();
/// @param name such as "cage384" or "tower:20" @throws InputError for an unknown name or a bad number
Scene builtInScene(std::string_view name);
/// True if the name (before a colon) is one of a built-in scene.
bool isBuiltInScene(std::string_view name);

struct SceneSurvey;

/// A scene whose bodies are told one after the other, so that nobody has to keep them: those of a file are read, and
/// those of a built-in family made, each time that they are told.
class SceneSource {
  public:
    /// Takes a body of a scene.
    using Take = std::function<void(const SceneBody&)>;
    /// Calls what it is given for every body, in their order: the same ones every time.
    using Tell = std::function<void(const Take&)>;

    /// A scene that is there, with its bodies.
    SceneSource(Scene scene);  // NOLINT(google-explicit-constructor): wherever one is told, one that is there will do
    /// @param scene all but its bodies. It has neither springs, joints, drives nor exceptions of pairs, whose bodies
    /// would have to be there @throws InputError if it has, and what `tell` throws
    SceneSource(Scene scene, Tell tell);

    /// Everything but bodies that are told.
    const Scene& scene() const { return scene_; }
    /// Whether the bodies are told and not in scene().
    bool isTold() const { return tell_ != nullptr; }
    /// Changes when the scene is over. @param seconds [s], > 0
    void setDuration(double seconds) { scene_.duration = seconds; }
    /// Tells every body. @throws IoError if their file cannot be read any more or is another one now
    void forEachBody(const Take& take) const;
    /// The scene with all its bodies. @throws as forEachBody()
    Scene whole() const;
    /// What its bodies are like, for the library's own use.
    const SceneSurvey& survey() const { return *survey_; }

  private:
    Scene scene_;
    Tell tell_;
    std::shared_ptr<const SceneSurvey> survey_;
};

/// As readScene(), but bodies that nothing else of the file names are read when they are told. @throws as readScene()
SceneSource readSceneSource(const std::filesystem::path& file);
/// As builtInScene(), but families that may be large make their bodies when they are told. @throws as builtInScene()
SceneSource builtInSource(std::string_view name);
/// As formatScene(), of bodies that are told.
std::string formatScene(const SceneSource& source);

/// What overrides a scene's own settings.
struct SettingOverrides {
    std::optional<Preset> preset;                             ///< in place of the scene's
    std::optional<double> steps_per_second;                   ///< in place of the preset's [1/s]
    std::vector<std::pair<std::string, std::string>> fields;  ///< name and text, as in `--set`
};

/// The settings of a run: preset (override, then scene, then performance) scaled to the steps per second and to the
/// weakest gravity the scene has for long, then the scene's fields, then the overrides. @throws InputError
Settings settingsFor(const Scene& scene, const SettingOverrides& overrides = {});
/// The same of bodies that are told.
Settings settingsFor(const SceneSource& source, const SettingOverrides& overrides = {});

class MotionCurve;

/// A scene in a world, with its events.
class SceneRun {
  public:
    /// @throws InputError
    SceneRun(SceneSource source, const Settings& settings);
    /// The same on ranks that share the world from the start, so that not even at the beginning one of them has all
    /// bodies, where the scene allows it (World::share() with places): it has neither springs nor joints, drives,
    /// exceptions of pairs, nor a frame that moves, and what moves in it are balls, boxes, capsules and cylinders
    /// without locks. Other worlds are divided by the first step. @param ranks must outlive the run @throws InputError
    SceneRun(SceneSource source, const Settings& settings, Ranks& ranks, const Partition& partition = {});

    World& world() { return world_; }                      ///< may be changed between steps
    const World& world() const { return world_; }          ///< as it is after the last step
    const SceneSource& source() const { return source_; }  ///< as it was given
    /// As it was given; without bodies if these were told.
    const Scene& scene() const { return source_.scene(); }
    /// Changes when the run is over. @param seconds [s], > 0
    void setDuration(double seconds) { source_.setDuration(seconds); }
    /// Ids of the scene's bodies, by index; stale once removed.
    const std::vector<BodyId>& ids() const { return ids_; }

    /// Applies the events that are due, then steps the world once. A shared world is gathered before an event.
    void step();
    /// One simulation step: the time steps until one ends at the next thirtieth of a second or later.
    /// @return the sum of the statistics of its time steps
    Statistics simulationStep();
    /// The same, noting World::stateHash() after each of its time steps.
    Statistics simulationStep(std::vector<std::uint64_t>& hashes);
    /// Time steps of the next simulation step: always the same if their number per second is a multiple of 30, one if
    /// it is less than 30.
    int stepsPerSimulationStep() const;

    /// The run as it is: scene, world, ids and the events that are still to come. @source docs/snapshots.md
    std::vector<std::byte> save() const;
    /// A run as it was saved. @param source shown in messages, such as the name of its file
    /// @throws InputError with the offset, for bytes that are truncated, damaged or too new
    static SceneRun restore(std::span<const std::byte> snapshot, std::string_view source = "snapshot");
    /// As World::saveCommon(), and the events that are still to come; but neither the scene nor, of the world, what
    /// World::savePart() has.
    std::vector<std::byte> saveCommon() const;
    /// As World::restoreParts(), of what World::savePart() has. @param source of the same scene
    static SceneRun restoreParts(SceneSource source, const SavedPart& common, const ReadPart& read);
    static SceneRun restoreParts(SceneSource source, const SavedPart& common, const ReadPart& read, Ranks& ranks,
                                 const Partition& partition = {});

  private:
    SceneRun(SceneSource source, const Settings& settings, Ranks* ranks, const Partition& partition);
    SceneRun(SceneSource source, World world, std::vector<BodyId> ids, std::size_t next_event);
    void apply(const EventAction& action);
    void takeDrives();

    SceneSource source_;
    World world_;
    std::vector<SceneEvent> events_;  ///< by time
    std::vector<BodyId> ids_;
    std::vector<std::shared_ptr<const MotionCurve>> curves_;  ///< of Scene::drives, by index
    std::size_t next_event_ = 0;
};

/// Simulation steps (recorded frames) per second. @source thesis §5.1
inline constexpr double simulation_steps_per_second = 30;

}  // namespace cairn
