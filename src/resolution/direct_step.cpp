#include "resolution/direct_step.h"

#include <Eigen/LU>

namespace cairn {

namespace {

/// Softness of a contact as a part of its K00.
constexpr double softness = 1e-7;

/// Rounds of iterative refinement: what the stiff matrix loses to rounding.
constexpr int refinements = 2;

Mat3 skew(const Vec3& r) {
    Mat3 m;
    m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    return m;
}

/// Velocity of a point of a body from its velocities: J = [1, −R].
Vec3 velocityAt(const Vec6& motion, const Vec3& r) {
    return motion.head<3>() + Vec3(motion.tail<3>()).cross(r);
}

void addForceAt(const Vec3& force, const Vec3& r, Vec6& sum) {
    sum.head<3>() += force;
    sum.tail<3>() += r.cross(force);
}

/// J_Xᵀ·W·J_Y of two points.
Mat6 coupling(const Vec3& r_x, const Mat3& weight, const Vec3& r_y) {
    const Mat3 x = skew(r_x);  // (−R)ᵀ
    const Mat3 y = -skew(r_y);
    Mat6 block;
    block.topLeftCorner<3, 3>() = weight;
    block.topRightCorner<3, 3>() = weight * y;
    block.bottomLeftCorner<3, 3>() = x * weight;
    block.bottomRightCorner<3, 3>() = x * weight * y;
    return block;
}

bool isSticking(const SweptContact& contact) {
    const double normal = contact.normal.dot(contact.impulse);
    // On the cone it slides; rounding must not make it stick again.
    constexpr double inside = 1 - 1e-9;
    const double cone = inside * contact.friction * normal;
    return (contact.impulse - normal * contact.normal).squaredNorm() < cone * cone;
}

}  // namespace

bool DirectStep::compute(const LocalBatch& batch, std::span<const SweptContact> swept) {
    const std::size_t count = swept.size();
    holds_.resize(count);
    stiffness_.resize(count);
    changes_.resize(count);
    couplings_.clear();
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
        const SweptContact& contact = swept[i];
        const bool pushes = contact.normal.dot(contact.impulse) > 0 && isResolvable(contact);
        holds_[i] = !pushes ? Hold::none : isSticking(contact) ? Hold::all : Hold::normal;
        stiffness_[i] = contact.normal_mass / softness;
        any = any || pushes;
        const bool couples = !batch.isFixed(contact.a) && !batch.isFixed(contact.b);
        if (couples && (couplings_.empty() || couplings_.back() != std::pair(contact.a, contact.b))) {
            couplings_.emplace_back(contact.a, contact.b);
        }
    }
    if (!any) return false;
    assemble(batch, swept);
    if (!matrix_.factorize()) return false;
    solve(batch, swept);
    return true;
}

void DirectStep::assemble(const LocalBatch& batch, std::span<const SweptContact> swept) {
    matrix_.reset(batch.dynamic_bodies, couplings_);
    inertia_.resize(batch.dynamic_bodies);
    for (std::uint32_t i = 0; i < batch.dynamic_bodies; ++i) {
        const LocalBody& body = batch.bodies[i];
        inertia_[i].setZero();
        inertia_[i].topLeftCorner<3, 3>().diagonal().setConstant(1 / body.mass_inv);
        inertia_[i].bottomRightCorner<3, 3>() = inverse(body.inertia_inv).toMatrix();
        matrix_.addDiagonal(i, inertia_[i]);
    }
    for (std::size_t i = 0; i < swept.size(); ++i) {
        if (holds_[i] == Hold::none) continue;
        const SweptContact& contact = swept[i];
        const Vec3 n = toVec3(contact.normal);
        const Vec3 r_a = toVec3(contact.r_a);
        const Vec3 r_b = toVec3(contact.r_b);
        const Mat3 weight = stiffness_[i] * (holds_[i] == Hold::all ? Mat3(Mat3::Identity()) : Mat3(n * n.transpose()));
        const bool a_moves = !batch.isFixed(contact.a);
        const bool b_moves = !batch.isFixed(contact.b);
        if (a_moves) matrix_.addDiagonal(contact.a, coupling(r_a, weight, r_a));
        if (b_moves) matrix_.addDiagonal(contact.b, coupling(r_b, weight, r_b));
        if (a_moves && b_moves) matrix_.add(contact.a, contact.b, -coupling(r_a, weight, r_b));
    }
}

Vec3 DirectStep::missing(const LocalBatch& batch, const SweptContact& contact, std::size_t i) const {
    Vec3 velocity = toVec3(relativeVelocity(contact, read(batch.bodies[contact.a]), read(batch.bodies[contact.b])));
    if (!batch.isFixed(contact.a)) velocity += velocityAt(motion_[contact.a], toVec3(contact.r_a));
    if (!batch.isFixed(contact.b)) velocity -= velocityAt(motion_[contact.b], toVec3(contact.r_b));
    const Vec3 n = toVec3(contact.normal);
    const Vec3 lacking = contact.target * n - velocity;
    return holds_[i] == Hold::all ? lacking : Vec3(n.dot(lacking) * n);
}

void DirectStep::solve(const LocalBatch& batch, std::span<const SweptContact> swept) {
    motion_.assign(batch.dynamic_bodies, Vec6::Zero());
    force_.resize(batch.dynamic_bodies);
    for (int round = 0; round <= refinements; ++round) {
        for (std::size_t i = 0; i < batch.dynamic_bodies; ++i) force_[i] = -(inertia_[i] * motion_[i]);
        for (std::size_t i = 0; i < swept.size(); ++i) {
            if (holds_[i] == Hold::none) continue;
            const SweptContact& contact = swept[i];
            const Vec3 impulse = stiffness_[i] * missing(batch, contact, i);
            if (!batch.isFixed(contact.a)) addForceAt(impulse, toVec3(contact.r_a), force_[contact.a]);
            if (!batch.isFixed(contact.b)) addForceAt(-impulse, toVec3(contact.r_b), force_[contact.b]);
        }
        matrix_.solve(force_);
        for (std::size_t i = 0; i < batch.dynamic_bodies; ++i) motion_[i] += force_[i];
    }
    for (std::size_t i = 0; i < swept.size(); ++i) {
        changes_[i] = holds_[i] == Hold::none ? Vec3(Vec3::Zero()) : Vec3(stiffness_[i] * missing(batch, swept[i], i));
    }
}

}  // namespace cairn
