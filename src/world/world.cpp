#include "cairn/world.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "world/motions.h"
#include "world/parts.h"
#include "world/step_rate.h"
#include "world/stillness.h"
#include "world/world_state.h"

namespace cairn {

WorldState::WorldState(const Settings& initial) {
    applySettings(initial);
}

void WorldState::applySettings(const Settings& s) {
    still_steps = 0;
    const auto threads = static_cast<std::size_t>(s.parallel.threads);
    if (corrections.size() != threads || s.correction.correction != settings.correction.correction) {
        corrections.clear();
        for (std::size_t t = 0; t < threads; ++t) corrections.push_back(makeCorrection(s.correction.correction));
    }
    if (resolution == nullptr || s.resolution.resolution != settings.resolution.resolution) {
        resolution = makeResolution(s.resolution.resolution);
    }
    executor = Executor(static_cast<int>(threads));
    if (s.steps_per_second != settings.steps_per_second) {
        steps_at_start = steps;
        time_at_start = time;
    }
    settings = s;
    if (foresees(s)) return;
    // What follows from mean velocities is not the thesis's.
    std::ranges::fill(bodies.mean_v, Vec3::Zero());
    std::ranges::fill(bodies.mean_w, Vec3::Zero());
}

void WorldState::wakeAll() {
    const BodyState state = bodies.state();
    for (BodyIndex i = 0; i < state.size(); ++i) state.wake(i, WakeReason::changed);
}

namespace {

/// Whether ranks may have the one and the other: results do not depend on the threads.
bool differInThreadsAlone(const Settings& a, const Settings& b) {
    return a.steps_per_second == b.steps_per_second &&
           std::ranges::all_of(settingFields(), [&](const SettingField& field) {
               return field.name == "threads" || field.get(a) == field.get(b);
           });
}

}  // namespace

World::World(const Settings& settings) {
    validate(settings, Vec3::Zero());
    state_ = std::make_unique<WorldState>(settings);
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

MaterialId World::addMaterial(const Material& material) {
    beginChange(*state_, "World::addMaterial");
    state_->lasting.reset();
    return state_->materials.add(material);
}

std::span<const Material> World::materials() const {
    return state_->materials.all();
}

void World::setDefaultPairProperties(const PairProperties& properties) {
    beginChange(*state_, "World::setDefaultPairProperties");
    state_->lasting.reset();
    state_->materials.setDefault(properties);
    state_->data.pairs.forgetContacts();
}

void World::setPairProperties(MaterialId a, MaterialId b, const PairProperties& properties) {
    beginChange(*state_, "World::setPairProperties");
    state_->lasting.reset();
    state_->materials.setPair(a, b, properties);
    state_->data.pairs.forgetContacts();
}

void World::setPairLaw(MaterialId a, MaterialId b, const PairLaw& law) {
    beginChange(*state_, "World::setPairLaw");
    state_->lasting.reset();
    state_->materials.setLaw(a, b, law);
    state_->data.pairs.forgetContacts();
}

PairLaw World::pairLaw(MaterialId a, MaterialId b) const {
    static_cast<void>(pairProperties(a, b));
    const PairLaw* law = state_->materials.law(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    return law != nullptr ? *law : PairLaw{};
}

PairProperties World::pairProperties(MaterialId a, MaterialId b) const {
    for (const MaterialId id : {a, b}) {
        if (!state_->materials.contains(id)) {
            throw InputError(fmt::format("material {} is unknown; the world has {} materials",
                                         static_cast<std::uint32_t>(id), state_->materials.all().size()));
        }
    }
    return state_->materials.pair(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
}

void World::setGlobalAcceleration(const Vec3& acceleration) {
    beginChange(*state_, "World::setGlobalAcceleration");
    validate(state_->settings, lastingGravity(state_->gravity, state_->gravity_law) + acceleration);
    if (acceleration == state_->global_acceleration) return;
    state_->global_acceleration = acceleration;
    state_->wakeAll();
}

Vec3 World::globalAcceleration() const {
    return state_->global_acceleration;
}

void World::step() {
    if (!isDivided() || !state_->dealt_extents.empty()) settleSteps(*state_);
    stepWorld(*state_);
}

void World::setChecks(Checks checks) {
    state_->checks = checks;
}

double World::time() const {
    return state_->time;
}

std::int64_t World::stepCount() const {
    return state_->steps;
}

double World::stepsPerSecondBySize() const {
    const int exponent = state_->sized ? state_->step_exponent : stepExponentOf(*state_).value_or(0);
    return withKnownSteps(Settings{}, exponent).steps_per_second;
}

const Settings& World::settings() const {
    return state_->settings;
}

void World::setSettings(const Settings& settings) {
    if (!differInThreadsAlone(settings, state_->settings)) beginChange(*state_, "World::setSettings");
    validate(settings, lastingGravity(state_->gravity, state_->gravity_law) + state_->global_acceleration);
    state_->applySettings(state_->sized ? withKnownSteps(settings, state_->step_exponent) : settings);
}

}  // namespace cairn
