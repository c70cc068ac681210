#include "resolution/relay.h"

#include <algorithm>
#include <limits>

#include "resolution/contact_visit.h"
#include "resolution/lane_contact.h"

namespace cairn {

Relay::Relay() : idle_bodies_(2) {
    idle_contact_.normal = Triple1(1, 0, 0);
    idle_contact_.impulse = idle_contact_.normal;
    idle_contact_.friction = idle_contact_.normal_mass = 1;
}

void Relay::run(FunctionRef<bool(std::size_t, Sweeps<OrderedSweeper>&)> prepare,
                FunctionRef<void(std::size_t, Sweeps<OrderedSweeper>&)> end) {
    for (Lane& lane : lanes_) lane.step = 0;
    while (take(prepare)) {
        for (bool full = true; full;) {
            std::size_t busy = 0;
            std::size_t visits = std::numeric_limits<std::size_t>::max();
            for (const Lane& lane : lanes_) {
                if (lane.step == 0) continue;
                ++busy;
                visits = std::min(visits, lane.left);
            }
            if (busy > 1) {
                visitAll(visits);
            } else {
                visitOne(*std::ranges::find_if(lanes_, [](const Lane& lane) { return lane.step != 0; }), visits);
            }
            for (std::size_t lane = 0; lane < lane_count; ++lane) {
                if (lanes_[lane].step == 0 || lanes_[lane].left > 0 || turn(lane)) continue;
                end(lane, sweeps_[lane]);
                lanes_[lane].step = 0;
                full = false;
            }
        }
    }
}

/// Gives all empty lanes a batch, as far as there are such. @return whether any lane has one
bool Relay::take(FunctionRef<bool(std::size_t, Sweeps<OrderedSweeper>&)> prepare) {
    unfilled_.clear();
    std::array<bool, lane_count> taken{};
    bool any = false;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        any = any || lanes_[lane].step != 0;
        if (lanes_[lane].step != 0) continue;
        lanes_[lane] = {.contacts = &idle_contact_, .ends = &idle_ends_, .bodies = idle_bodies_.data()};
        taken[lane] = prepare(lane, sweeps_[lane]);
        if (taken[lane]) sweeps_[lane].sweeper().listUnfilled(sweeps_[lane].pgs(), unfilled_);
        any = any || taken[lane];
    }
    if (unfilled_.empty()) return any;
    // Small batches that are begun together share the lanes.
    const PgsBatch& pgs = sweeps_[std::ranges::find(taken, true) - taken.begin()].pgs();
    fillContacts(unfilled_, pgs.bodies.position, pgs.settings);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        if (!taken[lane]) continue;
        sweeps_[lane].sweeper().start(sweeps_[lane].pgs());
        beginSweep(lane);
    }
    return any;
}

void Relay::beginSweep(std::size_t lane) {
    sweeps_[lane].beginSweep();
    const std::span<Contact1> contacts = sweeps_[lane].sweeper().contacts();
    LocalBatch& local = sweeps_[lane].pgs().local;
    lanes_[lane] = {.contacts = contacts.data(),
                    .ends = local.ends.data(),
                    .bodies = local.bodies.data(),
                    .next = 0,
                    .step = 1,
                    .count = contacts.size(),
                    .left = contacts.size()};
}

/// Goes on where all contacts were visited. @return whether the batch needs another visit
bool Relay::turn(std::size_t lane) {
    Lane& l = lanes_[lane];
    if (l.step > 0) {
        l.next = static_cast<std::ptrdiff_t>(l.count) - 1;
        l.step = -1;
        l.left = l.count;
        return true;
    }
    sweeps_[lane].endSweep();
    if (sweeps_[lane].isDone()) return false;
    beginSweep(lane);
    return true;
}

void Relay::visitOne(Lane& lane, std::size_t visits) {
    for (std::size_t n = 0; n < visits; ++n, lane.next += lane.step) {
        const ContactEnds& ends = lane.ends[lane.next];
        PgsBody<double> a = read(lane.bodies[ends.a]);
        PgsBody<double> b = read(lane.bodies[ends.b]);
        visit(lane.contacts[lane.next], FreePair<double>{a, b});
        write(a, lane.bodies[ends.a]);
        write(b, lane.bodies[ends.b]);
    }
    lane.left -= visits;
}

void Relay::visitAll(std::size_t visits) {
    runOnLanes<Lanes>([&]() __attribute__((always_inline)) {
        std::array<Lane, lane_count> at = lanes_;
        for (std::size_t n = 0; n < visits; ++n) {
            OfLanes<Contact1> contacts;
            OfLanes<LocalBody> of_a;
            OfLanes<LocalBody> of_b;
            for (std::size_t lane = 0; lane < lane_count; ++lane) {
                Lane& l = at[lane];
                const ContactEnds& ends = l.ends[l.next];
                contacts[lane] = l.contacts + l.next;
                of_a[lane] = l.bodies + ends.a;
                of_b[lane] = l.bodies + ends.b;
                l.next += l.step;
            }
            BasicPgsContact<Lanes> contact = loadContacts(contacts);
            PgsBody<Lanes> a = loadBodies(of_a);
            PgsBody<Lanes> b = loadBodies(of_b);
            visit(contact, FreePair<Lanes>{a, b});
            storeImpulse(contact, contacts);
            const auto all = [](std::size_t) __attribute__((always_inline)) {
                return true;
            };
            store(a, of_a, all);
            store(b, of_b, all);
        }
    });
    for (Lane& lane : lanes_) {
        lane.next += lane.step * static_cast<std::ptrdiff_t>(visits);
        lane.left -= lane.step == 0 ? 0 : visits;
    }
}

}  // namespace cairn
