/// What a step reports.
#include "arrays.h"
#include "parts.h"
#include "record.h"

namespace cairn::python {

namespace {

void bindDiagnostics(py::module_& module) {
    using D = Diagnostics;
    Record<D>(module, "Diagnostics", "Momentum, energy and contact laws of a step, with the setting diagnostics only.")
        .field("momentum", &D::momentum, "Of all dynamic bodies at the end [N·s, W].")
        .field("angular_momentum", &D::angular_momentum, "Likewise, about the origin [N·m·s, W].")
        .field("fixed_impulse", &D::fixed_impulse, "From fixed bodies and the world [N·s, W].")
        .field("fixed_angular_impulse", &D::fixed_angular_impulse, "Likewise, about the origin [N·m·s, W].")
        .field("force_impulse", &D::force_impulse, "From gravity, applied forces and springs [N·s, W].")
        .field("force_angular_impulse", &D::force_angular_impulse, "Likewise, about the origin [N·m·s, W].")
        .field("momentum_error", &D::momentum_error, "Change that neither explains [N·s].")
        .field("angular_momentum_error", &D::angular_momentum_error, "Likewise [N·m·s].")
        .field("energy", &D::energy, "Kinetic and potential energy at the end [J].")
        .field("energy_flight", &D::energy_flight, "Error of the motion under gravity [J].")
        .field("energy_forces", &D::energy_forces, "Work of applied forces and springs [J].")
        .field("energy_damping", &D::energy_damping, "Of the gravity damping [J].")
        .field("energy_friction", &D::energy_friction, "Work of friction [J].")
        .field("energy_restitution", &D::energy_restitution, "Work of the contacts along their normals [J].")
        .field("energy_joints", &D::energy_joints, "Work of joints, motors included [J].")
        .field("energy_correction", &D::energy_correction, "Potential energy by the penetration correction [J].")
        .field("energy_drives", &D::energy_drives, "Of bodies, a frame or a gravity that follow a law [J].")
        .field("energy_sleep", &D::energy_sleep, "Of bodies that fell asleep [J].")
        .field("energy_error", &D::energy_error, "What no account explains [J].")
        .field("signorini", &D::signorini, "Largest residual of Signorini's law [J].")
        .field("de_saxce", &D::de_saxce, "Largest residual of the complementarity of the cones [J].")
        .field("dissipation", &D::dissipation, "Largest residual of the law of dissipation [J].")
        .finish();
    py::class_<DiagnosticsField>(module, "DiagnosticsField", "One number of Diagnostics, by name.")
        .def_readonly("name", &DiagnosticsField::name, "As in recordings.")
        .def_readonly("unit", &DiagnosticsField::unit, "SI unit.")
        .def_readonly("fold", &DiagnosticsField::fold, "How several steps become one number.")
        .def(
            "of", [](const DiagnosticsField& self, Diagnostics diagnostics) { return double{self.of(diagnostics)}; },
            py::arg("diagnostics"), "Its value.");
    module.def(
        "diagnostics_fields",
        [] {
            const auto fields = diagnosticsFields();
            return py::tuple(py::cast(std::vector<DiagnosticsField>(fields.begin(), fields.end())));
        },
        "All numbers, in a fixed order.");
}

void bindStatistics(py::module_& module) {
    using S = Statistics;
    Record<S> record(module, "Statistics", "Counters of one time step, or sums and extremes over several.");
    record.field("stage_ms", &S::stage_ms, "Wall time per stage [ms].")
        .field("contacts", &S::contacts, "Contact points.")
        .field("penetrating_contacts", &S::penetrating_contacts, "Deeper than the penetration threshold.")
        .field("corrected_contacts", &S::corrected_contacts, "Of these, brought back within the threshold.")
        .field("uncorrected_contacts", &S::uncorrected_contacts, "Of these, left.")
        .field("displaced_bodies", &S::displaced_bodies, "Moves of bodies by the correction.")
        .field("global_iterations", &S::global_iterations, "Contacts resolved by the global resolution.")
        .field("shock_iterations", &S::shock_iterations, "Contacts resolved by the shock propagation.")
        .field("shock_batches", &S::shock_batches, "Batches that needed the shock propagation.")
        .field("batches", &S::batches, "Groups of connected bodies.")
        .field("largest_batch", &S::largest_batch, "Contacts of the largest batch.")
        .field("asleep", &S::asleep, "Bodies asleep at the end.")
        .field("woken", &S::woken, "Bodies woken.")
        .field("largest_overlap", &S::largest_overlap, "After the correction [m].")
        .field("mean_overlap", &S::mean_overlap, "Over the overlapping contacts, after the correction [m].")
        .field("diagnostics", &S::diagnostics, "Zero without the setting.");
    record.finish().def(
        "__add__",
        [](Statistics self, const Statistics& next) {
            self.add(next);
            return self;
        },
        "Both steps together.");
}

void bindInfos(py::module_& module) {
    Record<BatchInfo>(module, "BatchInfo", "A group of bodies connected by contacts, fixed bodies being barriers.")
        .field("bodies", &BatchInfo::bodies, "In ascending order of id.")
        .field("contacts", &BatchInfo::contacts, "Contact points between them.")
        .finish();
    Record<BodyTrace>(module, "BodyTrace", "What the last step did with a body, for viewers.")
        .field("bounds_lower", &BodyTrace::bounds_lower, "As the broad phase saw them [m, W].")
        .field("bounds_upper", &BodyTrace::bounds_upper, "[m, W]")
        .field("level", &BodyTrace::level, "In the hierarchy of the broad phase; -1 = outside it.")
        .field("correction", &BodyTrace::correction, "Displacement by the correction [m, W]; needs tracing.")
        .field("shock_stage", &BodyTrace::shock_stage, "Subset of the shock propagation; -1 = none.")
        .finish();
    Record<FaultInfo>(module, "FaultInfo", "A body that left the finite numbers was fixed where it last was finite.")
        .field("body", &FaultInfo::body, "Which one.")
        .field("step", &FaultInfo::step, "Number of the time step, from 1.")
        .field("what", &FaultInfo::what, "Its numbers as text.")
        .finish();
}

}  // namespace

void bindReports(py::module_& module) {
    bindDiagnostics(module);
    bindStatistics(module);
    bindInfos(module);
    module.attr("body_id_dtype") = idDtype();
    module.attr("contact_dtype") = contactDtype();
    module.attr("event_dtype") = eventDtype();
}

}  // namespace cairn::python
