#include "cairn/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <set>
#include <string>
#include <utility>

namespace cairn {
namespace {

/// What the presets of the thesis have in common: its algorithms and nothing else.
void expectTheThesissAlgorithms(const Settings& s) {
    EXPECT_EQ(s.correction.correction, CorrectionKind::propagated);
    EXPECT_EQ(s.resolution.resolution, ResolutionKind::impulse_queue);
    EXPECT_EQ(s.resolution.restitution_law, RestitutionLaw::newton);
    EXPECT_EQ(s.resolution.restitution_speed, RestitutionSpeed::closing);
    EXPECT_EQ(s.resolution.impacts, Impacts::of_resolution);
    EXPECT_TRUE(s.sleep.sleeping);
    EXPECT_FALSE(s.integration.exact_flight);
}

TEST(Presets, ThesisIsTheTableOfTheThesis) {
    const Settings s = Settings::preset(Preset::thesis);
    expectTheThesissAlgorithms(s);
    EXPECT_EQ(s.steps_per_second, 240);
    EXPECT_EQ(s.correction.penetration_threshold, 1.74e-3);
    EXPECT_EQ(s.sleep.sleep_threshold, 8.33e-3);
    EXPECT_EQ(s.resolution.resolution_threshold, 83.4e-6);
    EXPECT_EQ(s.resolution.restitution_threshold, 45.8e-3);
    EXPECT_EQ(s.resolution.iterations, 2);
    EXPECT_TRUE(s.resolution.shock_propagation);
    EXPECT_EQ(s.sleep.damping, 0.7);
}

TEST(Presets, ThesisAccuracyIsTheTableOfTheThesis) {
    const Settings s = Settings::preset(Preset::thesis_accuracy);
    expectTheThesissAlgorithms(s);
    EXPECT_EQ(s.steps_per_second, 960);
    EXPECT_EQ(s.correction.penetration_threshold, 0.1e-3);
    EXPECT_EQ(s.sleep.sleep_threshold, 0.52e-3);
    EXPECT_EQ(s.resolution.resolution_threshold, 5.2e-6);
    EXPECT_EQ(s.resolution.restitution_threshold, 11.5e-3);
    EXPECT_EQ(s.resolution.iterations, 0);
    EXPECT_FALSE(s.resolution.shock_propagation);
    EXPECT_EQ(s.sleep.damping, 0);
}

TEST(Presets, PerformanceAndAccuracyHaveTheThresholdsOfTheThesis) {
    for (const auto& [own, of_thesis] :
         {std::pair(Preset::performance, Preset::thesis), std::pair(Preset::accuracy, Preset::thesis_accuracy)}) {
        const Settings s = Settings::preset(own);
        const Settings t = Settings::preset(of_thesis);
        EXPECT_EQ(s.steps_per_second, t.steps_per_second);
        EXPECT_EQ(s.correction.penetration_threshold, 0) << "lengths follow from the sizes of bodies";
        EXPECT_EQ(s.sleep.sleep_threshold, t.sleep.sleep_threshold);
        EXPECT_EQ(s.resolution.resolution_threshold, t.resolution.resolution_threshold);
        EXPECT_EQ(s.resolution.restitution_threshold, t.resolution.restitution_threshold);
        EXPECT_EQ(s.sleep.damping, t.sleep.damping);
    }
}

TEST(Presets, AreFoundByTheirNames) {
    for (const std::string_view name : presetNames()) EXPECT_EQ(nameOf(presetNamed(name)), name);
    EXPECT_EQ(nameOf(Preset::thesis_accuracy), "thesis_accuracy");
    EXPECT_THROW(presetNamed("fast"), InputError);
}

TEST(Presets, SpeedThresholdsFollowGravityAndTimeStep) {
    const Settings slow = Settings::preset(Preset::performance, 60, 5);
    EXPECT_DOUBLE_EQ(slow.sleep.sleep_threshold, 8.33e-3 * 4 / 2);
    EXPECT_DOUBLE_EQ(slow.resolution.restitution_threshold, 45.8e-3 * 2);
    EXPECT_EQ(slow.correction.allowed_overlap, Settings().correction.allowed_overlap);
    const Settings thesis = Settings::preset(Preset::thesis, 60, 5);
    EXPECT_EQ(thesis.sleep.sleep_threshold, slow.sleep.sleep_threshold);
    for (const double steps : {30.0, 60.0, 240.0, 960.0, 1e6}) {
        for (const double g : {0.01, 1.62, 9.81, 10.0, 274.0}) {
            for (const std::string_view preset : presetNames()) {
                EXPECT_NO_THROW(validate(Settings::preset(presetNamed(preset), steps, g), Vec3(0, 0, -g)));
            }
        }
    }
    EXPECT_THROW(Settings::preset(Preset::performance, 1e-4), InputError);
    EXPECT_THROW(Settings::preset(Preset::performance, std::nan("")), InputError);
    EXPECT_THROW(Settings::preset(Preset::performance, 240, -1), InputError);
}

TEST(Fields, NamesAreUniqueAndEveryFieldReadsAndWrites) {
    std::set<std::string_view> names;
    for (const SettingField& field : settingFields()) {
        EXPECT_TRUE(names.insert(field.name).second) << field.name;
        EXPECT_FALSE(field.meaning.empty()) << field.name;
        Settings s = Settings::preset(Preset::performance);
        const SettingValue value = getField(s, field.name);
        EXPECT_NO_THROW(setField(s, field.name, value)) << field.name;
        EXPECT_EQ(getField(s, field.name), value) << field.name;
    }
}

TEST(Fields, TextIsConvertedToTheFieldsType) {
    Settings s;
    setFieldFromText(s, "sleep_threshold", "0.004");
    EXPECT_EQ(s.sleep.sleep_threshold, 0.004);
    setFieldFromText(s, "threads", "3");
    EXPECT_EQ(s.parallel.threads, 3);
    setFieldFromText(s, "sleeping", "off");
    EXPECT_FALSE(s.sleep.sleeping);
    setFieldFromText(s, "resolution", "sweep");
    EXPECT_EQ(s.resolution.resolution, ResolutionKind::sweep);
    setField(s, "damping", std::int64_t{0});
    EXPECT_EQ(s.sleep.damping, 0);
}

/// The message of the error that setting a field gives, or nothing.
std::string refusal(std::string_view name, std::string_view text) {
    Settings s;
    try {
        setFieldFromText(s, name, text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Fields, BadValuesAreRefusedWithWhatIsAllowed) {
    EXPECT_NE(refusal("nonsense", "1").find("steps_per_second"), std::string::npos);
    EXPECT_NE(refusal("threads", "0").find("within 1 and 1024"), std::string::npos);
    EXPECT_NE(refusal("threads", "1.5").find("whole number"), std::string::npos);
    EXPECT_NE(refusal("allowed_overlap", "0").find("1e-06"), std::string::npos) << refusal("allowed_overlap", "0");
    EXPECT_NE(refusal("penetration_threshold", "nan"), "");
    EXPECT_NE(refusal("penetration_threshold", "inf"), "");
    EXPECT_NE(refusal("penetration_threshold", "1e-3m"), "");
    EXPECT_NE(refusal("sleeping", "maybe").find("true or false"), std::string::npos);
    EXPECT_NE(refusal("impacts", "random").find("sequential, simultaneous"), std::string::npos);
    EXPECT_NE(refusal("steps_per_second", "0"), "");
}

TEST(Fields, FormerNamesAreRefusedWithWhatIsThereInstead) {
    for (const auto& [former, instead] : std::initializer_list<std::pair<std::string_view, std::string_view>>{
             {"sweep_limit", "'iterations'"},
             {"broad_phase", "hash_grids"},
             {"speculative_contacts", "'restitution_speed'"},
             {"remaining_penetration", "'penetration_threshold'"},
             {"order", "arbitrary_order"},
             {"global_iterations", "'iterations'"},
             {"sweeps", "'iterations'"},
             {"shock_iterations", "'shock_propagation'"},
             {"queue_switch", "leave it out"},
             {"sweep_tolerance", "'resolution_threshold'"},
             {"direct_limit", "leave it out"},
             {"direct_pairs", "leave it out"},
             {"wake_speed", "'sleep_threshold'"},
             {"motion_bias", "'steps_per_second'"},
             {"motion_limit", "leave it out"},
             {"damping_threshold", "'sleep_threshold'"},
             {"gyroscopic", "leave it out"},
             {"body_limit", "leave it out"}}) {
        EXPECT_NE(refusal(former, "1").find("any more"), std::string::npos) << former;
        EXPECT_NE(refusal(former, "1").find(instead), std::string::npos) << refusal(former, "1");
    }
}

TEST(Validation, ASleepThresholdThatGravityCannotBeatIsRefused) {
    Settings s = Settings::preset(Preset::performance);
    s.sleep.sleep_threshold = 10.0 / 240;
    EXPECT_THROW(validate(s, Vec3(0, 0, -10)), InputError);
    EXPECT_NO_THROW(validate(s, Vec3::Zero()));
    s.sleep.sleeping = false;
    EXPECT_NO_THROW(validate(s, Vec3(0, 0, -10)));
}

TEST(Validation, DampingThatLetsBodiesSleepInTheAirIsRefused) {
    Settings s = Settings::preset(Preset::performance);
    s.sleep.damping = 0.95;
    EXPECT_THROW(validate(s, Vec3(0, 0, -10)), InputError);
    EXPECT_THROW(validate(s, Vec3(0, 0, std::nan(""))), InputError);
    EXPECT_THROW(validate(s, Vec3(0, 0, 1e200)), InputError);
}

}  // namespace
}  // namespace cairn
