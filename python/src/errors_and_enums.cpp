/// Exceptions that fit Python's own, and enumerations as Python's enums.
#include "casters.h"
#include "parts.h"

namespace cairn::python {

namespace {

py::object newError(const char* name, const py::tuple& bases, const char* doc) {
    PyObject* error = PyErr_NewExceptionWithDoc(("cairn." + std::string(name)).c_str(), doc, bases.ptr(), nullptr);
    if (error == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::object>(error);
}

void raise(const char* name, const char* what) {
    PyErr_SetString(py::module_::import("cairn._core").attr(name).ptr(), what);
}

void translate(std::exception_ptr pointer) {
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const StaleIdError& error) {
        raise("StaleIdError", error.what());
    } catch (const InputError& error) {
        raise("InputError", error.what());
    } catch (const IoError& error) {
        raise("IoError", error.what());
    } catch (const InvariantError& error) {
        raise("InvariantError", error.what());
    }
}

/// Makes enum.IntEnum of the names, which are numbered from 0.
template <class Enum>
void bindEnum(py::module_& module, std::initializer_list<const char*> names, const char* doc) {
    py::dict members;
    int number = 0;
    for (const char* name : names) members[name] = number++;
    const char* called = enum_name<Enum>;
    py::object made = py::module_::import("enum").attr("IntEnum")(called, members, py::arg("module") = "cairn._core");
    made.doc() = doc;
    module.attr(called) = made;
}

void bindEnumsOfSettings(py::module_& module) {
    bindEnum<Preset>(module, {"performance", "accuracy", "thesis", "thesis_accuracy"}, "Where all settings begin.");
    bindEnum<CorrectionKind>(module, {"propagated", "none", "position_sweeps"}, "Which penetration correction runs.");
    bindEnum<ResolutionKind>(module, {"impulse_queue", "arbitrary_order", "sweep", "accelerated_sweeps", "none"},
                             "How closing contacts are resolved.");
    bindEnum<RestitutionLaw>(module, {"newton", "energetic"},
                             "What the coefficient of restitution says: a ratio of speeds or of works.");
    bindEnum<RestitutionSpeed>(module, {"closing", "touching"},
                               "Which speed restitution takes for that of the impact.");
    bindEnum<Impacts>(module, {"of_resolution", "sequential", "simultaneous"},
                      "How impacts pass through chains of touching bodies.");
}

}  // namespace

void bindErrors(py::module_& module) {
    const py::module_ builtins = py::module_::import("builtins");
    const auto bases = [&](auto... names) { return py::make_tuple(builtins.attr(names)...); };
    module.attr("InputError") = newError("InputError", bases("ValueError"),
                                         "What was given is not allowed; the text names the value and the remedy.");
    module.attr("StaleIdError") =
        newError("StaleIdError", py::make_tuple(module.attr("InputError"), builtins.attr("LookupError")),
                 "An id names a body, spring or joint that is no longer (or was never) in the world.");
    module.attr("IoError") =
        newError("IoError", bases("OSError"), "A file cannot be read or written, or a disk is full.");
    module.attr("InvariantError") =
        newError("InvariantError", bases("RuntimeError"), "A mistake of Cairn itself, found by World.set_checks().");
    py::register_exception_translator(&translate);
}

void bindEnums(py::module_& module) {
    bindEnum<BodyKind>(module, {"hole", "fixed", "dynamic"}, "What a slot of a world holds.");
    bindEnum<WakeReason>(module,
                         {"none", "changed", "displaced", "struck", "neighbour_removed", "support_lost", "floating"},
                         "Why a body woke.");
    bindEnum<EventKind>(module,
                        {"contact_begun", "contact_persisted", "contact_ended", "woke", "fell_asleep", "frozen",
                         "joint_broke", "sensor_entered", "sensor_left"},
                        "What happened.");
    bindEnum<EventLevel>(module, {"none", "changes", "all"},
                         "Which events a world collects; each level has those before it.");
    bindEnum<JointKind>(module,
                        {"distance", "rope", "ball", "hinge", "slider", "fixed", "universal", "planar", "cylindrical",
                         "screw", "generic", "gear", "rack", "mimic"},
                        "What a joint keeps.");
    bindEnum<JointAlong>(module, {"x", "y", "z", "turn_x", "turn_y", "turn_z"},
                         "Along or about which axis of a joint's frame A can move relative to B.");
    bindEnum<Touch>(module, {"never", "always"}, "Whether two bodies may touch.");
    bindEnum<TableEnd>(module, {"hold", "repeat"}, "What a table of motion does after its last time.");
    bindEnum<DriveOf>(module, {"position", "speed", "force", "torque"}, "What follows a function of time.");
    bindEnum<Baseline>(module, {"none", "at_rest"}, "How an accelerogram is brought to an end.");
    bindEnum<SurfaceSides>(module, {"one", "two"}, "Which sides of a surface touch others.");
    bindEnum<Stage>(
        module,
        {"events", "positions", "detection", "batches", "correction", "velocities", "resolution", "sleeping", "output"},
        "The nine stages of a time step, in order.");
    bindEnum<DiagnosticsField::Fold>(module, {"sum", "newest", "largest"}, "How several steps become one number.");
    bindEnum<Tracing>(module, {"off", "on"}, "Whether steps note what the response did with every body.");
    bindEnum<Checks>(module, {"off", "state", "on"}, "Whether a step checks itself.");
    bindEnumsOfSettings(module);
}

}  // namespace cairn::python
