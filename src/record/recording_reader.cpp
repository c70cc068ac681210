#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/recording.h"
#include "record/attributes.h"
#include "record/file_check.h"
#include "record/force_series.h"
#include "record/frame_series.h"
#include "record/part_reader.h"
#include "record/recorded_settings.h"
#include "record/recording_file.h"

namespace cairn {

namespace {

using hdf5::checked;

Scene readRecordedScene(const hdf5::File& file, const std::filesystem::path& path) {
    const std::string text = hdf5::readText(file, path, layout::scene);
    try {
        return parseScene(text, path.string() + ": scene");
    } catch (const InputError& error) {
        throw IoError(fmt::format("{}: is damaged: its scene is refused: {}", path.string(), error.what()));
    }
}

std::string textAttribute(const hdf5::File& file, const std::filesystem::path& path, const char* name) {
    const auto value = hdf5::readAttribute(file.get(), path, name);
    const auto* text = value ? std::get_if<std::string>(&*value) : nullptr;
    return text != nullptr ? *text : "unknown";
}

}  // namespace

struct RecordingReader::Impl {
    explicit Impl(const std::filesystem::path& file_path) : path(file_path) {
        const FileState state = checkFile(path);
        file = hdf5::openFile(path, state);
        hdf5::requireFormat(file, path, layout::format_name);
        info.scene = readRecordedScene(file, path);
        info.bodies = info.scene.bodies.size();
        info.version = textAttribute(file, path, layout::version_attribute);
        info.machine = textAttribute(file, path, layout::machine_attribute);
        info.settings = hdf5::readAttributes(
            hdf5::Group(H5Gopen2(file.get(), layout::settings, H5P_DEFAULT), path, "settings"), path);
        info.frame_rate = frameRate();
        series.emplace(file, path);
        info.parts = hdf5::numberAttribute(file, path, layout::parts_attribute);
        if (info.parts == 0) series->bodies.emplace(file, path, info.bodies);
        openHashes();
        if (H5Lexists(file.get(), layout::diagnostics, H5P_DEFAULT) > 0) {
            diagnostics = hdf5::diagnosticsSeries<hdf5::SeriesReader>(file, path);
        }
        openForces();
        const std::uint64_t mark = hdf5::numberAttribute(file, path, layout::mark_attribute);
        for (std::size_t rank = 0; rank < info.parts; ++rank) {
            parts.push_back(std::make_unique<PartReader>(path, rank, mark, info));
        }
        info.frames = countFrames();
        if (!state.closed) requireAllInFile();
        quaternions.resize(info.bodies);
    }

    ~Impl() {
        const hdf5::QuietErrors quiet;
        series.reset();
        diagnostics.clear();
        hashes.reset();
        contacts.reset();
        joints.reset();
        file.close();
    }

    double frameRate() const {
        const auto value = hdf5::readAttribute(file.get(), path, layout::rate_attribute);
        const auto* rate = value ? std::get_if<double>(&*value) : nullptr;
        if (rate != nullptr && *rate >= layout::least_frame_rate && std::isfinite(*rate)) return *rate;
        throw IoError(fmt::format("{}: is damaged: it has no frames_per_second in range", path.string()));
    }

    void openForces() {
        info.contacts = H5Lexists(file.get(), layout::contacts, H5P_DEFAULT) > 0;
        info.joints = H5Lexists(file.get(), layout::joints, H5P_DEFAULT) > 0;
        if (info.parts > 0) return;
        if (info.contacts) contacts.emplace(file, path);
        if (info.joints) joints.emplace(file, path, info.scene.joints.size());
    }

    void readBodies(hsize_t index, Frame& frame) const {
        series->bodies->position.read(index, frame.position.data());
        series->bodies->orientation.read(index, quaternions.data());
        series->bodies->linear_velocity.read(index, frame.linear_velocity.data());
        series->bodies->angular_velocity.read(index, frame.angular_velocity.data());
        series->bodies->asleep.read(index, frame.asleep.data());
        for (std::size_t i = 0; i < info.bodies; ++i) {
            const std::array<double, 4>& q = quaternions[i];
            frame.orientation[i] = Quat(q[0], q[1], q[2], q[3]);
        }
    }

    /// Of all frames up to one. @throws IoError if the file says nonsense
    hsize_t contactsUpTo(hsize_t frame) const {
        std::int64_t end = 0;
        contacts->end.read(frame, &end);
        if (end < 0) throw IoError(fmt::format("{}: is damaged: {} contacts", path.string(), end));
        return static_cast<hsize_t>(end);
    }

    void readForces(hsize_t index, Frame& frame) const {
        if (contacts) {
            const hsize_t begin = index == 0 ? 0 : contactsUpTo(index - 1);
            const hsize_t end = contactsUpTo(index);
            if (end < begin || end > contacts->a.frames()) {
                throw IoError(
                    fmt::format("{}: is damaged: the contacts of frame {} are not there", path.string(), index));
            }
            contacts->forEachOfRows(frame, [&](const hdf5::SeriesReader& rows, auto& values) {
                values.resize(end - begin);
                rows.readRows(begin, end - begin, values.data());
            });
        }
        if (joints) {
            joints->forEach(frame, [&](const hdf5::SeriesReader& rows, auto& values) {
                values.resize(info.scene.joints.size());
                rows.read(index, values.data());
            });
        }
    }

    /// Their number is that of the time steps in a frame.
    void openHashes() {
        if (H5Lexists(file.get(), layout::step_hashes, H5P_DEFAULT) <= 0) return;
        const Settings settings = settingsOf(info);
        const auto per_frame = static_cast<hsize_t>(std::lround(settings.steps_per_second / info.frame_rate));
        hashes.emplace(file, path, hdf5::stepHashes(per_frame));
        info.hashes_per_frame = per_frame;
    }

    /// Frames that were written to the end: those whose time, which is written last, is there.
    std::size_t countFrames() {
        std::vector<double> times(series->time.frames());
        series->time.readAll(times.data());
        const auto end = std::find_if(times.begin(), times.end(), [](double t) { return std::isnan(t); });
        auto frames = static_cast<hsize_t>(end - times.begin());
        series->forEachButTime([&](const hdf5::SeriesReader& s) { frames = std::min(frames, s.frames()); });
        for (const hdf5::SeriesReader& s : diagnostics) frames = std::min(frames, s.frames());
        if (hashes) frames = std::min(frames, hashes->frames());
        if (contacts) frames = std::min(frames, contacts->end.frames());
        if (joints)
            frames = std::min({frames, joints->point.frames(), joints->force.frames(), joints->torque.frames()});
        for (const auto& part : parts) frames = std::min<hsize_t>(frames, part->frames());
        return frames;
    }

    /// HDF5 does not compare the length of a file that was not closed with what it refers to.
    void requireAllInFile() {
        haddr_t end = 0;
        const auto visit = [&](const hdf5::SeriesReader& s) {
            for (hsize_t frame = 0; frame < info.frames; ++frame) end = std::max(end, s.endInFile(frame));
        };
        visit(series->time);
        series->forEachButTime(visit);
        for (const hdf5::SeriesReader& s : diagnostics) visit(s);
        Frame none;
        if (joints) joints->forEach(none, [&](const hdf5::SeriesReader& s, auto&) { visit(s); });
        if (contacts && info.frames > 0) {
            visit(contacts->end);
            const hsize_t rows = contactsUpTo(info.frames - 1);
            contacts->forEachOfRows(none, [&](const hdf5::SeriesReader& s, auto&) {
                for (hsize_t row = 0; row < std::min(rows, s.frames()); ++row) end = std::max(end, s.endInFile(row));
            });
        }
        requireLength(path, end);
    }
    void requireFrame(std::size_t index) const {
        if (index < info.frames) return;
        throw InputError(fmt::format("{}: there is no frame {}, the recording has {} frames, counted from 0",
                                     path.string(), index, info.frames));
    }

    std::filesystem::path path;
    hdf5::File file;
    RecordingInfo info;
    std::optional<hdf5::FrameSeries<hdf5::SeriesReader>> series;
    std::vector<hdf5::SeriesReader> diagnostics;  ///< empty if it was recorded without
    std::optional<hdf5::SeriesReader> hashes;
    std::optional<hdf5::ContactSeries<hdf5::SeriesReader>> contacts;
    std::optional<hdf5::JointSeries<hdf5::SeriesReader>> joints;
    std::vector<std::unique_ptr<PartReader>> parts;
    mutable std::vector<std::array<double, 4>> quaternions;  ///< w, x, y, z
};

RecordingReader::RecordingReader(const std::filesystem::path& file) {
    const hdf5::QuietErrors quiet;
    // cppcheck-suppress useInitializationList ; the errors must be quiet before
    impl_ = std::make_unique<Impl>(file);
}

RecordingReader::~RecordingReader() = default;
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;

const RecordingInfo& RecordingReader::info() const {
    return impl_->info;
}

Frame RecordingReader::framePart(std::size_t index, std::size_t part) const {
    impl_->requireFrame(index);
    if (part >= impl_->parts.size()) {
        throw InputError(fmt::format("{}: there is no part {}, the recording has {} parts, counted from 0",
                                     impl_->path.string(), part, impl_->parts.size()));
    }
    const hdf5::QuietErrors quiet;
    Frame frame = emptyFrame(impl_->info);
    impl_->series->time.read(index, &frame.time);
    impl_->parts[part]->read(index, frame);
    return frame;
}

Frame RecordingReader::frame(std::size_t index) const {
    const Impl& impl = *impl_;
    impl.requireFrame(index);
    const hdf5::QuietErrors quiet;
    const auto& series = *impl.series;
    Frame frame = emptyFrame(impl.info);
    series.time.read(index, &frame.time);
    if (series.bodies) impl.readBodies(index, frame);
    series.kinetic_energy.read(index, &frame.kinetic_energy);
    series.potential_energy.read(index, &frame.potential_energy);
    series.stage_ms.read(index, frame.statistics.stage_ms.data());
    for (std::size_t i = 0; i < layout::counters.size(); ++i) {
        series.counters[i].read(index, &(frame.statistics.*layout::counters[i].member));
    }
    for (std::size_t i = 0; i < layout::overlaps.size(); ++i) {
        series.overlaps[i].read(index, &(frame.statistics.*layout::overlaps[i].member));
    }
    for (std::size_t i = 0; i < impl.diagnostics.size(); ++i) {
        impl.diagnostics[i].read(index, &diagnosticsFields()[i].of(frame.statistics.diagnostics));
    }
    if (impl.hashes) {
        frame.step_hashes.resize(impl.info.hashes_per_frame);
        impl.hashes->read(index, frame.step_hashes.data());
    }
    for (const auto& part : impl.parts) part->read(index, frame);
    if (!impl.parts.empty()) sortContacts(frame);
    impl.readForces(index, frame);
    return frame;
}

}  // namespace cairn
