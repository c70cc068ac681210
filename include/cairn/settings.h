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

/// Which penetration correction runs: the thesis's propagation, none, or sweeps over the overlapping contacts that move
/// their bodies apart by inverse masses and take what that lifts from their motion. @source thesis §2
enum class CorrectionKind { propagated, none, position_sweeps };
/// How closing contacts are resolved: the thesis's queue, the one that closes fastest first; the same in another order,
/// to compare with; a plain sweep as an independent third one; sweeps with warm starting accelerated by conjugate
/// gradients; or not at all. @source thesis §3.6 and §5.4
enum class ResolutionKind { impulse_queue, arbitrary_order, sweep, accelerated_sweeps, none };

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
    /// Contacts are reported up to this distance before touching [m], ≥ 0; where penetration_threshold is 0, 0 stands
    /// for a sixteenth of the overlap that is allowed.
    double contact_margin = 0;
};

/// Penetration correction. @source thesis §2
struct CorrectionSettings {
    CorrectionKind correction = CorrectionKind::position_sweeps;  ///< the algorithm, or none
    /// Overlap above which a contact is corrected [m]; −thr_pen of the thesis; 0 = allowed_overlap.
    double penetration_threshold = 0;
    double allowed_overlap = 0.0145;  ///< the same as a part of the smaller body's smallest extent, > 0
};

/// Contact resolution and shock propagation. @source thesis §3.3–3.8
struct ResolutionSettings {
    ResolutionKind resolution = ResolutionKind::accelerated_sweeps;  ///< the algorithm, or none
    double resolution_threshold = 83.4e-6;   ///< closing speed above which a contact is resolved [m/s] (3.4.3)
    double restitution_threshold = 45.8e-3;  ///< closing speed below which restitution is zero [m/s] (3.8.1)
    RestitutionLaw restitution_law = RestitutionLaw::newton;         ///< what the coefficient of restitution says
    RestitutionSpeed restitution_speed = RestitutionSpeed::closing;  ///< the speed that it is about
    Impacts impacts = Impacts::of_resolution;                        ///< in chains of touching bodies
    /// Most visits: resolutions as a multiple of the batch's contacts (impulse_queue, arbitrary_order; a part is
    /// rounded up), or sweeps over a batch (sweep; accelerated_sweeps forth and back, three times as many where it
    /// rests). 0 = no limit.
    double iterations = 100;
    /// accelerated_sweeps sweeps a batch until what all further sweeps would change is estimated to be no more than
    /// this part of how its contacts move, 0 to 1: exactly where it lies still. Less is left where bodies are in each
    /// other deeper than allowed. 0 = until a sweep changes no contact by more than a hundredth of
    /// resolution_threshold.
    double tolerance = 0.15;
    /// The same where forces of users, springs or joints act, if it is less: friction that balances a force errs to one
    /// side in every step. The hundredth becomes smaller in the same measure. 1e-6 to 1: sweeps must come to an end.
    double pulled_tolerance = 0.15;
    bool shock_propagation = true;  ///< of impulse_queue: Algorithm 10, when iterations left contacts closing
};

/// Sleeping, and the gravity damping of bodies that soon will. @source thesis §3.2, §3.8
struct SleepSettings {
    bool sleeping = true;  ///< off = every body stays awake
    /// A body whose averaged motion is below this sleeps [m/s], < |g|Δt (3.2.5). accelerated_sweeps leaves sleeping
    /// bodies of a batch asleep until their contacts push otherwise than when they fell asleep, by what would make them
    /// faster than this.
    double sleep_threshold = 8.33e-3;
    /// Part of gravity taken away from bodies whose motion is below ten times sleep_threshold, 0 = off, ≤ 0.99
    /// (Algorithm 12). accelerated_sweeps takes nothing from bodies in whose batch other forces act,
    /// and from what moves evenly.
    double damping = 0.7;
};

/// Motion of bodies.
struct IntegrationSettings {
    bool exact_flight = true;  ///< smooth motion follows the mean of a step's velocities: free bodies, the parabola
    /// A step is divided into so many parts at most (the next lower power of two, ≤ 64), where bodies that touch move
    /// far in it; 1 = never. Only where contacts are foreseen: with accelerated_sweeps and the restitution_speed
    /// closing.
    std::int64_t most_parts = 8;
};

/// Threads. @source thesis §4
struct ParallelSettings {
    std::int64_t threads = 1;  ///< threads that a step uses, 1 to 1024; results do not depend on it
    /// All take part in every stage. Without it they do where their processors are free and where it was measured to be
    /// faster.
    bool always_helped = false;
};

/// What a step measures besides.
struct DiagnosticsSettings {
    bool diagnostics = false;  ///< fills Statistics::diagnostics in every step
};

/// How many time steps a simulated second has: a number [1/s], or what the sizes of the bodies ask for. Converts from
/// and to the number.
class StepRate {
  public:
    /// Just so many. @param number [1/s]
    StepRate(double number) : number_(number) {}
    /// @param number for bodies of 0.12 m under 10 m/s² [1/s]; for others it is multiplied by a power of two when the
    ///        world takes its first step with bodies that move
    static StepRate bySize(double number) {
        StepRate rate(number);
        rate.by_size_ = true;
        return rate;
    }
    operator double() const { return number_; }  ///< [1/s]
    bool isBySize() const { return by_size_; }   ///< and not yet known

  private:
    double number_;
    bool by_size_ = false;
};

/// All settings of a world.
struct Settings {
    /// Time steps per simulated second, 1e-3 to 1e6. By default 240 for bodies of 0.12 m under 10 m/s², the thesis's;
    /// for others 240·2^k with k = −round(½·log₂(d·10 m/s²/(0.12 m·|g|))), where d is the median over the bodies that
    /// move of the middle one of a body's three extents, when the world takes its first step with such bodies. The
    /// speed thresholds below are given for the number that stands here and follow it.
    StepRate steps_per_second = StepRate::bySize(240);
    DetectionSettings detection;
    CorrectionSettings correction;
    ResolutionSettings resolution;
    SleepSettings sleep;
    IntegrationSettings integration;
    ParallelSettings parallel;
    DiagnosticsSettings diagnostics;

    /// The length of a time step [s].
    double timeStep() const { return 1 / steps_per_second; }

    /// A preset. Its speed thresholds are multiples of |g|Δt and are given for g = 10 m/s² and the preset's own time
    /// step; other values scale them, so that a resting body is still told from a colliding one.
    /// @param preset which one
    /// @param steps_per_second [1/s], 1e-3 to 1e6; 0 = 240 or, for accuracy, 960, by the sizes of the bodies; the
    ///        presets of the thesis take 240 and 960 for all sizes
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
