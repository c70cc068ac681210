#include "world/saved_motions.h"

#include <cmath>

#include "world/saved_fields.h"

namespace cairn {

namespace {

template <class Stream, class Law>
void lawFields(Stream& stream, Law& law) requires requires {
    law.velocity;
}
{
    field(stream, law.velocity);
    field(stream, law.spin);
}

template <class Stream, class Law>
void lawFields(Stream& stream, Law& law) requires requires {
    law.amplitude;
}
{
    field(stream, law.amplitude);
    field(stream, law.turn);
    field(stream, law.frequency);
    field(stream, law.phase);
}

template <class Stream, class Law>
void lawFields(Stream& stream, Law& law) requires requires {
    law.times;
}
{
    array(stream, law.times);
    array(stream, law.displacements);
    array(stream, law.turns);
    array(stream, law.velocities);
}

void saveMotion(const Motion& motion, ByteWriter& out) {
    out.put(static_cast<std::uint8_t>(motion.index()));
    std::visit([&](const auto& law) { lawFields(out, law); }, motion);
    if (const auto* table = std::get_if<TableMotion>(&motion)) out.put(table->end);
}

template <class Law>
Motion loadLaw(ByteReader& in) {
    Law law;
    lawFields(in, law);
    if constexpr (std::is_same_v<Law, TableMotion>) law.end = in.getEnum(TableEnd::repeat);
    return law;
}

std::shared_ptr<const MotionCurve> loadCurve(ByteReader& in) {
    const auto kind = in.get<std::uint8_t>();
    if (kind >= std::variant_size_v<Motion>) in.refuse("an unknown law of motion");
    const Motion motion = kind == 0   ? loadLaw<ConstantMotion>(in)
                          : kind == 1 ? loadLaw<SineMotion>(in)
                                      : loadLaw<TableMotion>(in);
    try {
        return std::make_shared<const MotionCurve>(motion);
    } catch (const InputError& error) {
        in.refuse(error.what());
    }
}

template <class Stream, class Driven>
void drivenFields(Stream& stream, Driven& driven) {
    field(stream, driven.body);
    field(stream, driven.start);
    field(stream, driven.pose.position);
    field(stream, driven.pose.orientation);
    field(stream, driven.pivot);
}

/// A law of the whole world, if it has one. @param save what it has of its own
template <class Law, class Save>
void saveOptional(const std::optional<Law>& law, ByteWriter& out, const Save& save) {
    out.put(static_cast<std::uint8_t>(law.has_value()));
    if (!law) return;
    out.put(law->start);
    save(*law);
    saveMotion(law->curve->motion(), out);
}

template <class Law, class Load>
void loadOptional(ByteReader& in, std::optional<Law>& law, const Load& load) {
    if (in.get<std::uint8_t>() == 0) return;
    law.emplace();
    law->start = in.get<double>();
    load(*law);
    law->curve = loadCurve(in);
    if (!std::isfinite(law->start) || law->curve->turns()) in.refuse("a law of the whole world as there is none");
}

bool isSound(const DrivenBody& driven, const BodyStorage& bodies) {
    return driven.body < bodies.slots() && bodies.kind[driven.body] == BodyKind::fixed && std::isfinite(driven.start) &&
           driven.pose.position.allFinite() && driven.pivot.allFinite() &&
           std::abs(driven.pose.orientation.coeffs().squaredNorm() - 1) < 1e-6;
}

}  // namespace

void saveMotions(const WorldState& world, ByteWriter& out) {
    saveList(out, world.driven, [&](DrivenBody driven) {
        driven.body = world.bodies.homeOf(driven.body);
        drivenFields(out, driven);
        saveMotion(driven.curve->motion(), out);
    });
    saveOptional(world.frame, out, [](const FrameMotion&) {});
    saveOptional(world.gravity_law, out, [&](const GravityLaw& law) { field(out, law.gravity); });
}

void loadMotions(ByteReader& in, WorldState& world) {
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
        DrivenBody driven;
        drivenFields(in, driven);
        driven.body = world.bodies.slotOf(driven.body);
        const bool follows = world.driven.empty() || world.driven.back().body < driven.body;
        if (!follows || !isSound(driven, world.bodies)) in.refuse("a motion of an unknown body");
        driven.curve = loadCurve(in);
        world.driven.push_back(std::move(driven));
    }
    loadOptional(in, world.frame, [](FrameMotion&) {});
    loadOptional(in, world.gravity_law, [&](GravityLaw& law) {
        field(in, law.gravity);
        if (!law.gravity.allFinite()) in.refuse("a law of a gravity that no world has");
    });
}

}  // namespace cairn
