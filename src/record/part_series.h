/// @file What the file of a rank holds of a recording in parts; described once for writing and reading.
#pragma once

#include <filesystem>
#include <optional>

#include "cairn/recording.h"
#include "record/force_series.h"
#include "record/layout.h"
#include "record/series.h"

namespace cairn::hdf5 {

/// The bodies that a rank has: rows of all frames, and where each frame's end. @tparam Series SeriesWriter or
/// SeriesReader
template <typename Series>
struct BodyRows {
    /// @param path of the file, for messages; must outlive this @throws IoError
    BodyRows(const File& file, const std::filesystem::path& path)
        : body(file, path, {layout::body, "1", Element::integer, Storage::rows, {}}),
          position(file, path, {layout::position, "m", Element::real, Storage::rows, {3}}),
          orientation(file, path, {layout::orientation, "1", Element::real, Storage::rows, {4}}),
          linear_velocity(file, path, {layout::linear_velocity, "m/s", Element::real, Storage::rows, {3}}),
          angular_velocity(file, path, {layout::angular_velocity, "rad/s", Element::real, Storage::rows, {3}}),
          asleep(file, path, {layout::asleep, "1", Element::flag, Storage::rows, {}}),
          end(file, path, {layout::bodies_end, "1", Element::integer, Storage::plain, {}}) {}

    /// Calls visit with each series of rows and what it is of a frame. @param quaternions w, x, y, z
    template <typename AnyPart, typename Quaternions, typename Visit>
    void forEachOfRows(AnyPart& part, Quaternions& quaternions, const Visit& visit) const {
        visit(body, part.body);
        visit(position, part.position);
        visit(orientation, quaternions);
        visit(linear_velocity, part.linear_velocity);
        visit(angular_velocity, part.angular_velocity);
        visit(asleep, part.asleep);
    }

    mutable Series body, position, orientation, linear_velocity, angular_velocity, asleep;
    Series end;  ///< rows up to and with each frame
};

/// The joints that a rank has, likewise.
template <typename Series>
struct JointRows {
    /// @param path of the file, for messages; must outlive this @throws IoError
    JointRows(const File& file, const std::filesystem::path& path)
        : joint(file, path, {layout::joint, "1", Element::integer, Storage::rows, {}}),
          point(file, path, {layout::joint_point, "m", Element::real, Storage::rows, {3}}),
          force(file, path, {layout::joint_force, "N", Element::real, Storage::rows, {3}}),
          torque(file, path, {layout::joint_torque, "N m", Element::real, Storage::rows, {3}}),
          end(file, path, {layout::joints_end, "1", Element::integer, Storage::plain, {}}) {}

    /// Calls visit with each series of rows and what it is of a frame.
    template <typename AnyPart, typename Visit>
    void forEachOfRows(AnyPart& part, const Visit& visit) const {
        visit(joint, part.joint);
        visit(point, part.joint_point);
        visit(force, part.joint_force);
        visit(torque, part.joint_torque);
    }

    mutable Series joint, point, force, torque;
    Series end;  ///< rows up to and with each frame
};

/// All of them.
template <typename Series>
struct PartSeries {
    /// @param path of the file, for messages; must outlive this @throws IoError
    PartSeries(const File& file, const std::filesystem::path& path, bool has_contacts, bool has_joints)
        : time(file, path, {layout::time, "s", Element::real, Storage::plain, {}}), bodies(file, path) {
        if (has_contacts) contacts.emplace(file, path);
        if (has_joints) joints.emplace(file, path);
    }

    Series time;  ///< a frame is there once its time is, so it is written last and opened first
    BodyRows<Series> bodies;
    std::optional<ContactSeries<Series>> contacts;
    std::optional<JointRows<Series>> joints;
};

}  // namespace cairn::hdf5
