#include "cairn/settings.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace cairn {

namespace {

/// The smallest number above zero: the lower end of ranges that exclude zero.
constexpr double above_zero = std::numeric_limits<double>::min();
/// Far above any use; a body falls beyond the limit of speeds at once [m/s²].
constexpr double gravity_limit = 1e12;

constexpr std::array<std::string_view, 3> correction_names = {"propagated", "none", "position_sweeps"};
constexpr std::array<std::string_view, 5> resolution_names = {"impulse_queue", "arbitrary_order", "sweep",
                                                              "accelerated_sweeps", "none"};
constexpr std::array<std::string_view, 2> restitution_law_names = {"newton", "energetic"};
constexpr std::array<std::string_view, 2> restitution_speed_names = {"closing", "touching"};
constexpr std::array<std::string_view, 3> impacts_names = {"of_resolution", "sequential", "simultaneous"};

template <auto Stage, auto Member>
auto& member(auto& settings) {
    return (settings.*Stage).*Member;
}

/// What a field of one value type needs to be read and written: a number, a whole number or a switch.
template <auto Stage, auto Member>
SettingField plain(std::string_view name, std::string_view stage, std::string_view unit, double minimum, double maximum,
                   std::string_view meaning) {
    return {name,
            stage,
            unit,
            meaning,
            minimum,
            maximum,
            {},
            [](const Settings& s) -> SettingValue { return member<Stage, Member>(s); },
            [](Settings& s, const SettingValue& value) {
                auto& target = member<Stage, Member>(s);
                target = std::get<std::remove_cvref_t<decltype(target)>>(value);
            }};
}

template <auto Stage, auto Member, const auto& Names>
SettingField choice(std::string_view name, std::string_view stage, std::string_view meaning) {
    return {name,
            stage,
            "",
            meaning,
            0,
            0,
            Names,
            [](const Settings& s) -> SettingValue {
                return std::string(Names[static_cast<std::size_t>(member<Stage, Member>(s))]);
            },
            [](Settings& s, const SettingValue& value) {
                auto& target = member<Stage, Member>(s);
                const auto found = std::ranges::find(Names, std::get<std::string>(value));
                target = static_cast<std::remove_cvref_t<decltype(target)>>(found - Names.begin());
            }};
}

SettingField stepsPerSecond() {
    return {"steps_per_second",
            "time",
            "1/s",
            "time steps per simulated second; not given, those of performance and accuracy follow the bodies' sizes",
            1e-3,
            1e6,
            {},
            [](const Settings& s) -> SettingValue { return static_cast<double>(s.steps_per_second); },
            [](Settings& s, const SettingValue& value) { s.steps_per_second = std::get<double>(value); }};
}

const std::vector<SettingField>& settingTable() {
    using S = Settings;
    using D = DetectionSettings;
    using C = CorrectionSettings;
    using R = ResolutionSettings;
    using L = SleepSettings;
    using I = IntegrationSettings;
    using P = ParallelSettings;
    static const std::vector<SettingField> all = {
        stepsPerSecond(),
        plain<&S::detection, &D::contact_margin>(
            "contact_margin", "detection", "m", 0, 1,
            "contacts are reported up to this distance before touching; 0 without penetration_threshold = a "
            "sixteenth of the overlap allowed"),
        choice<&S::correction, &C::correction, correction_names>("correction", "correction",
                                                                 "algorithm of the penetration correction"),
        plain<&S::correction, &C::penetration_threshold>(
            "penetration_threshold", "correction", "m", 0, 1,
            "overlap above which a contact is corrected; 0 = allowed_overlap"),
        plain<&S::correction, &C::allowed_overlap>(
            "allowed_overlap", "correction", "", 1e-6, 0.1,
            "the same as part of the smaller body's smallest extent, where penetration_threshold is 0"),
        choice<&S::resolution, &R::resolution, resolution_names>("resolution", "resolution",
                                                                 "algorithm of the contact resolution"),
        plain<&S::resolution, &R::resolution_threshold>("resolution_threshold", "resolution", "m/s", above_zero, 1e3,
                                                        "closing speed above which a contact is resolved (3.4.3)"),
        plain<&S::resolution, &R::restitution_threshold>("restitution_threshold", "resolution", "m/s", 0, 1e3,
                                                         "closing speed below which restitution is zero (3.8.1)"),
        choice<&S::resolution, &R::restitution_law, restitution_law_names>(
            "restitution_law", "resolution",
            "restitution as a ratio of speeds (the thesis) or, never gaining energy, of works"),
        choice<&S::resolution, &R::restitution_speed, restitution_speed_names>(
            "restitution_speed", "resolution",
            "restitution takes the closing speed with the step's forces (the thesis) or that at the touching"),
        choice<&S::resolution, &R::impacts, impacts_names>(
            "impacts", "resolution", "impacts in touching chains: as the resolution does, in sequence or all at once"),
        plain<&S::resolution, &R::iterations>(
            "iterations", "resolution", "", 0, 1e6,
            "most resolutions per contact of 'impulse_queue' and 'arbitrary_order', "
            "or sweeps over a batch of the others (where it rests, three times as many of "
            "'accelerated_sweeps'); 0 = no limit"),
        plain<&S::resolution, &R::tolerance>("tolerance", "resolution", "", 0, 1,
                                             "'accelerated_sweeps' goes on until about so much is left to change, as a "
                                             "part of how a batch's contacts move"),
        plain<&S::resolution, &R::pulled_tolerance>(
            "pulled_tolerance", "resolution", "", 1e-6, 1,
            "'tolerance' where forces of users, springs or joints act, if it is less"),
        plain<&S::resolution, &R::shock_propagation>(
            "shock_propagation", "resolution", "", 0, 1,
            "shock propagation of 'impulse_queue' when iterations were not enough (Algorithm 10)"),
        plain<&S::sleep, &L::sleeping>("sleeping", "sleep", "", 0, 1, "bodies at rest fall asleep"),
        plain<&S::sleep, &L::sleep_threshold>("sleep_threshold", "sleep", "m/s", 0, 1e3,
                                              "a body whose averaged motion is below this sleeps (3.2.5); "
                                              "'accelerated_sweeps' wakes what is pushed to more"),
        plain<&S::sleep, &L::damping>(
            "damping", "sleep", "", 0, 0.99,
            "part of gravity taken from bodies slower than ten times sleep_threshold; 0 = off (Algorithm 12); "
            "'accelerated_sweeps' takes nothing where other forces act as well and from what moves evenly"),
        plain<&S::integration, &I::exact_flight>(
            "exact_flight", "integration", "", 0, 1,
            "smooth motion follows the mean of a step's velocities, so that free bodies keep to the parabola"),
        plain<&S::integration, &I::most_parts>(
            "most_parts", "integration", "", 1, 64,
            "a step is divided into so many parts at most (the next lower power of two) where what touches moves far; "
            "1 = never"),
        plain<&S::parallel, &P::threads>("threads", "parallel", "", 1, 1024,
                                         "threads of a step; results do not depend on it"),
        plain<&S::parallel, &P::always_helped>(
            "always_helped", "parallel", "", 0, 1,
            "all threads take part in every stage; without it where their processors are free and it is faster"),
        plain<&S::diagnostics, &DiagnosticsSettings::diagnostics>(
            "diagnostics", "diagnostics", "", 0, 1, "every step measures momentum, energy accounts and residuals"),
    };
    return all;
}

/// Fields that are no more, and what is there instead.
constexpr auto former_fields = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"sweep_limit", "use 'iterations'"},
    {"moving_sweep_limit", "use 'tolerance'"},
    {"moving_tolerance", "use 'tolerance'"},
    {"small_sweep_part", "use 'tolerance'"},
    {"sliding_part", "use 'tolerance'"},
    {"visit_limit", "use 'tolerance'"},
    {"spread_levels", "use 'correction'"},
    {"correction_rounds", "use 'correction'"},
    {"broad_phase", "leave it out: it is always hash_grids"},
    {"speculative_contacts",
     "contacts are foreseen exactly where 'resolution' is accelerated_sweeps and 'restitution_speed' is closing"},
    {"remaining_penetration", "a correction leaves 0.7 of 'penetration_threshold' or 'allowed_overlap': set these"},
    {"order", "set 'resolution' to impulse_queue (the fastest first) or arbitrary_order"},
    {"global_iterations", "use 'iterations'"},
    {"sweeps", "use 'iterations'"},
    {"shock_iterations", "leave it out: it is 6 per contact; 'shock_propagation' switches the whole"},
    {"queue_switch", "leave it out: it never changed a result"},
    {"sweep_tolerance", "it is a hundredth of 'resolution_threshold': set that"},
    {"direct_limit", "leave it out: stacks and chains at rest are solved directly"},
    {"direct_pairs", "leave it out: stacks and chains at rest are solved directly"},
    {"wake_speed", "it is 'sleep_threshold': set that"},
    {"motion_bias", "it is 0.9 in 1/240 s and follows from 'steps_per_second'"},
    {"motion_limit", "leave it out: it is 3"},
    {"damping_threshold", "it is ten times 'sleep_threshold': set that, or 'damping' to 0 for none"},
    {"gyroscopic", "leave it out: free bodies always keep their angular momentum"},
    {"body_limit", "leave it out: a world refuses more bodies than it can number"},
});

const SettingField& findField(std::string_view name) {
    for (const SettingField& field : settingTable()) {
        if (field.name == name) return field;
    }
    for (const auto& [former, instead] : former_fields) {
        if (name == former) throw InputError(fmt::format("there is no setting '{}' any more; {}", name, instead));
    }
    std::vector<std::string_view> names;
    for (const SettingField& field : settingTable()) names.push_back(field.name);
    throw InputError(fmt::format("unknown setting '{}'; the settings are {}", name, fmt::join(names, ", ")));
}

std::string allowedRange(const SettingField& field) {
    const std::string unit = field.unit.empty() ? "" : fmt::format(" {}", field.unit);
    if (field.minimum == above_zero) return fmt::format("above 0 and at most {}{}", field.maximum, unit);
    return fmt::format("within {} and {}{}", field.minimum, field.maximum, unit);
}

std::string asText(const SettingValue& value) {
    return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

[[noreturn]] void refuse(const SettingField& field, const SettingValue& value, const std::string& allowed) {
    throw InputError(fmt::format("setting '{}' is {}; it must be {}", field.name, asText(value), allowed));
}

/// The value in the field's own type, checked. @throws InputError
SettingValue converted(const SettingField& field, const SettingValue& given) {
    const SettingValue present = field.get(Settings{});
    SettingValue value = given;
    if (std::holds_alternative<std::string>(present)) {
        const auto* name = std::get_if<std::string>(&given);
        if (name == nullptr || std::ranges::find(field.choices, *name) == field.choices.end()) {
            refuse(field, given, fmt::format("one of {}", fmt::join(field.choices, ", ")));
        }
        return value;
    }
    if (std::holds_alternative<bool>(present)) {
        if (!std::holds_alternative<bool>(given)) refuse(field, given, "true or false");
        return value;
    }
    double number = 0;
    if (const auto* whole = std::get_if<std::int64_t>(&given)) {
        number = static_cast<double>(*whole);
    } else if (const auto* real = std::get_if<double>(&given)) {
        number = *real;
    } else {
        refuse(field, given, "a number " + allowedRange(field));
    }
    if (!(number >= field.minimum && number <= field.maximum)) refuse(field, given, allowedRange(field));
    if (std::holds_alternative<std::int64_t>(present)) {
        if (number != std::floor(number)) refuse(field, given, "a whole number " + allowedRange(field));
        return static_cast<std::int64_t>(number);
    }
    return number;
}

/// Refuses a combination of settings. @throws InputError
void requireTogether(const Settings& s, double gravity) {
    if (s.resolution.restitution_law == RestitutionLaw::energetic && s.resolution.impacts == Impacts::simultaneous) {
        throw InputError(
            "restitution_law 'energetic' is a law of single impacts and cannot hold with impacts 'simultaneous'; set "
            "impacts to 'sequential' or restitution_law to 'newton'");
    }
    const double speed = gravity * s.timeStep();
    if (!s.sleep.sleeping || gravity == 0) return;
    if (s.sleep.sleep_threshold >= speed) {
        throw InputError(fmt::format(
            "sleep_threshold {} m/s is not below the speed {} m/s that gravity gives a body in one time step, so a "
            "resting body could never fall (3.2.5); lower sleep_threshold, take fewer steps_per_second or set "
            "sleeping to false",
            s.sleep.sleep_threshold, speed));
    }
    const double damped = std::sqrt(2.0) * (1 - s.sleep.damping) * speed;
    if (s.sleep.sleep_threshold >= damped) {
        throw InputError(fmt::format(
            "with damping {} a released body gains a motion of only {} m/s in one time step and would fall asleep in "
            "the air: sleep_threshold {} m/s must be lower; lower it or damping",
            s.sleep.damping, damped, s.sleep.sleep_threshold));
    }
}

}  // namespace

std::span<const SettingField> settingFields() {
    return settingTable();
}

void setField(Settings& settings, std::string_view name, const SettingValue& value) {
    const SettingField& field = findField(name);
    field.set(settings, converted(field, value));
}

void setFieldFromText(Settings& settings, std::string_view name, std::string_view text) {
    const SettingField& field = findField(name);
    const SettingValue present = field.get(settings);
    SettingValue value = std::string(text);
    if (std::holds_alternative<bool>(present)) {
        if (text == "true" || text == "on" || text == "1") value = true;
        if (text == "false" || text == "off" || text == "0") value = false;
    } else if (!std::holds_alternative<std::string>(present)) {
        double number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc() && end == text.data() + text.size()) value = number;
    }
    field.set(settings, converted(field, value));
}

SettingValue getField(const Settings& settings, std::string_view name) {
    return findField(name).get(settings);
}

void validate(const Settings& settings, const Vec3& gravity) {
    for (const SettingField& field : settingTable()) {
        static_cast<void>(converted(field, field.get(settings)));
    }
    const double magnitude = gravity.stableNorm();
    if (!gravity.allFinite() || magnitude > gravity_limit) {
        throw InputError(fmt::format("gravity is ({}, {}, {}) m/s²; its magnitude must be a number up to {} m/s²",
                                     gravity.x(), gravity.y(), gravity.z(), gravity_limit));
    }
    requireTogether(settings, magnitude);
}

}  // namespace cairn
