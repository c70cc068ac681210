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

}  // namespace

void applyPairLaws(WorldState& world, const BodyState& bodies) {
    const MaterialTable& materials = world.materials;
    if (materials.laws().empty()) return;
    std::vector<Contact>& contacts = world.data.contacts;
    const FieldArray<std::uint32_t>& material = world.bodies.material;
    world.executor.forBlocks(contacts.size(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t a = material[contacts[i].a];
            const std::uint32_t b = material[contacts[i].b];
            if (const PairLaw* law = materials.law(a, b)) apply(*law, materials.pair(a, b), bodies, contacts[i]);
        }
    });
}

}  // namespace cairn
