/// @file Groups of bodies connected by contacts and joints. Fixed bodies are barriers: they join nothing and are in no
/// group.
/// @source thesis §3.1, Figure 14
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/contact.h"
#include "joints/joint_rows.h"

namespace cairn {

/// One group, as the response sees it.
struct BatchView {
    std::span<const BodyIndex> bodies;        ///< dynamic bodies of the group, ascending
    std::span<const std::uint32_t> contacts;  ///< indices into the contact array, ascending
    std::span<JointBlock> joints{};           ///< of the group, group of joints after group of joints
};

/// All groups of a step, in canonical order (ascending by their lowest body). Bodies without contacts and joints are in
/// no group.
struct Batches {
    std::vector<BodyIndex> bodies;                ///< [Σ bodies] grouped
    std::vector<std::uint32_t> contacts;          ///< [Σ contacts] grouped
    std::vector<std::uint32_t> body_begin;        ///< [batches + 1] offsets into bodies
    std::vector<std::uint32_t> contact_begin;     ///< [batches + 1] offsets into contacts
    std::vector<std::uint32_t> batch_of_contact;  ///< [contacts] index of the batch

    static constexpr std::uint32_t none = UINT32_MAX;

    std::size_t size() const { return body_begin.empty() ? 0 : body_begin.size() - 1; }
    /// The group without its joints.
    BatchView operator[](std::size_t i) const {
        return {std::span(bodies).subspan(body_begin[i], body_begin[i + 1] - body_begin[i]),
                std::span(contacts).subspan(contact_begin[i], contact_begin[i + 1] - contact_begin[i]),
                {}};
    }
};

/// The contacts of each body, as a compressed table.
struct ContactsOfBodies {
    std::vector<std::uint32_t> begin;     ///< [slots + 1] offsets into contacts
    std::vector<std::uint32_t> contacts;  ///< indices into the contact array, ascending per body

    std::span<const std::uint32_t> operator[](BodyIndex i) const {
        return std::span(contacts).subspan(begin[i], begin[i + 1] - begin[i]);
    }
};

/// Scratch of buildBatches, kept between steps so that a steady step allocates nothing.
struct BatchScratch {
    std::vector<std::uint32_t> parent;
    std::vector<std::uint32_t> batch_of_body;
    std::vector<BodyIndex> owners;  ///< [contacts] a dynamic body of each
    std::vector<std::uint32_t> cursor;
};

/// Union–find over contacts and joints. @param kind per slot @param contacts sorted by (a, b)
void buildBatches(std::span<const BodyKind> kind, std::span<const Contact> contacts, BatchScratch& scratch,
                  Batches& batches, std::span<const Joint> joints = {});

/// Lists the contacts of every dynamic body; fixed bodies get empty lists, since nothing travels through them.
void listContacts(std::span<const BodyKind> kind, std::span<const Contact> contacts, ContactsOfBodies& of_bodies);

}  // namespace cairn
