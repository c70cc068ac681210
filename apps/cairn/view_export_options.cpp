#include "view_exports.h"

namespace cairn::cli {

void addViewExports(CLI::App& command, CLI::Option_group& formats, ViewExports& exports) {
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
    command.add_option("--theme", exports.theme, "light (also the default) or dark")
        ->check(CLI::IsMember({"light", "dark"}));
}

}  // namespace cairn::cli
