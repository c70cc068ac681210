/// @file The joints of a batch under resolution. They hold at any time: an impulse at a contact of a jointed body
/// changes all that is tied to it, and the contact's collision matrix says so. Sequential impulses with restitution
/// then work on mechanisms as on single bodies. So does what yields in proportion (springs, servos). Ropes, limits,
/// motors and friction are resolved between the contacts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "joints/joint_system.h"
#include "resolution/contact_frame.h"
#include "resolution/rolling.h"

namespace cairn {

/// A group of joints in the local numbering of a batch.
class BatchJointGroup {
  public:
    void gather(std::span<JointBlock> blocks, std::vector<LocalBody>& bodies, std::span<const std::uint32_t> place);
    /// Takes the masses of the bodies as they are now.
    void factorise(std::span<const LocalBody> bodies);
    /// Makes the velocities those that the joints allow.
    void project(std::span<LocalBody> bodies);
    /// Adds the change of system.respond() to the bodies, and to the impulses of the joints.
    void applyResponse(std::span<LocalBody> bodies);
    /// One pass over ropes, limits and motors. @return largest change of a rate [m/s], of turns at the body's reach
    double resolveBounds(std::span<LocalBody> bodies);
    /// @param direct what contacts changed of the members by themselves
    void settle(std::span<Twist> direct);
    /// Writes the sum of the joints' impulses into their blocks.
    void report() const;
    std::span<double> received() { return received_; }              ///< [rows] sum of the impulses
    std::span<const double> received() const { return received_; }  ///< likewise

    JointSystem system;
    std::vector<std::uint32_t> local;  ///< [members] index of their LocalBody

  private:
    void throwBack(std::span<const LocalBody> bodies);
    double rateOf(const JointBlock& block, const JointRow& row, std::span<const LocalBody> bodies);
    double resolveBound(const JointBlock& block, BoundRow& bound, std::span<LocalBody> bodies);

    std::vector<BodyIndex> members_;      ///< ascending
    std::vector<BodyResponse> response_;  ///< [members] scratch
    std::vector<Twist> velocity_;         ///< [members] scratch
    std::vector<double> impulses_;        ///< [rows] scratch
    std::vector<double> received_;        ///< [rows] sum of the impulses
    std::vector<double> projected_;       ///< [rows] those of project()
};

/// All groups of joints of a batch.
class BatchJoints {
  public:
    /// Makes the joints hold. @param bodies the batch's dynamic bodies @param place [slots] their indices
    void gather(std::span<JointBlock> blocks, std::vector<LocalBody>& bodies, std::span<const std::uint32_t> place);
    bool empty() const { return count_ == 0; }
    bool hasBounds() const { return has_bounds_; }
    /// Whether a contact touches a jointed body.
    bool holds(const ContactFrame& contact) const {
        return count_ > 0 && (groupOf(contact.a) != none || groupOf(contact.b) != none);
    }
    /// The collision matrix with the joints holding [1/kg, contact coordinates]: positive definite, or 0 where they
    /// block the normal. @pre holds(contact)
    Symmetric3 collisionMatrix(const ContactFrame& contact, std::span<const LocalBody> bodies);
    /// Stores it, with its inverse where the joints leave the contact free to move. @pre holds(contact)
    void setCollisionMatrixOf(ContactFrame& contact, std::span<const LocalBody> bodies);
    /// Applies an impulse on A at a contact. @param impulse [N·s, W] @pre holds(contact)
    void push(const ContactFrame& contact, const Vec3& impulse, std::span<LocalBody> bodies);
    /// Likewise an angular impulse. @param impulse [N·m·s, W] @pre holds(contact)
    void turn(const ContactFrame& contact, const Vec3& impulse, std::span<LocalBody> bodies);
    /// wrenchMatrix() with the joints holding. @pre holds(contact)
    Mat6 wrenchMatrix(const ContactFrame& contact, std::span<const LocalBody> bodies);
    /// Calls use(local body, change) for all that the last push() or turn() changed. @pre holds(contact), that of the
    /// push
    template <class Use>
    void forChanged(const ContactFrame& contact, const Use& use) const;
    /// Takes the masses of the bodies as they are now.
    void factorise(std::span<const LocalBody> bodies);
    /// Passes over ropes, limits and motors until they hold together. @param threshold rate that may be left [m/s]
    /// @return whether a rate changed by more than that
    bool resolveBounds(std::span<LocalBody> bodies, double threshold);
    /// Finds the impulses of the joints from the sums of the contacts' impulses, for resolutions that change velocities
    /// in other ways than by push(). @pre no body's mass was changed
    void settle(std::span<const ContactFrame> contacts, std::span<const RollingContact> rolling,
                std::span<const LocalBody> bodies);
    /// Writes the impulses into the blocks.
    void scatter() const;
    /// The impulses that the rows received so far. @param saved out; keeps its memory
    void save(std::vector<double>& saved) const;
    /// Takes those received since back to a part.
    void keepPartSince(std::span<const double> saved, double part);

  private:
    static constexpr std::uint32_t none = UINT32_MAX;

    /// A body's place among the groups.
    struct Place {
        std::uint32_t group = none;
        std::uint32_t member = JointSystem::none;
    };

    std::uint32_t groupOf(std::uint32_t body) const { return body < place_.size() ? place_[body].group : none; }
    Place placeOf(std::uint32_t body) const { return body < place_.size() ? place_[body] : Place{}; }
    /// What impulse and angular impulse change of A and B directly, and of all else through respond().
    void respond(const ContactFrame& contact, const Vec3& impulse, const Vec3& angular,
                 std::span<const LocalBody> bodies);
    void applyResponse(const ContactFrame& contact, std::span<LocalBody> bodies);
    /// Of A relative to B at the contact, by the last respond().
    Twist relativeChange(const ContactFrame& contact) const;

    std::vector<BatchJointGroup> groups_;  ///< the first count_ are in use
    std::size_t count_ = 0;
    bool has_bounds_ = false;
    std::vector<Place> place_;                 ///< [dynamic bodies]
    std::vector<std::vector<Twist>> settled_;  ///< [groups][members] scratch of settle()
    Twist direct_a_, direct_b_;                ///< of the last respond()
};

template <class Use>
void BatchJoints::forChanged(const ContactFrame& contact, const Use& use) const {
    const std::uint32_t group_a = groupOf(contact.a);
    const std::uint32_t group_b = groupOf(contact.b);
    const auto useGroup = [&](const BatchJointGroup& group) {
        for (std::size_t i = 0; i < group.local.size(); ++i) use(group.local[i], group.system.changes()[i]);
    };
    if (group_a != none) {
        useGroup(groups_[group_a]);
    } else {
        use(contact.a, direct_a_);
    }
    if (group_b == none) {
        use(contact.b, direct_b_);
    } else if (group_b != group_a) {
        useGroup(groups_[group_b]);
    }
}

}  // namespace cairn
