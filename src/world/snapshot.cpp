#include "world/snapshot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "math/rotation.h"
#include "world/limits.h"
#include "world/motions.h"
#include "world/saved_fields.h"
#include "world/saved_filter.h"
#include "world/saved_joints.h"
#include "world/saved_motions.h"
#include "world/snapshot_pieces.h"

namespace cairn {

namespace {

void saveSettings(const Settings& settings, ByteWriter& out) {
    out.put(std::uint64_t{settingFields().size()});
    for (const SettingField& field : settingFields()) {
        const SettingValue value = field.get(settings);
        out.putText(field.name);
        out.put(static_cast<std::uint8_t>(value.index()));
        if (const auto* on = std::get_if<bool>(&value)) out.put(static_cast<std::uint8_t>(*on));
        if (const auto* whole = std::get_if<std::int64_t>(&value)) out.put(*whole);
        if (const auto* number = std::get_if<double>(&value)) out.put(*number);
        if (const auto* name = std::get_if<std::string>(&value)) out.putText(*name);
    }
    out.put(static_cast<std::uint8_t>(settings.steps_per_second.isBySize()));
}

SettingValue loadSettingValue(ByteReader& in) {
    switch (in.get<std::uint8_t>()) {
        case 0:
            return in.get<std::uint8_t>() != 0;
        case 1:
            return in.get<std::int64_t>();
        case 2:
            return in.get<double>();
        case 3:
            return in.getText();
        default:
            in.refuse("an unknown type of setting");
    }
}

Settings loadSettings(ByteReader& in) {
    constexpr std::string_view others =
        "another setting than this program has: use the Cairn that wrote it or run the scene again";
    Settings settings;
    if (in.get<std::uint64_t>() != settingFields().size()) in.refuse(others);
    for (const SettingField& field : settingFields()) {
        if (in.getText() != field.name) in.refuse(others);
        const SettingValue value = loadSettingValue(in);
        try {
            setField(settings, field.name, value);
        } catch (const InputError& error) {
            in.refuse(error.what());
        }
    }
    if (in.get<std::uint8_t>() != 0) settings.steps_per_second = StepRate::bySize(settings.steps_per_second);
    return settings;
}

void saveMaterials(const MaterialTable& materials, ByteWriter& out) {
    const auto count = static_cast<std::uint32_t>(materials.all().size());
    out.put(count);
    for (const Material& material : materials.all()) {
        out.putText(material.name);
        out.put(material.density);
    }
    PairProperties pair = materials.defaultPair();
    pairFields(out, pair);
    for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = a; b < count; ++b) {
            const PairProperties* own = materials.ownPair(a, b);
            out.put(static_cast<std::uint8_t>(own != nullptr));
            if (own != nullptr) pairFields(out, *own);
        }
    }
    saveList(out, materials.laws(), [&](const MaterialTable::LawOfPair& entry) {
        out.put(entry.a);
        out.put(entry.b);
        curveArrays(out, entry.law.restitution);
        curveArrays(out, entry.law.friction);
    });
}

void loadMaterials(ByteReader& in, MaterialTable& materials) {
    const auto count = in.get<std::uint32_t>();
    try {
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::string name = in.getText();
            materials.add({name, in.get<double>()});
        }
        PairProperties pair;
        pairFields(in, pair);
        materials.setDefault(pair);
        for (std::uint32_t a = 0; a < count; ++a) {
            for (std::uint32_t b = a; b < count; ++b) {
                if (in.get<std::uint8_t>() == 0) continue;
                pairFields(in, pair);
                materials.setPair(static_cast<MaterialId>(a), static_cast<MaterialId>(b), pair);
            }
        }
        for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
            const auto a = static_cast<MaterialId>(in.get<std::uint32_t>());
            const auto b = static_cast<MaterialId>(in.get<std::uint32_t>());
            PairLaw law;
            curveArrays(in, law.restitution);
            curveArrays(in, law.friction);
            materials.setLaw(a, b, law);
        }
    } catch (const StaleIdError&) {
        throw;
    } catch (const InputError& error) {
        in.refuse(error.what());
    }
}

/// Refuses what no world can be. Velocities may be anything, since the next step tells such a fault.
void checkBody(const ByteReader& in, const BodyStorage& b, BodyIndex i, std::size_t materials) {
    if (b.material[i] >= materials) in.refuse(fmt::format("body {} of an unknown material", i));
    if (!b.position[i].allFinite()) in.refuse(fmt::format("body {} at no place", i));
    if (!(std::abs(b.orientation[i].coeffs().squaredNorm() - 1) < 1e-6)) {
        in.refuse(fmt::format("body {} with an orientation that is no unit quaternion", i));
    }
    if (!b.p_BS[i].allFinite() || !(std::abs(b.R_BS[i].coeffs().squaredNorm() - 1) < 1e-6)) {
        in.refuse(fmt::format("body {} whose shape has no pose", i));
    }
    try {
        requireGravityFactor(b.gravity_factor[i]);
        requireDamping(b.linear_damping[i], "linear");
        requireDamping(b.angular_damping[i], "angular");
    } catch (const InputError& error) {
        in.refuse(error.what());
    }
    const bool runs = !b.surface_velocity[i].isZero(0);
    if (!b.surface_velocity[i].allFinite() || (runs && b.kind[i] != BodyKind::fixed)) {
        in.refuse(fmt::format("body {} with a surface that runs as none does", i));
    }
    if (b.kind[i] != BodyKind::dynamic) return;
    if (!isSolid(b.shape[i])) in.refuse(fmt::format("body {} that has no mass and moves", i));
    const bool heavy =
        b.mass[i] > 0 && std::isfinite(b.mass[i]) && b.inertia_B[i].allFinite() && (b.inertia_B[i].array() > 0).all();
    if (!heavy) in.refuse(fmt::format("body {} without a mass", i));
    if (!(b.r_max[i] > 0 && b.r_min[i] > 0)) in.refuse(fmt::format("body {} without a size", i));
}

void saveBodies(const BodyStorage& b, ByteWriter& out) {
    out.put(std::uint64_t{b.slots()});
    out.put(b.nextNumber());
    bodyFields(out, b, b.slots());
}

/// Refuses inverse masses that are not those of the masses: the response would give energy without end.
void checkMassProperties(const ByteReader& in, const BodyStorage& b, BodyIndex i) {
    const bool heavy = isUsableMass(b.mass[i]) && b.inertia_B[i].allFinite() && (b.inertia_B[i].array() > 0).all();
    if (isSolid(b.shape[i]) && !heavy) in.refuse(fmt::format("body {} without a mass", i));
    if (!isInfinite(b.shape[i]) && !(b.r_max[i] <= distance_limit)) in.refuse(fmt::format("body {} without end", i));
    Vec3 inverse_B = Vec3::Zero();
    Mat3 inverse_W = Mat3::Zero();
    double inverse = 0;
    if (b.kind[i] == BodyKind::dynamic) {
        inverse = 1 / b.mass[i];
        inverse_B = b.inertia_B[i].cwiseInverse();
        inverse_W = toWorldInertia(inverse_B, b.orientation[i]);
    }
    // Another compiler may have rounded otherwise.
    const bool fits = std::abs(b.mass_inv[i] - inverse) <= 1e-12 * inverse &&
                      ((b.inertiaInv_B[i] - inverse_B).cwiseAbs().array() <= 1e-12 * inverse_B.array()).all() &&
                      (b.inertiaInv_W[i] - inverse_W).cwiseAbs().maxCoeff() <= 1e-6 * inverse_B.maxCoeff();
    if (!fits) in.refuse(fmt::format("body {} with an inverse mass that is not that of its mass", i));
}

/// Refuses two slots with the same number, and numbers that a later body would get again.
void checkNumbers(const ByteReader& in, std::vector<std::uint64_t> numbers, std::uint64_t next_number) {
    std::ranges::sort(numbers);
    const bool unique = std::ranges::adjacent_find(numbers) == numbers.end();
    if (!unique || (!numbers.empty() && numbers.back() >= next_number)) in.refuse("two bodies with the same number");
}

}  // namespace

void completeBodies(const ByteReader& in, std::size_t materials, std::uint64_t next_number, BodyStorage& b) {
    const std::size_t slots = b.kind.size();
    if (std::ranges::any_of(b.kind, [](BodyKind kind) { return kind > BodyKind::dynamic; }) ||
        std::ranges::any_of(b.woken, [](WakeReason reason) { return reason > WakeReason::floating; }) ||
        std::ranges::any_of(b.load, [](Load load) { return load > Load::pulled; }) ||
        std::ranges::any_of(b.asleep, [](std::uint8_t asleep) { return asleep > 1; }) ||
        std::ranges::any_of(b.sensor, [](std::uint8_t sensor) { return sensor > 1; })) {
        in.refuse("an unknown state of a body");
    }
    checkNumbers(in, {b.number.begin(), b.number.end()}, next_number);
    b.adoptSlots(next_number);
    for (BodyIndex i = 0; i < slots; ++i) {
        if (b.kind[i] == BodyKind::hole) continue;
        checkBody(in, b, i, materials);
        checkMassProperties(in, b, i);
    }
}

namespace {

void loadBodies(ByteReader& in, std::size_t materials, BodyStorage& b) {
    const auto slots = in.get<std::uint64_t>();
    const auto next_number = in.get<std::uint64_t>();
    bodyFields(in, b, slots);
    completeBodies(in, materials, next_number, b);
}

void loadSprings(ByteReader& in, const BodyStorage& bodies, std::vector<Spring>& springs) {
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
        Spring& spring = springs.emplace_back();
        springFields(in, spring);
        if (!spring.present) continue;
        const auto exists = [&](BodyIndex i) { return i < bodies.slots() && bodies.kind[i] != BodyKind::hole; };
        if (!exists(spring.a) || (spring.b != Spring::world_point && !exists(spring.b))) {
            in.refuse("a spring of an unknown body");
        }
        const bool sound = spring.anchor_a.allFinite() && spring.anchor_b.allFinite() &&
                           isFiniteAndNotNegative(spring.stiffness) && isFiniteAndNotNegative(spring.damping) &&
                           isFiniteAndNotNegative(spring.rest_length);
        if (!sound) in.refuse("a spring that no world has");
    }
}

/// Offsets that begin at 0, never fall and end at the number of entries.
bool areOffsets(const std::vector<std::uint32_t>& begin, std::size_t entries) {
    if (begin.empty()) return entries == 0;
    return begin.front() == 0 && begin.back() == entries && std::ranges::is_sorted(begin);
}

bool areBelow(const std::vector<std::uint32_t>& indices, std::size_t limit) {
    return std::ranges::all_of(indices, [&](std::uint32_t index) { return index < limit; });
}

void loadBatches(ByteReader& in, StepData& data) {
    const std::size_t count = data.contacts.size();
    Batches& batches = data.batches;
    batchArrays(in, batches);
    const bool sound = areBelow(batches.bodies, data.generation.size()) && areBelow(batches.contacts, count) &&
                       areOffsets(batches.body_begin, batches.bodies.size()) &&
                       areOffsets(batches.contact_begin, batches.contacts.size()) &&
                       batches.body_begin.size() == batches.contact_begin.size() &&
                       batches.batch_of_contact.size() == count && areBelow(batches.batch_of_contact, batches.size());
    if (!sound) in.refuse("batches that do not fit the contacts");
}

}  // namespace

namespace {

/// What names two bodies, with what the whole world calls them.
template <class Pair>
Pair withHomes(const BodyStorage& bodies, Pair pair) {
    pair.a = bodies.homeOf(pair.a);
    pair.b = bodies.homeOf(pair.b);
    return pair;
}

}  // namespace

void saveContacts(const BodyStorage& bodies, const std::vector<Contact>& contacts, ByteWriter& out) {
    saveList(out, contacts, [&](const Contact& contact) {
        const Contact named = withHomes(bodies, contact);
        contactFields(out, named);
    });
}

void loadContacts(ByteReader& in, std::size_t slots, std::vector<Contact>& contacts) {
    BodyPair last;
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
        Contact& contact = contacts.emplace_back();
        contactFields(in, contact);
        const bool known = contact.a < contact.b && contact.b < slots;
        if (!known) in.refuse("a contact of an unknown body");
        const BodyPair pair{contact.a, contact.b};
        if (pair < last) in.refuse("contacts out of order");
        last = pair;
    }
}

void saveFaults(const std::vector<FaultInfo>& faults, ByteWriter& out) {
    out.put(std::uint64_t{faults.size()});
    for (const FaultInfo& fault : faults) {
        out.put(fault.body.index);
        out.put(fault.body.generation);
        out.put(fault.step);
        out.putText(fault.what);
    }
}

void loadFaults(ByteReader& in, std::vector<FaultInfo>& faults) {
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
        FaultInfo& fault = faults.emplace_back();
        fault.body.index = in.get<std::uint32_t>();
        fault.body.generation = in.get<std::uint32_t>();
        fault.step = in.get<std::int64_t>();
        fault.what = in.getText();
    }
}

void saveEvents(const EventLog& log, ByteWriter& out) {
    out.put(log.level);
    saveList(out, log.events, [&](const Event& event) { eventFields(out, event); });
}

void loadEvents(ByteReader& in, EventLog& log) {
    log.level = in.getEnum(EventLevel::all);
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
        Event& event = log.events.emplace_back();
        eventFields(in, event);
        if (event.kind > EventKind::sensor_left || event.reason > WakeReason::floating) in.refuse("an unknown event");
    }
}

void checkWorld(const ByteReader& in, const WorldState& world) {
    try {
        validate(world.settings, lastingGravity(world.gravity, world.gravity_law) + world.global_acceleration);
    } catch (const InputError& error) {
        in.refuse(error.what());
    }
    const bool sound = world.steps >= 0 && world.steps_at_start >= 0 && world.steps_at_start <= world.steps &&
                       std::isfinite(world.time) && std::isfinite(world.time_at_start);
    if (!sound) in.refuse("a time that no world has");
    const auto isPart = [](std::int32_t units) {
        return units > 0 && units <= step_units && std::has_single_bit(static_cast<std::uint32_t>(units));
    };
    if (!isPart(world.next_part.units) || !isPart(world.next_part.wanted))
        in.refuse("a part of a step that no world has");
    if (world.data.generation.size() > world.bodies.slots()) in.refuse("contacts of more bodies than there are");
}

void saveHead(const WorldState& world, ByteWriter& out) {
    saveSettings(world.settings, out);
    saveMaterials(world.materials, out);
    worldFields(out, world);
}

std::unique_ptr<WorldState> loadHead(ByteReader& in) {
    const Settings settings = loadSettings(in);
    auto world = std::make_unique<WorldState>(settings);
    loadMaterials(in, world->materials);
    worldFields(in, *world);
    return world;
}

void saveTies(const WorldState& world, ByteWriter& out) {
    const BodyStorage& bodies = world.bodies;
    saveFilter(bodies, out);
    saveMotions(world, out);
    saveList(out, world.springs, [&](const Spring& spring) {
        const Spring named = withHomes(bodies, spring);
        springFields(out, named);
    });
    saveList(out, world.joints, [&](const Joint& joint) {
        const Joint named = withHomes(bodies, joint);
        jointFields(out, named);
    });
}

void loadTies(ByteReader& in, WorldState& world) {
    loadFilter(in, world.bodies);
    loadMotions(in, world);
    loadSprings(in, world.bodies, world.springs);
    loadJoints(in, world.bodies, world.joints);
}

void saveWorld(const WorldState& world, ByteWriter& out) {
    saveHead(world, out);
    saveBodies(world.bodies, out);
    saveTies(world, out);
    out.putArray(std::span(world.data.generation));
    saveContacts(world.bodies, world.data.contacts, out);
    batchArrays(out, world.data.batches);
    saveSensed(world.data.sensed, out);
    statisticsFields(out, world.statistics);
    saveFaults(world.faults, out);
    saveEvents(world.events, out);
}

std::unique_ptr<WorldState> loadWorld(ByteReader& in) {
    std::unique_ptr<WorldState> world = loadHead(in);
    loadBodies(in, world->materials.all().size(), world->bodies);
    loadTies(in, *world);
    in.getArray(world->data.generation);
    loadContacts(in, world->data.generation.size(), world->data.contacts);
    loadBatches(in, world->data);
    loadSensed(in, world->data.sensed);
    statisticsFields(in, world->statistics);
    loadFaults(in, world->faults);
    loadEvents(in, world->events);
    checkWorld(in, *world);
    world->data.pairs.adopt(world->data.contacts);
    return world;
}

}  // namespace cairn
