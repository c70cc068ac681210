/// @file What `cairn export` has cairn-view make: pages, pictures and films.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace cairn::cli {

/// What the command line asks for; empty names are not asked for.
struct ViewExports {
    std::string html;
    std::string png;
    std::string mp4;
    double time = -1;  ///< of the picture [s]; below 0 = the end
    std::vector<int> size = {1280, 720};
    double speed = 1;
    std::vector<double> camera;  ///< empty = chosen so that everything is seen
    std::string theme = "light";
    std::vector<std::string> layers;  ///< of picture and film; empty = joints and laws

    bool any() const { return !html.empty() || !png.empty() || !mp4.empty(); }
};

/// Adds --html, --png and --mp4 to the formats, and what shapes them to the command. @param exports must outlive it
void addViewExports(CLI::App& command, CLI::App& formats, ViewExports& exports);

/// Has cairn-view write what is asked for. @param recording its file @return the exit code @throws IoError
int writeViewExports(const std::string& recording, const ViewExports& exports);

}  // namespace cairn::cli
