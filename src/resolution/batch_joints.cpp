#include "resolution/batch_joints.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "resolution/impulse.h"

namespace cairn {

namespace {

/// Where joints block all motion at a contact along a direction, rounding leaves about this part of what the bodies
/// would do without joints. @note far above one rounding, since factorising a mechanism takes many
constexpr double blocked = 1e-12;
/// What a contact yields along a direction counts as nothing below this part of what it yields along another one, or
/// this part of what it yields without joints: the impulses that a velocity along it asks for would be of rounding.
constexpr double hardly = 1e-7;
constexpr double hardly_of_unjointed = 1e3 * blocked;

/// Most passes over the bounds of a batch at a time.
constexpr int most_passes = 50;

Twist twistOf(const LocalBody& body) {
    return {body.v, body.w};
}

Twist directChange(const LocalBody& body, const Vec3& r, const Vec3& impulse) {
    const VelocityChange change = velocityChange(body, r, impulse);
    return {change.v, change.w};
}

/// The most that a contact would yield along one of its axes without joints [1/kg].
double largestYield(const ContactFrame& contact, std::span<const LocalBody> bodies) {
    const Symmetric3 k = cairn::collisionMatrix(contact, bodies[contact.a], bodies[contact.b]);
    return std::max({k.xx, k.yy, k.zz});
}

void add(const Twist& change, LocalBody& body) {
    apply({change.v, change.w}, body);
}

}  // namespace

void BatchJointGroup::gather(std::span<JointBlock> blocks, std::vector<LocalBody>& bodies,
                             std::span<const std::uint32_t> place) {
    members_.clear();
    for (const JointBlock& block : blocks) {
        // The bodies of a coupling are those of the joints that it couples.
        for (const BodyIndex body : {block.a, block.b}) {
            // Bodies that cannot move are not among the batch's.
            if (body == Joint::world || place[body] >= bodies.size()) continue;
            if (bodies[place[body]].slot == body) members_.push_back(body);
        }
    }
    std::sort(members_.begin(), members_.end());
    members_.erase(std::unique(members_.begin(), members_.end()), members_.end());
    local.clear();
    for (const BodyIndex body : members_) local.push_back(place[body]);
    system.begin(members_, blocks, JointSystem::Rows::all);
    received_.assign(system.rows(), 0);
    factorise(bodies);
    project(bodies);
    projected_ = received_;
    throwBack(bodies);
}

/// A limit that is reached in this step throws back what comes fast.
void BatchJointGroup::throwBack(std::span<const LocalBody> bodies) {
    for (JointBlock& block : system.blocks()) {
        for (BoundRow& bound : block.bound) {
            if (!(bound.restitution > 0)) continue;
            const double rate = rateOf(block, bound.row, bodies);
            if (!(std::abs(rate) > bound.slowest)) continue;
            const double back = -bound.restitution * rate;
            if (rate < bound.lowest) bound.lowest = std::min(back, bound.highest);
            if (rate > bound.highest) bound.highest = std::max(back, bound.lowest);
        }
    }
}

void BatchJointGroup::factorise(std::span<const LocalBody> bodies) {
    response_.resize(local.size());
    for (std::size_t i = 0; i < local.size(); ++i) {
        response_[i] = {bodies[local[i]].mass_inv, bodies[local[i]].inertia_inv.toMatrix()};
    }
    system.factorise(response_);
}

void BatchJointGroup::project(std::span<LocalBody> bodies) {
    velocity_.resize(local.size());
    for (std::size_t i = 0; i < local.size(); ++i) velocity_[i] = twistOf(bodies[local[i]]);
    impulses_.resize(system.rows());
    system.rates(velocity_, impulses_);
    system.subtractTargets(impulses_);
    // At rest nothing is struck, so that what sleeps sleeps on; what is not finite must not spread.
    const auto still = [](double rate) { return rate == 0; };
    const auto finite = [](double rate) { return std::isfinite(rate); };
    if (std::ranges::all_of(impulses_, still) || !std::ranges::all_of(impulses_, finite)) return;
    for (double& impulse : impulses_) impulse = -impulse;
    system.solve(impulses_);
    system.addImpulses(impulses_, velocity_);
    for (std::size_t i = 0; i < impulses_.size(); ++i) received_[i] += impulses_[i];
    for (std::size_t i = 0; i < local.size(); ++i) {
        LocalBody& body = bodies[local[i]];
        body.v = velocity_[i].v;
        body.w = velocity_[i].w;
        body.struck = 1;
    }
}

void BatchJointGroup::applyResponse(std::span<LocalBody> bodies) {
    for (std::size_t i = 0; i < local.size(); ++i) add(system.changes()[i], bodies[local[i]]);
    for (std::size_t i = 0; i < received_.size(); ++i) received_[i] += system.reactions()[i];
}

double BatchJointGroup::rateOf(const JointBlock& block, const JointRow& row, std::span<const LocalBody> bodies) {
    velocity_.resize(local.size());
    for (const BodyIndex body : {block.a, block.b}) {
        const std::uint32_t member = system.memberOf(body);
        if (member != JointSystem::none) velocity_[member] = twistOf(bodies[local[member]]);
    }
    return system.rateOf(block, row, velocity_);
}

/// The impulse is what brings the rate, taken without the impulse so far, into its bounds. @return change of the rate
double BatchJointGroup::resolveBound(const JointBlock& block, BoundRow& bound, std::span<LocalBody> bodies) {
    const double rate = rateOf(block, bound.row, bodies);
    const bool is_free = bound.impulse == 0 && rate >= bound.lowest && rate <= bound.highest;
    if (is_free || !std::isfinite(rate)) return 0;
    const double per_impulse = system.respondAlong(block, bound.row);
    if (!(per_impulse > 0)) return 0;
    const double without = rate - per_impulse * bound.impulse;
    const double wanted = std::clamp(without, bound.lowest, bound.highest);
    const double impulse =
        std::clamp((wanted - without) / (per_impulse + bound.softness), -bound.strongest, bound.strongest);
    const double change = impulse - bound.impulse;
    if (change == 0) return 0;
    bound.impulse = impulse;
    for (std::size_t i = 0; i < local.size(); ++i) {
        const Twist& unit = system.changes()[i];
        add({change * unit.v, change * unit.w}, bodies[local[i]]);
    }
    for (std::size_t i = 0; i < received_.size(); ++i) received_[i] += change * system.reactions()[i];
    return std::abs(change * per_impulse);
}

double BatchJointGroup::resolveBounds(std::span<LocalBody> bodies) {
    double largest = 0;
    for (JointBlock& block : system.blocks()) {
        for (std::uint32_t i = 0; i < block.bounds; ++i) {
            if (block.bound[i].is_linear) continue;
            const double change = resolveBound(block, block.bound[i], bodies);
            largest = std::max(largest, change * block.reach / unitOf(block, block.bound[i]));
        }
    }
    return largest;
}

void BatchJointGroup::settle(std::span<Twist> direct) {
    for (const JointBlock& block : system.blocks()) {
        for (std::uint32_t i = 0; i < block.bounds; ++i) {
            const BoundRow& bound = block.bound[i];
            if (bound.is_linear) continue;
            system.addAlong(block, bound.row, bound.impulse, direct);
        }
    }
    system.rates(direct, received_);
    for (double& rate : received_) rate = -rate;
    system.solve(received_);
    for (std::size_t i = 0; i < received_.size(); ++i) received_[i] += projected_[i];
}

void BatchJointGroup::report() const {
    system.report(received_);
}

void BatchJoints::gather(std::span<JointBlock> blocks, std::vector<LocalBody>& bodies,
                         std::span<const std::uint32_t> place) {
    count_ = 0;
    has_bounds_ = false;
    if (blocks.empty()) return;
    place_.assign(bodies.size(), Place{});
    for (std::size_t begin = 0; begin < blocks.size();) {
        std::size_t end = begin;
        while (end < blocks.size() && blocks[end].group == blocks[begin].group) {
            const auto follows = [](const BoundRow& bound) { return !bound.is_linear; };
            has_bounds_ = has_bounds_ || std::ranges::any_of(blocks[end].bound, follows);
            ++end;
        }
        if (count_ == groups_.size()) groups_.emplace_back();
        BatchJointGroup& group = groups_[count_];
        group.gather(blocks.subspan(begin, end - begin), bodies, place);
        for (std::uint32_t i = 0; i < group.local.size(); ++i) {
            place_[group.local[i]] = {static_cast<std::uint32_t>(count_), i};
        }
        ++count_;
        begin = end;
    }
}

void BatchJoints::respond(const ContactFrame& contact, const Vec3& impulse, const Vec3& angular,
                          std::span<const LocalBody> bodies) {
    const Place a = placeOf(contact.a);
    const Place b = placeOf(contact.b);
    direct_a_ = directChange(bodies[contact.a], contact.r_a, impulse);
    direct_b_ = directChange(bodies[contact.b], contact.r_b, -impulse);
    direct_a_.w += bodies[contact.a].inertia_inv * angular;
    direct_b_.w -= bodies[contact.b].inertia_inv * angular;
    if (a.group != none && a.group == b.group) {
        groups_[a.group].system.respond(a.member, direct_a_, b.member, direct_b_);
        return;
    }
    if (a.group != none) groups_[a.group].system.respond(a.member, direct_a_, JointSystem::none, {});
    if (b.group != none) groups_[b.group].system.respond(b.member, direct_b_, JointSystem::none, {});
}

Twist BatchJoints::relativeChange(const ContactFrame& contact) const {
    const Place a = placeOf(contact.a);
    const Place b = placeOf(contact.b);
    const Twist& change_a = a.group != none ? groups_[a.group].system.changes()[a.member] : direct_a_;
    const Twist& change_b = b.group != none ? groups_[b.group].system.changes()[b.member] : direct_b_;
    return {change_a.v + change_a.w.cross(contact.r_a) - change_b.v - change_b.w.cross(contact.r_b),
            change_a.w - change_b.w};
}

Symmetric3 BatchJoints::collisionMatrix(const ContactFrame& contact, std::span<const LocalBody> bodies) {
    Mat3 k;
    for (Eigen::Index i = 0; i < 3; ++i) {
        respond(contact, contact.basis.col(i), Vec3::Zero(), bodies);
        k.col(i) = contact.basis.transpose() * relativeChange(contact).v;
    }
    const double rest = blocked * largestYield(contact, bodies);
    if (!(k(0, 0) > rest)) return {};
    return Symmetric3::from(0.5 * (k + k.transpose()) + rest * Mat3::Identity());
}

void BatchJoints::setCollisionMatrixOf(ContactFrame& contact, std::span<const LocalBody> bodies) {
    const Symmetric3 k = collisionMatrix(contact, bodies);
    setCollisionMatrix(contact, k);
    if (!isResolvable(contact)) return;
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(k.toMatrix());
    const Vec3& yields = solver.eigenvalues();  // ascending
    const double least = std::max(hardly * yields[2], hardly_of_unjointed * largestYield(contact, bodies));
    if (!(yields[0] < least)) return;
    const Mat3& directions = solver.eigenvectors();
    contact.k_row = Vec3(k.xx, k.xy, k.xz);
    contact.k_inv =
        Symmetric3::from(directions * yields.cwiseMax(least).cwiseInverse().asDiagonal() * directions.transpose());
    contact.is_blocked = true;
}

Mat6 BatchJoints::wrenchMatrix(const ContactFrame& contact, std::span<const LocalBody> bodies) {
    Mat6 k;
    for (Eigen::Index i = 0; i < 6; ++i) {
        const Vec3 direction = contact.basis.col(i % 3);
        const Vec3 none_such = Vec3::Zero();
        respond(contact, i < 3 ? direction : none_such, i < 3 ? none_such : direction, bodies);
        const Twist change = relativeChange(contact);
        k.col(i) << contact.basis.transpose() * change.v, contact.basis.transpose() * change.w;
    }
    return 0.5 * (k + k.transpose());
}

void BatchJoints::push(const ContactFrame& contact, const Vec3& impulse, std::span<LocalBody> bodies) {
    respond(contact, impulse, Vec3::Zero(), bodies);
    applyResponse(contact, bodies);
}

void BatchJoints::turn(const ContactFrame& contact, const Vec3& impulse, std::span<LocalBody> bodies) {
    respond(contact, Vec3::Zero(), impulse, bodies);
    applyResponse(contact, bodies);
}

void BatchJoints::applyResponse(const ContactFrame& contact, std::span<LocalBody> bodies) {
    const std::uint32_t group_a = groupOf(contact.a);
    const std::uint32_t group_b = groupOf(contact.b);
    if (group_a == none) add(direct_a_, bodies[contact.a]);
    if (group_b == none) add(direct_b_, bodies[contact.b]);
    if (group_a != none) groups_[group_a].applyResponse(bodies);
    if (group_b != none && group_b != group_a) groups_[group_b].applyResponse(bodies);
}

void BatchJoints::factorise(std::span<const LocalBody> bodies) {
    for (std::size_t i = 0; i < count_; ++i) groups_[i].factorise(bodies);
}

bool BatchJoints::resolveBounds(std::span<LocalBody> bodies, double threshold) {
    if (!has_bounds_) return false;
    bool changed = false;
    for (int pass = 0; pass < most_passes; ++pass) {
        double largest = 0;
        for (std::size_t i = 0; i < count_; ++i) largest = std::max(largest, groups_[i].resolveBounds(bodies));
        changed = changed || largest > threshold;
        if (!(largest > 1e-3 * threshold)) break;
    }
    return changed;
}

void BatchJoints::settle(std::span<const ContactFrame> contacts, std::span<const RollingContact> rolling,
                         std::span<const LocalBody> bodies) {
    if (count_ == 0) return;
    settled_.resize(std::max(settled_.size(), count_));
    for (std::size_t i = 0; i < count_; ++i) settled_[i].assign(groups_[i].local.size(), Twist{});
    const auto add_direct = [&](std::uint32_t body, const Vec3& r, const Vec3& impulse, const Vec3& angular) {
        const Place place = placeOf(body);
        if (place.group == none) return;
        const Twist change = directChange(bodies[body], r, impulse);
        settled_[place.group][place.member].v += change.v;
        settled_[place.group][place.member].w += change.w + bodies[body].inertia_inv * angular;
    };
    for (const ContactFrame& contact : contacts) {
        const bool rolls_freely = contact.rolling == ContactFrame::rolls_freely;
        const Vec3 angular = rolls_freely ? Vec3::Zero() : rolling[contact.rolling].impulse_W;
        add_direct(contact.a, contact.r_a, contact.impulse, angular);
        add_direct(contact.b, contact.r_b, -contact.impulse, -angular);
    }
    for (std::size_t i = 0; i < count_; ++i) groups_[i].settle(settled_[i]);
}

void BatchJoints::scatter() const {
    for (std::size_t i = 0; i < count_; ++i) groups_[i].report();
}

void BatchJoints::save(std::vector<double>& saved) const {
    saved.clear();
    for (std::size_t i = 0; i < count_; ++i) {
        const std::span<const double> received = groups_[i].received();
        saved.insert(saved.end(), received.begin(), received.end());
    }
}

void BatchJoints::keepPartSince(std::span<const double> saved, double part) {
    std::size_t row = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        for (double& impulse : groups_[i].received()) {
            impulse = saved[row] + part * (impulse - saved[row]);
            ++row;
        }
    }
}

}  // namespace cairn
