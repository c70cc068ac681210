/// Recordings: frames, written and read.
#include "arrays.h"
#include "owner.h"
#include "parts.h"
#include "record.h"

namespace cairn::python {

namespace {

/// A field of a frame with one row per body.
template <class Element, class Read>
void rowsField(Record<Frame>& frame, const char* name, std::vector<Element> Frame::*member, Read read,
               const char* doc) {
    frame.fieldBy(
        name, [member](const Frame& self) -> py::object { return readOnly(copied(self.*member)); },
        [member, read, name](Frame& self, py::handle value) { self.*member = read(value, name); }, doc);
}

void bindFrame(py::module_& module) {
    Record<Frame> frame(module, "Frame",
                        "The state of all bodies at one moment; arrays have one row per body of the scene.");
    frame.field("time", &Frame::time, "[s]");
    rowsField(frame, "position", &Frame::position, &vectorsFrom,
              "[m, W], shape (bodies, 3); NaN once the body was removed.");
    rowsField(frame, "orientation", &Frame::orientation, &quaternionsFrom,
              "B to W: quaternions (w, x, y, z), shape (bodies, 4).");
    rowsField(frame, "linear_velocity", &Frame::linear_velocity, &vectorsFrom, "[m/s, W], shape (bodies, 3).");
    rowsField(frame, "angular_velocity", &Frame::angular_velocity, &vectorsFrom, "[rad/s, W], shape (bodies, 3).");
    rowsField(frame, "asleep", &Frame::asleep, &numbersFrom<std::uint8_t>, "1 = asleep, shape (bodies,).");
    frame.field("statistics", &Frame::statistics, "Of the simulation step that led here.")
        .field("kinetic_energy", &Frame::kinetic_energy, "[J]")
        .field("potential_energy", &Frame::potential_energy, "[J]");
    rowsField(frame, "step_hashes", &Frame::step_hashes, &numbersFrom<std::uint64_t>,
              "World.state_hash() after each time step of the simulation step; empty = not recorded.");
    frame.finish(1);
    module.def(
        "capture_frame",
        [](const PyRun& run, const std::optional<Statistics>& statistics) {
            return captureFrame(run.use(), statistics.value_or(Statistics{}));
        },
        py::arg("run"), py::arg("statistics") = py::none(),
        "The present state of a run. statistics: of the simulation step that led here.");
}

void bindInfo(py::module_& module) {
    Record<RecordingInfo>(module, "RecordingInfo", "What stands in a recording apart from its frames.")
        .field("scene", &RecordingInfo::scene, "As it was run.")
        .field("settings", &RecordingInfo::settings, "Field and value as text.")
        .field("version", &RecordingInfo::version, "Of Cairn.")
        .field("machine", &RecordingInfo::machine, "Processor and operating system.")
        .field("frames", &RecordingInfo::frames, "How many.")
        .field("bodies", &RecordingInfo::bodies, "How many, of the scene.")
        .field("hashes_per_frame", &RecordingInfo::hashes_per_frame, "0 = recorded without hashes.")
        .finish();
    Record<RecordingDifference>(module, "RecordingDifference", "Where a simulation left its recording.")
        .field("step", &RecordingDifference::step, "The first time step that differs.")
        .field("body", &RecordingDifference::body, "The first body of the scene that differs then, if one does.")
        .field("what", &RecordingDifference::what, "What was recorded and what came out now.")
        .finish();
}

void bindWriter(py::module_& module) {
    using Writer = RecordingWriter;
    py::class_<Writer>(module, "RecordingWriter",
                       "Writes a recording; what was appended can be read while it is written and after a crash.")
        .def(py::init<const std::filesystem::path&, const Scene&, const Settings&, std::size_t>(), py::arg("file"),
             py::arg("scene"), py::arg("settings"), py::arg("hashes_per_frame") = 0, "Raises IoError.")
        .def("append", &Writer::append, py::arg("frame"), "Raises IoError; frames before it stay readable.")
        .def("close", &Writer::close, "Writes what is left and closes. Raises IoError.")
        .def("__enter__", [](const py::object& self) { return self; })
        .def("__exit__", [](Writer& self, const py::args& /*error*/) { self.close(); });
}

void bindReader(py::module_& module) {
    using Reader = RecordingReader;
    py::class_<Reader>(module, "RecordingReader", "Reads a recording.")
        .def(py::init<const std::filesystem::path&>(), py::arg("file"),
             "Raises IoError if it is missing, truncated or not a recording.")
        .def_property_readonly("info", &Reader::info, "Read once, when the file is opened.")
        .def("frame", &Reader::frame, py::arg("index"), "0 (the initial state) to info.frames - 1. Raises InputError.");
    module.def("verify_recording", &verifyRecording, py::arg("recording"), py::arg("threads") = 1,
               "Simulates again and compares bit by bit. Returns the first difference, or None. Raises InputError.");
    module.def("export_csv", &exportCsv, py::arg("recording"), py::arg("file"), "One row per frame and body.");
    module.def("export_vtk", &exportVtk, py::arg("recording"), py::arg("file"), "A ParaView time series.");
}

}  // namespace

void bindRecordings(py::module_& module) {
    bindFrame(module);
    bindInfo(module);
    bindWriter(module);
    bindReader(module);
}

}  // namespace cairn::python
