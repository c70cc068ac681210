/// The part of World that reports what a step did and what the state amounts to.
#include <algorithm>
#include <bit>

#include "cairn/world.h"
#include "messages/packing.h"
#include "world/step_statistics.h"
#include "world/stillness.h"
#include "world/totals.h"
#include "world/world_state.h"

namespace cairn {

void Statistics::add(const Statistics& next) {
    for (std::size_t i = 0; i < stage_count; ++i) stage_ms[i] += next.stage_ms[i];
    contacts += next.contacts;
    penetrating_contacts += next.penetrating_contacts;
    corrected_contacts += next.corrected_contacts;
    uncorrected_contacts += next.uncorrected_contacts;
    displaced_bodies += next.displaced_bodies;
    global_iterations += next.global_iterations;
    shock_iterations += next.shock_iterations;
    shock_batches += next.shock_batches;
    batches += next.batches;
    largest_batch = std::max(largest_batch, next.largest_batch);
    asleep = next.asleep;
    woken += next.woken;
    largest_overlap = std::max(largest_overlap, next.largest_overlap);
    mean_overlap = next.mean_overlap;
    Diagnostics newer = next.diagnostics;
    for (const DiagnosticsField& field : diagnosticsFields()) {
        double& value = field.of(diagnostics);
        const double other = field.of(newer);
        switch (field.fold) {
            case DiagnosticsField::Fold::sum:
                value += other;
                break;
            case DiagnosticsField::Fold::newest:
                value = other;
                break;
            case DiagnosticsField::Fold::largest:
                value = std::max(value, other);
                break;
        }
    }
}

namespace {

/// Mixes 64 bits so that every input bit reaches every output bit (the finaliser of splitmix64, by Vigna).
std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
}

void feed(std::uint64_t& hash, std::uint64_t word) {
    hash = mix(hash + 0x9e3779b97f4a7c15U + word);
}

template <class Vector>
void feedAll(std::uint64_t& hash, const Vector& values) {
    // Adding zero turns −0 into +0: equal states have equal hashes.
    for (Eigen::Index i = 0; i < values.size(); ++i) feed(hash, std::bit_cast<std::uint64_t>(values[i] + 0.0));
}

/// Of one body, which its number names in whatever slot it is.
std::uint64_t hashOf(const BodyStorage& b, BodyIndex i) {
    std::uint64_t hash = 0;
    feed(hash, b.number[i]);
    feedAll(hash, b.position[i]);
    feedAll(hash, b.orientation[i].coeffs());
    feedAll(hash, b.v[i]);
    feedAll(hash, b.w[i]);
    feed(hash, std::uint64_t{b.asleep[i]});
    return hash;
}

}  // namespace

std::vector<ContactInfo> World::contacts() const {
    std::vector<ContactInfo> infos;
    contactsTo(infos);
    return infos;
}

void World::contactsTo(std::vector<ContactInfo>& infos) const {
    const StepData& data = state_->data;
    infos.clear();
    infos.reserve(data.contacts.size());
    for (std::size_t i = 0; i < data.contacts.size(); ++i) {
        const Contact& c = data.contacts[i];
        const BodyId a{state_->bodies.homeOf(c.a), data.generation[c.a]};
        const BodyId b{state_->bodies.homeOf(c.b), data.generation[c.b]};
        if (!contains(a) || !contains(b)) continue;
        infos.push_back(
            {a, b, c.point, c.normal, c.distance, c.impulse, c.angular_impulse, data.batches.batch_of_contact[i]});
    }
}

std::vector<BatchInfo> World::batches() const {
    const StepData& data = state_->data;
    std::vector<BatchInfo> infos(data.batches.size());
    for (std::size_t i = 0; i < infos.size(); ++i) {
        const BatchView batch = data.batches[i];
        infos[i].contacts = batch.contacts.size();
        for (const BodyIndex body : batch.bodies) {
            const BodyId id{state_->bodies.homeOf(body), data.generation[body]};
            if (contains(id)) infos[i].bodies.push_back(id);
        }
    }
    return infos;
}

const Statistics& World::statistics() const {
    return state_->statistics;
}

const std::vector<FaultInfo>& World::faults() const {
    return state_->faults;
}

void World::setEventLevel(EventLevel level) {
    beginChange(*state_, "World::setEventLevel");
    state_->events.level = level;
}

EventLevel World::eventLevel() const {
    return state_->events.level;
}

std::span<const Event> World::events() const {
    return state_->events.events;
}

void World::setTracing(Tracing tracing) {
    state_->trace = {};
    state_->trace.tracing = tracing;
}

BodyTrace World::trace(BodyId id) const {
    const BodyIndex i = state_->bodies.indexOf(id);
    const StepData& data = state_->data;
    BodyTrace trace;
    if (i < data.pairs.bounds().size()) {
        trace.bounds_lower = data.pairs.bounds()[i].lower;
        trace.bounds_upper = data.pairs.bounds()[i].upper;
        // Ranks search otherwise between the steps' own searches.
        if (state_->shared == nullptr) trace.level = state_->broad_phase.level(i);
    }
    if (i < state_->trace.correction.size()) trace.correction = state_->trace.correction[i];
    if (i < state_->trace.shock_stage.size()) trace.shock_stage = state_->trace.shock_stage[i];
    return trace;
}

double World::kineticEnergy() const {
    return kineticEnergyOf(state_->bodies).rounded();
}

double World::potentialEnergy() const {
    return potentialEnergyOf(state_->bodies, state_->gravity + state_->global_acceleration).rounded();
}

Vec3 World::linearMomentum() const {
    return linearMomentumOf(state_->bodies).rounded();
}

Vec3 World::angularMomentum() const {
    return angularMomentumOf(state_->bodies).rounded();
}

std::uint64_t World::stateHash() const {
    const BodyStorage& b = state_->bodies;
    const bool divided = isDivided();
    // A sum, so that neither the order of the slots nor who holds a body matters.
    std::uint64_t sum = 0;
    for (BodyIndex i = 0; i < b.slots(); ++i) {
        if (b.kind[i] == BodyKind::hole || (divided && !state_->shared->isCounted(i))) continue;
        sum += hashOf(b, i);
    }
    return sum;
}

double World::meanOverlap() const {
    Overlaps overlaps = overlapsOf(*state_);
    if (!isDivided()) return overlaps.mean();
    Ranks& ranks = state_->shared->ranks();
    std::vector<std::byte> message;
    pack(message, overlaps.sum);
    pack(message, overlaps.count);
    const Ranks::Messages told = tellAll(ranks, message);
    for (std::size_t rank = 0; rank < told.size(); ++rank) {
        if (rank == static_cast<std::size_t>(ranks.rank())) continue;
        Unpacker in(told[rank]);
        overlaps.sum.add(in.getSum());
        overlaps.count += in.get<std::int64_t>();
    }
    return overlaps.mean();
}

WorldSums World::sums() const {
    const BodyStorage& b = state_->bodies;
    ExactSum kinetic = kineticEnergyOf(b);
    ExactSum potential = potentialEnergyOf(b, state_->gravity + state_->global_acceleration);
    ExactVectorSum momentum = linearMomentumOf(b);
    ExactVectorSum angular = angularMomentumOf(b);
    WorldSums sums;
    sums.mean_overlap = meanOverlap();
    sums.asleep = std::ranges::count(b.asleep, std::uint8_t{1});
    sums.state_hash = stateHash();
    const auto forSums = [&](const auto& visit) {
        visit(kinetic);
        visit(potential);
        momentum.forAxes(visit);
        angular.forAxes(visit);
    };
    if (isDivided()) {
        Ranks& ranks = state_->shared->ranks();
        std::vector<std::byte> message;
        forSums([&](const ExactSum& sum) { pack(message, sum); });
        pack(message, sums.asleep);
        const Ranks::Messages told = tellAll(ranks, message);
        for (std::size_t rank = 0; rank < told.size(); ++rank) {
            if (rank == static_cast<std::size_t>(ranks.rank())) continue;
            Unpacker in(told[rank]);
            forSums([&](ExactSum& sum) { sum.add(in.getSum()); });
            sums.asleep += in.get<std::int64_t>();
        }
        sums.state_hash = sumOverRanks(ranks, sums.state_hash);
    }
    sums.kinetic_energy = kinetic.rounded();
    sums.potential_energy = potential.rounded();
    sums.linear_momentum = momentum.rounded();
    sums.angular_momentum = angular.rounded();
    return sums;
}

}  // namespace cairn
