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

bool isSticking(const PgsContact& contact) {
    const double normal = contact.normal.dot(contact.impulse);
    // On the cone it slides; rounding must not make it stick again.
    constexpr double inside = 1 - 1e-9;
    const double cone = inside * contact.friction * normal;
    return (contact.impulse - normal * contact.normal).squaredNorm() < cone * cone;
}

}  // namespace

bool DirectStep::compute(std::span<const LocalBody> bodies, BodyRange moving, std::span<const PgsContact> pgs) {
    bodies_ = bodies;
    moving_ = moving;
    const std::size_t count = pgs.size();
    holds_.resize(count);
    stiffness_.resize(count);
    changes_.resize(count);
    couplings_.clear();
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
        const PgsContact& contact = pgs[i];
        const bool pushes = contact.normal.dot(contact.impulse) > 0 && isResolvable(contact);
        holds_[i] = !pushes ? Hold::none : isSticking(contact) ? Hold::all : Hold::normal;
        stiffness_[i] = contact.normal_mass / softness;
        any = any || pushes;
        const bool couples = moves(contact.a) && moves(contact.b);
        if (couples && (couplings_.empty() || couplings_.back() != std::pair(placeOf(contact.a), placeOf(contact.b)))) {
            couplings_.emplace_back(placeOf(contact.a), placeOf(contact.b));
        }
    }
    if (!any) return false;
    assemble(pgs);
    if (!matrix_.factorize()) return false;
    solve(pgs);
    return true;
}

void DirectStep::assemble(std::span<const PgsContact> pgs) {
    matrix_.reset(moving_.end - moving_.begin, couplings_);
    inertia_.resize(moving_.end - moving_.begin);
    for (std::uint32_t i = 0; i < moving_.end - moving_.begin; ++i) {
        const LocalBody& body = bodies_[moving_.begin + i];
        inertia_[i].setZero();
        inertia_[i].topLeftCorner<3, 3>().diagonal().setConstant(1 / body.mass_inv);
        inertia_[i].bottomRightCorner<3, 3>() = inverse(body.inertia_inv).toMatrix();
        matrix_.addDiagonal(i, inertia_[i]);
    }
    for (std::size_t i = 0; i < pgs.size(); ++i) {
        if (holds_[i] == Hold::none) continue;
        const PgsContact& contact = pgs[i];
        const Vec3 n = toVec3(contact.normal);
        const Vec3 r_a = toVec3(contact.r_a);
        const Vec3 r_b = toVec3(contact.r_b);
        const Mat3 weight = stiffness_[i] * (holds_[i] == Hold::all ? Mat3(Mat3::Identity()) : Mat3(n * n.transpose()));
        const bool a_moves = moves(contact.a);
        const bool b_moves = moves(contact.b);
        if (a_moves) matrix_.addDiagonal(placeOf(contact.a), coupling(r_a, weight, r_a));
        if (b_moves) matrix_.addDiagonal(placeOf(contact.b), coupling(r_b, weight, r_b));
        if (a_moves && b_moves) matrix_.add(placeOf(contact.a), placeOf(contact.b), -coupling(r_a, weight, r_b));
    }
}

Vec3 DirectStep::missing(const PgsContact& contact, std::size_t i) const {
    Vec3 velocity = toVec3(relativeVelocity(contact, read(bodies_[contact.a]), read(bodies_[contact.b])));
    if (moves(contact.a)) velocity += velocityAt(motion_[placeOf(contact.a)], toVec3(contact.r_a));
    if (moves(contact.b)) velocity -= velocityAt(motion_[placeOf(contact.b)], toVec3(contact.r_b));
    const Vec3 n = toVec3(contact.normal);
    const Vec3 lacking = contact.target * n - velocity;
    return holds_[i] == Hold::all ? lacking : Vec3(n.dot(lacking) * n);
}

void DirectStep::solve(std::span<const PgsContact> pgs) {
    motion_.assign(moving_.end - moving_.begin, Vec6::Zero());
    force_.resize(moving_.end - moving_.begin);
    for (int round = 0; round <= refinements; ++round) {
        for (std::size_t i = 0; i < moving_.end - moving_.begin; ++i) force_[i] = -(inertia_[i] * motion_[i]);
        for (std::size_t i = 0; i < pgs.size(); ++i) {
            if (holds_[i] == Hold::none) continue;
            const PgsContact& contact = pgs[i];
            const Vec3 impulse = stiffness_[i] * missing(contact, i);
            if (moves(contact.a)) addForceAt(impulse, toVec3(contact.r_a), force_[placeOf(contact.a)]);
            if (moves(contact.b)) addForceAt(-impulse, toVec3(contact.r_b), force_[placeOf(contact.b)]);
        }
        matrix_.solve(force_);
        for (std::size_t i = 0; i < moving_.end - moving_.begin; ++i) motion_[i] += force_[i];
    }
    for (std::size_t i = 0; i < pgs.size(); ++i) {
        changes_[i] = holds_[i] == Hold::none ? Vec3(Vec3::Zero()) : Vec3(stiffness_[i] * missing(pgs[i], i));
    }
}

}  // namespace cairn
