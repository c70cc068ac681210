#include "pictures.h"

#include <fmt/format.h>

#include <algorithm>

namespace cairn::thesis {

namespace fs = std::filesystem;

fs::path recordingOf(const fs::path& out, const std::string& key) {
    return out / "recordings" / (key + ".h5");
}

Json Pictures::draw(const std::string& key, const std::vector<double>& camera) {
    const auto known = drawn_.find(key);
    if (known != drawn_.end()) return known->second;
    Json files = Json::array();
    try {
        files = drawAll(key, camera);
    } catch (const IoError& error) {
        // One reason is usually that of all.
        const std::string warning = fmt::format("pictures are missing: {}", error.what());
        if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end()) warnings_.push_back(warning);
    }
    return drawn_[key] = files;
}

Json Pictures::drawAll(const std::string& key, const std::vector<double>& camera) {
    Json files = Json::array();
    if (!options_.picture) {
        if (warnings_.empty())
            warnings_.push_back("no pictures: this program was built without its viewer, which draws them");
        return files;
    }
    const fs::path recording = recordingOf(options_.out, key);
    const RecordingReader reader(recording);
    fs::create_directories(options_.out / "pictures");
    for (std::size_t i = 0; i < reader.info().frames; ++i) {
        const double time = reader.frame(i).time;
        const fs::path file = fs::path("pictures") / fmt::format("{}-{}.png", key, i);
        const fs::path whole = options_.out / file;
        if (!fs::exists(whole) || fs::last_write_time(whole) < fs::last_write_time(recording)) {
            options_.progress({1, fmt::format("picture of {} at {:.2f} s", key, time)});
            if (options_.interrupted()) throw Interrupted{};
            options_.picture({recording, time, camera, whole});
        }
        files.push_back({{"time", time}, {"file", file.string()}});
    }
    return files;
}

}  // namespace cairn::thesis
