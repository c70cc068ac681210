#include "record/part_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "record/attributes.h"
#include "record/file_check.h"
#include "record/layout.h"
#include "record/part_series.h"
#include "record/recording_file.h"

namespace cairn {

namespace {

/// Rows of which at least one is in every chunk.
constexpr hsize_t rows_apart = 1024;

template <class List>
void permute(List& list, const std::vector<std::size_t>& order) {
    List sorted;
    sorted.reserve(list.size());
    for (const std::size_t i : order) sorted.push_back(list[i]);
    list.swap(sorted);
}

}  // namespace

Frame emptyFrame(const RecordingInfo& info) {
    Frame frame;
    frame.position.assign(info.bodies, layout::nowhere);
    frame.orientation.assign(info.bodies, Quat::Identity());
    frame.linear_velocity.assign(info.bodies, Vec3::Zero());
    frame.angular_velocity.assign(info.bodies, Vec3::Zero());
    frame.asleep.assign(info.bodies, 0);
    if (!info.joints) return frame;
    for (auto* values : {&frame.joint_point, &frame.joint_force, &frame.joint_torque}) {
        values->assign(info.scene.joints.size(), layout::nowhere);
    }
    return frame;
}

void sortContacts(Frame& frame) {
    std::vector<std::size_t> order(frame.contact_a.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // The bodies of a scene have ascending slots, and those of a pair all come from one rank.
    std::ranges::stable_sort(order, {},
                             [&](std::size_t i) { return std::tuple(frame.contact_a[i], frame.contact_b[i]); });
    permute(frame.contact_a, order);
    permute(frame.contact_b, order);
    permute(frame.contact_point, order);
    permute(frame.contact_normal, order);
    permute(frame.contact_distance, order);
    permute(frame.contact_impulse, order);
}

struct PartReader::Impl {
    Impl(const std::filesystem::path& named, std::size_t rank, std::uint64_t mark, const RecordingInfo& info)
        : path(recordingPart(named, rank)), bodies(info.bodies), joints(info.scene.joints.size()) {
        const FileState state = openAs(named);
        hdf5::requireFormat(file, path, layout::part_format_name);
        if (hdf5::numberAttribute(file, path, layout::mark_attribute) != mark ||
            hdf5::numberAttribute(file, path, layout::rank_attribute) != rank) {
            throw IoError(
                fmt::format("{}: is a part of another recording than {}; keep the files of one recording "
                            "together",
                            path.string(), named.string()));
        }
        series.emplace(file, path, info.contacts, info.joints);
        countFrames();
        if (!state.closed) requireAllInFile();
    }

    ~Impl() {
        const hdf5::QuietErrors quiet;
        series.reset();
        file.close();
    }

    FileState openAs(const std::filesystem::path& named) {
        try {
            const FileState state = checkFile(path);
            file = hdf5::openFile(path, state);
            return state;
        } catch (const IoError& error) {
            throw IoError(fmt::format("{}; it is a part of the recording {}", error.what(), named.string()));
        }
    }

    void countFrames() {
        std::vector<double> times(series->time.frames());
        series->time.readAll(times.data());
        const auto end = std::ranges::find_if(times, [](double t) { return std::isnan(t); });
        frames = std::min(static_cast<hsize_t>(end - times.begin()), series->bodies.end.frames());
        if (series->contacts) frames = std::min(frames, series->contacts->end.frames());
        if (series->joints) frames = std::min(frames, series->joints->end.frames());
    }

    /// Rows of the frames up to one.
    hsize_t rowsUpTo(const hdf5::SeriesReader& end, hsize_t frame) const {
        std::int64_t rows = 0;
        end.read(frame, &rows);
        if (rows < 0) throw IoError(fmt::format("{}: is damaged: {} rows", path.string(), rows));
        return static_cast<hsize_t>(rows);
    }

    /// Calls visit(first, count) for the rows of a frame.
    template <class Visit>
    void forRows(const hdf5::SeriesReader& end, hsize_t rows, hsize_t frame, const Visit& visit) const {
        const hsize_t first = frame == 0 ? 0 : rowsUpTo(end, frame - 1);
        const hsize_t last = rowsUpTo(end, frame);
        if (last < first || last > rows) {
            throw IoError(fmt::format("{}: is damaged: rows of frame {} are not there", path.string(), frame));
        }
        visit(first, last - first);
    }

    auto reader(hsize_t first, hsize_t count) const {
        return [first, count](const hdf5::SeriesReader& rows, auto& values) {
            values.resize(count);
            rows.readRows(first, count, values.data());
        };
    }

    /// HDF5 does not compare the length of a file that was not closed with what it refers to.
    void requireAllInFile() const {
        haddr_t last = 0;
        const auto visit = [&](const hdf5::SeriesReader& rows, auto&) {
            for (hsize_t row = 0; row < rows.frames(); row += rows_apart) last = std::max(last, rows.endInFile(row));
        };
        FramePart none;
        std::vector<std::array<double, 4>> quaternions;
        visit(series->time, none);
        visit(series->bodies.end, none);
        series->bodies.forEachOfRows(none, quaternions, visit);
        if (series->contacts) series->contacts->forEachOfRows(none, visit);
        if (series->joints) series->joints->forEachOfRows(none, visit);
        requireLength(path, last);
    }

    std::size_t indexIn(std::int64_t index, std::size_t count, std::string_view what) const {
        if (index >= 0 && static_cast<std::uint64_t>(index) < count) return static_cast<std::size_t>(index);
        throw IoError(fmt::format("{}: is damaged: it names {} {} of {}", path.string(), what, index, count));
    }

    void readBodies(hsize_t index, FramePart& part, Frame& frame) const {
        std::vector<std::array<double, 4>> quaternions;
        forRows(series->bodies.end, series->bodies.body.frames(), index, [&](hsize_t first, hsize_t count) {
            series->bodies.forEachOfRows(part, quaternions, reader(first, count));
        });
        for (std::size_t n = 0; n < part.body.size(); ++n) {
            const std::size_t i = indexIn(part.body[n], bodies, "body");
            const std::array<double, 4>& q = quaternions[n];
            frame.position[i] = part.position[n];
            frame.orientation[i] = Quat(q[0], q[1], q[2], q[3]);
            frame.linear_velocity[i] = part.linear_velocity[n];
            frame.angular_velocity[i] = part.angular_velocity[n];
            frame.asleep[i] = part.asleep[n];
        }
    }

    void readForces(hsize_t index, FramePart& part, Frame& frame) const {
        const auto addAll = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
        if (series->contacts) {
            forRows(series->contacts->end, series->contacts->a.frames(), index,
                    [&](hsize_t first, hsize_t count) { series->contacts->forEachOfRows(part, reader(first, count)); });
            addAll(frame.contact_a, part.contact_a);
            addAll(frame.contact_b, part.contact_b);
            addAll(frame.contact_point, part.contact_point);
            addAll(frame.contact_normal, part.contact_normal);
            addAll(frame.contact_distance, part.contact_distance);
            addAll(frame.contact_impulse, part.contact_impulse);
        }
        if (!series->joints) return;
        forRows(series->joints->end, series->joints->joint.frames(), index,
                [&](hsize_t first, hsize_t count) { series->joints->forEachOfRows(part, reader(first, count)); });
        for (std::size_t n = 0; n < part.joint.size(); ++n) {
            const std::size_t j = indexIn(part.joint[n], joints, "joint");
            frame.joint_point[j] = part.joint_point[n];
            frame.joint_force[j] = part.joint_force[n];
            frame.joint_torque[j] = part.joint_torque[n];
        }
    }

    std::filesystem::path path;
    std::size_t bodies;  ///< of the scene
    std::size_t joints;  ///< likewise
    hdf5::File file;
    std::optional<hdf5::PartSeries<hdf5::SeriesReader>> series;
    hsize_t frames = 0;
};

PartReader::PartReader(const std::filesystem::path& file, std::size_t rank, std::uint64_t mark,
                       const RecordingInfo& info)
    : impl_(std::make_unique<Impl>(file, rank, mark, info)) {}

PartReader::~PartReader() = default;

std::size_t PartReader::frames() const {
    return impl_->frames;
}

void PartReader::read(std::size_t index, Frame& frame) const {
    FramePart part;
    double time = 0;
    impl_->series->time.read(index, &time);
    if (time != frame.time) {
        throw IoError(fmt::format("{}: is damaged: its frame {} is of {} s, not {} s", impl_->path.string(), index,
                                  time, frame.time));
    }
    impl_->readBodies(index, part, frame);
    impl_->readForces(index, part, frame);
}

}  // namespace cairn
