/// @file Contacts and joints of a recording, which only some have; described once for writing and reading.
#pragma once

#include <filesystem>
#include <vector>

#include "cairn/recording.h"
#include "record/layout.h"
#include "record/series.h"

namespace cairn::hdf5 {

/// Contacts: rows of all frames, and where each frame's end. @tparam Series SeriesWriter or SeriesReader
template <typename Series>
struct ContactSeries {
    /// @param path of the file, for messages; must outlive this @throws IoError
    ContactSeries(const File& file, const std::filesystem::path& path)
        : a(file, path, {layout::contact_a, "1", Element::integer, Storage::rows, {}}),
          b(file, path, {layout::contact_b, "1", Element::integer, Storage::rows, {}}),
          point(file, path, {layout::contact_point, "m", Element::real, Storage::rows, {3}}),
          normal(file, path, {layout::contact_normal, "1", Element::real, Storage::rows, {3}}),
          distance(file, path, {layout::contact_distance, "m", Element::real, Storage::rows, {}}),
          impulse(file, path, {layout::contact_impulse, "N s", Element::real, Storage::rows, {3}}),
          end(file, path, {layout::contacts_end, "1", Element::integer, Storage::plain, {}}) {}

    /// Calls visit with each series of rows and what it is of a frame. @tparam AnyFrame Frame, maybe const
    template <typename AnyFrame, typename Visit>
    void forEachOfRows(AnyFrame& frame, const Visit& visit) const {
        visit(a, frame.contact_a);
        visit(b, frame.contact_b);
        visit(point, frame.contact_point);
        visit(normal, frame.contact_normal);
        visit(distance, frame.contact_distance);
        visit(impulse, frame.contact_impulse);
    }

    mutable Series a, b, point, normal, distance, impulse;
    Series end;  ///< rows up to and with each frame; written last, since it says that they are there
};

/// Forces of joints: one row per joint of the scene. @tparam Series SeriesWriter or SeriesReader
template <typename Series>
struct JointSeries {
    /// @param path of the file, for messages; must outlive this @throws IoError
    JointSeries(const File& file, const std::filesystem::path& path, hsize_t joints)
        : point(file, path, {layout::joint_point, "m", Element::real, Storage::compressed, {joints, 3}}),
          force(file, path, {layout::joint_force, "N", Element::real, Storage::compressed, {joints, 3}}),
          torque(file, path, {layout::joint_torque, "N m", Element::real, Storage::compressed, {joints, 3}}) {}

    /// Calls visit with each series and what it is of a frame. @tparam AnyFrame Frame, maybe const
    template <typename AnyFrame, typename Visit>
    void forEach(AnyFrame& frame, const Visit& visit) const {
        visit(point, frame.joint_point);
        visit(force, frame.joint_force);
        visit(torque, frame.joint_torque);
    }

    mutable Series point, force, torque;
};

}  // namespace cairn::hdf5
