/// The settings of a world; what each means stands in the table of fields of the C++ library.
#include <algorithm>

#include "parts.h"
#include "record.h"

namespace cairn::python {

namespace {

/// A struct of settings. The documentation of its fields is that of settingFields().
template <class Stage>
class SettingRecord {
  public:
    SettingRecord(py::module_& module, const char* name, const char* doc) : record_(module, name, doc) {
        // The library knows what is there instead of a field that is no more.
        record_.refusing([](const std::string& field) { getField(Settings{}, field); });
    }

    template <class Member>
    SettingRecord& field(const char* name, Member Stage::*member) {
        const auto fields = settingFields();
        const auto found = std::ranges::find(fields, name, &SettingField::name);
        if (found == fields.end()) throw std::logic_error(std::string("no setting is called ") + name);
        std::string doc(found->meaning);
        if (!found->unit.empty()) doc += " [" + std::string(found->unit) + "]";
        record_.field(name, member, doc.c_str());
        return *this;
    }
    void finish() { record_.finish(); }

  private:
    Record<Stage> record_;
};

void bindStages(py::module_& module) {
    using D = DetectionSettings;
    SettingRecord<D>(module, "DetectionSettings", "Broad and narrow phase.")
        .field("contact_margin", &D::contact_margin)
        .finish();
    using C = CorrectionSettings;
    SettingRecord<C>(module, "CorrectionSettings", "Penetration correction.")
        .field("correction", &C::correction)
        .field("penetration_threshold", &C::penetration_threshold)
        .field("allowed_overlap", &C::allowed_overlap)
        .finish();
    using S = SleepSettings;
    SettingRecord<S>(module, "SleepSettings", "Sleeping and gravity damping.")
        .field("sleeping", &S::sleeping)
        .field("sleep_threshold", &S::sleep_threshold)
        .field("damping", &S::damping)
        .finish();
    using I = IntegrationSettings;
    SettingRecord<I>(module, "IntegrationSettings", "Motion of bodies.")
        .field("exact_flight", &I::exact_flight)
        .field("most_parts", &I::most_parts)
        .finish();
    using P = ParallelSettings;
    SettingRecord<P>(module, "ParallelSettings", "Threads; results do not depend on them.")
        .field("threads", &P::threads)
        .field("always_helped", &P::always_helped)
        .finish();
    SettingRecord<DiagnosticsSettings>(module, "DiagnosticsSettings", "What a step measures besides.")
        .field("diagnostics", &DiagnosticsSettings::diagnostics)
        .finish();
}

void bindResolution(py::module_& module) {
    using R = ResolutionSettings;
    SettingRecord<R>(module, "ResolutionSettings", "Contact resolution and shock propagation.")
        .field("resolution", &R::resolution)
        .field("resolution_threshold", &R::resolution_threshold)
        .field("restitution_threshold", &R::restitution_threshold)
        .field("restitution_law", &R::restitution_law)
        .field("restitution_speed", &R::restitution_speed)
        .field("impacts", &R::impacts)
        .field("iterations", &R::iterations)
        .field("tolerance", &R::tolerance)
        .field("pulled_tolerance", &R::pulled_tolerance)
        .field("shock_propagation", &R::shock_propagation)
        .finish();
}

/// The value of a field: enums by name. @throws TypeError
SettingValue settingValue(const std::string& name, py::handle value) {
    if (py::hasattr(value, "name") && py::isinstance<py::int_>(value)) return value.attr("name").cast<std::string>();
    try {
        return value.cast<SettingValue>();
    } catch (const py::cast_error&) {
        refuseField("Settings", name, value);
    }
}

Settings settingsReplaced(const py::object& self, const py::kwargs& changes) {
    const py::tuple stages = py::type::of(self).attr("__match_args__");
    py::dict whole;
    py::dict fields;
    for (const auto& [name, value] : changes) {
        // Some stages are called like a field of theirs.
        const bool is_stage = stages.contains(name) && py::type::of(value).is(py::type::of(self.attr(name)));
        (is_stage ? whole : fields)[name] = value;
    }
    for (const py::handle name : stages) {
        if (!whole.contains(name)) whole[name] = self.attr(name);
    }
    auto settings = py::type::of(self)(**whole).cast<Settings>();
    for (const auto& [name, value] : fields) {
        const auto field = name.cast<std::string>();
        setField(settings, field, settingValue(field, value));
    }
    return settings;
}

void bindAllSettings(py::module_& module) {
    Record<Settings> record(module, "Settings", "All settings of a world, one record per stage.");
    record
        .fieldBy(
            "steps_per_second",
            [](const Settings& self) { return py::float_(static_cast<double>(self.steps_per_second)); },
            [](Settings& self, py::handle value) { self.steps_per_second = value.cast<double>(); },
            "Time steps per simulated second, 1e-3 to 1e6 [1/s].")
        .field("detection", &Settings::detection, "Broad and narrow phase.")
        .field("correction", &Settings::correction, "Penetration correction.")
        .field("resolution", &Settings::resolution, "Contact resolution and shock propagation.")
        .field("sleep", &Settings::sleep, "Sleeping and gravity damping.")
        .field("integration", &Settings::integration, "Motion of free bodies.")
        .field("parallel", &Settings::parallel, "Threads.")
        .field("diagnostics", &Settings::diagnostics, "What a step measures besides.")
        .fieldBy(
            "steps_by_size", [](const Settings& self) { return py::bool_(self.steps_per_second.isBySize()); },
            [](Settings& self, py::handle value) {
                const double number = self.steps_per_second;
                self.steps_per_second = value.cast<bool>() ? StepRate::bySize(number) : StepRate(number);
            },
            "Whether steps_per_second is for bodies of 0.12 m under 10 m/s² and others get a power of two times as "
            "many "
            "when the world takes its first step.");
    py::class_<Settings>& settings = record.finish();
    settings.def_property_readonly("time_step", &Settings::timeStep, "The length of a time step [s].")
        .def_static("preset", &Settings::preset, py::arg("preset"), py::arg("steps_per_second") = 0.0,
                    py::arg("gravity") = 10.0,
                    "A preset, its speed thresholds scaled to the time step and to gravity [m/s²]. Raises InputError.");
    settings.attr("replace") =
        py::cpp_function(&settingsReplaced, py::name("replace"), py::is_method(settings),
                         "A copy in which the named fields, of any stage, have other values. Raises InputError.");
}

void bindSettingFields(py::module_& module) {
    py::class_<SettingField>(module, "SettingField", "One field of Settings, by name.")
        .def_readonly("name", &SettingField::name, "Unique, as in scene files.")
        .def_readonly("stage", &SettingField::stage, "What it belongs to.")
        .def_readonly("unit", &SettingField::unit, "SI unit, or empty.")
        .def_readonly("meaning", &SettingField::meaning, "One sentence.")
        .def_readonly("minimum", &SettingField::minimum, "Smallest allowed number.")
        .def_readonly("maximum", &SettingField::maximum, "Largest allowed number.")
        .def_property_readonly(
            "choices",
            [](const SettingField& self) {
                return py::tuple(py::cast(std::vector<std::string>(self.choices.begin(), self.choices.end())));
            },
            "Allowed names.")
        .def(
            "get", [](const SettingField& self, const Settings& settings) { return self.get(settings); },
            py::arg("settings"), "Its value.")
        .def("__repr__", [](const SettingField& self) { return "SettingField('" + std::string(self.name) + "')"; });
    module.def(
        "setting_fields",
        [] {
            const auto fields = settingFields();
            return py::tuple(py::cast(std::vector<SettingField>(fields.begin(), fields.end())));
        },
        "All fields, in a fixed order.");
    module.def(
        "preset_names",
        [] {
            const auto names = presetNames();
            return py::tuple(py::cast(std::vector<std::string>(names.begin(), names.end())));
        },
        "The name of each preset, in the order of the enumeration.");
    module.def("get_field", &getField, py::arg("settings"), py::arg("name"),
               "Reads one field. Raises InputError for an unknown name.");
    module.def(
        "validate", [](const Settings& settings, const Vec3& gravity) { validate(settings, gravity); },
        py::arg("settings"), py::arg("gravity"),
        "Refuses settings that contradict each other. gravity: sum of all accelerations [m/s², W]. Raises InputError.");
}

}  // namespace

void bindSettings(py::module_& module) {
    bindStages(module);
    bindResolution(module);
    bindAllSettings(module);
    bindSettingFields(module);
}

}  // namespace cairn::python
