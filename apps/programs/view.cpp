/// @file cairn-view: the testbed in the browser; and the exports that need it.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <thread>

#include "cli/companions.h"
#include "cli/interrupt.h"
#include "cli/output.h"
#include "cli/override_options.h"
#include "cli/program.h"
#include "cli/progress.h"
#include "cli/scene_argument.h"
#include "cli/view_exports.h"
#include "view/film.h"
#include "view/html_export.h"
#include "view/process.h"
#include "view/viewer.h"

namespace cairn::cli {

namespace {

constexpr std::uint16_t default_port = 8137;
constexpr std::string_view default_scene = "stacks5";

struct ViewOptions {
    std::vector<std::string> subjects;
    OverrideOptions overrides;
    std::string host = "127.0.0.1";
    std::uint16_t port = default_port;
    bool no_open = false;
    bool paused = false;
    ViewExports exports;
};

bool isLoopback(const std::string& host) {
    return host.substr(0, 4) == "127." || host == "::1";
}

view::ServerOptions servingFrom(const ViewOptions& options) {
    view::ServerOptions serving;
    serving.host = options.host == "localhost" ? "127.0.0.1" : options.host;
    serving.port = options.port;
    if (!isLoopback(serving.host)) {
        serving.token = view::makeToken();
        printLine(stderr, fmt::format("cairn: warning: everyone who can reach {} and knows the address below can see "
                                      "and change this simulation; the connection is not encrypted",
                                      serving.host));
    }
    return serving;
}

std::unique_ptr<view::Viewer> makeViewer(const ViewOptions& options) {
    std::vector<std::filesystem::path> recordings;
    for (const std::string& subject : options.subjects) {
        if (!isBuiltInScene(subject) && looksLikeRecording(subject)) recordings.emplace_back(subject);
    }
    if (!recordings.empty()) {
        if (recordings.size() != options.subjects.size()) {
            throw InputError(
                "scenes and recordings cannot be shown together; name one scene, or one or two recordings");
        }
        return std::make_unique<view::Viewer>(recordings, servingFrom(options));
    }
    if (options.subjects.size() > 1) throw InputError("one scene can be shown at a time; two recordings can");
    view::LiveOptions live;
    live.scene_name = options.subjects.empty() ? default_scene : options.subjects.front();
    live.scene = loadScene(live.scene_name);
    live.overrides = overridesFrom(options.overrides, live.scene);
    live.begin = options.paused ? view::LiveOptions::Begin::paused : view::LiveOptions::Begin::playing;
    if (!isBuiltInScene(live.scene_name)) live.scene_name = std::filesystem::path(live.scene_name).filename().string();
    return std::make_unique<view::Viewer>(live, servingFrom(options));
}

void show(const ViewOptions& options) {
    catchInterrupts();
    const auto viewer = makeViewer(options);
    printOut(fmt::format("{}\n", viewer->address()));
    const bool opened = !options.no_open && view::openBrowser(viewer->address());
    printLine(stderr, opened ? "Ctrl-C ends it." : "Open the address in a browser; Ctrl-C ends it.");
    while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

view::FilmOptions filmFrom(const ViewExports& exports) {
    view::FilmOptions film;
    film.width = exports.size.at(0);
    film.height = exports.size.at(1);
    film.speed = exports.speed;
    film.theme = exports.theme == "dark" ? view::FilmOptions::Theme::dark : view::FilmOptions::Theme::light;
    if (!exports.camera.empty()) film.camera = exports.camera;
    if (!exports.layers.empty()) film.layers = exports.layers;
    if (exports.layers == std::vector<std::string>{"none"}) film.layers.clear();
    return film;
}

void write(const ViewOptions& options) {
    if (options.subjects.size() != 1) throw InputError("one recording at a time can be drawn or exported");
    const RecordingReader recording(options.subjects.front());
    const ViewExports& exports = options.exports;
    if (!exports.html.empty()) view::exportHtml(recording, exports.html);
    if (exports.png.empty() && exports.mp4.empty()) return;
    catchInterrupts();
    const std::size_t frames = recording.info().frames;
    if (frames == 0) throw IoError("the recording has no frames to draw");
    const double end = recording.frame(frames - 1).time;
    view::FilmOptions film = filmFrom(exports);
    Progress progress(end, Progress::Wish::show);
    film.progress = [&](std::size_t done, std::size_t all) {
        progress.update(end * static_cast<double>(done) / static_cast<double>(all));
        return !interrupted();
    };
    if (!exports.png.empty()) view::exportPicture(recording, exports.time < 0 ? end : exports.time, film, exports.png);
    if (!exports.mp4.empty()) view::exportFilm(recording, film, exports.mp4);
}

void addOptions(CLI::App& command, int&) {
    auto options = std::make_shared<ViewOptions>();
    command
        .add_option("WHAT", options->subjects,
                    "A built-in scene, a scene file, or one or two recordings; default: stacks5")
        ->expected(0, 2);
    addOverrideOptions(command, options->overrides);
    command.add_option("--port", options->port, "The port to listen on, 0 for any free one; default: 8137");
    command.add_option("--host", options->host,
                       "The address to listen on; default: 127.0.0.1, which only this machine reaches");
    command.add_flag("--no-open", options->no_open, "Only print the address");
    command.add_flag("--paused", options->paused, "Begin paused instead of with the first viewer");
    addViewExports(command, *command.add_option_group("exports", "Of one recording; nothing is shown then"),
                   options->exports);
    command.callback([options] { options->exports.any() ? write(*options) : show(*options); });
}

}  // namespace

}  // namespace cairn::cli

int main(int argc, char** argv) {
    using namespace cairn::cli;
    return runProgram(argc, argv, "cairn view", std::string(view_companion.description), addOptions);
}
