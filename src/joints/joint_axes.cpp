#include "joints/joint_axes.h"

#include <algorithm>

namespace cairn {

namespace {

BoundRow& newBound(const JointMotion& motion, JointBlock& block) {
    BoundRow& bound = block.bound.emplace_back();
    ++block.bounds;
    bound.row = motion.row;
    return bound;
}

/// Impulses −weight·(rate − target), added up: what yields is one row, however much acts along it.
struct Yielding {
    double weight = 0;     ///< [N·s per m/s, or N·m·s per rad/s]
    double by_target = 0;  ///< Σ weight·target

    void add(double its_weight, double its_target) {
        weight += its_weight;
        by_target += its_weight * its_target;
    }
    /// The impulse h·(k·(wanted − x) + c·(speed − ẋ)) with x and ẋ at the end of a step h, where x has moved by h·ẋ.
    void addPull(double stiffness, double wanted, double damping, double speed, double position, double time_step) {
        const double weight_of_both = time_step * (stiffness * time_step + damping);
        if (!(weight_of_both > 0)) return;
        add(weight_of_both, time_step * (stiffness * (wanted - position) + damping * speed) / weight_of_both);
    }
    void addTo(BoundRow& bound) const {
        bound.is_motor = true;
        bound.softness = 1 / weight;
        bound.lowest = bound.highest = by_target / weight;
        bound.strongest = Joint::infinite;
    }
};

void addServo(const FreeAxis& axis, double position, double time_step, Yielding& yielding) {
    yielding.addPull(axis.servo_stiffness, axis.servo_position, axis.servo_damping, axis.servo_speed, position,
                     time_step);
}

void addYielding(const JointMotion& motion, const FreeAxis& axis, double time_step, JointBlock& block) {
    Yielding yielding;
    yielding.addPull(axis.spring_stiffness, axis.spring_rest, axis.damping, 0, motion.position, time_step);
    if (axis.rotor_inertia > 0) yielding.add(axis.rotor_inertia, axis.rotor_speed);
    const bool is_strong = axis.hasServo() && axis.servo_limit == FreeAxis::infinite;
    if (is_strong) addServo(axis, motion.position, time_step, yielding);
    if (!(yielding.weight > 0)) return;
    BoundRow& bound = newBound(motion, block);
    yielding.addTo(bound);
    bound.is_linear = true;
}

}  // namespace

void addLimits(const JointMotion& motion, double lower, double upper, double time_step, JointBlock& block) {
    BoundRow& bound = newBound(motion, block);
    bound.to_lower = lower - motion.position;
    bound.to_upper = upper - motion.position;
    bound.lowest = std::min(bound.to_lower, 0.0) / time_step;
    bound.highest = std::max(bound.to_upper, 0.0) / time_step;
    bound.strongest = Joint::infinite;
}

void addDrives(const JointMotion& motion, const FreeAxis& axis, double time_step, JointBlock& block) {
    addYielding(motion, axis, time_step, block);
    if (axis.friction > 0) {
        BoundRow& bound = newBound(motion, block);
        bound.strongest = axis.friction * time_step;
        bound.is_motor = true;
    }
    if (axis.hasMotor()) {
        BoundRow& bound = newBound(motion, block);
        bound.lowest = bound.highest = axis.motor_speed;
        bound.strongest = axis.motor_limit * time_step;
        bound.is_motor = true;
    }
    if (axis.hasServo() && axis.servo_limit < FreeAxis::infinite) {
        Yielding servo;
        addServo(axis, motion.position, time_step, servo);
        if (!(servo.weight > 0)) return;
        BoundRow& bound = newBound(motion, block);
        servo.addTo(bound);
        bound.strongest = axis.servo_limit * time_step;
    }
}

}  // namespace cairn
