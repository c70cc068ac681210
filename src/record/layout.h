/// @file What stands where in a recording; docs/recording.md describes the same for readers in other languages.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/statistics.h"
#include "cairn/types.h"

namespace cairn::layout {

// Attributes of the root group.
inline constexpr const char* format_attribute = "format";
inline constexpr std::string_view format_name = "cairn recording";
inline constexpr const char* format_version_attribute = "format_version";
inline constexpr std::int64_t format_version = 1;
inline constexpr const char* version_attribute = "cairn_version";
inline constexpr const char* machine_attribute = "machine";
inline constexpr const char* rate_attribute = "frames_per_second";
inline constexpr double least_frame_rate = 1e-3;  ///< [1/s]

// Of a recording in parts: also attributes of the root groups of the parts, whose format is another.
inline constexpr const char* parts_attribute = "parts";
inline constexpr const char* mark_attribute = "mark";
inline constexpr const char* rank_attribute = "rank";
inline constexpr std::string_view part_format_name = "cairn recording part";

/// What stands for places and forces of what is no longer there.
inline const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

inline constexpr const char* scene = "scene";        ///< the scene file's text
inline constexpr const char* settings = "settings";  ///< a group with one attribute per field

// One row per frame each.
inline constexpr const char* frames = "frames";
inline constexpr const char* time = "frames/time";
inline constexpr const char* position = "frames/position";
inline constexpr const char* orientation = "frames/orientation";
inline constexpr const char* linear_velocity = "frames/linear_velocity";
inline constexpr const char* angular_velocity = "frames/angular_velocity";
inline constexpr const char* asleep = "frames/asleep";
inline constexpr const char* kinetic_energy = "frames/kinetic_energy";
inline constexpr const char* potential_energy = "frames/potential_energy";
inline constexpr const char* step_hashes = "frames/state_hashes";  ///< only if it was asked for

// Only if they were asked for: rows of all frames, one after the other, and where each frame's rows end.
inline constexpr const char* contacts = "contacts";  ///< a group
inline constexpr const char* contacts_end = "contacts/end";
inline constexpr const char* contact_a = "contacts/a";
inline constexpr const char* contact_b = "contacts/b";
inline constexpr const char* contact_point = "contacts/point";
inline constexpr const char* contact_normal = "contacts/normal";
inline constexpr const char* contact_distance = "contacts/distance";
inline constexpr const char* contact_impulse = "contacts/impulse";

// Of parts: rows of all frames, and where each frame's rows end.
inline constexpr const char* bodies_end = "frames/end";
inline constexpr const char* body = "frames/body";
inline constexpr const char* joints_end = "joints/end";
inline constexpr const char* joint = "joints/joint";

inline constexpr const char* joints = "joints";  ///< a group; only if it was asked for
inline constexpr const char* joint_point = "joints/point";
inline constexpr const char* joint_force = "joints/force";
inline constexpr const char* joint_torque = "joints/torque";

inline constexpr const char* statistics = "statistics";
inline constexpr const char* stage_ms = "statistics/stage_ms";
inline constexpr const char* stages_attribute =
    "stages";  ///< of the group statistics: names of the columns of stage_ms

inline constexpr const char* diagnostics = "diagnostics";  ///< a group; only with the setting of that name

/// Paths of its data sets, in the order of diagnosticsFields().
inline const std::vector<std::string>& diagnosticsNames() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const DiagnosticsField& field : diagnosticsFields()) {
            all.push_back(std::string(diagnostics) + '/' + std::string(field.name));
        }
        return all;
    }();
    return names;
}

/// A member of Statistics and its data set.
template <typename Value>
struct StatisticsColumn {
    const char* name;
    const char* unit;
    Value Statistics::*member;
};

inline constexpr std::array<StatisticsColumn<std::int64_t>, 12> counters{{
    {"statistics/contacts", "1", &Statistics::contacts},
    {"statistics/penetrating_contacts", "1", &Statistics::penetrating_contacts},
    {"statistics/corrected_contacts", "1", &Statistics::corrected_contacts},
    {"statistics/uncorrected_contacts", "1", &Statistics::uncorrected_contacts},
    {"statistics/displaced_bodies", "1", &Statistics::displaced_bodies},
    {"statistics/global_iterations", "1", &Statistics::global_iterations},
    {"statistics/shock_iterations", "1", &Statistics::shock_iterations},
    {"statistics/shock_batches", "1", &Statistics::shock_batches},
    {"statistics/batches", "1", &Statistics::batches},
    {"statistics/largest_batch", "1", &Statistics::largest_batch},
    {"statistics/asleep", "1", &Statistics::asleep},
    {"statistics/woken", "1", &Statistics::woken},
}};

inline constexpr std::array<StatisticsColumn<double>, 2> overlaps{{
    {"statistics/largest_overlap", "m", &Statistics::largest_overlap},
    {"statistics/mean_overlap", "m", &Statistics::mean_overlap},
}};

}  // namespace cairn::layout
