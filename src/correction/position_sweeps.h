/// @file Penetration correction by projected Gauss–Seidel on positions. @source Catto, Modeling and Solving
/// Constraints, GDC 2009 (position correction of overlapping contacts by inverse masses)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "correction/correction.h"

namespace cairn {

/// Visits the contacts of a batch forth and back in ascending order. Where one is deeper than the threshold with all
/// that moved so far, its bodies move apart along the normal, each in proportion to its inverse mass, until the part of
/// the threshold is left that remains. So the centre of mass of a pair stays, a chain of contacts shares what one of
/// them had too much, and the cost follows the number of contacts. Nothing turns.
///
/// What this lifts is paid for: the bodies that gained potential energy are owed by the motion along the normals of
/// their contacts. Each contact in turn gives what it has and they still owe, by an equal and opposite impulse that
/// slows closing or separating bodies down and never reverses them. Momentum is kept, and a pile that is pushed apart
/// has lost as much motion as it gained height, as far as it had any.
class PositionSweeps final : public Correction {
  public:
    CorrectionCounts correct(const BatchView& batch, const ContactsOfBodies& contacts_of, std::span<Contact> contacts,
                             const BodyState& bodies, const CorrectionSettings& settings) override;

  private:
    /// A contact as the sweeps see it, compact and with local indices of its bodies.
    struct Overlap {
        Vec3 normal;              ///< from B to A [W]
        double distance = 0;      ///< before the correction [m]
        double part_a = 0;        ///< part of a push that moves A: its share of the inverse masses
        double part_b = 0;        ///< likewise of B; the two make 1
        std::uint32_t a = 0;      ///< local index of A; that of all fixed bodies is the last
        std::uint32_t b = 0;      ///< local index of B
        std::uint32_t index = 0;  ///< in the contact array
    };
    /// What happens to a body.
    struct Share {
        Vec3 displacement = Vec3::Zero();  ///< [m, W]
        double debt = 0;                   ///< potential energy gained and not paid for yet [J], ≥ 0
    };

    void gather(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies);
    double sweep(double threshold, double remaining);
    double separate(const Overlap& overlap, double threshold, double remaining);
    std::int64_t displace(const BatchView& batch, const BodyState& bodies);
    void pay(std::span<const Contact> contacts, const BodyState& bodies);
    void payAt(const Contact& contact, Share& a, Share& b, const BodyState& bodies);

    std::vector<Overlap> overlaps_;
    std::vector<Share> shares_;         ///< [bodies of the batch + 1]
    std::vector<std::uint32_t> local_;  ///< [slots] local index; holds for the bodies of the present batch
};

}  // namespace cairn
