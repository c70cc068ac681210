#include "pairs/found_contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/arrays.h"

namespace cairn {

namespace {

/// What resists rolling or spinning shifts the force between two bodies by so much at most, to the side or, along
/// it, as friction does with this lever. An area that is wide enough does that by where it presses.
double unlessPatch(const FoundContact& found, double shift, double friction) {
    return shift * shift <= friction * friction * found.squared_patch ? 0 : shift;
}

Contact contactOf(const BodyStorage& bodies, const MaterialTable& materials, const FoundContact& found) {
    const PairProperties properties = materials.pair(bodies.material[found.a], bodies.material[found.b]);
    return {.a = found.a,
            .b = found.b,
            .distance = found.distance,
            .allowed_overlap = found.allowed_overlap,
            .allowed_closing = found.allowed_closing,
            .restitution = properties.restitution,
            .normal = found.normal,
            .point = found.point,
            .slide = found.slide,
            .static_friction = properties.static_friction,
            .kinetic_friction = properties.kinetic_friction,
            .rolling_friction = unlessPatch(found, properties.rolling_friction, 1),
            .spinning_friction = unlessPatch(found, properties.spinning_friction, properties.kinetic_friction),
            .last_impulse = found.last_impulse,
            .reference_impulse = found.reference_impulse,
            .earlier_impulse = found.earlier_impulse,
            .earlier_angular_impulse = found.earlier_angular_impulse};
}

/// Calls use(run, place of its first contact), in the order of the contacts.
template <class Use>
void forEachRun(std::span<const FoundContacts> parts, const Use& use) {
    std::size_t next = 0;
    for (const FoundContacts& part : parts) {
        for (const FoundContacts::Run& run : part.runs) {
            use(run, next);
            next += run.count;
        }
    }
}

}  // namespace

double squaredPatchOf(std::span<const FoundContact> contacts) {
    if (contacts.size() < 3) return 0;
    const auto touches = [](const FoundContact& c) { return c.distance <= c.allowed_overlap; };
    Vec3 sum = Vec3::Zero();
    double count = 0;
    for (const FoundContact& contact : contacts) {
        if (!touches(contact)) continue;
        sum += contact.point;
        ++count;
    }
    if (count < 3) return 0;
    Mat3 spread = Mat3::Zero();
    for (const FoundContact& contact : contacts) {
        if (!touches(contact)) continue;
        const Vec3 r = contact.point - sum / count;
        spread += r * r.transpose() / count;
    }
    // Of the three eigenvalues that across the area is nearly none, and those along it follow from two invariants.
    const double mean = 0.5 * spread.trace();
    const double product = 0.5 * (spread.trace() * spread.trace() - (spread * spread).trace());
    return mean - std::sqrt(std::max(0.0, mean * mean - product));
}

void requireContacts(std::size_t count) {
    if (count <= most_contacts) return;
    throw InputError(fmt::format(
        "{} contacts in one time step; {} are the most: remove bodies, or part those that were put into each other",
        count, most_contacts));
}

void FoundContacts::clear() {
    found.clear();
    runs.clear();
    grown.clear();
    tightened.clear();
    count = pair_begin = pair_end = 0;
    others = deep = false;
}

void FoundContacts::add(std::size_t from, std::size_t contacts, bool stays) {
    if (contacts == 0) return;
    count += contacts;
    const auto size = static_cast<std::uint32_t>(contacts);
    if (!runs.empty() && runs.back().stays == stays && runs.back().from + runs.back().count == from) {
        runs.back().count += size;
    } else {
        runs.push_back({static_cast<std::uint32_t>(from), size, stays});
    }
}

void FoundContacts::tighten(const Tightened& wanted, double allowed_now) {
    if (!(wanted.allowed_closing < allowed_now)) return;
    const bool again =
        !tightened.empty() && tightened.back().pair == wanted.pair && tightened.back().place == wanted.place;
    if (!again) tightened.push_back(wanted);
    tightened.back().allowed_closing = std::min(tightened.back().allowed_closing, wanted.allowed_closing);
}

/// Brings the contacts that stay to their places: first all that move down, then, from the last on, those that move up.
/// So none is written over before its turn.
void ContactJoiner::moveStaying(std::span<const FoundContacts> parts, std::size_t total,
                                std::vector<Contact>& contacts) {
    resizeTightly(contacts, std::max(total, contacts.size()));
    moving_up_.clear();
    forEachRun(parts, [&](const FoundContacts::Run& run, std::size_t to) {
        if (!run.stays || to == run.from) return;
        if (to > run.from) {
            moving_up_.emplace_back(run, to);
        } else {
            const auto first = contacts.begin() + run.from;
            std::move(first, first + run.count, contacts.begin() + static_cast<std::ptrdiff_t>(to));
        }
    });
    for (std::size_t n = moving_up_.size(); n-- > 0;) {
        const auto& [run, to] = moving_up_[n];
        const auto first = contacts.begin() + run.from;
        std::move_backward(first, first + run.count, contacts.begin() + static_cast<std::ptrdiff_t>(to) + run.count);
    }
    contacts.resize(total);
}

void ContactJoiner::join(const BodyStorage& bodies, const MaterialTable& materials, const Executor& executor,
                         std::span<const FoundContacts> parts, std::vector<Contact>& contacts) {
    std::size_t total = 0;
    for (const FoundContacts& part : parts) total += part.count;
    requireContacts(total);
    moveStaying(parts, total, contacts);
    const auto fill = [&](const FoundContacts& part, std::size_t place) {
        for (const FoundContacts::Run& run : part.runs) {
            for (std::size_t i = 0; !run.stays && i < run.count; ++i) {
                contacts[place + i] = contactOf(bodies, materials, part.found[run.from + i]);
            }
            place += run.count;
        }
    };
    executor.forBlocks(
        parts.size(),
        [&](std::size_t begin, std::size_t end, int) {
            std::size_t place = 0;
            for (std::size_t t = 0; t < begin; ++t) place += parts[t].count;
            for (std::size_t t = begin; t < end; place += parts[t++].count) fill(parts[t], place);
        },
        1);
}

}  // namespace cairn
