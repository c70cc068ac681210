#include "clip.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "describe.h"
#include "gzip.h"
#include "samples.h"
#include "wire.h"

namespace cairn::view {

using nlohmann::json;

namespace {

constexpr std::uint32_t clip_version = 3;
constexpr std::uint8_t clip_present = 1;
constexpr std::uint8_t clip_asleep = 2;
constexpr std::uint8_t clip_fixed = 4;

/// Larger numbers would not survive JavaScript's arithmetic; bodies so far away are not seen.
constexpr double largest_whole = 1e14;

/// Whole numbers, each written as the difference to what the last rows predict, in as few bytes as it needs.
class DeltaStream {
  public:
    enum class Prediction { last, line };

    DeltaStream(std::size_t width, double unit, Prediction prediction)
        : unit_(unit), prediction_(prediction), last_(width), before_(width) {}

    void put(std::size_t column, double value) {
        const double whole = std::isfinite(value) ? std::round(value / unit_) : 0;
        next(column, static_cast<std::int64_t>(std::clamp(whole, -largest_whole, largest_whole)));
    }
    /// The value of the last row once more.
    void repeat(std::size_t column) { next(column, last_[column]); }
    /// The present value of a column in the last row.
    double last(std::size_t column) const { return static_cast<double>(last_[column]) * unit_; }
    void endRow() {
        std::swap(last_, before_);
        ++rows_;
    }
    std::string take() { return bytes_.take(); }

  private:
    /// Puts the value into the row before the last, which nobody needs any more.
    void next(std::size_t column, std::int64_t value) {
        std::int64_t predicted = last_[column];
        if (prediction_ == Prediction::line && rows_ > 1) predicted += last_[column] - before_[column];
        before_[column] = value;
        varint(value - predicted);
    }

    void varint(std::int64_t difference) {
        auto zigzag = (static_cast<std::uint64_t>(difference) << 1) ^ static_cast<std::uint64_t>(difference >> 63);
        while (zigzag > 127) {
            bytes_.put(static_cast<std::uint8_t>(zigzag | 128));
            zigzag >>= 7;
        }
        bytes_.put(static_cast<std::uint8_t>(zigzag));
    }

    double unit_;
    Prediction prediction_;
    std::vector<std::int64_t> last_;
    std::vector<std::int64_t> before_;
    std::size_t rows_ = 0;
    ByteWriter bytes_;
};

/// The streams of a clip.
class ClipWriter {
  public:
    explicit ClipWriter(const Scene& scene)
        : scene_(scene),
          positions_(3 * scene.bodies.size(), ClipUnits::position, DeltaStream::Prediction::line),
          orientations_(4 * scene.bodies.size(), ClipUnits::orientation, DeltaStream::Prediction::last),
          velocities_(3 * scene.bodies.size(), ClipUnits::velocity, DeltaStream::Prediction::last),
          spins_(3 * scene.bodies.size(), ClipUnits::spin, DeltaStream::Prediction::last) {}

    void put(const Frame& frame) {
        times_.put(frame.time);
        const std::size_t n = scene_.bodies.size();
        // Component by component: equal ones stand together and compress better.
        for (int k = 0; k < 3; ++k) putVectors(frame, positions_, frame.position, k);
        for (int k = 0; k < 3; ++k) putVectors(frame, velocities_, frame.linear_velocity, k);
        for (int k = 0; k < 3; ++k) putVectors(frame, spins_, frame.angular_velocity, k);
        putOrientations(frame);
        for (DeltaStream* stream : {&positions_, &orientations_, &velocities_, &spins_}) stream->endRow();
        for (std::size_t body = 0; body < n; ++body) {
            flags_.put(static_cast<std::uint8_t>((isPresent(frame, body) ? clip_present : 0) |
                                                 (frame.asleep[body] != 0 ? clip_asleep : 0) |
                                                 (scene_.bodies[body].fixed ? clip_fixed : 0)));
        }
        putContacts(frame);
        std::vector<double> values;
        appendSample({frame.time, frame.statistics, frame.kinetic_energy, frame.potential_energy}, values);
        samples_.putAll(std::span<const double>(values));
    }

    std::string finish(const json& header) {
        ByteWriter out;
        const std::string head = header.dump(-1, ' ', false, json::error_handler_t::replace);
        out.putText("CAIRNCLP");
        out.put(clip_version);
        out.put(static_cast<std::uint32_t>(head.size()));
        out.putText(head);
        for (const std::string& stream : {times_.take(), flags_.take(), positions_.take(), orientations_.take(),
                                          velocities_.take(), spins_.take(), samples_.take(), contacts_.take()}) {
            out.put(static_cast<std::uint64_t>(stream.size()));
            out.putText(stream);
        }
        return gzip(out.take());
    }

  private:
    /// Their number, then each as in the frames of a live world.
    void putContacts(const Frame& frame) {
        const auto putVector = [this](const Vec3& v) {
            for (int k = 0; k < 3; ++k) contacts_.put(static_cast<float>(v[k]));
        };
        contacts_.put(static_cast<std::uint32_t>(frame.contact_a.size()));
        for (std::size_t i = 0; i < frame.contact_a.size(); ++i) {
            contacts_.put(static_cast<std::uint32_t>(frame.contact_a[i]));
            contacts_.put(static_cast<std::uint32_t>(frame.contact_b[i]));
            contacts_.put(static_cast<float>(frame.contact_distance[i]));
            putVector(frame.contact_point[i]);
            putVector(frame.contact_normal[i]);
            putVector(frame.contact_impulse[i]);
        }
    }

    static bool isPresent(const Frame& frame, std::size_t body) { return frame.position[body].allFinite(); }

    void putVectors(const Frame& frame, DeltaStream& stream, const std::vector<Vec3>& values, int k) {
        for (std::size_t body = 0; body < values.size(); ++body) {
            const std::size_t column = 3 * body + static_cast<std::size_t>(k);
            if (isPresent(frame, body))
                stream.put(column, values[body][k]);
            else
                stream.repeat(column);
        }
    }

    /// q and −q are the same rotation: the one nearer to the last is taken.
    double signOf(const Frame& frame, std::size_t body) const {
        const Quat& q = frame.orientation[body];
        double likeness = 0;
        for (std::size_t k = 0; k < 4; ++k)
            likeness += q.coeffs()[static_cast<int>(k)] * orientations_.last(4 * body + k);
        return likeness < 0 ? -1 : 1;
    }

    void putOrientations(const Frame& frame) {
        for (std::size_t k = 0; k < 4; ++k) {
            for (std::size_t body = 0; body < scene_.bodies.size(); ++body) {
                const std::size_t column = 4 * body + k;
                if (isPresent(frame, body)) {
                    const double part = frame.orientation[body].coeffs()[static_cast<int>(k)];  // x, y, z, w
                    orientations_.put(column, signOf(frame, body) * part);
                } else {
                    orientations_.repeat(column);
                }
            }
        }
    }

    const Scene& scene_;
    ByteWriter times_, flags_, samples_, contacts_;
    DeltaStream positions_, orientations_, velocities_, spins_;
};

json describeSceneBody(const SceneRun& run, std::size_t index) {
    const Scene& scene = run.scene();
    const SceneBody& body = scene.bodies[index];
    std::size_t material = 0;
    while (material + 1 < scene.materials.size() && scene.materials[material].name != body.material) ++material;
    // As a live world tells of it, but by the numbers of the scene.
    json described = describeBody(run.world(), run.ids()[index]);
    described["slot"] = index;
    described["generation"] = 0;
    described["material"] = material;
    return described;
}

/// A line between two bodies, or a body and the world. @param b none = the world
json describeLine(std::size_t a, const std::optional<std::size_t>& b, const Vec3& anchor_a, const Vec3& anchor_b) {
    return {
        {"a", a}, {"b", b ? json(*b) : json(nullptr)}, {"anchorA", toJson(anchor_a)}, {"anchorB", toJson(anchor_b)}};
}

/// Joints in the frames of their bodies, so that the page can place them in every frame.
json describeJoints(const SceneRun& run) {
    const World& world = run.world();
    const std::vector<JointId> ids = world.joints();
    json all = json::array();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const SceneJoint& given = run.scene().joints[i];
        const JointInfo info = world.joint(ids[i]);
        const Pose a = world.pose(info.a);
        const Pose b = info.b ? world.pose(*info.b) : Pose{};
        const std::optional<std::size_t> other = info.b ? std::optional<std::size_t>(info.b->index) : std::nullopt;
        json joint = describeLine(info.a.index, other, a.toInner(info.anchor_a), b.toInner(info.anchor_b));
        joint["kind"] = static_cast<std::uint32_t>(info.kind);
        joint["axis"] = toJson(Vec3(b.orientation.conjugate() * info.axis));
        joint["length"] = given.joint.length.value_or((info.anchor_a - info.anchor_b).norm());
        joint["breaks"] = std::isfinite(given.joint.break_force) || std::isfinite(given.joint.break_torque);
        all.push_back(std::move(joint));
    }
    return all;
}

json describeSprings(const Scene& scene) {
    json all = json::array();
    for (const SceneSpring& spring : scene.springs) {
        all.push_back(describeLine(spring.a, spring.b, spring.anchor_a, spring.anchor_b));
    }
    return all;
}

json makeHeader(const RecordingInfo& info) {
    const SceneRun run(info.scene, settingsFor(info.scene));
    json bodies = json::array();
    for (std::size_t i = 0; i < info.scene.bodies.size(); ++i) bodies.push_back(describeSceneBody(run, i));
    json settings = json::object();
    for (const auto& [name, value] : info.settings) settings[name] = value;
    return {{"title", info.scene.name},
            {"version", info.version},
            {"machine", info.machine},
            {"settings", std::move(settings)},
            {"materials", toJson(info.scene.materials)},
            {"bodies", std::move(bodies)},
            {"joints", describeJoints(run)},
            {"springs", describeSprings(info.scene)},
            {"frames", info.frames},
            {"contacts", info.contacts},
            {"stages", describeStages()},
            {"sampleFields", sampleFields()},
            {"positionUnit", ClipUnits::position},
            {"orientationUnit", ClipUnits::orientation},
            {"velocityUnit", ClipUnits::velocity},
            {"spinUnit", ClipUnits::spin}};
}

}  // namespace

std::string makeClip(const RecordingReader& recording) {
    const RecordingInfo& info = recording.info();
    ClipWriter clip(info.scene);
    for (std::size_t i = 0; i < info.frames; ++i) clip.put(recording.frame(i));
    return clip.finish(makeHeader(info));
}

}  // namespace cairn::view
