#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "cairn/recording.h"
#include "record/recorded_settings.h"

namespace cairn {

namespace {

/// Equal bit by bit: also a NaN, where a body was removed.
template <class Vector>
bool areEqual(const Vector& a, const Vector& b) {
    return std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

bool isEqualBody(const Frame& a, const Frame& b, std::size_t i) {
    // Of a removed body only the position says that it is gone.
    if (!a.position[i].allFinite() && !b.position[i].allFinite()) return true;
    return areEqual(a.position[i], b.position[i]) && areEqual(a.orientation[i].coeffs(), b.orientation[i].coeffs()) &&
           areEqual(a.linear_velocity[i], b.linear_velocity[i]) &&
           areEqual(a.angular_velocity[i], b.angular_velocity[i]) && a.asleep[i] == b.asleep[i];
}

std::string describe(const Frame& frame, std::size_t i) {
    const Vec3& p = frame.position[i];
    const Vec3& v = frame.linear_velocity[i];
    return fmt::format("position ({}, {}, {}) m, velocity ({}, {}, {}) m/s{}", p.x(), p.y(), p.z(), v.x(), v.y(), v.z(),
                       frame.asleep[i] != 0 ? ", asleep" : "");
}

std::optional<std::size_t> firstBody(const Frame& recorded, const Frame& now) {
    for (std::size_t i = 0; i < recorded.position.size(); ++i) {
        if (!isEqualBody(recorded, now, i)) return i;
    }
    return std::nullopt;
}

RecordingDifference differenceAt(std::int64_t step, const Frame& recorded, const Frame& now) {
    RecordingDifference difference{step, firstBody(recorded, now), {}};
    if (difference.body) {
        difference.what =
            fmt::format("recorded: {}; now: {}", describe(recorded, *difference.body), describe(now, *difference.body));
    } else {
        difference.what = "the hash of the state differs, but the frame at the end of the simulation step is equal";
    }
    return difference;
}

/// Compares a frame. @param first_step number of the first time step of the frame
std::optional<RecordingDifference> compare(const Frame& recorded, const Frame& now, std::int64_t first_step) {
    const auto mismatch = std::mismatch(recorded.step_hashes.begin(), recorded.step_hashes.end(),
                                        now.step_hashes.begin(), now.step_hashes.end());
    if (mismatch.first != recorded.step_hashes.end()) {
        return differenceAt(first_step + (mismatch.first - recorded.step_hashes.begin()), recorded, now);
    }
    const auto last_step =
        first_step + std::max<std::int64_t>(static_cast<std::int64_t>(now.step_hashes.size()), 1) - 1;
    if (firstBody(recorded, now)) return differenceAt(last_step, recorded, now);
    return std::nullopt;
}

}  // namespace

Settings settingsOf(const RecordingInfo& info) {
    Settings settings;
    try {
        for (const auto& [name, text] : info.settings) setFieldFromText(settings, name, text);
    } catch (const InputError& error) {
        throw IoError(fmt::format("the recording's settings are refused: {}", error.what()));
    }
    return settings;
}

std::optional<RecordingDifference> verifyRecording(const RecordingReader& recording, std::int64_t threads) {
    const RecordingInfo& info = recording.info();
    if (info.frames == 0) throw InputError("the recording has no frames; there is nothing to verify");
    if (recording.frame(0).time != 0) {
        throw InputError(fmt::format(
            "the recording begins at {} s, after 'cairn resume'; only one that begins with its scene can be verified",
            recording.frame(0).time));
    }
    Settings settings = settingsOf(info);
    settings.parallel.threads = threads;
    SceneRun run(info.scene, settings);
    Frame first = recording.frame(0);
    first.step_hashes.clear();
    if (auto difference = compare(first, captureFrame(run, {}), 0)) {
        return difference;
    }
    for (std::size_t i = 1; i < info.frames; ++i) {
        const std::int64_t first_step = run.world().stepCount() + 1;
        std::vector<std::uint64_t> hashes;
        do {
            run.step();
            hashes.push_back(run.world().stateHash());
        } while (!isFrameDue(run, info.frame_rate));
        Frame now = captureFrame(run, {});
        now.step_hashes = hashes;
        if (auto difference = compare(recording.frame(i), now, first_step)) return difference;
    }
    return std::nullopt;
}

}  // namespace cairn
