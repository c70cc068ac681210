/// @file Penetration correction by projected Gauss–Seidel on positions. @source Catto, Modeling and Solving
/// Constraints, GDC 2009 (position correction of overlapping contacts by inverse masses)
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "correction/correction.h"

namespace cairn {

/// Visits the contacts of a batch forth and back in ascending order. Where one is deeper than what it is allowed with
/// all that moved so far, its bodies move and turn apart as an impulse along the normal would let them, until the part
/// of that is left that remains; of what is far too deep, half is left for the next steps. So the centre of mass of a
/// pair stays, a chain of contacts shares what one of them had too much, a body that stands on an edge is turned rather
/// than lifted, and the cost follows the number of contacts. Of what the first sweeps leave too deep, the heavier
/// body of a contact takes a larger part: light bodies between heavy ones have nowhere to go.
///
/// Only first-order distances of the contacts there are tell it where to stop, so somebody may take bodies back before
/// all this is settled.
///
/// What this lifts is paid for: the bodies that gained potential energy are owed by the motion along the normals of
/// their contacts. Each contact in turn gives what it has and they still owe, by an equal and opposite impulse that
/// slows closing or separating bodies down and never reverses them. Momentum is kept, and a pile that is pushed apart
/// has lost as much motion as it gained height. Where there is not enough, as in jams, all bodies of the batch go back
/// on their way until what is not paid for lifts them by no more than a small part of how far they fall in a time step:
/// else the correction would lift what gravity brings down again for ever. What is deeper than steps let bodies get, as
/// a scene or a user may begin with, comes apart faster the deeper it is (a stack slowly, from its top on), and what
/// supports that move carry goes along.
class PositionSweeps final : public Correction {
  public:
    /// Moves the bodies only.
    CorrectionCounts correct(const BatchView& batch, const ContactsOfBodies& contacts_of, std::span<Contact> contacts,
                             const BodyState& bodies, double remaining) override;
    CorrectionCounts settle(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                            const PosesBefore& before) override;

  private:
    static constexpr std::uint32_t no_levers = UINT32_MAX;
    /// A contact as the sweeps see it, compact and with local indices of its bodies.
    struct Overlap {
        Vec3 normal;                       ///< from B to A [W]
        double distance = 0;               ///< before the correction [m]
        double threshold = 0;              ///< of the distance, below which the bodies move apart [m], ≤ 0
        std::uint32_t a = 0;               ///< local index of A; that of all fixed bodies is the last
        std::uint32_t b = 0;               ///< local index of B
        std::uint32_t index = 0;           ///< in the contact array
        std::uint32_t levers = no_levers;  ///< in levers_
    };
    /// What pushes of a contact turn and how much they move.
    struct Levers {
        Vec3 a;             ///< from the centre of mass of A to the contact, × normal [m]
        Vec3 b;             ///< likewise of B
        Vec3 turn_a;        ///< I_A⁻¹·a [1/(kg·m)]
        Vec3 turn_b;        ///< likewise of B
        double mass_a = 0;  ///< inverse mass of A [1/kg]
        double mass_b = 0;  ///< likewise of B
        double k_a = 0;     ///< what a unit push on A along the normal changes of the distance [1/kg]
        double k_b = 0;     ///< likewise on B
    };
    /// How a sweep pushes.
    struct Push {
        double remaining;      ///< part of the threshold that is left
        double largest_ratio;  ///< of the ways of the two bodies, infinite = by inverse masses
    };
    /// What happens to a body.
    struct Share {
        Vec3 displacement = Vec3::Zero();  ///< [m, W]
        Vec3 turn = Vec3::Zero();          ///< rotation vector [W]
        double most_turn = 0;              ///< [rad]
        double lift = 0;                   ///< potential energy gained [J], ≥ 0
        double debt = 0;                   ///< of that, not paid for yet [J]
        double depth = 0;                  ///< of its deepest contact, as a multiple of what is allowed
        bool moved = false;

        void turnBy(const Vec3& angle) {
            turn += angle;
            const double squared = turn.squaredNorm();
            if (squared > most_turn * most_turn) turn *= most_turn / std::sqrt(squared);
        }
    };

    /// What happens to a body of the batch at hand; fixed bodies share the last one.
    Share& shareOf(BodyIndex i, const BodyState& bodies) {
        return bodies.isFixed(i) ? shares_.back() : shares_[bodies.place[i]];
    }
    void gather(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies);
    bool isMoved(const Overlap& overlap) const { return shares_[overlap.a].moved || shares_[overlap.b].moved; }
    const Levers& leversOf(Overlap& overlap, std::span<const Contact> contacts, const BodyState& bodies);
    double sweep(std::span<const Contact> contacts, const BodyState& bodies, const Push& push);
    double separate(Overlap& overlap, std::span<const Contact> contacts, const BodyState& bodies, const Push& push);
    double distanceOf(const Overlap& overlap) const;
    void displace(const BatchView& batch, const BodyState& bodies);
    std::int64_t findMoved(const BatchView& batch, const BodyState& bodies, const PosesBefore& before);
    double grantedPart(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
                       const PosesBefore& before);
    void takeBack(double part, const BatchView& batch, const BodyState& bodies, const PosesBefore& before);
    void moveContact(Contact& contact, const Share& a, const Share& b, const PosesBefore& before) const;
    void payAt(const Contact& contact, Share& a, Share& b, const BodyState& bodies, const PosesBefore& before);

    bool stuck_ = false;  ///< the batch began deep in each other
    std::vector<Overlap> overlaps_;
    std::vector<Levers> levers_;  ///< of the contacts that asked for them
    std::vector<Share> shares_;   ///< [bodies of the batch + 1]
};

}  // namespace cairn
