/// @file Structure-of-arrays storage of bodies. Slots keep their index for life; a removed body leaves a hole that a
/// later body may fill with the next generation. All loops run over slots in ascending order and skip holes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_fields.h"
#include "body/pair_filter.h"
#include "body/slot_move.h"

namespace cairn {

/// The state of bodies that the response reads and writes; knows nothing of shapes. All spans have one entry per slot.
struct BodyState {
    std::span<const BodyKind> kind;
    std::span<Vec3> position;                  ///< centre of mass [m, W]
    std::span<Quat> orientation;               ///< B to W
    std::span<Vec3> v;                         ///< [m/s, W]
    std::span<Vec3> w;                         ///< [rad/s, W]
    std::span<const double> mass_inv;          ///< [1/kg]; 0 for fixed bodies
    std::span<const Vec3> inertiaInv_B;        ///< [1/(kg·m²), B]; 0 for fixed bodies
    std::span<Mat3> inertiaInv_W;              ///< [1/(kg·m²), W]; 0 for fixed bodies
    std::span<const Vec3> linear_step;         ///< ℓ: displacement by the linear velocity in this time step [m, W]
    std::span<std::uint32_t> place;            ///< among the bodies of its batch, where that was written down
    std::span<std::uint8_t> asleep;            ///< 1 = asleep
    std::span<WakeReason> woken;               ///< why it woke in this step
    std::span<const double> gravity_factor{};  ///< of the global accelerations that it feels; empty = all of it
    std::span<const Load> load{};              ///< besides gravity; empty = nobody has one

    /// Whose last flight others denied for the most part [slots]; empty = nobody's.
    std::span<const std::uint8_t> denied{};

    /// Sum of the global accelerations, for the correction [m/s², W].
    Vec3 acceleration = Vec3::Zero();
    /// The length of a time step, for the correction and the resolution [s].
    double time_step = 0;
    /// What gravity gives in this time step to bodies at rest, and to those with a load [m/s, W].
    Vec3 damped_fall = Vec3::Zero(), whole_fall = Vec3::Zero();
    /// How the surfaces of fixed bodies move over them [slots] [m/s, W]; empty = none does.
    std::span<const Vec3> surface{};
    /// Whether one of the fixed bodies, or its surface, may move.
    bool supports_move = true;
    /// Who of those that can move is held still in this step [slots]; empty = nobody.
    std::span<const std::uint8_t> held{};
    /// Subset of the shock propagation; empty unless the step is traced.
    std::span<std::int32_t> shock_stage{};

    std::size_t size() const { return kind.size(); }
    /// Of a body's surface over the body, where it has a normal [m/s, W].
    Vec3 surfaceVelocity(BodyIndex i, const Vec3& normal) const {
        if (surface.empty()) return Vec3::Zero();
        return surface[i] - normal.dot(surface[i]) * normal;
    }
    double gravityFactor(BodyIndex i) const { return gravity_factor.empty() ? 1.0 : gravity_factor[i]; }
    bool isFixed(BodyIndex i) const { return kind[i] != BodyKind::dynamic; }
    bool isDenied(BodyIndex i) const { return !denied.empty() && denied[i] != 0; }
    Load loadOf(BodyIndex i) const { return load.empty() ? Load::none : load[i]; }
    /// What gravity gives a body in this time step if it is at rest [m/s, W].
    Vec3 fallOf(BodyIndex i) const { return gravityFactor(i) * (loadOf(i) == Load::none ? damped_fall : whole_fall); }
    /// Whether the resolution cannot move it.
    bool isImmovable(BodyIndex i) const { return isFixed(i) || (!held.empty() && held[i] != 0); }
    /// Writes down where the bodies of a batch stand in its list.
    void writePlaces(std::span<const BodyIndex> batch) const {
        for (std::uint32_t n = 0; n < batch.size(); ++n) place[batch[n]] = n;
    }
    /// Wakes a body if it sleeps, keeping the first reason of the step.
    void wake(BodyIndex i, WakeReason reason) const {
        if (asleep[i] == 0) return;
        asleep[i] = 0;
        woken[i] = reason;
    }
};

/// All bodies of a world.
class BodyStorage : public BodyArrays {
  public:
    /// The pose of the shape's frame S in B, and in W.
    Pose shapeInBody(BodyIndex i) const { return {p_BS[i], R_BS[i]}; }
    Pose shapePose(BodyIndex i) const {
        const Pose body{position[i], orientation[i]};
        // Most shapes have their frame where the body has its own.
        if (R_BS[i].w() == 1 && p_BS[i].isZero(0)) return body;
        return body.toOuter(shapeInBody(i));
    }
    /// Sets position and orientation of B from those of S. @param pose of S in W, a unit quaternion
    void setShapePose(BodyIndex i, const Pose& pose) {
        const Pose body = pose.toOuter(shapeInBody(i).inverse());
        position[i] = body.position;
        orientation[i] = body.orientation;
    }

    std::size_t slots() const { return kind.size(); }
    std::size_t count() const { return count_; }
    bool contains(BodyId id) const {
        const BodyIndex i = slotOf(id.index);
        return i < kind.size() && kind[i] != BodyKind::hole && generation[i] == id.generation;
    }
    BodyId idOf(BodyIndex i) const { return {homeOf(i), generation[i]}; }
    /// @throws StaleIdError
    BodyIndex indexOf(BodyId id) const;

    /// Takes the lowest hole or appends a slot, every entry reset, with the next number. The caller fills it.
    BodyIndex allocate(BodyKind new_kind);
    void release(BodyIndex i);
    /// A world that ranks share has slots only of some bodies. A slot then stands for another one, its home, which is
    /// that of the body in the whole world and names it; homes ascend. Otherwise a slot is its own home.
    /// @param i may be beyond all slots, as what is no body, and is its own home then
    BodyIndex homeOf(BodyIndex i) const { return i < homes_.size() ? homes_[i] : i; }
    /// The slot that stands for a home; no_slot if there is none here.
    BodyIndex slotOf(BodyIndex home) const;
    /// By slot; empty = every slot is its own home.
    std::span<const BodyIndex> homes() const { return homes_; }
    /// Number of slots of the whole world.
    std::size_t wholeSlots() const { return is_part_ ? whole_slots_ : slots(); }
    /// From now on slots may be those of a part of the world.
    void beginPart();
    /// Becomes a part of a world, of holes alone. @param homes of its slots, ascending @param whole_slots of the world
    void becomePart(std::vector<BodyIndex> homes, std::size_t whole_slots);
    /// @pre there is a slot for every home
    void endPart();
    /// Leaves the body that was allocated last to another rank, with its number and its home. @pre a part
    void passOver(BodyIndex i);
    /// Drops slots and adds blank holes. @param homes of the slots there are then, ascending @pre dropped slots are
    /// holes whose bodies no exception of the filter names, and the world is a part
    SlotMove takeHomes(std::vector<BodyIndex> homes);
    /// Finds the holes and the count anew. @pre every array that is saved has one entry per slot; call it after
    /// replacing them
    /// @param next_number above the number of every body
    void adoptSlots(std::uint64_t next_number);
    /// The number of the body that is added next.
    std::uint64_t nextNumber() const { return next_number_; }
    /// Changes when a body comes or goes, and when all are replaced.
    std::uint64_t layoutVersion() const { return layout_version_; }
    /// Takes the place of other bodies, so that the layout version becomes another than theirs.
    void succeed(const BodyStorage& others) { layout_version_ = others.layout_version_ + 1; }
    /// Sets the inverse mass properties from mass, inertia_B, kind and orientation.
    void updateMassProperties(BodyIndex i);
    BodyState state();

    /// Whether a body did not move since its contacts were found last.
    bool isWhereDetected(BodyIndex i) const {
        return detected_position[i] == position[i] && detected_orientation[i].coeffs() == orientation[i].coeffs();
    }

    /// Who touches whom. Exceptions of a body end with it.
    PairFilter filter;
    /// Whether two bodies never have contacts: their groups or an exception say so, or one of them is a sensor.
    bool areKeptApart(BodyIndex a, BodyIndex b) const {
        return (sensor[a] | sensor[b]) != 0 || filter.keepsApart(a, b, groups[a], groups[b]);
    }

  private:
    std::vector<BodyIndex> holes_;  ///< min-heap
    std::size_t count_ = 0;
    std::uint64_t next_number_ = 0;
    std::uint64_t layout_version_ = 0;
    bool is_part_ = false;          ///< of a world that ranks share
    std::size_t whole_slots_ = 0;   ///< where it is a part
    std::vector<BodyIndex> homes_;  ///< [slots] where it is a part
};

}  // namespace cairn
