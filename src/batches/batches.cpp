#include "batches/batches.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "math/arrays.h"

namespace cairn {

namespace {

constexpr std::uint32_t no_batch = Batches::none;
/// A body is in a batch if it has a contact or a joint; its number follows later.
constexpr std::uint32_t in_some_batch = 0;

bool isDynamic(std::span<const BodyKind> kind, BodyIndex i) {
    return kind[i] == BodyKind::dynamic;
}

/// Representative of a group, with path halving: every other body on the way is linked to its grandparent.
BodyIndex representative(std::vector<std::uint32_t>& parent, BodyIndex i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

[[noreturn]] void throwImmovable(BodyIndex a, BodyIndex b) {
    throw std::logic_error("batches: contact of bodies " + std::to_string(a) + " and " + std::to_string(b) +
                           ", neither of which can move");
}

/// Turns counts in values[0 … n−1] into offsets; values[n] becomes their sum.
void countsToOffsets(std::vector<std::uint32_t>& values) {
    std::exclusive_scan(values.begin(), values.end(), values.begin(), std::uint32_t{0});
}

/// Notes a dynamic body of each contact, its owner, whose batch is that of the contact. Joins the bodies of each
/// contact and joint and marks them as being in some batch. Each group's representative is its lowest body, since the
/// higher of two representatives is always linked to the lower one.
void joinBodies(std::span<const BodyKind> kind, std::span<const Contact> contacts, std::span<const Joint> joints,
                BatchScratch& scratch) {
    scratch.parent.resize(kind.size());
    std::iota(scratch.parent.begin(), scratch.parent.end(), 0);
    scratch.batch_of_body.assign(kind.size(), no_batch);
    resizeTightly(scratch.owners, contacts.size());
    const auto join = [&](BodyIndex a, BodyIndex b) {
        const BodyIndex p = representative(scratch.parent, a);
        const BodyIndex q = representative(scratch.parent, b);
        scratch.parent[std::max(p, q)] = std::min(p, q);
    };
    const auto mark = [&](BodyIndex body) { scratch.batch_of_body[body] = in_some_batch; };
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const auto [a, b] = std::pair(contacts[c].a, contacts[c].b);
        if (c > 0 && a == contacts[c - 1].a && b == contacts[c - 1].b) {
            scratch.owners[c] = scratch.owners[c - 1];
            continue;
        }
        const bool a_joins = isDynamic(kind, a);
        const bool b_joins = isDynamic(kind, b);
        if (!a_joins && !b_joins) throwImmovable(a, b);
        if (a_joins) mark(a);
        if (b_joins) mark(b);
        scratch.owners[c] = a_joins ? a : b;
        if (a_joins && b_joins) join(a, b);
    }
    for (const Joint& joint : joints) {
        if (!joint.present) continue;
        const bool a_joins = isMovable(kind, joint.a);
        const bool b_joins = isMovable(kind, joint.b);
        if (a_joins) mark(joint.a);
        if (b_joins) mark(joint.b);
        if (a_joins && b_joins) join(joint.a, joint.b);
    }
}

/// Numbers the groups that have contacts or joints in ascending order of their lowest bodies. @return their number
std::uint32_t numberBatches(BatchScratch& scratch) {
    auto& batch = scratch.batch_of_body;
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < batch.size(); ++i) {
        if (batch[i] == no_batch) continue;
        const BodyIndex lowest = representative(scratch.parent, static_cast<BodyIndex>(i));
        batch[i] = lowest == i ? count++ : batch[lowest];
    }
    return count;
}

}  // namespace

void buildBatches(std::span<const BodyKind> kind, std::span<const Contact> contacts, BatchScratch& scratch,
                  Batches& batches, std::span<const Joint> joints) {
    joinBodies(kind, contacts, joints, scratch);
    const std::uint32_t count = numberBatches(scratch);
    const auto& batch_of_body = scratch.batch_of_body;

    batches.body_begin.assign(count + 1, 0);
    for (const std::uint32_t batch : batch_of_body) {
        if (batch != no_batch) ++batches.body_begin[batch];
    }
    countsToOffsets(batches.body_begin);
    batches.bodies.resize(batches.body_begin[count]);
    scratch.cursor.assign(batches.body_begin.begin(), batches.body_begin.end());
    for (std::size_t i = 0; i < batch_of_body.size(); ++i) {
        if (batch_of_body[i] == no_batch) continue;
        batches.bodies[scratch.cursor[batch_of_body[i]]++] = static_cast<BodyIndex>(i);
    }

    batches.contact_begin.assign(count + 1, 0);
    resizeTightly(batches.batch_of_contact, contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        batches.batch_of_contact[c] = batch_of_body[scratch.owners[c]];
        ++batches.contact_begin[batches.batch_of_contact[c]];
    }
    countsToOffsets(batches.contact_begin);
    resizeTightly(batches.contacts, contacts.size());
    scratch.cursor.assign(batches.contact_begin.begin(), batches.contact_begin.end());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        batches.contacts[scratch.cursor[batches.batch_of_contact[c]]++] = static_cast<std::uint32_t>(c);
    }
}

void listContacts(std::span<const BodyKind> kind, std::span<const Contact> contacts, ContactsOfBodies& of_bodies) {
    auto& begin = of_bodies.begin;
    begin.assign(kind.size() + 1, 0);
    for (const Contact& contact : contacts) {
        for (const BodyIndex body : {contact.a, contact.b}) begin[body] += isDynamic(kind, body) ? 1u : 0u;
    }
    countsToOffsets(begin);
    resizeTightly(of_bodies.contacts, begin[kind.size()]);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        for (const BodyIndex body : {contacts[c].a, contacts[c].b}) {
            if (isDynamic(kind, body)) of_bodies.contacts[begin[body]++] = static_cast<std::uint32_t>(c);
        }
    }
    // Each begin has moved on to the begin of the next body: shift them back by one.
    std::copy_backward(begin.begin(), begin.end() - 1, begin.end());
    begin.front() = 0;
}

}  // namespace cairn
