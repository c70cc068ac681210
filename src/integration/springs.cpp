#include "integration/springs.h"

#include "math/tolerances.h"

namespace cairn {

namespace {

/// One end of a spring in W.
struct End {
    Vec3 point = Vec3::Zero();     ///< [m]
    Vec3 arm = Vec3::Zero();       ///< from the centre of mass [m]
    Vec3 velocity = Vec3::Zero();  ///< of the point [m/s]
};

bool moves(const BodyStorage& bodies, BodyIndex i) {
    return i != Spring::world_point && bodies.kind[i] == BodyKind::dynamic;
}

End endOf(const BodyStorage& bodies, BodyIndex i, const Vec3& anchor) {
    if (i == Spring::world_point) return {.point = anchor};
    const Vec3 arm = bodies.orientation[i] * anchor;
    return {.point = bodies.position[i] + arm, .arm = arm, .velocity = bodies.v[i] + bodies.w[i].cross(arm)};
}

/// Inverse of the effective mass of an end along a direction [1/kg].
double response(const BodyStorage& bodies, BodyIndex i, const Vec3& arm, const Vec3& direction) {
    if (!moves(bodies, i)) return 0;
    const Vec3 lever = arm.cross(direction);
    return bodies.mass_inv[i] + lever.dot(bodies.inertiaInv_W[i] * lever);
}

void push(BodyStorage& bodies, BodyIndex i, const Vec3& arm, const Vec3& impulse) {
    if (!moves(bodies, i)) return;
    bodies.v[i] += bodies.mass_inv[i] * impulse;
    bodies.w[i] += bodies.inertiaInv_W[i] * arm.cross(impulse);
}

void applySpring(const Spring& spring, BodyStorage& bodies, double time_step) {
    const End a = endOf(bodies, spring.a, spring.anchor_a);
    const End b = endOf(bodies, spring.b, spring.anchor_b);
    const Vec3 between = a.point - b.point;
    const double length = between.norm();
    // Ends that meet have no direction.
    if (!(length > tiny_part * spring.rest_length)) return;
    const Vec3 direction = between / length;
    const double speed = direction.dot(a.velocity - b.velocity);
    const double inverse_mass =
        response(bodies, spring.a, a.arm, direction) + response(bodies, spring.b, b.arm, direction);
    // Implicit Euler along the line: the impulse that the spring's force at the end of the step would give.
    const double per_speed = time_step * (spring.damping + spring.stiffness * time_step);
    const double stretch = length - spring.rest_length;
    const double impulse =
        -(spring.stiffness * stretch * time_step + per_speed * speed) / (1 + per_speed * inverse_mass);
    push(bodies, spring.a, a.arm, impulse * direction);
    push(bodies, spring.b, b.arm, -impulse * direction);
}

bool isStill(const BodyStorage& bodies, BodyIndex i) {
    return !moves(bodies, i) || bodies.asleep[i] != 0;
}

}  // namespace

void applySprings(const std::vector<Spring>& springs, BodyStorage& bodies, double time_step) {
    for (const Spring& spring : springs) {
        if (!spring.present || (isStill(bodies, spring.a) && isStill(bodies, spring.b))) continue;
        applySpring(spring, bodies, time_step);
    }
}

void wakeSpringEnds(const std::vector<Spring>& springs, BodyStorage& bodies) {
    const BodyState state = bodies.state();
    for (const Spring& spring : springs) {
        if (!spring.present) continue;
        const bool a_still = isStill(bodies, spring.a);
        const bool b_still = isStill(bodies, spring.b);
        if (a_still == b_still) continue;
        const BodyIndex still = a_still ? spring.a : spring.b;
        if (moves(bodies, still)) state.wake(still, WakeReason::changed);
    }
}

}  // namespace cairn
