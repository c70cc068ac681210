#include "resolution/shock_propagation.h"

#include <algorithm>
#include <utility>

namespace cairn {

namespace {

constexpr std::uint32_t unreached = UINT32_MAX;

std::uint32_t otherBody(const ContactFrame& contact, std::uint32_t body) {
    return contact.a == body ? contact.b : contact.a;
}

}  // namespace

ShockOutcome ShockPropagation::run(QueueSolver& solver, double iterations_per_contact) {
    ShockOutcome outcome;
    findFirstSubset(solver.batch);
    for (stage_ = 0; !subset_.empty(); ++stage_) {
        listContactsOfSubset(solver);
        outcome.iterations += solver.run(members_, iterations_per_contact).iterations;
        ++outcome.stages;
        freezeSubset(solver);
        std::swap(subset_, next_subset_);
    }
    return outcome;
}

/// Lines 2–5: the bodies that touch a fixed one.
void ShockPropagation::findFirstSubset(const LocalBatch& batch) {
    subset_.clear();
    stage_of_body_.assign(batch.bodies.size(), unreached);
    for (const ContactFrame& contact : batch.contacts) {
        if (batch.isFixed(contact.a) == batch.isFixed(contact.b)) continue;
        const std::uint32_t body = batch.isFixed(contact.a) ? contact.b : contact.a;
        if (stage_of_body_[body] != unreached) continue;
        stage_of_body_[body] = 0;
        subset_.push_back(body);
    }
    std::sort(subset_.begin(), subset_.end());
}

void ShockPropagation::listContactsOfSubset(const QueueSolver& solver) {
    members_.clear();
    for (const std::uint32_t body : subset_) {
        const std::span<const std::uint32_t> contacts = solver.rows.contactsOf(body);
        members_.insert(members_.end(), contacts.begin(), contacts.end());
    }
    // A contact between two bodies of the subset is in twice.
    std::sort(members_.begin(), members_.end());
    members_.erase(std::unique(members_.begin(), members_.end()), members_.end());
}

/// Lines 8–13: gives the subset infinite mass, finds the next one, and recomputes K towards it.
void ShockPropagation::freezeSubset(QueueSolver& solver) {
    LocalBatch& batch = solver.batch;
    for (const std::uint32_t body : subset_) {
        batch.bodies[body].shock_stage = static_cast<std::int32_t>(stage_);
        batch.bodies[body].mass_inv = 0;
        batch.bodies[body].inertia_inv = {};
    }
    batch.joints.factorise(batch.bodies);
    next_subset_.clear();
    for (const std::uint32_t body : subset_) {
        for (const std::uint32_t i : solver.rows.contactsOf(body)) {
            ContactFrame& contact = batch.contacts[i];
            const std::uint32_t other = otherBody(contact, body);
            if (batch.isFixed(other)) continue;
            if (stage_of_body_[other] == unreached) {
                stage_of_body_[other] = stage_ + 1;
                next_subset_.push_back(other);
            }
            if (stage_of_body_[other] == stage_ + 1) batch.updateCollisionMatrixOf(contact);
        }
    }
    std::sort(next_subset_.begin(), next_subset_.end());
    if (batch.joints.empty()) return;
    // What is tied to a body of infinite mass gives way less, too.
    for (ContactFrame& contact : batch.contacts) {
        if (batch.joints.holds(contact)) batch.updateCollisionMatrixOf(contact);
    }
}

}  // namespace cairn
