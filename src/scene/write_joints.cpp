#include <fmt/format.h>

#include <cmath>

#include "joints/joint_kinds.h"
#include "scene/joint_axis_names.h"
#include "scene/scene_writing.h"

namespace cairn {
namespace {

using written::isOmitted;
using written::number;
using written::same;
using written::vector;

/// Adds members behind others.
class Members {
  public:
    explicit Members(std::string text) : text_(std::move(text)) {}

    void add(std::string_view key, const std::string& value) {
        text_ += fmt::format(R"({}"{}":{})", text_.back() == '{' ? "" : ",", key, value);
    }
    void addNumber(std::string_view key, const std::optional<double>& value) {
        if (value && std::isfinite(*value)) add(key, number(*value));
    }
    void addUnlessZero(std::string_view key, double value) {
        if (!same(value, 0)) addNumber(key, value);
    }
    std::string end() { return text_ + "}"; }

  private:
    std::string text_;
};

std::string servoText(const JointServo& servo) {
    Members out("{");
    out.addUnlessZero("position", servo.position);
    out.addUnlessZero("speed", servo.speed);
    out.addUnlessZero("stiffness", servo.stiffness);
    out.addUnlessZero("damping", servo.damping);
    out.addNumber("limit", servo.limit);
    return out.end();
}

/// What acts along an axis of a joint, or of its own.
template <class Axis>
void addAxis(const Axis& axis, Members& out) {
    out.addNumber("lower", axis.lower);
    out.addNumber("upper", axis.upper);
    out.addUnlessZero("restitution", axis.restitution);
    if (axis.motor) {
        out.add("motor",
                fmt::format(R"({{"speed":{},"limit":{}}})", number(axis.motor->speed), number(axis.motor->limit)));
    }
    if (axis.servo) out.add("servo", servoText(*axis.servo));
    if (axis.spring) {
        Members spring("{");
        spring.addNumber("stiffness", axis.spring->stiffness);
        spring.addUnlessZero("rest", axis.spring->rest);
        out.add("spring", spring.end());
    }
    out.addUnlessZero("damping", axis.damping);
    out.addUnlessZero("friction", axis.friction);
    out.addUnlessZero("rotor_inertia", axis.rotor_inertia);
}

std::string axesText(const JointDescription& joint, const JointUses& uses) {
    std::string out;
    for (const JointAxis& axis : joint.axes) {
        Members members("{");
        if (uses.free_axes) {
            members.add("along", fmt::format("\"{}\"", jointAxisNames()[static_cast<std::size_t>(axis.along)]));
        }
        addAxis(axis, members);
        out += (out.empty() ? "" : ",") + members.end();
    }
    return "[" + out + "]";
}

std::string couplingText(const SceneJoint& scene_joint, Members out) {
    const JointDescription& joint = scene_joint.joint;
    out.add("first", fmt::format("{}", scene_joint.first.value_or(0)));
    out.add("second", fmt::format("{}", scene_joint.second.value_or(0)));
    if (joint.first_axis != 0) out.add("first_axis", fmt::format("{}", joint.first_axis));
    if (joint.second_axis != 0) out.add("second_axis", fmt::format("{}", joint.second_axis));
    out.addNumber("ratio", joint.ratio);
    out.addNumber("break_force", joint.break_force);
    out.addNumber("break_torque", joint.break_torque);
    return out.end();
}

}  // namespace

std::string jointText(const SceneJoint& scene_joint) {
    const JointDescription& joint = scene_joint.joint;
    const JointKindEntry& kind = entryOf(joint.kind);
    const JointUses& uses = kind.uses;
    Members out(fmt::format(R"({{"type":"{}")", kind.name));
    if (uses.couples) return couplingText(scene_joint, std::move(out));
    out.add("a", fmt::format("{}", scene_joint.a));
    if (scene_joint.b) out.add("b", fmt::format("{}", *scene_joint.b));
    if (!isOmitted(joint.anchor)) out.add("anchor", vector(joint.anchor));
    if (joint.anchor_b) out.add("anchor_b", vector(*joint.anchor_b));
    if (uses.axis || (uses.axes && joint.axis != Vec3::UnitZ())) out.add("axis", vector(joint.axis));
    if (joint.axis_2) out.add("axis_2", vector(*joint.axis_2));
    out.addNumber("length", joint.length);
    out.addNumber("lead", joint.lead);
    if (uses.own_axis) addAxis(joint, out);
    out.addNumber("cone", joint.cone);
    if (!joint.axes.empty()) out.add("axes", axesText(joint, uses));
    out.addNumber("break_force", joint.break_force);
    out.addNumber("break_torque", joint.break_torque);
    if (joint.collide) out.add("collide", "true");
    return out.end();
}

}  // namespace cairn
