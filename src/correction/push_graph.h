/// @file The contacts of a batch as the searches of the penetration correction see them: who pushes whom, and how far.
///
/// Most searches of a dense pile end at a body that must not move, and neighbouring contacts are blocked by the same
/// bodies. One unbroken chain of pushes from the first body to one that must not move makes a candidate invalid,
/// whatever else it pushes. So each body remembers through which contact it was last part of such a chain, and a search
/// follows these contacts from every body it reaches. Nothing is taken for granted: each link is checked with the
/// displacement at hand, so the outcome is that of the full search, but nearly always after a few bodies.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "batches/batches.h"
#include "body/contact.h"
#include "correction/candidate.h"

namespace cairn {

/// One contact seen from one of its bodies.
struct PushLink {
    Vec3 direction;           ///< the contact's normal, from this body to its neighbour [W]
    double gap = 0;           ///< distance that is left until the neighbour is pushed (2.5.6) [m]
    BodyIndex neighbour = 0;  ///< the other body
    bool neighbour_fixed = false;
};

/// What a moving body does to its neighbour. All displacements are multiples of the first one of their search.
struct Push {
    bool happens = false;
    double towards = 0;  ///< part of the first displacement along the link [m]
    double share = 0;    ///< by which the neighbour moves if it is free to; rounding can make it 0 or less
};

/// @param share of `displacement` by which the body moves @param displacement the first one of the search [m, W]
/// @source thesis (2.3.4)–(2.3.6)
///
/// A larger share never turns a push into none and never makes the neighbour's share smaller, in real numbers and in
/// rounded ones.
inline Push pushThrough(const PushLink& link, double share, const Vec3& displacement) {
    const double towards = displacement.dot(link.direction);
    const double approach = share * towards;  // dX·n_XY
    // (2.3.4), (2.3.5); both are false for what is not a number, so nothing travels through it.
    if (!(approach > 0 && approach > link.gap)) return {};
    // (2.3.6) with all vectors as multiples of the first: (s − e)/s · dX, s = share·towards.
    return {true, towards, link.gap > 0 ? share - link.gap / towards : share};
}

/// The links of every body, packed when a search first asks for them, and the ways along which pushes were blocked.
class PushGraph {
  public:
    /// Begins with new contacts; everything known is forgotten. What is passed must outlive the use.
    /// @param bodies with the places of those of the batch
    /// @param remaining f: the part of what they are allowed to overlap down to which contacts may be pushed, in (0, 1)
    void reset(const BatchView& batch, const ContactsOfBodies& contacts_of, std::span<const Contact> contacts,
               const BodyState& bodies, double remaining);

    /// One link per contact, in the order of the body's contacts. None for a fixed body.
    std::span<const PushLink> linksOf(BodyIndex body) {
        const Node& node = nodes_[place_[body]];
        if (node.packed != round_) pack(body);
        return std::span(links_).subspan(node.first, node.count);
    }

    /// To be called for those bodies of a contact whose distance has changed that can move.
    void distancesChanged(BodyIndex body) { nodes_[place_[body]].packed = 0; }

    /// Remembers that pushes of a body along about this displacement are blocked by way of one of its links.
    void rememberWay(BodyIndex body, const Vec3& displacement, std::uint32_t link);

    /// Follows the known way from a body that moves by a share of the candidate's displacement.
    /// @return true if it is blocked, which makes the candidate invalid; false says nothing
    bool isBlocked(BodyIndex body, double share, const Candidate& candidate);

  private:
    /// What blocks depends on the direction: one way for each combination of signs.
    static std::size_t octant(const Vec3& u) {
        return (u.x() < 0 ? 1U : 0U) | (u.y() < 0 ? 2U : 0U) | (u.z() < 0 ? 4U : 0U);
    }
    void pack(BodyIndex body);

    struct Node {
        std::uint64_t packed = 0;             ///< round in which the links were packed
        std::uint64_t known = 0;              ///< round in which the ways were found
        std::uint32_t first = 0;              ///< of the links, in links_
        std::uint32_t count = 0;              ///< number of links
        std::array<std::uint32_t, 8> ways{};  ///< link to follow, or none
    };

    const ContactsOfBodies* contacts_of_ = nullptr;
    std::span<const Contact> contacts_;
    std::span<const BodyKind> kind_;
    std::span<const std::uint32_t> place_;  ///< [slots]
    double remaining_ = 0;
    std::uint64_t round_ = 0;      ///< number of resets; nothing is ever cleared
    std::vector<Node> nodes_;      ///< [bodies of the batch]
    std::vector<PushLink> links_;  ///< of body after body
};

}  // namespace cairn
