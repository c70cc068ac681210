#include <fmt/format.h>

#include <array>
#include <initializer_list>
#include <optional>

#include "cairn/recording.h"
#include "record/attributes.h"
#include "record/part_series.h"
#include "record/recording_file.h"

namespace cairn {

namespace {

void requireEven(std::initializer_list<std::size_t> sizes, const char* what) {
    for (const std::size_t size : sizes) {
        if (size == *sizes.begin()) continue;
        throw InputError(
            fmt::format("the part of a frame has {} and {} entries of its {}; it needs as many of each "
                        "kind, as captureFramePart() takes them",
                        *sizes.begin(), size, what));
    }
}

}  // namespace

std::filesystem::path recordingPart(const std::filesystem::path& file, std::size_t rank) {
    std::filesystem::path part = file;
    part.replace_filename(fmt::format("{}.rank{}{}", file.stem().string(), rank, file.extension().string()));
    return part;
}

struct RecordingPartWriter::Impl {
    Impl(const std::filesystem::path& named, std::size_t rank, const RecordingOptions& options)
        : path(recordingPart(named, rank)), driver(path), file(hdf5::createFile(path, driver, writes)) {
        hdf5::requireWritten(writes, path, "cannot be created");
        hdf5::writeAttribute(file.get(), path, layout::format_attribute, std::string(layout::part_format_name));
        hdf5::writeAttribute(file.get(), path, layout::format_version_attribute, layout::format_version);
        hdf5::writeAttribute(file.get(), path, layout::rank_attribute, static_cast<std::int64_t>(rank));
        hdf5::writeAttribute(file.get(), path, layout::mark_attribute, static_cast<std::int64_t>(options.mark));
        hdf5::createGroup(file, path, layout::frames);
        if (options.contacts) hdf5::createGroup(file, path, layout::contacts);
        if (options.joints) hdf5::createGroup(file, path, layout::joints);
        series.emplace(file, path, options.contacts, options.joints);
        hdf5::checked(H5Fstart_swmr_write(file.get()), path, "cannot be made readable while it is written");
        hdf5::requireWritten(writes, path, "cannot be written");
    }

    ~Impl() {
        const hdf5::QuietErrors quiet;
        series.reset();
        file.close();
    }

    /// Appends rows to series, and where they end. @param rows so far
    template <class Rows, class ForEach>
    void appendRows(Rows& rows, hsize_t& end, std::size_t count, const ForEach& forEach) {
        forEach([&](hdf5::SeriesWriter& one, const auto& values) { one.appendRows(end, count, values.data()); });
        end += count;
        const auto last = static_cast<std::int64_t>(end);
        rows.end.append(frames, &last);
    }

    void write(const FramePart& part) {
        std::vector<std::array<double, 4>> quaternions;
        for (const Quat& q : part.orientation) quaternions.push_back({q.w(), q.x(), q.y(), q.z()});
        appendRows(series->bodies, body_rows, part.body.size(),
                   [&](const auto& append) { series->bodies.forEachOfRows(part, quaternions, append); });
        if (series->contacts) {
            appendRows(*series->contacts, contact_rows, part.contact_a.size(),
                       [&](const auto& append) { series->contacts->forEachOfRows(part, append); });
        }
        if (series->joints) {
            appendRows(*series->joints, joint_rows, part.joint.size(),
                       [&](const auto& append) { series->joints->forEachOfRows(part, append); });
        }
        hdf5::checked(H5Fflush(file.get(), H5F_SCOPE_LOCAL), path, "cannot be written");
        series->time.append(frames, &part.time);
        hdf5::checked(H5Fflush(file.get(), H5F_SCOPE_LOCAL), path, "cannot be written");
        hdf5::requireWritten(writes, path, "cannot be written");
        ++frames;
    }

    std::filesystem::path path;
    hdf5::WriteState writes;
    hdf5::FileDriver driver;
    hdf5::File file;
    std::optional<hdf5::PartSeries<hdf5::SeriesWriter>> series;
    hsize_t body_rows = 0, contact_rows = 0, joint_rows = 0;  ///< of all frames so far
    hsize_t frames = 0;
    bool failed = false;
};

RecordingPartWriter::RecordingPartWriter(const std::filesystem::path& file, std::size_t rank,
                                         const RecordingOptions& options) {
    const hdf5::QuietErrors quiet;
    // cppcheck-suppress useInitializationList ; the errors must be quiet before
    impl_ = std::make_unique<Impl>(file, rank, options);
}

RecordingPartWriter::~RecordingPartWriter() = default;

void RecordingPartWriter::append(const FramePart& frame) {
    requireEven({frame.body.size(), frame.position.size(), frame.orientation.size(), frame.linear_velocity.size(),
                 frame.angular_velocity.size(), frame.asleep.size()},
                "bodies");
    requireEven({frame.contact_a.size(), frame.contact_b.size(), frame.contact_point.size(),
                 frame.contact_normal.size(), frame.contact_distance.size(), frame.contact_impulse.size()},
                "contacts");
    requireEven({frame.joint.size(), frame.joint_point.size(), frame.joint_force.size(), frame.joint_torque.size()},
                "joints");
    Impl& impl = *impl_;
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

void RecordingPartWriter::close() {
    Impl& impl = *impl_;
    const hdf5::QuietErrors quiet;
    impl.series.reset();
    hdf5::checked(impl.file.close(), impl.path, "cannot be closed");
    if (!impl.failed) hdf5::requireWritten(impl.writes, impl.path, "cannot be written");
}

}  // namespace cairn
