#include "joints/joint_groups.h"

#include <algorithm>
#include <numeric>

namespace cairn {

namespace {

template <class Use>
void forMovable(const Joint& joint, std::span<const BodyKind> kind, const Use& use) {
    for (const BodyIndex body : {joint.a, joint.b}) {
        if (isMovable(kind, body)) use(body);
    }
}

}  // namespace

void JointGrouping::listJointsOfBodies(std::span<const Joint> joints, std::span<const BodyKind> kind) {
    begin_.assign(kind.size() + 1, 0);
    for (const Joint& joint : joints) {
        if (joint.present) forMovable(joint, kind, [&](BodyIndex body) { ++begin_[body]; });
    }
    std::exclusive_scan(begin_.begin(), begin_.end(), begin_.begin(), std::uint32_t{0});
    of_body_.resize(begin_.back());
    // Filled from the back, which leaves begin_ as it must be and the joints of a body ascending.
    for (std::size_t i = 0; i < kind.size(); ++i) begin_[i] = begin_[i + 1];
    for (auto j = static_cast<std::uint32_t>(joints.size()); j-- > 0;) {
        if (joints[j].present) forMovable(joints[j], kind, [&](BodyIndex body) { of_body_[--begin_[body]] = j; });
    }
}

/// Breadth first over the joints that share a body that can move.
void JointGrouping::walk(std::span<const Joint> joints, std::span<const BodyKind> kind, std::uint32_t first) {
    ++walks_;
    order_.assign(1, first);
    visit_[first] = walks_;
    for (std::size_t next = 0; next < order_.size(); ++next) {
        forMovable(joints[order_[next]], kind, [&](BodyIndex body) {
            for (std::uint32_t k = begin_[body]; k < begin_[body + 1]; ++k) {
                if (visit_[of_body_[k]] == walks_) continue;
                visit_[of_body_[k]] = walks_;
                order_.push_back(of_body_[k]);
            }
        });
    }
}

void JointGrouping::build(std::span<const Joint> joints, std::span<const BodyKind> kind, JointGroups& groups) {
    groups.joints.clear();
    groups.bodies.clear();
    groups.joint_begin.assign(1, 0);
    groups.body_begin.assign(1, 0);
    if (joints.empty()) return;
    listJointsOfBodies(joints, kind);
    visit_.assign(joints.size(), 0);
    walks_ = 0;
    for (std::uint32_t j = 0; j < joints.size(); ++j) {
        if (!isActive(joints[j], kind) || visit_[j] != 0) continue;
        walk(joints, kind, j);
        walk(joints, kind, order_.back());
        for (const std::uint32_t joint : order_) {
            groups.joints.push_back(joint);
            forMovable(joints[joint], kind, [&](BodyIndex body) { groups.bodies.push_back(body); });
        }
        const auto first = groups.bodies.begin() + groups.body_begin.back();
        std::sort(first, groups.bodies.end());
        groups.bodies.erase(std::unique(first, groups.bodies.end()), groups.bodies.end());
        groups.joint_begin.push_back(static_cast<std::uint32_t>(groups.joints.size()));
        groups.body_begin.push_back(static_cast<std::uint32_t>(groups.bodies.size()));
    }
}

}  // namespace cairn
