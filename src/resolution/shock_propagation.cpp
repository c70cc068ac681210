#include "resolution/shock_propagation.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace cairn {

namespace {

constexpr std::uint32_t unreached = UINT32_MAX;

std::uint32_t otherBody(const ContactEnds& contact, std::uint32_t body) {
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
    for (const ContactEnds& contact : batch.ends) {
        if (batch.isFixed(contact.a) == batch.isFixed(contact.b)) continue;
        const std::uint32_t body = batch.isFixed(contact.a) ? contact.b : contact.a;
        if (stage_of_body_[body] != unreached) continue;
        stage_of_body_[body] = 0;
        subset_.push_back(body);
    }
    std::sort(subset_.begin(), subset_.end());
}

/// Marks them first: a contact between two bodies of the subset is one, and the marks are in order.
void ShockPropagation::listContactsOfSubset(const QueueSolver& solver) {
    constexpr std::uint32_t bits = 64;
    marked_.assign(solver.batch.ends.size() / bits + 1, 0);
    for (const std::uint32_t body : subset_) {
        for (const std::uint32_t i : solver.rows.contactsOf(body)) marked_[i / bits] |= std::uint64_t{1} << i % bits;
    }
    members_.clear();
    for (std::uint32_t word = 0; word < marked_.size(); ++word) {
        for (std::uint64_t left = marked_[word]; left != 0; left &= left - 1) {
            members_.push_back(word * bits + static_cast<std::uint32_t>(std::countr_zero(left)));
        }
    }
}

/// Lines 8–13: gives the subset infinite mass, finds the next one, and forgets K towards it.
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
            const std::uint32_t other = otherBody(batch.ends[i], body);
            if (batch.isFixed(other)) continue;
            if (stage_of_body_[other] == unreached) {
                stage_of_body_[other] = stage_ + 1;
                next_subset_.push_back(other);
            }
            if (stage_of_body_[other] == stage_ + 1) batch.forgetCollisionMatrixOf(i);
        }
    }
    std::sort(next_subset_.begin(), next_subset_.end());
    if (batch.joints.empty()) return;
    // What is tied to a body of infinite mass gives way less, too.
    for (std::uint32_t i = 0; i < batch.ends.size(); ++i) batch.forgetCollisionMatrixOf(i);
}

}  // namespace cairn
