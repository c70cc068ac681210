/// @file Every setting of a world, one struct per stage, with the presets.
/// Units, defaults, ranges and meanings of all fields also stand in settingFields(), from which the command line,
/// the scene files, the documentation and the viewer read them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "cairn/types.h"

namespace cairn {

/// Where all fields begin.
enum class Preset {
    performance,     ///< for real time
    accuracy,        ///< the other end of the dial between speed and truth
    thesis,          ///< the thesis's algorithms with its high performance settings. @source thesis §5.1
    thesis_accuracy  ///< and with its high accuracy settings. @source thesis §5.5
};

/// The name of each preset, in the order of the enumeration, as in scene files and `--preset`.
std::span<const std::string_view> presetNames();
/// The name of a preset.
std::string_view nameOf(Preset preset);
/// The preset with a name. @throws InputError for an unknown one; the text names all
Preset presetNamed(std::string_view name);

/// How candidates for contacts are found; both find the same.
enum class BroadPhaseKind { hash_grids, all_pairs };
/// Which penetration correction runs: the thesis's propagation, none, or sweeps over the overlapping contacts that move
/// their bodies apart by inverse masses and take what that lifts from their motion. @source thesis §2
enum class CorrectionKind { propagated, none, position_sweeps };
/// How closing contacts are resolved: the thesis's queue, a plain sweep as an independent second one, sweeps with warm
/// starting accelerated by conjugate gradients, or not at all.
enum class ResolutionKind { impulse_queue, sweep, accelerated_sweeps, none };
/// Which closing contact is resolved next. @source thesis §3.6 and §5.4
enum class ResolutionOrder { highest_closing_speed, arbitrary };

/// What the coefficient of restitution says: the ratio of the speeds (the thesis), or of the works of compression and
/// restitution, which never gains energy whatever friction does. @source Newton; Stronge 1990
enum class RestitutionLaw { newton, energetic };
/// Which speed restitution takes for that of the impact: the closing speed at the end of the time step with the forces
/// of the step (the thesis), or the speed with which the bodies touched each other within the step.
enum class RestitutionSpeed { closing, touching };
/// How impacts pass through chains of touching bodies: as the resolution does by itself, one contact after the other
/// (the thesis) or all at once.
enum class Impacts { of_resolution, sequential, simultaneous };

/// Broad and narrow phase.
struct DetectionSettings {
    BroadPhaseKind broad_phase = BroadPhaseKind::hash_grids;  ///< all_pairs is its slow oracle
    /// Contacts are reported up to this distance before touching [m], ≥ 0; where penetration_threshold is 0, 0 stands
    /// for a sixteenth of the overlap that is allowed.
    double contact_margin = 0;
    /// And so are those of bodies that would meet before the next detection: accelerated_sweeps lets them come just so
    /// close, rather than fly into or through each other. What a call moved or added is looked ahead for from its
    /// second step on. Not with RestitutionSpeed::touching.
    bool speculative_contacts = true;
};

/// Penetration correction. @source thesis §2
struct CorrectionSettings {
    CorrectionKind correction = CorrectionKind::position_sweeps;  ///< the algorithm, or none
    /// Overlap above which a contact is corrected [m]; −thr_pen of the thesis; 0 = allowed_overlap.
    double penetration_threshold = 0;
    double allowed_overlap = 0.0145;     ///< the same as a part of the smaller body's smallest extent, > 0
    double remaining_penetration = 0.7;  ///< part of the threshold that a correction leaves, in (0, 1) (2.5.4)
};

/// Contact resolution and shock propagation. @source thesis §3.3–3.8
struct ResolutionSettings {
    ResolutionKind resolution = ResolutionKind::accelerated_sweeps;  ///< the algorithm, or none
    ResolutionOrder order = ResolutionOrder::highest_closing_speed;  ///< of ResolutionKind::impulse_queue
    double resolution_threshold = 83.4e-6;   ///< closing speed above which a contact is resolved [m/s] (3.4.3)
    double restitution_threshold = 45.8e-3;  ///< closing speed below which restitution is zero [m/s] (3.8.1)
    RestitutionLaw restitution_law = RestitutionLaw::newton;         ///< what the coefficient of restitution says
    RestitutionSpeed restitution_speed = RestitutionSpeed::closing;  ///< the speed that it is about
    Impacts impacts = Impacts::of_resolution;                        ///< in chains of touching bodies
    double global_iterations = 2;    ///< limit of resolutions as a multiple of the batch's contacts; 0 = unlimited
    bool shock_propagation = true;   ///< Algorithm 10, when the limit was reached with contacts still closing
    double shock_iterations = 6;     ///< the same limit for each stage of the shock propagation; 0 = unlimited
    std::int64_t queue_switch = 64;  ///< batches with more contacts use the ordered queue (§3.8)
    std::int64_t iterations = 100;   ///< most sweeps (forth and back) of accelerated_sweeps over a batch, ≥ 1
    /// A batch is swept until what all further sweeps would change is estimated to be no more than this part of how its
    /// contacts move, 0 to 1: exactly where it lies still. Less is left where bodies are in each other deeper than
    /// allowed. 0 = until sweep_tolerance.
    double tolerance = 0.25;
    double sweep_tolerance = 1e-6;    ///< no more sweeps once a sweep changes no contact's velocity by more [m/s]
    std::int64_t direct_limit = 100;  ///< batches at rest of up to so many bodies may take direct steps; 0 = none
    double direct_pairs = 1.5;        ///< and of up to so many pairs in touch per body: stacks and chains; 0 = any
    /// accelerated_sweeps leaves sleeping bodies of a batch asleep until their contacts push otherwise than when they
    /// fell asleep, by what would give them this speed [m/s], ≥ 0; 0 = they wake as soon as their batch is resolved.
    double wake_speed = 8.33e-3;
    std::int64_t sweeps = 50;  ///< sweeps over the contacts of ResolutionKind::sweep, ≥ 1
};

/// Sleeping. @source thesis §3.2
struct SleepSettings {
    bool sleeping = true;              ///< off = every body stays awake
    double sleep_threshold = 8.33e-3;  ///< a body whose averaged motion is below this sleeps [m/s], < |g|Δt (3.2.5)
    double motion_bias = 0.9;          ///< weight of the history in the averaged motion, 0 ≤ bias < 1 (3.2.4)
    double motion_limit = 3;           ///< the averaged motion is capped at limit·sleep_threshold, > 1 (Algorithm 5)
};

/// Velocity-dependent gravity damping. @source thesis §3.8
struct GravityDampingSettings {
    double damping = 0.7;                ///< part of gravity taken away from slow bodies, 0 = off, ≤ 1 (Algorithm 12)
    double damping_threshold = 83.3e-3;  ///< bodies below this motion are damped [m/s]
};

/// Motion of free bodies.
struct IntegrationSettings {
    bool gyroscopic = true;    ///< torque-free rotation keeps its angular momentum (Euler's equations)
    bool exact_flight = true;  ///< smooth motion follows the mean of a step's velocities: free bodies, the parabola
};

/// Threads. @source thesis §4
struct ParallelSettings {
    std::int64_t threads = 1;  ///< threads that a step uses, 1 to 1024; results do not depend on it
};

/// What a step measures besides.
struct DiagnosticsSettings {
    bool diagnostics = false;  ///< fills Statistics::diagnostics in every step
};

/// What a world refuses to grow beyond.
struct LimitSettings {
    std::int64_t body_limit = 10'000'000;  ///< most bodies at one time, 1 to 1e9; a body needs about 4 kB
};

/// All settings of a world.
struct Settings {
    double steps_per_second = 240;  ///< time steps per simulated second, 30 to 1e6; the thesis asks for at least 180
    DetectionSettings detection;
    CorrectionSettings correction;
    ResolutionSettings resolution;
    SleepSettings sleep;
    GravityDampingSettings gravity_damping;
    IntegrationSettings integration;
    ParallelSettings parallel;
    LimitSettings limits;
    DiagnosticsSettings diagnostics;

    /// The length of a time step [s].
    double timeStep() const { return 1 / steps_per_second; }

    /// A preset. Its speed thresholds are multiples of |g|Δt and are given for g = 10 m/s² and the preset's own time
    /// step; other values scale them, so that a resting body is still told from a colliding one.
    /// @param preset which one
    /// @param steps_per_second [1/s], 30 to 1e6; 0 = the preset's own (240 or 960)
    /// @param gravity [m/s²], ≥ 0, magnitude of the sum of global accelerations; 0 (weightless) counts as 10
    /// @throws InputError outside the ranges. @source thesis §5.1, §5.5
    static Settings preset(Preset preset, double steps_per_second = 0, double gravity = 10);
};

/// The value of any field: a switch, a whole number, a number or the name of a choice.
using SettingValue = std::variant<bool, std::int64_t, double, std::string>;

/// One field of Settings, by name.
struct SettingField {
    std::string_view name;                      ///< unique, as in scene files and `--set name=value`
    std::string_view stage;                     ///< the struct it belongs to
    std::string_view unit;                      ///< SI unit, or empty
    std::string_view meaning;                   ///< one sentence
    double minimum;                             ///< smallest allowed number (numbers only)
    double maximum;                             ///< largest allowed number (numbers only)
    std::span<const std::string_view> choices;  ///< allowed names (choices only)
    SettingValue (*get)(const Settings&);
    void (*set)(Settings&, const SettingValue&);  ///< assigns a value that was checked before
};

/// All fields, in a fixed order. @source docs/settings.md
std::span<const SettingField> settingFields();

/// Sets one field. Whole numbers are accepted for numbers. @throws InputError for an unknown name, another type, a
/// non-finite number or a value out of range; the text names what is allowed
void setField(Settings& settings, std::string_view name, const SettingValue& value);

/// Sets one field from text, as in `--set name=value`. @throws InputError as setField
void setFieldFromText(Settings& settings, std::string_view name, std::string_view text);

/// Reads one field. @throws InputError for an unknown name
SettingValue getField(const Settings& settings, std::string_view name);

/// Refuses values out of range and settings that contradict each other.
/// @param gravity sum of all global accelerations [m/s², world]; zero is allowed
/// @throws InputError with the reason and the remedy
void validate(const Settings& settings, const Vec3& gravity);

}  // namespace cairn
