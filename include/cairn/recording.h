/// @file Recordings: HDF5 files with frames at a steady rate, and their exports.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cairn/scene.h"

namespace cairn {

/// The state of all bodies at one moment; arrays have one entry per body of the scene file.
struct Frame {
    double time = 0;                     ///< [s]
    std::vector<Vec3> position;          ///< [m, W]; NaN once the body was removed
    std::vector<Quat> orientation;       ///< B to W
    std::vector<Vec3> linear_velocity;   ///< [m/s, W]
    std::vector<Vec3> angular_velocity;  ///< [rad/s, W]
    std::vector<std::uint8_t> asleep;    ///< 1 = asleep
    Statistics statistics;               ///< of the time steps since the last frame
    double kinetic_energy = 0;           ///< [J]
    double potential_energy = 0;         ///< [J]
    /// World::stateHash() after each time step since the last frame; empty = not recorded.
    std::vector<std::uint64_t> step_hashes;

    // Contacts between bodies of the scene as they were after the last time step, in the order of World::contacts();
    // empty unless they are recorded.
    std::vector<std::int64_t> contact_a;   ///< index in Scene::bodies
    std::vector<std::int64_t> contact_b;   ///< index in Scene::bodies
    std::vector<Vec3> contact_point;       ///< [m, W]
    std::vector<Vec3> contact_normal;      ///< unit, from B to A, W
    std::vector<double> contact_distance;  ///< along the normal [m]; negative = overlap
    std::vector<Vec3> contact_impulse;     ///< that A received in the last time step [N·s, W]

    // One entry per joint of the scene, NaN once it broke; empty unless they are recorded.
    std::vector<Vec3> joint_point;   ///< where A is joined [m, W]
    std::vector<Vec3> joint_force;   ///< that A received there, mean over the last time step [N, W]
    std::vector<Vec3> joint_torque;  ///< that A received besides [N·m, W]
};

/// What one rank has of a frame: some of the bodies, contacts and joints of the scene.
struct FramePart {
    double time = 0;                    ///< [s]
    std::vector<std::int64_t> body;     ///< indices in Scene::bodies, ascending; the next arrays have an entry for each
    std::vector<Vec3> position;         ///< as in Frame, and so are all that follow
    std::vector<Quat> orientation;      ///< B to W
    std::vector<Vec3> linear_velocity;  ///< [m/s, W]
    std::vector<Vec3> angular_velocity;  ///< [rad/s, W]
    std::vector<std::uint8_t> asleep;    ///< 1 = asleep

    std::vector<std::int64_t> contact_a;   ///< index in Scene::bodies
    std::vector<std::int64_t> contact_b;   ///< index in Scene::bodies
    std::vector<Vec3> contact_point;       ///< [m, W]
    std::vector<Vec3> contact_normal;      ///< unit, from B to A, W
    std::vector<double> contact_distance;  ///< along the normal [m]
    std::vector<Vec3> contact_impulse;     ///< [N·s, W]

    std::vector<std::int64_t> joint;  ///< indices in Scene::joints, ascending; the next arrays have an entry for each
    std::vector<Vec3> joint_point;    ///< [m, W]
    std::vector<Vec3> joint_force;    ///< [N, W]
    std::vector<Vec3> joint_torque;   ///< [N·m, W]
};

/// What is recorded besides the state of the bodies, and how often.
struct RecordingOptions {
    std::size_t hashes_per_frame = 0;  ///< entries of Frame::step_hashes, so that each can be verified; 0 = none
    double frame_rate =
        simulation_steps_per_second;  ///< frames per simulated second, ≥ 0.001, at most one per time step
    bool contacts = false;            ///< contacts with their impulses
    bool joints = false;              ///< forces of joints
    std::size_t parts = 0;   ///< files of ranks that have the bodies, contacts and joints; 0 = the recording has them
    std::uint64_t mark = 0;  ///< of a recording in parts: the same number in all of them, and in those of no other
};

/// Whether a frame is to be taken after the last time step: it is the first that ended at a multiple of 1/frame_rate
/// or after it. @param frame_rate [1/s]
bool isFrameDue(const SceneRun& run, double frame_rate);
/// Takes the present state of a run. @param statistics of the time steps since the last frame @param what to take
/// besides the bodies @pre no joint was removed before one of the scene
Frame captureFrame(const SceneRun& run, const Statistics& statistics, const RecordingOptions& what = {});

/// What this rank has at present of a run that ranks share; as long as the world is whole the first one has everything.
/// @param what to take besides the bodies @pre as captureFrame()
FramePart captureFramePart(const SceneRun& run, const RecordingOptions& what = {});

/// The file of a rank that records beside the one that was named: of RUN.h5 it is RUN.rank3.h5.
std::filesystem::path recordingPart(const std::filesystem::path& file, std::size_t rank);

/// Writes what a rank has of a recording whose RecordingOptions::parts say so. Such a recording is read like any other,
/// as long as its files are beside each other.
class RecordingPartWriter {
  public:
    /// @param file that the recording is named by @throws IoError if the part cannot be written
    RecordingPartWriter(const std::filesystem::path& file, std::size_t rank, const RecordingOptions& options);
    ~RecordingPartWriter();
    RecordingPartWriter(const RecordingPartWriter&) = delete;
    RecordingPartWriter& operator=(const RecordingPartWriter&) = delete;

    /// @throws InputError for arrays of other lengths than they need; IoError, for example when the disk is full
    void append(const FramePart& frame);
    /// Writes what is left and closes. @throws IoError
    void close();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Writes a recording; what was appended can be read while it is written and after a crash.
class RecordingWriter {
  public:
    /// @throws InputError for a frame rate out of range, or one that gives frames of another number of time steps than
    /// hashes; IoError if the file cannot be written
    RecordingWriter(const std::filesystem::path& file, const SceneSource& source, const Settings& settings,
                    const RecordingOptions& options = {});
    ~RecordingWriter();
    RecordingWriter(const RecordingWriter&) = delete;
    RecordingWriter& operator=(const RecordingWriter&) = delete;

    /// @throws IoError, for example when the disk is full; frames before it stay readable
    void append(const Frame& frame);
    /// Writes what is left and closes. @throws IoError
    void close();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// What stands in a recording apart from its frames.
struct RecordingInfo {
    Scene scene;                                                ///< as it was run
    std::vector<std::pair<std::string, std::string>> settings;  ///< field and value as text
    std::string version;                                        ///< of Cairn
    std::string machine;                                        ///< processor and operating system
    std::size_t frames = 0;
    std::size_t bodies = 0;
    std::size_t hashes_per_frame = 0;  ///< 0 = recorded without hashes
    double frame_rate = 0;             ///< frames per simulated second [1/s]
    bool contacts = false;             ///< whether frames have contacts
    bool joints = false;               ///< whether frames have the forces of joints
    std::size_t parts = 0;             ///< files beside it that have bodies, contacts and joints; 0 = it has them
};

/// Reads a recording.
class RecordingReader {
  public:
    /// @throws IoError if it is missing, truncated or not a recording; the text says which
    explicit RecordingReader(const std::filesystem::path& file);
    ~RecordingReader();
    RecordingReader(RecordingReader&&) noexcept;

    const RecordingInfo& info() const;  ///< read once, when the file is opened
    /// @param index 0 (the initial state) to info().frames − 1 @throws InputError, IoError
    Frame frame(std::size_t index) const;
    /// What one rank recorded of a frame: its bodies, the others have no position; with their contacts and joints.
    /// @param part 0 to info().parts − 1 @throws InputError, IoError
    Frame framePart(std::size_t index, std::size_t part) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Writes a recording in parts as one file. @param file of the new one, none of its own @throws InputError if it has no
/// parts; IoError
void mergeRecording(const RecordingReader& recording, const std::filesystem::path& file);

/// Where a simulation left its recording.
struct RecordingDifference {
    std::int64_t step = 0;            ///< the first time step that differs; without hashes the last one of its frame
    std::optional<std::size_t> body;  ///< the first body of the scene that differs at the end of the frame, if one does
    std::string what;                 ///< what was recorded and what came out now
};

/// Simulates a recording's scene again, with its settings, and compares every time step, or every frame of a recording
/// without hashes, bit by bit. @param threads results do not depend on it
/// @return the first difference, or none @throws InputError if it does not begin with the scene; IoError
std::optional<RecordingDifference> verifyRecording(const RecordingReader& recording, std::int64_t threads = 1);

/// One row per frame and body: frame,time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,asleep. @throws IoError
void exportCsv(const RecordingReader& recording, const std::filesystem::path& file);
/// A ParaView time series: OUT.pvd beside a folder of .vtp files with every body's surface; of a recording with
/// contacts or joints also OUT_forces.pvd, whose lines lead from bodies to where forces act on them. @throws IoError
void exportVtk(const RecordingReader& recording, const std::filesystem::path& file);

/// A scene file to which an HDF5 file adds bodies, which are read in slices when they are told. Each group of that file
/// has the name of a template of the scene, with a shape and a material, and arrays with a row for each body that is
/// like it: `position` [m], and if they are there `orientation` (w, x, y, z), `linear_velocity` [m/s],
/// `angular_velocity` [rad/s] and `scale`, a factor of the template's lengths. They follow the bodies of the scene, in
/// the groups' alphabetical order. @throws InputError for other names or arrays, and scenes that name bodies; IoError
SceneSource readSceneSource(const std::filesystem::path& file, const std::filesystem::path& bodies);

}  // namespace cairn
