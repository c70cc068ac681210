#include "film.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "clip.h"
#include "process.h"
#include "samples.h"
#include "server.h"

namespace cairn::view {

using nlohmann::json;

namespace {

constexpr std::array<std::string_view, 6> layer_names = {"joints", "laws", "points", "normals", "impulses", "friction"};
constexpr std::size_t longest_picture = 64 << 20;  // [bytes]
constexpr auto picture_timeout = std::chrono::seconds(90);

void validate(const FilmOptions& options, const RecordingInfo& info) {
    for (const int edge : {options.width, options.height}) {
        if (edge < 16 || edge > 4096 || edge % 2 != 0) {
            throw InputError(
                fmt::format("pictures of {} × {} pixels are not made; allowed are even numbers from 16 to 4096",
                            options.width, options.height));
        }
    }
    if (!(options.speed >= 0.01 && options.speed <= 100)) {
        throw InputError(fmt::format("the speed of a film is {}; allowed is 0.01 to 100", options.speed));
    }
    for (const std::string& layer : options.layers) {
        const auto known = std::ranges::find(layer_names, layer);
        if (known == layer_names.end()) {
            throw InputError(
                fmt::format("the layer '{}' is not known; known are {}", layer, fmt::join(layer_names, ", ")));
        }
        if (known - layer_names.begin() >= 2 && !info.contacts) {
            throw InputError(
                fmt::format("the layer '{}' needs contacts, which the recording does not hold; record it "
                            "with --record-contacts",
                            layer));
        }
    }
    if (options.camera && options.camera->size() != 6) {
        throw InputError(fmt::format("a camera needs six numbers, position and the point looked at; it has {}",
                                     options.camera->size()));
    }
}

std::string chromium() {
    if (const char* named = std::getenv("CAIRN_CHROMIUM")) return named;
    const std::string found = findProgram({"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"});
    if (found.empty()) {
        throw IoError("pictures and films are drawn by Chromium, which is not installed; install the package chromium");
    }
    return found;
}

std::vector<std::string> chromiumCommand(const std::string& address, const std::filesystem::path& profile) {
    std::vector<std::string> command = {chromium(),
                                        "--headless=new",
                                        "--user-data-dir=" + profile.string(),
                                        "--no-first-run",
                                        "--disable-extensions",
                                        "--disable-background-networking",
                                        "--disable-dev-shm-usage",
                                        "--hide-scrollbars",
                                        "--mute-audio",
                                        "--use-angle=swiftshader",
                                        "--enable-unsafe-swiftshader",
                                        "--remote-debugging-port=0"};
    // Chromium's sandbox refuses to run as root; the only page it opens is our own.
    if (geteuid() == 0) command.emplace_back("--no-sandbox");
    command.push_back(address);
    return command;
}

/// The pictures that the page sends, handed from the server's thread to the one that waits for them.
class PictureQueue {
  public:
    void put(std::string_view picture) {
        const std::lock_guard lock(mutex_);
        picture_ = std::string(picture);
        arrived_.notify_one();
    }
    void fail(std::string_view reason) {
        const std::lock_guard lock(mutex_);
        if (failure_.empty()) failure_ = reason;
        arrived_.notify_one();
    }
    /// @throws IoError
    std::string take(Process& browser) {
        std::unique_lock lock(mutex_);
        const auto until = std::chrono::steady_clock::now() + picture_timeout;
        while (!picture_) {
            if (!failure_.empty()) throw IoError(failure_);
            if (!browser.running()) throw IoError("Chromium ended before the picture was drawn");
            if (std::chrono::steady_clock::now() > until) throw IoError("Chromium did not draw a picture in time");
            arrived_.wait_for(lock, std::chrono::milliseconds(200));
        }
        std::string picture = std::move(*picture_);
        picture_.reset();
        return picture;
    }

  private:
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::optional<std::string> picture_;
    std::string failure_;
};

SharedMessage filmMessage(const json& object) {
    return std::make_shared<const Message>(Message{Message::Kind::text, object.dump()});
}

json filmHello(const FilmOptions& options, const std::vector<double>& times, std::string_view format) {
    return {{"type", "hello"},
            {"protocol", 1},
            {"mode", "film"},
            {"film",
             {{"width", options.width},
              {"height", options.height},
              {"format", format},
              {"times", times},
              {"camera", options.camera ? json(*options.camera) : json(nullptr)},
              {"layers", options.layers},
              {"theme", options.theme == FilmOptions::Theme::dark ? "dark" : "light"}}}};
}

/// Has the page draw the recording at some times. @param take gets each picture, in order
template <typename Take>
void drawPictures(const RecordingReader& recording, const std::vector<double>& times, const FilmOptions& options,
                  std::string_view format, const Take& take) {
    validate(options, recording.info());
    ServerOptions serving;
    serving.token = makeToken();
    serving.clips = {std::make_shared<const std::string>(makeClip(recording))};
    serving.longest_message = longest_picture;
    Server server(serving);
    PictureQueue pictures;
    ServerEvents events;
    const SharedMessage hello = filmMessage(filmHello(options, times, format));
    events.joined = [&](ClientId client) { server.toOne(client, hello); };
    events.left = [&](ClientId) { pictures.fail("Chromium closed the page before all pictures were drawn"); };
    events.binary = [&](ClientId, std::string_view bytes) { pictures.put(bytes); };
    events.text = [&](ClientId, std::string_view message) {
        const json object = json::parse(message, nullptr, false);
        if (object.is_object() && object.value("do", "") == "failed") {
            pictures.fail("the page could not draw: " + object.value("text", std::string("no reason given")));
        }
    };
    server.start(std::move(events));
    const TemporaryFolder profile;
    Process browser(chromiumCommand(server.address(), profile.path()), Process::Input::none, Process::Output::drop);
    for (std::size_t i = 0; i < times.size(); ++i) {
        take(pictures.take(browser));
        if (options.progress && !options.progress(i + 1, times.size())) {
            server.stop();
            throw IoError("stopped before all pictures were drawn");
        }
        server.toAll(filmMessage({{"type", "next-picture"}}));
    }
    server.stop();
}

double duration(const RecordingReader& recording) {
    const std::size_t frames = recording.info().frames;
    if (frames == 0) throw IoError("the recording has no frames");
    return recording.frame(frames - 1).time;
}

}  // namespace

void exportPicture(const RecordingReader& recording, double time, const FilmOptions& options,
                   const std::filesystem::path& file) {
    const double end = duration(recording);
    if (!(time >= 0 && time <= end)) {
        throw InputError(fmt::format("the recording has no picture at {} s; it goes from 0 to {} s", time, end));
    }
    drawPictures(recording, {time}, options, "png", [&](const std::string& picture) {
        std::ofstream out(file, std::ios::binary);
        out.write(picture.data(), static_cast<std::streamsize>(picture.size()));
        out.close();
        if (!out) throw IoError(fmt::format("'{}' cannot be written", file.string()));
    });
}

void exportFilm(const RecordingReader& recording, const FilmOptions& options, const std::filesystem::path& file) {
    validate(options, recording.info());
    const std::string ffmpeg = findProgram({"ffmpeg"});
    if (ffmpeg.empty())
        throw IoError("films are encoded by ffmpeg, which is not installed; install the package ffmpeg");
    const auto pictures =
        static_cast<std::size_t>(std::floor(duration(recording) / options.speed * film_rate + 1e-6)) + 1;
    std::vector<double> times;
    for (std::size_t i = 0; i < pictures; ++i) times.push_back(static_cast<double>(i) * options.speed / film_rate);
    // Begins with an own file, so that a half-made film never stands in the place of an older one.
    const std::filesystem::path unfinished = file.string() + ".part";
    Process encoder({ffmpeg,
                     "-y",
                     "-loglevel",
                     "error",
                     "-f",
                     "image2pipe",
                     "-framerate",
                     fmt::format("{}", film_rate),
                     "-c:v",
                     "mjpeg",
                     "-i",
                     "-",
                     "-c:v",
                     "libx264",
                     "-preset",
                     "medium",
                     "-crf",
                     "20",
                     "-pix_fmt",
                     "yuv420p",
                     "-movflags",
                     "+faststart",
                     "-f",
                     "mp4",
                     unfinished.string()},
                    Process::Input::pipe, Process::Output::keep);
    try {
        drawPictures(recording, times, options, "jpeg", [&](const std::string& picture) { encoder.write(picture); });
        encoder.closeInput();
        if (encoder.wait() != 0) throw IoError("ffmpeg could not make the film");
        std::filesystem::rename(unfinished, file);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(unfinished, ignored);
        throw;
    }
}

}  // namespace cairn::view
