#include "resolution/plain_sweeper.h"

#include <limits>

#include "math/arrays.h"
#include "resolution/contact_law.h"

namespace cairn {

namespace {

/// False for what velocities give that are not finite: it would spread.
bool isFinite(const Vec3& impulse) {
    return impulse.squaredNorm() < std::numeric_limits<double>::infinity();
}

void pushBodies(const SweptContact& contact, const Vec3& impulse, LocalBatch& local) {
    push(contact, impulse, local.bodies[contact.a], local.bodies[contact.b]);
}

}  // namespace

void PlainSweeper::begin(const SweptBatch& swept) {
    const std::size_t count = swept.batch.contacts.size();
    framed_ = swept.framed;
    rolling_.assign(framed_ ? swept.local.rolling.size() : 0, {});
    resizeTightly(contacts_, count);
    for (std::size_t i = 0; i < count; ++i) beginContact(i, swept);
    for (std::size_t i = 0; i < count; ++i) {
        if (framed_) {
            swept.local.pushWorld(swept.local.contacts[i], contacts_[i].impulse);
        } else {
            pushBodies(contacts_[i], contacts_[i].impulse, swept.local);
        }
    }
}

void PlainSweeper::beginContact(std::size_t i, const SweptBatch& swept) {
    const Contact& contact = swept.contacts[swept.batch.contacts[i]];
    LocalBatch& local = swept.local;
    SweptContact& s = contacts_[i];
    s.a = local.ends[i].a;
    s.b = local.ends[i].b;
    s.normal = contact.normal;
    s.r_a = contact.point - swept.bodies.position[contact.a];
    s.r_b = contact.point - swept.bodies.position[contact.b];
    const LocalBody& a = local.bodies[s.a];
    const LocalBody& b = local.bodies[s.b];
    Symmetric3 k;
    if (framed_ && local.joints.holds(local.contacts[i])) {
        const ContactFrame& frame = local.contacts[i];
        k = Symmetric3::from(frame.basis * local.collisionMatrixOf(frame).toMatrix() * frame.basis.transpose());
    } else {
        addCollisionMatrix(a.mass_inv, a.inertia_inv, s.r_a, k);
        addCollisionMatrix(b.mass_inv, b.inertia_inv, s.r_b, k);
    }
    setInvertible(s, k);
    mendSingular(s);
    s.friction = contact.static_friction;
    const double closing = s.normal.dot(relativeVelocity(s, a, b));
    s.target = ContactLaw::separatingSpeed(swept.settings, contact, closing);
    s.impulse = contact.last_impulse;
    if (!(s.normal.dot(s.impulse) > 0) || !isResolvable(s)) s.impulse.setZero();
}

void PlainSweeper::sweep(const SweptBatch& swept) {
    if (framed_) {
        for (std::size_t i = 0; i < contacts_.size(); ++i) visitFramed(i, swept.local);
        for (std::size_t i = contacts_.size(); i-- > 0;) visitFramed(i, swept.local);
    } else {
        for (std::size_t i = 0; i < contacts_.size(); ++i) visit(contacts_[i], swept.local);
        for (std::size_t i = contacts_.size(); i-- > 0;) visit(contacts_[i], swept.local);
    }
}

void PlainSweeper::visit(SweptContact& contact, LocalBatch& local) {
    const Vec3 velocity = relativeVelocity(contact, local.bodies[contact.a], local.bodies[contact.b]);
    const Vec3 impulse = projectedImpulse(contact, velocity);
    if (!isFinite(impulse) || !isResolvable(contact)) return;
    pushBodies(contact, impulse - contact.impulse, local);
    contact.impulse = impulse;
}

void PlainSweeper::visitFramed(std::size_t i, LocalBatch& local) {
    SweptContact& contact = contacts_[i];
    const ContactFrame& frame = local.contacts[i];
    const Vec3 velocity = relativeVelocity(contact, local.bodies[contact.a], local.bodies[contact.b]);
    if (!isResolvable(contact) || !velocity.allFinite()) return;
    if (frame.rolling != ContactFrame::rolls_freely) {
        visitRolling(contact, frame, local);
        return;
    }
    const Vec3 impulse = projectedImpulse(contact, velocity);
    if (!isFinite(impulse)) return;
    local.pushWorld(frame, impulse - contact.impulse);
    contact.impulse = impulse;
}

void PlainSweeper::visitRolling(SweptContact& contact, const ContactFrame& frame, LocalBatch& local) {
    Rolling& turned = rolling_[frame.rolling];
    Vec6 excess = relativeTwist(frame, local.bodies[frame.a], local.bodies[frame.b]);
    excess[0] -= contact.target;
    Vec6 present;
    present << frame.basis.transpose() * contact.impulse, turned.impulse;
    const Vec6 next = solveRolling(local.rolling[frame.rolling], contact.friction, contact.friction, excess, present,
                                   RollingRounds::few);
    const Vec3 impulse = frame.basis * next.head<3>();
    local.pushWorld(frame, impulse - contact.impulse);
    local.turn(frame, next.tail<3>() - turned.impulse);
    contact.impulse = impulse;
    turned.impulse = next.tail<3>();
}

void PlainSweeper::setImpulse(std::size_t contact, const Vec3& impulse, LocalBatch& local) {
    SweptContact& s = contacts_[contact];
    pushBodies(s, impulse - s.impulse, local);
    s.impulse = impulse;
}

void PlainSweeper::note(const SweptBatch&) {
    resizeTightly(before_, contacts_.size());
    for (std::size_t i = 0; i < contacts_.size(); ++i) before_[i] = contacts_[i].impulse;
    for (Rolling& r : rolling_) r.before = r.impulse;
}

SweepChange PlainSweeper::change(const SweptBatch& swept) {
    SweepChange change;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const SweptContact& s = contacts_[i];
        if (!isResolvable(s)) continue;
        const Vec3 difference = s.impulse - before_[i];
        change.add({difference.squaredNorm() / s.normal_mass, (s.k * difference).norm()});
    }
    if (!rolling_.empty()) addRollingChange(swept.local, change);
    return change;
}

void PlainSweeper::addRollingChange(const LocalBatch& local, SweepChange& change) const {
    for (const ContactFrame& frame : local.contacts) {
        if (frame.rolling == ContactFrame::rolls_freely) continue;
        const Mat6& k = local.rolling[frame.rolling].k;
        const Vec3 difference = rolling_[frame.rolling].impulse - rolling_[frame.rolling].before;
        change.add({k(3, 3) * difference.squaredNorm(), (k.topRightCorner<3, 3>() * difference).norm()});
    }
}

void PlainSweeper::restart() {
    direction_.assign(contacts_.size(), Vec3::Zero());
    for (Rolling& r : rolling_) r.direction.setZero();
}

void PlainSweeper::accelerate(double beta, const SweptBatch&) {
    const auto advance = [beta](Vec3& impulse, const Vec3& before, Vec3& direction) {
        const Vec3 change = impulse - before;
        const Vec3 step = beta * direction;
        impulse += step;
        direction = change + step;
    };
    for (std::size_t i = 0; i < contacts_.size(); ++i) advance(contacts_[i].impulse, before_[i], direction_[i]);
    for (Rolling& r : rolling_) advance(r.impulse, r.before, r.direction);
}

bool PlainSweeper::releaseSliding(const SweptBatch& swept) {
    bool released = false;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        SweptContact& s = contacts_[i];
        const Contact& contact = swept.contacts[swept.batch.contacts[i]];
        if (!(contact.kinetic_friction < contact.static_friction)) continue;
        if (!slides(s, swept.local.bodies[s.a], swept.local.bodies[s.b], swept.settings.resolution_threshold)) continue;
        s.friction = contact.kinetic_friction;
        released = true;
    }
    return released;
}

void PlainSweeper::finish(const SweptBatch& swept) {
    if (framed_) settleFrames(swept);
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        swept.contacts[swept.batch.contacts[i]].impulse += contacts_[i].impulse;
    }
}

/// Finds the impulses of the joints, and writes those of the rolling contacts.
void PlainSweeper::settleFrames(const SweptBatch& swept) {
    LocalBatch& local = swept.local;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        ContactFrame& frame = local.contacts[i];
        frame.impulse = contacts_[i].impulse;
        if (frame.rolling == ContactFrame::rolls_freely) continue;
        RollingContact& rolling = local.rolling[frame.rolling];
        rolling.impulse_W = frame.basis * rolling_[frame.rolling].impulse;
        swept.contacts[swept.batch.contacts[i]].angular_impulse += rolling.impulse_W;
    }
    local.joints.settle(local.contacts, local.rolling, local.bodies);
    local.joints.scatter();
}

}  // namespace cairn
