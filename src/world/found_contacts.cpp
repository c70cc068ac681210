#include "world/found_contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "math/arrays.h"
#include "world/world_state.h"

namespace cairn {

namespace {

Contact contactOf(const FoundContact& found, const PairProperties& properties) {
    return {.a = found.a,
            .b = found.b,
            .point = found.point,
            .normal = found.normal,
            .distance = found.distance,
            .restitution = properties.restitution,
            .static_friction = properties.static_friction,
            .kinetic_friction = properties.kinetic_friction,
            .rolling_friction = properties.rolling_friction,
            .spinning_friction = properties.spinning_friction};
}

/// Calls use(piece, place of its first contact), in the order of the contacts.
template <class Use>
void forEachPiece(const StepData& data, const Use& use) {
    std::size_t next = 0;
    for (const FoundContacts& part : data.thread_contacts) {
        for (const FoundContacts::Piece& piece : part.pieces) {
            use(piece, next);
            next += piece.count;
        }
    }
}

/// Brings the contacts that stay to their places: first all that move down, then, from the last on, those that move up.
/// So none is written over before its turn.
void moveStaying(StepData& data, std::size_t total) {
    std::vector<Contact>& contacts = data.contacts;
    resizeTightly(contacts, std::max(total, contacts.size()));
    data.rising.clear();
    forEachPiece(data, [&](const FoundContacts::Piece& piece, std::size_t to) {
        if (!piece.stays || to == piece.from) return;
        if (to > piece.from) {
            data.rising.emplace_back(piece, to);
        } else {
            const auto first = contacts.begin() + piece.from;
            std::move(first, first + piece.count, contacts.begin() + static_cast<std::ptrdiff_t>(to));
        }
    });
    for (std::size_t n = data.rising.size(); n-- > 0;) {
        const auto& [piece, to] = data.rising[n];
        const auto first = contacts.begin() + piece.from;
        std::move_backward(first, first + piece.count,
                           contacts.begin() + static_cast<std::ptrdiff_t>(to) + piece.count);
    }
    contacts.resize(total);
}

/// Makes what the response of the last step left the beginning of the present one.
void beginStep(bool has_history, std::span<Contact> contacts) {
    for (Contact& contact : contacts) {
        contact.last_impulse = has_history ? contact.impulse : Vec3(Vec3::Zero());
        if (!has_history) contact.reference_impulse.setZero();
        contact.impulse.setZero();
        contact.angular_impulse.setZero();
        contact.gap = contact.forced = contact.fall = contact.climb = 0;
    }
}

}  // namespace

void requireContacts(std::size_t count) {
    if (count <= most_contacts) return;
    throw InputError(fmt::format(
        "{} contacts in one time step; {} are the most: remove bodies, or part those that were put into each other",
        count, most_contacts));
}

void FoundContacts::clear() {
    found.clear();
    pieces.clear();
    count = 0;
}

void FoundContacts::add(std::size_t from, std::size_t contacts, bool stays) {
    if (contacts == 0) return;
    count += contacts;
    const auto size = static_cast<std::uint32_t>(contacts);
    if (!pieces.empty() && pieces.back().stays == stays && pieces.back().from + pieces.back().count == from) {
        pieces.back().count += size;
    } else {
        pieces.push_back({static_cast<std::uint32_t>(from), size, stays});
    }
}

void joinContacts(const BodyStorage& bodies, const MaterialTable& materials, const Executor& executor,
                  DetectionRound round, StepData& data) {
    std::size_t total = 0;
    for (const FoundContacts& part : data.thread_contacts) total += part.count;
    requireContacts(total);
    moveStaying(data, total);
    const auto fill = [&](const FoundContacts& part, std::size_t place) {
        for (const FoundContacts::Piece& piece : part.pieces) {
            const std::span<Contact> contacts = std::span(data.contacts).subspan(place, piece.count);
            place += piece.count;
            if (piece.stays) {
                if (round == DetectionRound::first) beginStep(data.has_history, contacts);
                continue;
            }
            for (std::size_t i = 0; i < contacts.size(); ++i) {
                const FoundContact& found = part.found[piece.from + i];
                contacts[i] = contactOf(found, materials.pair(bodies.material[found.a], bodies.material[found.b]));
            }
        }
    };
    executor.forBlocks(
        data.thread_contacts.size(),
        [&](std::size_t begin, std::size_t end, int) {
            std::size_t place = 0;
            for (std::size_t t = 0; t < begin; ++t) place += data.thread_contacts[t].count;
            for (std::size_t t = begin; t < end; place += data.thread_contacts[t++].count) {
                fill(data.thread_contacts[t], place);
            }
        },
        1);
}

}  // namespace cairn
