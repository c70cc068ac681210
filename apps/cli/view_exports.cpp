#include "cli/view_exports.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/companions.h"

namespace cairn::cli {

void addViewExports(CLI::App& command, CLI::App& formats, ViewExports& exports) {
    formats.add_option("--html", exports.html, "Write one page that plays the recording without a network")
        ->type_name("FILE");
    formats.add_option("--png", exports.png, "Write a picture; needs chromium")->type_name("FILE");
    formats.add_option("--mp4", exports.mp4, "Write a film of 30 pictures a second; needs chromium and ffmpeg")
        ->type_name("FILE");
    command.add_option("--time", exports.time, "The moment of the picture [s]; default: the end");
    command.add_option("--size", exports.size, "Width and height of picture and film [pixels]; default: 1280 720")
        ->expected(2);
    command.add_option("--speed", exports.speed, "Simulated seconds per second of the film; default: 1");
    command.add_option("--camera", exports.camera, "Position of the camera and the point it looks at [m]: x y z x y z")
        ->expected(6);
    command
        .add_option("--layers", exports.layers,
                    "What picture and film show over the bodies: none, or any of joints,laws,points,normals,impulses,"
                    "friction; default: joints,laws")
        ->delimiter(',');
    command.add_option("--theme", exports.theme, "light (also the default) or dark")
        ->check(CLI::IsMember({"light", "dark"}));
}

int writeViewExports(const std::string& recording, const ViewExports& exports) {
    std::vector<std::string> arguments{recording};
    const auto add = [&](std::initializer_list<std::string> words) { arguments.insert(arguments.end(), words); };
    if (!exports.html.empty()) add({"--html", exports.html});
    if (!exports.png.empty()) add({"--png", exports.png});
    if (!exports.mp4.empty()) add({"--mp4", exports.mp4});
    if (exports.time >= 0) add({"--time", fmt::format("{}", exports.time)});
    add({"--size", fmt::format("{}", exports.size.at(0)), fmt::format("{}", exports.size.at(1))});
    add({"--speed", fmt::format("{}", exports.speed), "--theme", exports.theme});
    if (!exports.camera.empty()) {
        add({"--camera"});
        for (const double number : exports.camera) add({fmt::format("{}", number)});
    }
    if (!exports.layers.empty()) add({"--layers", fmt::format("{}", fmt::join(exports.layers, ","))});
    return runCompanion(view_companion, arguments);
}

}  // namespace cairn::cli
