#include "world/saved_filter.h"

#include <algorithm>

#include "world/saved_fields.h"

namespace cairn {

void saveFilter(const BodyStorage& bodies, ByteWriter& out) {
    const PairFilter& filter = bodies.filter;
    const auto count = static_cast<std::uint32_t>(filter.groups().size());
    out.put(count);
    for (const std::string& name : filter.groups()) out.putText(name);
    for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = a; b < count; ++b) {
            out.put(filter.ofGroups(static_cast<GroupId>(a), static_cast<GroupId>(b)));
        }
    }
    saveList(out, filter.exceptions(), [&](const PairException& exception) {
        out.put(bodies.homeOf(exception.a));
        out.put(bodies.homeOf(exception.b));
        out.put(exception.touch);
    });
}

void loadFilter(ByteReader& in, BodyStorage& bodies) {
    PairFilter& filter = bodies.filter;
    const auto count = in.get<std::uint32_t>();
    try {
        for (std::uint32_t i = 0; i < count; ++i) filter.addGroup(in.getText());
    } catch (const StaleIdError&) {
        throw;
    } catch (const InputError& error) {
        in.refuse(error.what());
    }
    for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = a; b < count; ++b) {
            filter.setGroups(static_cast<GroupId>(a), static_cast<GroupId>(b), in.getEnum(Touch::always));
        }
    }
    const auto exists = [&](BodyIndex i) { return i < bodies.slots() && bodies.kind[i] != BodyKind::hole; };
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
        const auto a = in.get<BodyIndex>();
        const auto b = in.get<BodyIndex>();
        if (!exists(a) || !exists(b) || a == b) in.refuse("an exception of unknown bodies");
        filter.setPair(a, b, in.getEnum(Touch::always));
    }
    const std::uint64_t known = count < most_groups ? (std::uint64_t{1} << count) - 1 : UINT64_MAX;
    if (std::ranges::any_of(bodies.groups, [&](std::uint64_t groups) { return (groups & ~known) != 0; })) {
        in.refuse("a body in an unknown group");
    }
}

void saveSensed(std::span<const Sensed> sensed, ByteWriter& out) {
    saveList(out, sensed, [&](const Sensed& s) {
        for (const BodyId id : {s.sensor, s.body}) {
            out.put(id.index);
            out.put(id.generation);
        }
    });
}

void loadSensed(ByteReader& in, std::vector<Sensed>& sensed) {
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
        Sensed& s = sensed.emplace_back();
        for (BodyId* id : {&s.sensor, &s.body}) {
            id->index = in.get<std::uint32_t>();
            id->generation = in.get<std::uint32_t>();
        }
    }
}

}  // namespace cairn
