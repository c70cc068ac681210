/// @file Joints connected by bodies that can move.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "joints/joint.h"

namespace cairn {

/// All groups, ascending by their lowest joints. Inactive joints are in none.
struct JointGroups {
    /// Grouped slots of joints, within a group in the order of a walk from one end to the other: what a solver fills in
    /// then stays near the diagonal.
    std::vector<std::uint32_t> joints;
    std::vector<std::uint32_t> joint_begin;  ///< [groups + 1] offsets into joints
    std::vector<BodyIndex> bodies;           ///< grouped, those that can move, ascending
    std::vector<std::uint32_t> body_begin;   ///< [groups + 1] offsets into bodies

    std::size_t size() const { return joint_begin.empty() ? 0 : joint_begin.size() - 1; }
    std::span<const std::uint32_t> jointsOf(std::size_t group) const {
        return std::span(joints).subspan(joint_begin[group], joint_begin[group + 1] - joint_begin[group]);
    }
    std::span<const BodyIndex> bodiesOf(std::size_t group) const {
        return std::span(bodies).subspan(body_begin[group], body_begin[group + 1] - body_begin[group]);
    }
};

/// Finds the groups; keeps its memory.
class JointGrouping {
  public:
    void build(std::span<const Joint> joints, std::span<const BodyKind> kind, JointGroups& groups);

  private:
    void listJointsOfBodies(std::span<const Joint> joints, std::span<const BodyKind> kind);
    void walk(std::span<const Joint> joints, std::span<const BodyKind> kind, std::uint32_t first);

    std::vector<std::uint32_t> begin_;    ///< [slots + 1] offsets into of_body_
    std::vector<std::uint32_t> of_body_;  ///< joints of each body that can move, ascending
    std::vector<std::uint32_t> visit_;    ///< [joints] number of the walk that came by
    std::vector<std::uint32_t> order_;    ///< joints of the walk
    std::uint32_t walks_ = 0;
};

}  // namespace cairn
