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
    frame.field("statistics", &Frame::statistics, "Of the time steps since the last frame.")
        .field("kinetic_energy", &Frame::kinetic_energy, "[J]")
        .field("potential_energy", &Frame::potential_energy, "[J]");
    rowsField(frame, "step_hashes", &Frame::step_hashes, &numbersFrom<std::uint64_t>,
              "World.state_hash() after each time step since the last frame; empty = not recorded.");
    rowsField(
        frame, "contact_a", &Frame::contact_a, &numbersFrom<std::int64_t>,
        "Of contacts after the last time step: indices in Scene.bodies, shape (contacts,); empty = not recorded.");
    rowsField(frame, "contact_b", &Frame::contact_b, &numbersFrom<std::int64_t>,
              "Indices in Scene.bodies, shape (contacts,).");
    rowsField(frame, "contact_point", &Frame::contact_point, &vectorsFrom, "[m, W], shape (contacts, 3).");
    rowsField(frame, "contact_normal", &Frame::contact_normal, &vectorsFrom,
              "Unit, from B to A, W, shape (contacts, 3).");
    rowsField(frame, "contact_distance", &Frame::contact_distance, &numbersFrom<double>,
              "Along the normal [m], negative = overlap, shape (contacts,).");
    rowsField(frame, "contact_impulse", &Frame::contact_impulse, &vectorsFrom,
              "That A received in the last time step [N s, W], shape (contacts, 3).");
    rowsField(frame, "joint_point", &Frame::joint_point, &vectorsFrom,
              "Where A is joined [m, W], shape (joints, 3), NaN once it broke; empty = not recorded.");
    rowsField(frame, "joint_force", &Frame::joint_force, &vectorsFrom,
              "That A received there, mean over the last time step [N, W], shape (joints, 3).");
    rowsField(frame, "joint_torque", &Frame::joint_torque, &vectorsFrom,
              "That A received besides [N m, W], shape (joints, 3).");
    frame.finish(1);
    Record<RecordingOptions>(module, "RecordingOptions",
                             "What is recorded besides the state of the bodies, and how often.")
        .field("hashes_per_frame", &RecordingOptions::hashes_per_frame,
               "Entries of Frame.step_hashes, so that each can be verified; 0 = none.")
        .field("frame_rate", &RecordingOptions::frame_rate,
               "Frames per simulated second, at least 0.001, at most one per time step.")
        .field("contacts", &RecordingOptions::contacts, "Contacts with their impulses.")
        .field("joints", &RecordingOptions::joints, "Forces of joints.")
        .finish();
    module.def(
        "is_frame_due", [](const PyRun& run, double frame_rate) { return isFrameDue(run.use(), frame_rate); },
        py::arg("run"), py::arg("frame_rate"),
        "Whether a frame is to be taken after the last time step: the first at or after a multiple of 1/frame_rate.");
    module.def(
        "capture_frame",
        [](const PyRun& run, const std::optional<Statistics>& statistics, const RecordingOptions& what) {
            return captureFrame(run.use(), statistics.value_or(Statistics{}), what);
        },
        py::arg("run"), py::arg("statistics") = py::none(), py::arg("what") = RecordingOptions{},
        "The present state of a run. statistics: of the time steps since the last frame. what: besides the bodies.");
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
        .field("frame_rate", &RecordingInfo::frame_rate, "Frames per simulated second [1/s].")
        .field("contacts", &RecordingInfo::contacts, "Whether frames have contacts.")
        .field("joints", &RecordingInfo::joints, "Whether frames have the forces of joints.")
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
        .def(py::init<const std::filesystem::path&, const Scene&, const Settings&, const RecordingOptions&>(),
             py::arg("file"), py::arg("scene"), py::arg("settings"), py::arg("options") = RecordingOptions{},
             "Raises InputError for a frame rate out of range, IoError.")
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
