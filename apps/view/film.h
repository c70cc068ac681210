/// @file Pictures and films of recordings, drawn by headless Chromium and encoded by ffmpeg.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cairn/recording.h"

namespace cairn::view {

/// How a picture or film is drawn.
struct FilmOptions {
    int width = 1280;  ///< [pixels], 16 to 4096, even
    int height = 720;  ///< [pixels], 16 to 4096, even
    double speed = 1;  ///< simulated seconds per second of the film
    enum class Theme { light, dark } theme = Theme::light;
    std::optional<std::vector<double>> camera;  ///< position and the point looked at: six numbers [m, W]
    /// What is drawn over the bodies: joints and laws; of a recording with contacts points, normals, impulses,
    /// friction.
    std::vector<std::string> layers = {"joints", "laws"};
    /// Called after each picture with their number and the total; returns false to stop.
    std::function<bool(std::size_t, std::size_t)> progress;
};

/// Pictures per second of a film.
inline constexpr double film_rate = 30;

/// @param time [s] @throws InputError for options out of range; IoError if Chromium is missing or fails
void exportPicture(const RecordingReader& recording, double time, const FilmOptions& options,
                   const std::filesystem::path& file);
/// @throws as exportPicture, also if ffmpeg is missing or fails
void exportFilm(const RecordingReader& recording, const FilmOptions& options, const std::filesystem::path& file);

}  // namespace cairn::view
