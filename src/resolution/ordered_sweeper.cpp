#include "resolution/ordered_sweeper.h"

#include <algorithm>
#include <cmath>

#include "math/arrays.h"
#include "resolution/contact_visit.h"
#include "resolution/fill_contact.h"
#include "resolution/release_sliding.h"

namespace cairn {

namespace {

constexpr auto visit_contact = [](BasicPgsContact<double>& contact, PgsBody<double>& a, PgsBody<double>& b) {
    visit(contact, FreePair<double>{a, b});
};

}  // namespace

void fillContacts(std::span<const UnfilledContact> contacts, std::span<const Vec3> position,
                  const ResolutionSettings& settings) {
    runOnLanes<Lanes>([&]() __attribute__((always_inline)) {
        for (std::size_t i = 0; i < contacts.size(); i += lane_count) {
            Sources sources;
            OfLanes<const LocalBody> a;
            OfLanes<const LocalBody> b;
            OfLanes<BasicPgsContact<double>> to;
            for (std::size_t lane = 0; lane < lane_count; ++lane) {
                sources.fills[lane] = i + lane < contacts.size();
                const UnfilledContact& contact = contacts[sources.fills[lane] ? i + lane : i];
                sources.contacts[lane] = contact.source;
                a[lane] = contact.a;
                b[lane] = contact.b;
                to[lane] = sources.fills[lane] ? contact.contact : nullptr;
            }
            WideContact wide;
            fillContact(wide, loadBodies(a), loadBodies(b), sources, position, settings);
            storeContacts(wide, to);
        }
    });
}

void OrderedSweeper::prepare(const PgsBatch&, std::size_t contacts) {
    resizeTightly(contacts_, contacts);
}

void OrderedSweeper::listUnfilled(const PgsBatch& pgs, std::vector<UnfilledContact>& unfilled) {
    const std::vector<LocalBody>& bodies = pgs.local.bodies;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const ContactEnds& ends = pgs.local.ends[i];
        unfilled.push_back({&pgs.contacts[pgs.batch.contacts[i]], &bodies[ends.a], &bodies[ends.b], &contacts_[i]});
    }
}

/// Calls visit(contact, a, b) for all contacts. Those of a pair, side by side, meet their bodies in registers.
template <class Visit>
void OrderedSweeper::visitPairs(bool back, LocalBatch& local, const Visit& visit) {
    const std::size_t count = contacts_.size();
    const auto place = [&](std::size_t n) { return back ? count - 1 - n : n; };
    for (std::size_t n = 0; n < count;) {
        const ContactEnds ends = local.ends[place(n)];
        PgsBody<double> a = read(local.bodies[ends.a]);
        PgsBody<double> b = read(local.bodies[ends.b]);
        for (; n < count && local.ends[place(n)] == ends; ++n) visit(contacts_[place(n)], a, b);
        if (!local.isFixed(ends.a)) write(a, local.bodies[ends.a]);
        if (!local.isFixed(ends.b)) write(b, local.bodies[ends.b]);
    }
}

void OrderedSweeper::fill(const PgsBatch& pgs) {
    unfilled_.clear();
    listUnfilled(pgs, unfilled_);
    fillContacts(unfilled_, pgs.bodies.position, pgs.settings);
}

void OrderedSweeper::start(const PgsBatch& pgs) {
    visitPairs(false, pgs.local, [](const BasicPgsContact<double>& contact, PgsBody<double>& a, PgsBody<double>& b) {
        push(contact, contact.impulse, a, b);
    });
}

void OrderedSweeper::sweepForth(const PgsBatch& pgs) {
    visitPairs(false, pgs.local, visit_contact);
}

void OrderedSweeper::sweepBack(const PgsBatch& pgs) {
    visitPairs(true, pgs.local, visit_contact);
}

void OrderedSweeper::save(const PgsBatch&) {
    resizeTightly(before_, contacts_.size());
    for (std::size_t i = 0; i < contacts_.size(); ++i) before_[i] = contacts_[i].impulse;
}

SweepChange OrderedSweeper::change(const PgsBatch&) const {
    SweepChange change;
    double largest = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const BasicPgsContact<double>& contact = contacts_[i];
        const Triple1 difference = contact.impulse - before_[i];
        if (contact.normal_mass > 0) change.squared += difference.squaredNorm() / contact.normal_mass;
        const double speed = (contact.k * difference).squaredNorm();
        largest = speed > largest ? speed : largest;
    }
    change.largest_speed = std::sqrt(largest);
    return change;
}

void OrderedSweeper::restart() {
    direction_.assign(contacts_.size(), Triple1());
}

void OrderedSweeper::accelerate(double beta, const PgsBatch&) {
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const Triple1 change = contacts_[i].impulse - before_[i];
        const Triple1 step = beta * direction_[i];
        contacts_[i].impulse += step;
        direction_[i] = change + step;
    }
}

PgsContact OrderedSweeper::contactAt(std::size_t contact, const PgsBatch& pgs) const {
    return {pgs.local.ends[contact], contacts_[contact]};
}

void OrderedSweeper::setImpulse(std::size_t contact, const Triple1& impulse, LocalBatch& local) {
    const ContactEnds& ends = local.ends[contact];
    PgsBody<double> a = read(local.bodies[ends.a]);
    PgsBody<double> b = read(local.bodies[ends.b]);
    push(contacts_[contact], impulse - contacts_[contact].impulse, a, b);
    if (!local.isFixed(ends.a)) write(a, local.bodies[ends.a]);
    if (!local.isFixed(ends.b)) write(b, local.bodies[ends.b]);
    contacts_[contact].impulse = impulse;
}

bool OrderedSweeper::releaseSliding(const PgsBatch& pgs) {
    const auto at = [&](std::size_t i) { return contactAt(i, pgs); };
    return releaseSlidingOf(pgs, 0, contacts_.size(), at,
                            [&](std::size_t i, double friction) { contacts_[i].friction = friction; });
}

void OrderedSweeper::finish(const PgsBatch& pgs) const {
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        pgs.contacts[pgs.batch.contacts[i]].impulse += toVec3(contacts_[i].impulse);
    }
}

}  // namespace cairn
