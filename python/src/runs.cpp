/// Runs of scenes, and checkpoints of them.
#include "owner.h"
#include "parts.h"
#include "record.h"

namespace cairn::python {

namespace {

PyRun runOf(SceneRun run) {
    return {std::make_shared<Owner>(std::move(run))};
}

PyRun restoredRun(const py::buffer& snapshot, const std::string& source) {
    const py::bytes copy = contiguous(snapshot);
    return runOf(SceneRun::restore(bytesIn(copy), source));
}

PyRun newRun(const Scene& scene, const std::optional<Settings>& settings) {
    return runOf(SceneRun(scene, settings ? *settings : settingsFor(scene)));
}

Statistics simulationStep(const PyRun& self) {
    SceneRun& run = self.use();
    return self.owner->alone([&] { return run.simulationStep(); });
}

py::tuple hashedSimulationStep(const PyRun& self) {
    SceneRun& run = self.use();
    std::vector<std::uint64_t> hashes;
    const Statistics statistics = self.owner->alone([&] { return run.simulationStep(hashes); });
    return py::make_tuple(statistics, py::tuple(py::cast(hashes)));
}

void setDuration(const PyRun& self, double seconds) {
    if (!(seconds > 0)) throw InputError("duration is " + std::to_string(seconds) + " s; it must be above 0");
    self.use().setDuration(seconds);
}

}  // namespace

void bindRuns(py::module_& module) {
    py::class_<PyRun>(module, "SceneRun", "A scene in a world, with its events.")
        .def(py::init(&newRun), py::arg("scene"), py::arg("settings") = py::none(),
             "settings: those of settings_for(scene) if None. Raises InputError.")
        .def_property_readonly(
            "world", [](const PyRun& self) { return PyWorld{self.owner}; }, "May be changed between steps.")
        .def_property_readonly(
            "scene", [](const PyRun& self) { return self.use().scene(); }, "As it was given.")
        .def("set_duration", &setDuration, py::arg("seconds"), "Changes when the run is over [s], > 0.")
        .def_property_readonly(
            "ids", [](const PyRun& self) { return py::tuple(py::cast(self.use().ids())); },
            "Ids of the scene's bodies, by index; stale once removed.")
        .def(
            "step",
            [](const PyRun& self, std::int64_t steps) {
                SceneRun& run = self.use();
                stepOften(*self.owner, steps, [&] { run.step(); });
            },
            py::arg("steps") = 1, "So many times: applies the events that are due, then steps the world.")
        .def("simulation_step", &simulationStep,
             "One simulation step of 1/30 s; returns the sum of the statistics of its time steps.")
        .def("hashed_simulation_step", &hashedSimulationStep,
             "The same, and World.state_hash() after each of its time steps.")
        .def_property_readonly(
            "steps_per_simulation_step", [](const PyRun& self) { return self.use().stepsPerSimulationStep(); },
            "Time steps of one simulation step.")
        .def(
            "save", [](const PyRun& self) { return bytesOf(self.use().save()); },
            "The run as it is: scene, world, ids and the events that are still to come.")
        .def_static("restore", &restoredRun, py::arg("snapshot"), py::arg("source") = "snapshot",
                    "A run as it was saved; source is shown in messages. Raises InputError.")
        .def(py::pickle([](const PyRun& self) { return bytesOf(self.use().save()); },
                        [](const py::bytes& snapshot) { return restoredRun(snapshot, "pickle"); }))
        .def("__repr__", [](const PyRun& self) {
            return "<cairn.SceneRun of '" + self.use().scene().name + "' at " +
                   std::to_string(self.use().world().time()) + " s>";
        });
    module.def(
        "write_checkpoint",
        [](const PyRun& run, const std::filesystem::path& file) { writeCheckpoint(run.use(), file); }, py::arg("run"),
        py::arg("file"), "Writes a run to a file, which is complete whatever happens. Raises IoError.");
    module.def(
        "read_checkpoint", [](const std::filesystem::path& file) { return runOf(readCheckpoint(file)); },
        py::arg("file"), "Raises IoError if it cannot be read, InputError if it is damaged.");
}

}  // namespace cairn::python
