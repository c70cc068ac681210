#include "world/pair_laws.h"

#include <algorithm>
#include <cmath>

#include "batches/batch_motion.h"

namespace cairn {

namespace {

void apply(const PairLaw& law, const PairProperties& properties, const BodyState& bodies, Contact& contact) {
    const Vec3 velocity = relativeVelocity(contact, bodies);
    const double along = contact.normal.dot(velocity);
    if (!std::isfinite(velocity.squaredNorm())) return;
    if (!law.restitution.speeds.empty()) contact.restitution = valueAt(law.restitution, std::max(-along, 0.0));
    if (law.friction.speeds.empty()) return;
    contact.kinetic_friction = valueAt(law.friction, (velocity - along * contact.normal).norm());
    contact.static_friction = std::max(properties.static_friction, contact.kinetic_friction);
}

void apply(const WorldState& world, const BodyState& bodies, Contact& contact) {
    const std::uint32_t a = world.bodies.material[contact.a];
    const std::uint32_t b = world.bodies.material[contact.b];
    if (const PairLaw* law = world.materials.law(a, b)) apply(*law, world.materials.pair(a, b), bodies, contact);
}

}  // namespace

void applyPairLaws(WorldState& world, const BodyState& bodies) {
    if (world.materials.laws().empty()) return;
    std::vector<Contact>& contacts = world.data.contacts;
    world.executor.forBlocks(contacts.size(), [&](std::size_t begin, std::size_t end, int) {
        for (Contact& contact : std::span(contacts).subspan(begin, end - begin)) apply(world, bodies, contact);
    });
}

void applyPairLaws(WorldState& world, const BodyState& bodies, std::span<const std::uint32_t> some) {
    if (world.materials.laws().empty()) return;
    for (const std::uint32_t i : some) apply(world, bodies, world.data.contacts[i]);
}

}  // namespace cairn
