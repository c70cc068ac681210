#include "frame_message.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn::view {

namespace {

constexpr std::uint32_t frame_kind = 1;

enum class Section : std::uint32_t {
    position = 1,
    orientation,
    flags,
    speed,
    batch,
    overlap,
    level,
    stage,
    bounds,
    moves,
    contacts,
    springs,
    joints,
    rays
};

constexpr std::uint8_t flag_present = 1;
constexpr std::uint8_t flag_asleep = 2;
constexpr std::uint8_t flag_fixed = 4;
constexpr std::uint32_t no_batch = UINT32_MAX;
constexpr std::uint32_t no_slot = UINT32_MAX;

constexpr std::array<std::pair<std::string_view, Layer>, 9> names = {{{"speed", Layer::speed},
                                                                      {"batch", Layer::batch},
                                                                      {"overlap", Layer::overlap},
                                                                      {"level", Layer::level},
                                                                      {"stage", Layer::stage},
                                                                      {"bounds", Layer::bounds},
                                                                      {"moves", Layer::moves},
                                                                      {"contacts", Layer::contacts},
                                                                      {"joints", Layer::joints}}};

constexpr Layers traced_layers = bit(Layer::level) | bit(Layer::stage) | bit(Layer::bounds) | bit(Layer::moves);

template <typename Number>
void putSection(ByteWriter& out, Section section, const std::vector<Number>& values) {
    out.put(section);
    out.put(static_cast<std::uint32_t>(values.size() * sizeof(Number)));
    out.putAll(std::span<const Number>(values));
    out.align();
}

void set(std::vector<float>& values, std::size_t at, const Vec3& v) {
    for (int k = 0; k < 3; ++k) values[at + static_cast<std::size_t>(k)] = static_cast<float>(v[k]);
}

std::int16_t packed(double unit) {
    return static_cast<std::int16_t>(std::lround(std::clamp(unit, -1.0, 1.0) * 32767));
}

void putPoses(ByteWriter& out, const World& world, const std::vector<BodyId>& bodies, std::size_t slots) {
    std::vector<float> position(3 * slots);
    std::vector<std::int16_t> orientation(4 * slots);
    std::vector<std::uint8_t> flags(slots);
    for (const BodyId id : bodies) {
        const std::size_t slot = id.index;
        const Pose pose = world.pose(id);
        set(position, 3 * slot, pose.position);
        const Quat& q = pose.orientation;
        const std::array parts = {q.x(), q.y(), q.z(), q.w()};
        for (std::size_t k = 0; k < 4; ++k) orientation[4 * slot + k] = packed(parts[k]);
        flags[slot] = static_cast<std::uint8_t>(flag_present | (world.isAsleep(id) ? flag_asleep : 0) |
                                                (world.isFixed(id) ? flag_fixed : 0));
    }
    putSection(out, Section::position, position);
    putSection(out, Section::orientation, orientation);
    putSection(out, Section::flags, flags);
}

void putSpeeds(ByteWriter& out, const World& world, const std::vector<BodyId>& bodies, std::size_t slots) {
    std::vector<float> speed(slots);
    for (const BodyId id : bodies) speed[id.index] = static_cast<float>(world.linearVelocity(id).norm());
    putSection(out, Section::speed, speed);
}

/// The smallest slot of each batch stands for it, since it changes less from step to step than the batch's index.
void putBatches(ByteWriter& out, const World& world, std::size_t slots) {
    std::vector<std::uint32_t> batch(slots, no_batch);
    for (const BatchInfo& info : world.batches()) {
        for (const BodyId id : info.bodies) {
            if (id.index < slots) batch[id.index] = info.bodies.front().index;
        }
    }
    putSection(out, Section::batch, batch);
}

void putOverlaps(ByteWriter& out, const std::vector<ContactInfo>& contacts, std::size_t slots) {
    std::vector<float> overlap(slots);
    for (const ContactInfo& contact : contacts) {
        for (const BodyId id : {contact.a, contact.b}) {
            if (id.index < slots)
                overlap[id.index] = std::max(overlap[id.index], static_cast<float>(-contact.distance));
        }
    }
    putSection(out, Section::overlap, overlap);
}

void putVectors(ByteWriter& out, std::initializer_list<Vec3> vectors) {
    for (const Vec3& v : vectors) {
        for (int k = 0; k < 3; ++k) out.put(static_cast<float>(v[k]));
    }
}

void putContacts(ByteWriter& out, const std::vector<ContactInfo>& contacts) {
    constexpr std::size_t contact_bytes = 48;
    out.put(Section::contacts);
    out.put(static_cast<std::uint32_t>(contacts.size() * contact_bytes));
    for (const ContactInfo& contact : contacts) {
        out.put(contact.a.index);
        out.put(contact.b.index);
        out.put(static_cast<float>(contact.distance));
        putVectors(out, {contact.point, contact.normal, contact.impulse});
    }
}

void putJoints(ByteWriter& out, const World& world) {
    constexpr std::size_t joint_bytes = 48;
    const std::vector<JointId> ids = world.joints();
    out.put(Section::joints);
    out.put(static_cast<std::uint32_t>(ids.size() * joint_bytes));
    for (const JointId id : ids) {
        const JointInfo joint = world.joint(id);
        out.put(static_cast<std::uint32_t>(joint.kind));
        out.put(joint.a.index);
        out.put(joint.b ? joint.b->index : no_slot);
        putVectors(out, {joint.anchor_a, joint.anchor_b, joint.axis});
    }
}

/// What the world traces of each body.
struct Traces {
    std::vector<std::int8_t> level;
    std::vector<std::int16_t> stage;
    std::vector<float> bounds;
    std::vector<float> moves;
};

void putTraces(ByteWriter& out, const World& world, const std::vector<BodyId>& bodies, std::size_t slots,
               Layers layers) {
    Traces traces{std::vector<std::int8_t>(slots, -1), std::vector<std::int16_t>(slots, -1),
                  std::vector<float>(6 * slots), std::vector<float>(3 * slots)};
    for (const BodyId id : bodies) {
        const std::size_t slot = id.index;
        const BodyTrace trace = world.trace(id);
        traces.level[slot] = static_cast<std::int8_t>(std::clamp(trace.level, -1, 127));
        traces.stage[slot] = static_cast<std::int16_t>(std::clamp(trace.shock_stage, -1, 32767));
        set(traces.bounds, 6 * slot, trace.bounds_lower);
        set(traces.bounds, 6 * slot + 3, trace.bounds_upper);
        set(traces.moves, 3 * slot, trace.correction);
    }
    if ((layers & bit(Layer::level)) != 0) putSection(out, Section::level, traces.level);
    if ((layers & bit(Layer::stage)) != 0) putSection(out, Section::stage, traces.stage);
    if ((layers & bit(Layer::bounds)) != 0) putSection(out, Section::bounds, traces.bounds);
    if ((layers & bit(Layer::moves)) != 0) putSection(out, Section::moves, traces.moves);
}

void putSprings(ByteWriter& out, const std::vector<SpringLine>& springs) {
    std::vector<float> ends(6 * springs.size());
    for (std::size_t i = 0; i < springs.size(); ++i) {
        set(ends, 6 * i, springs[i].from);
        set(ends, 6 * i + 3, springs[i].to);
    }
    putSection(out, Section::springs, ends);
}

/// Where rays begin and hit, and the normal there; those that hit nothing are left out.
void putRays(ByteWriter& out, const World& world, const std::vector<Ray>& rays) {
    std::vector<float> lines;
    const std::vector<std::optional<RayHit>> hits = world.castRays(rays);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (!hits[i]) continue;
        const std::size_t at = lines.size();
        lines.resize(at + 9);
        set(lines, at, rays[i].origin);
        set(lines, at + 3, hits[i]->point);
        set(lines, at + 6, hits[i]->normal);
    }
    putSection(out, Section::rays, lines);
}

}  // namespace

std::optional<Layer> layerFromName(std::string_view name) {
    for (const auto& [known, layer] : names) {
        if (known == name) return layer;
    }
    return std::nullopt;
}

std::string layerNames() {
    std::string all;
    for (const auto& entry : names) all += (all.empty() ? "" : ", ") + std::string(entry.first);
    return all;
}

SharedMessage makeFrameMessage(const World& world, const std::vector<BodyId>& bodies, std::uint32_t epoch,
                               Layers layers, const Additions& additions) {
    const std::size_t slots = bodies.empty() ? 0 : bodies.back().index + std::size_t{1};
    const auto wanted = [&](Layer layer) { return (layers & bit(layer)) != 0; };
    ByteWriter out;
    out.put(frame_kind);
    out.put(epoch);
    out.put(static_cast<std::uint64_t>(world.stepCount()));
    out.put(world.time());
    out.put(static_cast<std::uint32_t>(slots));
    out.put(std::uint32_t{0});
    putPoses(out, world, bodies, slots);
    if (wanted(Layer::speed)) putSpeeds(out, world, bodies, slots);
    if (wanted(Layer::batch)) putBatches(out, world, slots);
    if (wanted(Layer::overlap) || wanted(Layer::contacts)) {
        const std::vector<ContactInfo> contacts = world.contacts();
        if (wanted(Layer::overlap)) putOverlaps(out, contacts, slots);
        if (wanted(Layer::contacts)) putContacts(out, contacts);
    }
    if ((layers & traced_layers) != 0) putTraces(out, world, bodies, slots, layers);
    if (wanted(Layer::joints)) putJoints(out, world);
    if (!additions.springs.empty()) putSprings(out, additions.springs);
    if (!additions.rays.empty()) putRays(out, world, additions.rays);
    return std::make_shared<const Message>(Message{Message::Kind::binary, out.take()});
}

}  // namespace cairn::view
