#include "resolution/wide_sweeper.h"

#include <algorithm>
#include <limits>

#include "math/arrays.h"
#include "resolution/contact_law.h"

namespace cairn {

namespace {

constexpr std::uint32_t empty_lane = UINT32_MAX;

/// Pairs with more contacts are put together as if they had so many.
constexpr std::size_t most_alike = 16;
constexpr std::size_t alike_sizes = most_alike + 1;

/// Fewest groups worth a thread of their own.
constexpr std::size_t group_grain = 24;

/// Groups of contacts worth a thread of their own in simple loops.
constexpr std::size_t wide_grain = loop_grain / lane_count;

/// Wide contacts whose changes are added up together: fixed, so that sums do not depend on the number of threads.
constexpr std::size_t sum_block = 64;

/// Four bodies.
using WideBody = SweptBody<Lanes>;

using BodyIndices = std::array<std::uint32_t, lane_count>;

[[gnu::always_inline]] inline Lanes3 gatherVectors(const std::vector<LocalBody>& bodies, const BodyIndices& i,
                                                   Vec3 LocalBody::*vector) {
    return {Lanes{(bodies[i[0]].*vector).x(), (bodies[i[1]].*vector).x(), (bodies[i[2]].*vector).x(),
                  (bodies[i[3]].*vector).x()},
            Lanes{(bodies[i[0]].*vector).y(), (bodies[i[1]].*vector).y(), (bodies[i[2]].*vector).y(),
                  (bodies[i[3]].*vector).y()},
            Lanes{(bodies[i[0]].*vector).z(), (bodies[i[1]].*vector).z(), (bodies[i[2]].*vector).z(),
                  (bodies[i[3]].*vector).z()}};
}

[[gnu::always_inline]] inline WideBody load(const std::vector<LocalBody>& bodies, const BodyIndices& i) {
    const auto inertia = [&](double Symmetric3::*part) __attribute__((always_inline)) {
        return Lanes{bodies[i[0]].inertia_inv.*part, bodies[i[1]].inertia_inv.*part, bodies[i[2]].inertia_inv.*part,
                     bodies[i[3]].inertia_inv.*part};
    };
    WideBody body;
    body.v = gatherVectors(bodies, i, &LocalBody::v);
    body.w = gatherVectors(bodies, i, &LocalBody::w);
    body.mass_inv = Lanes{bodies[i[0]].mass_inv, bodies[i[1]].mass_inv, bodies[i[2]].mass_inv, bodies[i[3]].mass_inv};
    body.inertia_inv = {inertia(&Symmetric3::xx), inertia(&Symmetric3::xy), inertia(&Symmetric3::xz),
                        inertia(&Symmetric3::yy), inertia(&Symmetric3::yz), inertia(&Symmetric3::zz)};
    return body;
}

/// Only lanes with the bit: others may stand for a body that another thread is at work on.
[[gnu::always_inline]] inline void store(const WideBody& body, const BodyIndices& i,
                                         const std::array<std::uint8_t, lane_count>& moves, int bit,
                                         std::vector<LocalBody>& bodies) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        if ((moves[lane] & bit) == 0) continue;
        bodies[i[lane]].v = laneOf(body.v, lane);
        bodies[i[lane]].w = laneOf(body.w, lane);
    }
}

[[gnu::always_inline]] inline void visit(WideContact& contact, WideBody& a, WideBody& b) {
    const Lanes3 impulse = projectedImpulse(contact, relativeVelocity(contact, a, b));
    // False for velocities that are not finite: they would spread.
    const LaneMask usable =
        (impulse.squaredNorm() < std::numeric_limits<double>::infinity()) & (contact.normal_mass > 0);
    const Lanes3 next = where(usable, impulse, contact.impulse);
    push(contact, next - contact.impulse, a, b);
    contact.impulse = next;
}

/// Whether setInvertible() was able to invert K, in all lanes.
[[gnu::always_inline]] inline bool isRegular(const WideContact& contact) {
    const auto& k = contact.k_inv;
    const Lanes sum = k.xx + k.xy + k.xz + k.yy + k.yz + k.zz + contact.tangential_mass;
    const Lanes normal_part = contact.normal.dot(k * contact.normal);
    return holdsInAll((sum - sum == 0) & (normal_part > 0));
}

using cairn::laneOf;
using cairn::setLane;

void setLane(BasicSymmetric3<Lanes>& m, std::size_t lane, const Symmetric3& value) {
    m.xx[lane] = value.xx;
    m.xy[lane] = value.xy;
    m.xz[lane] = value.xz;
    m.yy[lane] = value.yy;
    m.yz[lane] = value.yz;
    m.zz[lane] = value.zz;
}

Symmetric3 laneOf(const BasicSymmetric3<Lanes>& m, std::size_t lane) {
    return {m.xx[lane], m.xy[lane], m.xz[lane], m.yy[lane], m.yz[lane], m.zz[lane]};
}

SweptContact laneOf(const WideContact& wide, std::size_t lane) {
    SweptContact contact;
    contact.impulse = Triple1(laneOf(wide.impulse, lane));
    contact.normal = Triple1(laneOf(wide.normal, lane));
    contact.r_a = Triple1(laneOf(wide.r_a, lane));
    contact.r_b = Triple1(laneOf(wide.r_b, lane));
    contact.k_inv = laneOf(wide.k_inv, lane);
    contact.target = wide.target[lane];
    contact.friction = wide.friction[lane];
    contact.k = laneOf(wide.k, lane);
    contact.normal_mass = wide.normal_mass[lane];
    contact.tangential_mass = wide.tangential_mass[lane];
    return contact;
}

/// What follows from K alone.
void setMasses(WideContact& wide, std::size_t lane, const SweptContact& contact) {
    setLane(wide.k_inv, lane, contact.k_inv);
    setLane(wide.k, lane, contact.k);
    wide.normal_mass[lane] = contact.normal_mass;
    wide.tangential_mass[lane] = contact.tangential_mass;
}

}  // namespace

void WideSweeper::begin(const SweptBatch& swept) {
    colours_.colour(swept.local.ends, swept.local.dynamic_bodies);
    arrange(swept.local);
    swept.executor.forBlocks(
        groups_.size(),
        [&](std::size_t begin, std::size_t end, int) {
            runOnLanes([&]() __attribute__((always_inline)) {
                for (std::size_t g = begin; g < end; ++g) beginGroup(groups_[g], swept);
            });
        },
        group_grain);
    for (std::size_t c = 0; c < colours_.colours(); ++c) {
        visitGroups(
            c, swept, [](std::span<WideContact> contacts, WideBody & a, WideBody & b) __attribute__((always_inline)) {
                for (const WideContact& contact : contacts) push(contact, contact.impulse, a, b);
            });
    }
}

/// Groups of pairs with equally many contacts, as far as there are such.
void WideSweeper::arrange(const LocalBatch& local) {
    groups_.clear();
    contact_of_.clear();
    group_begin_.assign(1, 0);
    slot_of_.resize(colours_.order().size());
    std::array<std::array<Pair, lane_count>, alike_sizes> waiting;
    std::array<std::size_t, alike_sizes> waiting_count{};
    for (std::size_t c = 0; c < colours_.colours(); ++c) {
        for (std::size_t p = 0; p < colours_.pairs(c); ++p) {
            const Pair pair{colours_.begin(c, p), colours_.begin(c, p + 1) - colours_.begin(c, p)};
            if (!colours_.isShared(c)) {
                addGroup({&pair, 1}, local);
                continue;
            }
            const std::size_t alike = std::min(pair.size, most_alike);
            waiting[alike][waiting_count[alike]++] = pair;
            if (waiting_count[alike] < lane_count) continue;
            addGroup(waiting[alike], local);
            waiting_count[alike] = 0;
        }
        std::array<Pair, lane_count> rest;
        std::size_t rest_count = 0;
        for (std::size_t alike = alike_sizes; alike-- > 0; waiting_count[alike] = 0) {
            for (std::size_t i = 0; i < waiting_count[alike]; ++i) {
                rest[rest_count++] = waiting[alike][i];
                if (rest_count < lane_count) continue;
                addGroup(rest, local);
                rest_count = 0;
            }
        }
        if (rest_count > 0) addGroup({rest.data(), rest_count}, local);
        group_begin_.push_back(groups_.size());
    }
    resizeTightly(contacts_, contact_of_.size() / lane_count);
}

void WideSweeper::addGroup(std::span<const Pair> pairs, const LocalBatch& local) {
    const std::span<const std::uint32_t> order = colours_.order();
    Group group;
    group.begin = static_cast<std::uint32_t>(contact_of_.size() / lane_count);
    std::size_t length = 0;
    for (const Pair& pair : pairs) length = std::max(length, pair.size);
    group.end = group.begin + static_cast<std::uint32_t>(length);
    contact_of_.resize(contact_of_.size() + length * lane_count, empty_lane);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const Pair& pair = pairs[lane < pairs.size() ? lane : 0];
        const ContactEnds& ends = local.ends[order[pair.begin]];
        group.a[lane] = ends.a;
        group.b[lane] = ends.b;
        if (lane >= pairs.size()) continue;
        group.moves[lane] =
            static_cast<std::uint8_t>((local.isFixed(ends.a) ? 0 : 1) | (local.isFixed(ends.b) ? 0 : 2));
        for (std::size_t i = 0; i < pair.size; ++i) {
            const std::size_t slot = (group.begin + i) * lane_count + lane;
            contact_of_[slot] = order[pair.begin + i];
            slot_of_[order[pair.begin + i]] = static_cast<std::uint32_t>(slot);
        }
    }
    groups_.push_back(group);
}

[[gnu::always_inline]] inline void WideSweeper::beginGroup(const Group& group, const SweptBatch& swept) {
    const WideBody a = load(swept.local.bodies, group.a);
    const WideBody b = load(swept.local.bodies, group.b);
    for (std::size_t i = group.begin; i < group.end; ++i) {
        WideContact& wide = contacts_[i];
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
            const std::uint32_t index = contact_of_[i * lane_count + lane];
            // An empty lane repeats the group's first contact, which can be computed with.
            const std::uint32_t source = index == empty_lane ? contact_of_[group.begin * lane_count] : index;
            const Contact& contact = swept.contacts[swept.batch.contacts[source]];
            setLane(wide.normal, lane, contact.normal);
            setLane(wide.r_a, lane, contact.point - swept.bodies.position[contact.a]);
            setLane(wide.r_b, lane, contact.point - swept.bodies.position[contact.b]);
            setLane(wide.impulse, lane, index == empty_lane ? Vec3(Vec3::Zero()) : contact.last_impulse);
            wide.friction[lane] = contact.static_friction;
        }
        WideContact::Symmetric k;
        addCollisionMatrix(a.mass_inv, a.inertia_inv, wide.r_a, k);
        addCollisionMatrix(b.mass_inv, b.inertia_inv, wide.r_b, k);
        setInvertible(wide, k);
        const Lanes closing = wide.normal.dot(relativeVelocity(wide, a, b));
        const bool regular = isRegular(wide);
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
            const std::uint32_t index = contact_of_[i * lane_count + lane];
            if (index == empty_lane) {
                setMasses(wide, lane, SweptContact{});
                continue;
            }
            if (!regular) {
                SweptContact contact = laneOf(wide, lane);
                mendSingular(contact);
                setMasses(wide, lane, contact);
            }
            wide.target[lane] =
                ContactLaw::separatingSpeed(swept.settings, swept.contacts[swept.batch.contacts[index]], closing[lane]);
        }
        const LaneMask pushes = (wide.normal.dot(wide.impulse) > 0) & (wide.normal_mass > 0);
        wide.impulse = where(pushes, wide.impulse, Lanes3());
    }
}

/// Calls visit(contacts, a, b) for every group of a colour.
template <class Visit>
void WideSweeper::visitGroups(std::size_t colour, const SweptBatch& swept, const Visit& visit) {
    const std::size_t first = group_begin_[colour];
    const std::size_t count = group_begin_[colour + 1] - first;
    std::vector<LocalBody>& bodies = swept.local.bodies;
    const auto work = [&](std::size_t begin, std::size_t end, int) {
        runOnLanes([&]() __attribute__((always_inline)) {
            for (std::size_t g = first + begin; g < first + end; ++g) {
                const Group& group = groups_[g];
                WideBody a = load(bodies, group.a);
                WideBody b = load(bodies, group.b);
                visit(std::span(contacts_).subspan(group.begin, group.end - group.begin), a, b);
                store(a, group.a, group.moves, 1, bodies);
                store(b, group.b, group.moves, 2, bodies);
            }
        });
    };
    if (colours_.isShared(colour)) {
        swept.executor.forBlocks(count, work, group_grain);
    } else {
        work(0, count, 0);
    }
}

void WideSweeper::sweep(const SweptBatch& swept) {
    for (std::size_t c = 0; c < colours_.colours(); ++c) {
        visitGroups(
            c, swept, [](std::span<WideContact> contacts, WideBody & a, WideBody & b) __attribute__((always_inline)) {
                for (WideContact& contact : contacts) visit(contact, a, b);
            });
    }
    for (std::size_t c = colours_.colours(); c-- > 0;) {
        visitGroups(
            c, swept, [](std::span<WideContact> contacts, WideBody & a, WideBody & b) __attribute__((always_inline)) {
                for (std::size_t i = contacts.size(); i-- > 0;) visit(contacts[i], a, b);
            });
    }
}

void WideSweeper::note(const SweptBatch& swept) {
    resizeTightly(before_, contacts_.size());
    forEach(
        before_.size(), swept.executor, [&](std::size_t i) { before_[i] = contacts_[i].impulse; }, wide_grain);
}

SweepChange WideSweeper::change(const SweptBatch& swept) {
    sums_.resize((contacts_.size() + sum_block - 1) / sum_block);
    forEach(
        sums_.size(), swept.executor, [&](std::size_t block) { sums_[block] = changeOfBlock(block); }, 1);
    SweepChange change;
    for (const SweepChange& part : sums_) change.add(part);
    return change;
}

SweepChange WideSweeper::changeOfBlock(std::size_t block) const {
    const std::size_t end = std::min(contacts_.size(), (block + 1) * sum_block);
    SweepChange change;
    runOnLanes([&]() __attribute__((always_inline)) {
        Lanes squared{};
        Lanes largest{};
        for (std::size_t i = block * sum_block; i < end; ++i) {
            const WideContact& contact = contacts_[i];
            const Lanes3 difference = contact.impulse - before_[i];
            const Lanes weighted = difference.squaredNorm() / contact.normal_mass;
            const Lanes speed = (contact.k * difference).squaredNorm();
            squared += where(contact.normal_mass > 0, weighted, Lanes{});
            largest = where(speed > largest, speed, largest);
        }
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
            change.add({squared[lane], std::sqrt(largest[lane])});
        }
    });
    return change;
}

void WideSweeper::restart() {
    direction_.clear();
    resizeTightly(direction_, contacts_.size());
}

void WideSweeper::accelerate(double beta, const SweptBatch& swept) {
    swept.executor.forBlocks(
        contacts_.size(),
        [&](std::size_t begin, std::size_t end, int) {
            runOnLanes([&]() __attribute__((always_inline)) {
                const Lanes factor = beta + Lanes{};
                for (std::size_t i = begin; i < end; ++i) {
                    const Lanes3 change = contacts_[i].impulse - before_[i];
                    const Lanes3 step = factor * direction_[i];
                    contacts_[i].impulse += step;
                    direction_[i] = change + step;
                }
            });
        },
        wide_grain);
}

SweptContact WideSweeper::contactAt(std::size_t slot) const {
    return laneOf(contacts_[slot / lane_count], slot % lane_count);
}

bool WideSweeper::releaseSliding(const SweptBatch& swept) {
    bool released = false;
    for (std::size_t i = 0; i < slot_of_.size(); ++i) {
        const Contact& contact = swept.contacts[swept.batch.contacts[i]];
        if (!(contact.kinetic_friction < contact.static_friction)) continue;
        const ContactEnds& ends = swept.local.ends[i];
        const SweptContact s = contactAt(slot_of_[i]);
        if (!slides(s, swept.local.bodies[ends.a], swept.local.bodies[ends.b], swept.settings.resolution_threshold))
            continue;
        contacts_[slot_of_[i] / lane_count].friction[slot_of_[i] % lane_count] = contact.kinetic_friction;
        released = true;
    }
    return released;
}

void WideSweeper::finish(const SweptBatch& swept) {
    forEach(slot_of_.size(), swept.executor, [&](std::size_t i) {
        const WideContact& wide = contacts_[slot_of_[i] / lane_count];
        swept.contacts[swept.batch.contacts[i]].impulse += laneOf(wide.impulse, slot_of_[i] % lane_count);
    });
}

}  // namespace cairn
