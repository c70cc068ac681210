/// @file The kinds of joints: one table entry each, which says what a joint is called, what it is described with, what
/// it keeps and what it leaves free.
#pragma once

#include <span>
#include <string_view>

#include "joints/joint_motions.h"
#include "joints/joint_rows.h"

namespace cairn {

/// What the description of a joint may have besides its bodies and anchor.
struct JointUses {
    bool length = false;       ///< two points and a length
    bool axis = false;         ///< needs an axis
    bool second_axis = false;  ///< may have a second one
    bool lead = false;         ///< needs a lead
    bool cone = false;         ///< may have a cone
    bool torque = false;       ///< passes torque, at which it may break
    bool own_axis = false;     ///< what acts along the one free axis is given by the description itself
    bool axes = false;         ///< ... is given as a list
    bool free_axes = false;    ///< the list names the free axes
    bool couples = false;      ///< two joints, no bodies of its own
};

/// One kind.
struct JointKindEntry {
    std::string_view name;   ///< in scene files
    std::string_view title;  ///< in messages
    JointUses uses;
    std::span<const JointAlong> free;  ///< axes that it leaves free, in the order of JointDescription::axes
    /// Adds what it keeps; null for couplings, whose row is about two joints.
    void (*keep)(const Joint& joint, const JointPlacement& at, JointBlock& block);
    /// Position and rate along a free axis.
    JointMotion (*motion)(const Joint& joint, const JointPlacement& at, const FreeAxis& axis);
};

/// The locked axes of a body, which are kept like a joint that nobody but the world knows of.
inline constexpr JointKind body_locks = static_cast<JointKind>(static_cast<std::uint8_t>(JointKind::mimic) + 1);

/// All kinds, in the order of JointKind.
std::span<const JointKindEntry> jointKinds();

/// @pre kind <= body_locks
const JointKindEntry& entryOf(JointKind kind);

/// Whether a position along an axis is an angle.
inline bool isAngle(JointAlong along) {
    return along >= JointAlong::turn_x;
}

}  // namespace cairn
