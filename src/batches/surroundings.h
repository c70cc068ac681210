/// @file The surroundings of some contacts, as groups of their own: what a change there reaches at first.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "batches/batches.h"
#include "math/groups.h"
#include "parallel/function_ref.h"

namespace cairn {

/// What surroundings are looked for in.
struct SurroundingsInput {
    std::span<const BodyKind> kind;
    std::span<const Contact> contacts;
    const ContactsOfBodies& contacts_of;
    std::span<const std::uint8_t> excluded;  ///< [slots] 1 = its contacts are left out; empty = none
};

/// How many contacts away from the seeds the bodies are that are taken with all their contacts.
struct Rings {
    int near;  ///< through any contact
    int far;   ///< further on, through contacts that lead there
    FunctionRef<bool(const Contact&)> leads;
};

/// Groups of contacts that share no body that moves, each with all contacts of the bodies that so many contacts lead to
/// from one of some contacts. The bodies at the edge of a group are in it with a part of their contacts: what the group
/// gives them they keep, so nothing is lost, but what it means to their others is not asked.
class Surroundings {
  public:
    /// @param seeds indices of contacts @param rings from their bodies
    void find(const SurroundingsInput& input, std::span<const std::uint32_t> seeds, const Rings& rings);
    /// In the order of their lowest bodies.
    std::span<const BatchView> groups() const { return groups_; }

  private:
    void collectBodies(const SurroundingsInput& input, std::span<const std::uint32_t> seeds, const Rings& rings);
    void collectContacts(const SurroundingsInput& input);
    void divide();

    /// Which contacts of a body are taken.
    enum class Taken : std::uint8_t { none, some, all };

    std::vector<Taken> taken_;                                     ///< [slots]
    Groups joined_;                                                ///< of slots
    std::vector<BodyIndex> inside_;                                ///< bodies with all their contacts
    std::vector<std::pair<BodyIndex, BodyIndex>> members_;         ///< root and body
    std::vector<std::pair<BodyIndex, std::uint32_t>> of_members_;  ///< a body, later the root, and contact
    std::vector<BodyIndex> bodies_;                                ///< group after group
    std::vector<std::uint32_t> contacts_;                          ///< likewise
    std::vector<BatchView> groups_;
};

}  // namespace cairn
