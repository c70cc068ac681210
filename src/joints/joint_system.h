/// @file The equations of a group of joints: which impulses keep all of them at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "joints/joint_rows.h"

namespace cairn {

/// Linear and angular velocity of a body, or a change of them.
struct Twist {
    Vec3 v = Vec3::Zero();  ///< [m/s, W]
    Vec3 w = Vec3::Zero();  ///< [rad/s, W]
};

/// What a body opposes to impulses.
struct BodyResponse {
    double mass_inv = 0;              ///< [1/kg]
    Mat3 inertia_inv = Mat3::Zero();  ///< [1/(kg·m²), W]
};

/// The rows J of a group of joints and the factors of J·M⁻¹·Jᵀ = L·D·Lᵀ, stored from the first nonzero of each row on:
/// a chain costs as much per joint as a single one. Rows that yield have their softness on the diagonal. Rows that
/// follow from others (closed loops in space) have a zero pivot and receive no impulse. Bodies are called by their
/// places in members(); what a body cannot do is left out.
class JointSystem {
  public:
    static constexpr std::uint32_t none = UINT32_MAX;

    /// Which rows of the blocks are solved.
    enum class Rows : std::uint8_t {
        rigid,  ///< what the joints keep
        all,    ///< and linear bound rows, which yield
    };

    /// @param members bodies of the group that can move, ascending @param blocks its joints, in the order of their
    /// group; they must stay where they are
    void begin(std::span<const BodyIndex> members, std::span<JointBlock> blocks, Rows which);
    /// Takes the bodies' masses and factorises. @param response of each member
    void factorise(std::span<const BodyResponse> response);

    std::span<const BodyIndex> members() const { return members_; }
    std::span<JointBlock> blocks() const { return blocks_; }
    std::size_t rows() const { return rows_.size(); }

    /// Solves in place for the impulses that change the rates of the rows by the given amounts, less what those that
    /// yield do.
    void solve(std::span<double> x) const;
    /// Takes from the rates of rows that yield those which they are to have. @param rates of all rows
    void subtractTargets(std::span<double> rates) const;
    /// Gives the blocks the impulses of their rows. @param impulses of all rows, since begin()
    void report(std::span<const double> impulses) const;
    /// Rate of each row. @param velocity of each member
    void rates(std::span<const Twist> velocity, std::span<double> out) const;
    /// Adds what impulses along the rows give. @param velocity of each member
    void addImpulses(std::span<const double> impulses, std::span<Twist> velocity) const;

    /// The change of all members when two of them are given an impulse and the joints hold, with the joints' impulses.
    /// @param a, b members, or none @param direct what the impulse alone would change of them
    void respond(std::uint32_t a, const Twist& direct_a, std::uint32_t b, const Twist& direct_b);
    std::span<const Twist> changes() const { return changes_; }       ///< by respond() [members]
    std::span<const double> reactions() const { return reactions_; }  ///< by respond() [rows]

    /// As respond(), to a unit impulse along a bound row. @return how much its rate changes
    double respondAlong(const JointBlock& block, const JointRow& row);
    /// Adds what an impulse along a row gives, joints aside. @param velocity of each member
    void addAlong(const JointBlock& block, const JointRow& row, double impulse, std::span<Twist> velocity) const;
    double rateOf(const JointBlock& block, const JointRow& row, std::span<const Twist> velocity) const;
    /// How many rows of a block followed from others. @param block its index
    std::uint32_t redundantOf(std::size_t block) const;
    /// The place of a body in members(), or none.
    std::uint32_t memberOf(BodyIndex body) const;

  private:
    /// What a row means for one of its bodies.
    struct End {
        std::uint32_t member;
        Vec3 linear, angular;
        Twist per;  ///< what a unit impulse changes
    };
    struct Row {
        std::uint32_t ends, ends_end;  ///< in ends_, with members only
        double softness = 0;           ///< rate by which it yields per impulse
        double target = 0;             ///< rate that it is to have
        std::uint32_t first = 0;       ///< first row with which it is coupled
        std::size_t begin = 0;         ///< offset of that entry in lower_
    };

    void addRow(const JointBlock& block, const JointRow& row);
    void addCoupling(const JointBlock& block);
    void addEnd(BodyIndex body, const Vec3& linear, const Vec3& angular);
    std::span<const End> endsOf(const Row& row) const {
        return std::span(ends_).subspan(row.ends, row.ends_end - row.ends);
    }

    void findProfile();
    double coupling(const Row& x, const Row& y) const;
    Twist perImpulse(std::uint32_t member, const Vec3& linear, const Vec3& angular) const;

    std::span<const BodyIndex> members_;
    std::span<JointBlock> blocks_;
    std::vector<BodyResponse> response_;  ///< [members]
    Rows which_ = Rows::all;
    std::vector<Row> rows_;                 ///< of all blocks
    std::vector<End> ends_;                 ///< of all rows
    std::vector<std::uint32_t> block_end_;  ///< [blocks] offsets into rows_
    std::vector<double> lower_;             ///< L, row by row, without its diagonal
    std::vector<double> pivot_inv_;         ///< [rows] 1/D; 0 = the row follows from others
    std::vector<std::uint32_t> first_row_;  ///< [members] scratch of the profile
    std::vector<Twist> changes_;            ///< [members]
    std::vector<double> reactions_;         ///< [rows]
};

}  // namespace cairn
