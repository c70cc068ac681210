#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <optional>

#include "cairn/recording.h"
#include "cairn/version.h"
#include "record/attributes.h"
#include "record/force_series.h"
#include "record/frame_series.h"
#include "record/machine.h"
#include "record/recording_file.h"
#include "scene/scene_survey.h"

namespace cairn {

namespace {

using hdf5::checked;

std::string stageNames() {
    return std::accumulate(
        stage_names.begin() + 1, stage_names.end(), std::string(stage_names[0]),
        [](std::string all, std::string_view name) { return std::move(all) + ',' + std::string(name); });
}

void writeMetadata(const hdf5::File& file, const std::filesystem::path& path, const SceneSource& source,
                   const Settings& settings, double frame_rate) {
    hdf5::writeAttribute(file.get(), path, layout::format_attribute, std::string(layout::format_name));
    hdf5::writeAttribute(file.get(), path, layout::format_version_attribute, layout::format_version);
    hdf5::writeAttribute(file.get(), path, layout::version_attribute, std::string(version));
    hdf5::writeAttribute(file.get(), path, layout::machine_attribute, describeMachine());
    hdf5::writeAttribute(file.get(), path, layout::rate_attribute, frame_rate);
    hdf5::writeText(file, path, layout::scene, formatScene(source));
    const hdf5::Group fields = hdf5::createGroup(file, path, layout::settings);
    for (const SettingField& field : settingFields()) {
        hdf5::writeAttribute(fields.get(), path, std::string(field.name).c_str(), field.get(settings));
    }
    hdf5::createGroup(file, path, layout::frames);
    const hdf5::Group statistics = hdf5::createGroup(file, path, layout::statistics);
    hdf5::writeAttribute(statistics.get(), path, layout::stages_attribute, stageNames());
}

void refuseWrongSize(std::size_t size, std::size_t bodies, const char* what) {
    if (size != bodies) {
        throw InputError(
            fmt::format("the frame has {} entries in {}, but the recorded scene has {} bodies", size, what, bodies));
    }
}

/// What belongs to contacts or joints must have one entry of each kind for each.
void refuseUneven(std::initializer_list<std::size_t> sizes, std::size_t expected, const char* what) {
    for (const std::size_t size : sizes) {
        if (size == expected) continue;
        throw InputError(
            fmt::format("the frame has {} and {} entries of its {}; it needs as many of each kind, as "
                        "captureFrame() takes them with the options of the recording",
                        expected, size, what));
    }
}

void validate(const RecordingOptions& options, const Settings& settings) {
    const double steps = settings.steps_per_second;
    const double rate = options.frame_rate;
    if (!(rate >= layout::least_frame_rate && rate <= steps * (1 + 1e-9))) {
        throw InputError(
            fmt::format("the frame rate is {}; it must be at least {} and at most the {} time steps per second", rate,
                        layout::least_frame_rate, steps));
    }
    if (options.hashes_per_frame == 0) return;
    if (std::abs(static_cast<double>(options.hashes_per_frame) * rate - steps) > 1e-9 * steps) {
        throw InputError(
            fmt::format("the frame rate is {}; with hashes every frame needs the same whole number of the {} "
                        "time steps per second, so take a rate that divides them",
                        rate, steps));
    }
}

}  // namespace

struct RecordingWriter::Impl {
    Impl(const std::filesystem::path& file_path, const SceneSource& source, const Settings& settings,
         const RecordingOptions& options)
        : path(file_path),
          bodies(options.parts == 0 ? source.survey().bodies : 0),
          joint_count(options.joints && options.parts == 0 ? source.scene().joints.size() : 0),
          hash_row(options.hashes_per_frame),
          driver(path),
          file(hdf5::createFile(path, driver, writes)),
          in_parts(options.parts > 0) {
        requireWritten(file ? "cannot be written" : "cannot be created");
        writeMetadata(file, path, source, settings, options.frame_rate);
        series.emplace(file, path);
        if (in_parts) {
            hdf5::writeAttribute(file.get(), path, layout::parts_attribute, static_cast<std::int64_t>(options.parts));
            hdf5::writeAttribute(file.get(), path, layout::mark_attribute, static_cast<std::int64_t>(options.mark));
            // Whether the parts have contacts and joints must be known without them.
            if (options.contacts) hdf5::createGroup(file, path, layout::contacts);
            if (options.joints) hdf5::createGroup(file, path, layout::joints);
        } else {
            series->bodies.emplace(file, path, bodies);
        }
        if (settings.diagnostics.diagnostics) {
            hdf5::createGroup(file, path, layout::diagnostics);
            diagnostics = hdf5::diagnosticsSeries<hdf5::SeriesWriter>(file, path);
        }
        if (!hash_row.empty()) hashes.emplace(file, path, hdf5::stepHashes(hash_row.size()));
        if (options.contacts && !in_parts) {
            hdf5::createGroup(file, path, layout::contacts);
            contacts.emplace(file, path);
        }
        if (options.joints && !in_parts) {
            hdf5::createGroup(file, path, layout::joints);
            joints.emplace(file, path, source.scene().joints.size());
        }
        checked(H5Fstart_swmr_write(file.get()), path, "cannot be made readable while it is written");
        requireWritten("cannot be written");
        quaternions.resize(bodies);
    }

    ~Impl() {
        const hdf5::QuietErrors quiet;
        closeSeries();
        file.close();
    }

    void closeSeries() {
        series.reset();
        diagnostics.clear();
        hashes.reset();
        contacts.reset();
        joints.reset();
    }

    void writeForces(const Frame& frame) {
        if (contacts) {
            const hsize_t count = frame.contact_a.size();
            contacts->forEachOfRows(frame, [&](hdf5::SeriesWriter& rows, const auto& values) {
                rows.appendRows(contact_rows, count, values.data());
            });
            contact_rows += count;
            const auto end = static_cast<std::int64_t>(contact_rows);
            contacts->end.append(frames, &end);
        }
        if (joints) {
            joints->forEach(frame,
                            [&](hdf5::SeriesWriter& rows, const auto& values) { rows.append(frames, values.data()); });
        }
    }

    void writeBodies(const Frame& frame) {
        for (std::size_t i = 0; i < bodies; ++i) {
            const Quat& q = frame.orientation[i];
            quaternions[i] = {q.w(), q.x(), q.y(), q.z()};
        }
        series->bodies->position.append(frames, frame.position.data());
        series->bodies->orientation.append(frames, quaternions.data());
        series->bodies->linear_velocity.append(frames, frame.linear_velocity.data());
        series->bodies->angular_velocity.append(frames, frame.angular_velocity.data());
        series->bodies->asleep.append(frames, frame.asleep.data());
    }

    void write(const Frame& frame) {
        if (series->bodies) writeBodies(frame);
        series->kinetic_energy.append(frames, &frame.kinetic_energy);
        series->potential_energy.append(frames, &frame.potential_energy);
        series->stage_ms.append(frames, frame.statistics.stage_ms.data());
        for (std::size_t i = 0; i < layout::counters.size(); ++i) {
            series->counters[i].append(frames, &(frame.statistics.*layout::counters[i].member));
        }
        for (std::size_t i = 0; i < layout::overlaps.size(); ++i) {
            series->overlaps[i].append(frames, &(frame.statistics.*layout::overlaps[i].member));
        }
        Diagnostics measured = frame.statistics.diagnostics;
        for (std::size_t i = 0; i < diagnostics.size(); ++i) {
            diagnostics[i].append(frames, &diagnosticsFields()[i].of(measured));
        }
        if (hashes) {
            // The initial state has no time step behind it.
            std::copy(frame.step_hashes.begin(), frame.step_hashes.end(), hash_row.begin());
            hashes->append(frames, hash_row.data());
        }
        writeForces(frame);
        checked(H5Fflush(file.get(), H5F_SCOPE_LOCAL), path, "cannot be written");
        series->time.append(frames, &frame.time);
        checked(H5Fflush(file.get(), H5F_SCOPE_LOCAL), path, "cannot be written");
        requireWritten("cannot be written");
        ++frames;
    }

    void requireWritten(std::string_view what) const { hdf5::requireWritten(writes, path, what); }

    std::filesystem::path path;
    std::size_t bodies;                   ///< recorded here
    std::size_t joint_count;              ///< recorded
    std::vector<std::uint64_t> hash_row;  ///< [hashes per frame]
    hdf5::WriteState writes;
    hdf5::FileDriver driver;
    hdf5::File file;
    bool in_parts;
    std::optional<hdf5::FrameSeries<hdf5::SeriesWriter>> series;
    std::vector<hdf5::SeriesWriter> diagnostics;  ///< empty without the setting
    std::optional<hdf5::SeriesWriter> hashes;
    std::optional<hdf5::ContactSeries<hdf5::SeriesWriter>> contacts;
    std::optional<hdf5::JointSeries<hdf5::SeriesWriter>> joints;
    hsize_t contact_rows = 0;                        ///< of all frames so far
    std::vector<std::array<double, 4>> quaternions;  ///< w, x, y, z
    hsize_t frames = 0;
    bool failed = false;
};

RecordingWriter::RecordingWriter(const std::filesystem::path& file, const SceneSource& source, const Settings& settings,
                                 const RecordingOptions& options) {
    validate(options, settings);
    const hdf5::QuietErrors quiet;
    // cppcheck-suppress useInitializationList ; the errors must be quiet before
    impl_ = std::make_unique<Impl>(file, source, settings, options);
}

RecordingWriter::~RecordingWriter() = default;

void RecordingWriter::append(const Frame& frame) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double), "rows of vectors are written as they are");
    Impl& impl = *impl_;
    refuseWrongSize(frame.position.size(), impl.bodies, "position");
    refuseWrongSize(frame.orientation.size(), impl.bodies, "orientation");
    refuseWrongSize(frame.linear_velocity.size(), impl.bodies, "linear_velocity");
    refuseWrongSize(frame.angular_velocity.size(), impl.bodies, "angular_velocity");
    refuseWrongSize(frame.asleep.size(), impl.bodies, "asleep");
    const std::size_t contacts = impl.contacts ? frame.contact_a.size() : 0;
    refuseUneven({frame.contact_a.size(), frame.contact_b.size(), frame.contact_point.size(),
                  frame.contact_normal.size(), frame.contact_distance.size(), frame.contact_impulse.size()},
                 contacts, "contacts");
    refuseUneven({frame.joint_point.size(), frame.joint_force.size(), frame.joint_torque.size()}, impl.joint_count,
                 "joints");
    if (!frame.step_hashes.empty() && frame.step_hashes.size() != impl.hash_row.size()) {
        throw InputError(fmt::format("the frame has {} step_hashes, but the recording was begun for {}",
                                     frame.step_hashes.size(), impl.hash_row.size()));
    }
    if (!impl.file) throw InputError(fmt::format("{}: the recording is closed", impl.path.string()));
    if (impl.failed) throw IoError(fmt::format("{}: not written, as an earlier frame failed", impl.path.string()));
    const hdf5::QuietErrors quiet;
    try {
        impl.write(frame);
    } catch (const IoError&) {
        impl.failed = true;
        throw;
    }
}

void RecordingWriter::close() {
    Impl& impl = *impl_;
    const hdf5::QuietErrors quiet;
    impl.closeSeries();
    checked(impl.file.close(), impl.path, "cannot be closed");
    if (!impl.failed) impl.requireWritten("cannot be written");
}

}  // namespace cairn
