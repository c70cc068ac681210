/// @file All series of a recording, described once for writing and reading.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "record/layout.h"
#include "record/series.h"

namespace cairn::hdf5 {

/// The hashes of a recording that has them: apart, since most have none.
inline SeriesShape stepHashes(hsize_t per_frame) {
    return {layout::step_hashes, "1", Element::integer, Storage::plain, {per_frame}};
}

/// One per diagnosticsFields(), of a recording with diagnostics. @tparam Series SeriesWriter or SeriesReader
/// @param path of the file, for messages; must outlive them @throws IoError
template <typename Series>
std::vector<Series> diagnosticsSeries(const File& file, const std::filesystem::path& path) {
    std::vector<Series> series;
    const std::vector<std::string>& names = layout::diagnosticsNames();
    for (std::size_t i = 0; i < names.size(); ++i) {
        // Units are literals.
        const char* unit = diagnosticsFields()[i].unit.data();
        series.emplace_back(file, path, SeriesShape{names[i].c_str(), unit, Element::real, Storage::plain, {}});
    }
    return series;
}

/// The states of all bodies. @tparam Series SeriesWriter or SeriesReader
template <typename Series>
struct BodySeries {
    /// @param path of the file, for messages; must outlive this @throws IoError
    BodySeries(const File& file, const std::filesystem::path& path, hsize_t bodies)
        : position(file, path, {layout::position, "m", Element::real, Storage::compressed, {bodies, 3}}),
          orientation(file, path, {layout::orientation, "1", Element::real, Storage::compressed, {bodies, 4}}),
          linear_velocity(file, path,
                          {layout::linear_velocity, "m/s", Element::real, Storage::compressed, {bodies, 3}}),
          angular_velocity(file, path,
                           {layout::angular_velocity, "rad/s", Element::real, Storage::compressed, {bodies, 3}}),
          asleep(file, path, {layout::asleep, "1", Element::flag, Storage::compressed, {bodies}}) {}

    Series position, orientation, linear_velocity, angular_velocity, asleep;
};

/// What all recordings have one of per frame. @tparam Series SeriesWriter or SeriesReader
template <typename Series>
struct FrameSeries {
    /// @param path of the file, for messages; must outlive this @throws IoError
    FrameSeries(const File& file, const std::filesystem::path& path)
        : time(file, path, {layout::time, "s", Element::real, Storage::plain, {}}),
          kinetic_energy(file, path, {layout::kinetic_energy, "J", Element::real, Storage::plain, {}}),
          potential_energy(file, path, {layout::potential_energy, "J", Element::real, Storage::plain, {}}),
          stage_ms(file, path, {layout::stage_ms, "ms", Element::real, Storage::plain, {stage_count}}) {
        for (const auto& column : layout::counters) {
            counters.emplace_back(file, path,
                                  SeriesShape{column.name, column.unit, Element::integer, Storage::plain, {}});
        }
        for (const auto& column : layout::overlaps) {
            overlaps.emplace_back(file, path, SeriesShape{column.name, column.unit, Element::real, Storage::plain, {}});
        }
    }

    /// Calls visit for every series but time.
    template <typename Visit>
    void forEachButTime(const Visit& visit) {
        if (bodies) {
            for (Series* s : {&bodies->position, &bodies->orientation, &bodies->linear_velocity,
                              &bodies->angular_velocity, &bodies->asleep}) {
                visit(*s);
            }
        }
        for (Series* s : {&kinetic_energy, &potential_energy, &stage_ms}) visit(*s);
        for (Series& s : counters) visit(s);
        for (Series& s : overlaps) visit(s);
    }

    Series time;  ///< a frame is there once its time is, so it is written last and opened first
    std::optional<BodySeries<Series>> bodies;  ///< none in a recording whose parts have them
    Series kinetic_energy, potential_energy;
    Series stage_ms;
    std::vector<Series> counters, overlaps;
};

}  // namespace cairn::hdf5
