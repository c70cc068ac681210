#include "resolution/framed_contacts.h"

#include <limits>
#include <type_traits>

#include "resolution/contact_law.h"

namespace cairn {

namespace {

/// False for what velocities give that are not finite: it would spread.
bool isUsable(const Triple1& impulse) {
    return impulse.squaredNorm() < std::numeric_limits<double>::infinity();
}

bool rolls(const ContactFrame& frame) {
    return frame.rolling != ContactFrame::rolls_freely;
}

}  // namespace

void FramedContacts::begin(const PgsBatch& pgs, std::uint32_t first, std::uint32_t end) {
    LocalBatch& local = pgs.local;
    contacts_.assign(end - first, {});
    frames_.clear();
    for (std::uint32_t i = first; i < end; ++i) {
        local.prepare(i);
        frames_.push_back(local.contacts[i]);
    }
    for (std::size_t n = 0; n < contacts_.size(); ++n) {
        contacts_[n].source = pgs.batch.contacts[first + n];
        beginContact(contacts_[n], frames_[n], pgs);
    }
    for (std::size_t n = 0; n < contacts_.size(); ++n) local.pushWorld(frames_[n], toVec3(contacts_[n].impulse));
}

void FramedContacts::beginContact(Framed& framed, ContactFrame& frame, const PgsBatch& pgs) {
    const Contact& contact = pgs.contacts[framed.source];
    LocalBatch& local = pgs.local;
    framed.a = frame.a;
    framed.b = frame.b;
    framed.normal = Triple1(contact.normal);
    framed.r_a = Triple1(frame.r_a);
    framed.r_b = Triple1(frame.r_b);
    const PgsBody<double> a = read(local.bodies[framed.a]);
    const PgsBody<double> b = read(local.bodies[framed.b]);
    Symmetric3 k;
    if (local.joints.holds(frame)) {
        const Mat3 in_contact = local.joints.collisionMatrix(frame, local.bodies).toMatrix();
        k = Symmetric3::from(frame.basis * in_contact * frame.basis.transpose());
    } else {
        if (!local.isFixed(framed.a)) addCollisionMatrix(a.mass_inv, a.inertia_inv, framed.r_a, k);
        if (!local.isFixed(framed.b)) addCollisionMatrix(b.mass_inv, b.inertia_inv, framed.r_b, k);
    }
    setInvertible(framed, k);
    mendSingular(framed);
    framed.friction = contact.static_friction;
    const double closing = framed.normal.dot(relativeVelocity(framed, a, b));
    framed.target = ContactLaw::separatingSpeed(pgs.settings, contact, closing);
    framed.impulse = Triple1(contact.last_impulse);
    if (!(framed.normal.dot(framed.impulse) > 0) || !isResolvable(framed)) framed.impulse = Triple1();
}

void FramedContacts::sweepForth(LocalBatch& local) {
    for (std::size_t i = 0; i < contacts_.size(); ++i) visit(i, local);
}

void FramedContacts::sweepBack(LocalBatch& local) {
    for (std::size_t i = contacts_.size(); i-- > 0;) visit(i, local);
}

void FramedContacts::visit(std::size_t i, LocalBatch& local) {
    Framed& contact = contacts_[i];
    const Triple1 velocity = relativeVelocity(contact, read(local.bodies[contact.a]), read(local.bodies[contact.b]));
    if (!isResolvable(contact) || !isUsable(velocity)) return;
    if (rolls(frames_[i])) {
        visitRolling(i, local);
        return;
    }
    const Triple1 impulse = projectedImpulse(contact, velocity);
    if (!isUsable(impulse)) return;
    local.pushWorld(frames_[i], toVec3(impulse - contact.impulse));
    contact.impulse = impulse;
}

void FramedContacts::visitRolling(std::size_t i, LocalBatch& local) {
    Framed& contact = contacts_[i];
    const ContactFrame& frame = frames_[i];
    Vec6 excess = relativeTwist(frame, local.bodies[frame.a], local.bodies[frame.b]);
    excess[0] -= contact.target;
    Vec6 present;
    present << frame.basis.transpose() * toVec3(contact.impulse), contact.turning;
    const Vec6 next = solveRolling(local.rolling[frame.rolling], contact.friction, contact.friction, excess, present,
                                   RollingRounds::few);
    const Vec3 impulse = frame.basis * next.head<3>();
    local.pushWorld(frame, impulse - toVec3(contact.impulse));
    local.turn(frame, next.tail<3>() - contact.turning);
    contact.impulse = Triple1(impulse);
    contact.turning = next.tail<3>();
}

void FramedContacts::save() {
    for (Framed& contact : contacts_) {
        contact.before = contact.impulse;
        contact.turning_before = contact.turning;
    }
}

SweepChange FramedContacts::change(const LocalBatch& local) const {
    SweepChange change;
    for (const Framed& contact : contacts_) {
        if (!isResolvable(contact)) continue;
        const Triple1 difference = contact.impulse - contact.before;
        change.add(
            {difference.squaredNorm() / contact.normal_mass, squareRoot((contact.k * difference).squaredNorm())});
    }
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        if (!rolls(frames_[i])) continue;
        const Mat6& k = local.rolling[frames_[i].rolling].k;
        const Vec3 difference = contacts_[i].turning - contacts_[i].turning_before;
        change.add({k(3, 3) * difference.squaredNorm(), (k.topRightCorner<3, 3>() * difference).norm()});
    }
    return change;
}

void FramedContacts::restart() {
    for (Framed& contact : contacts_) {
        contact.direction = Triple1();
        contact.turning_direction.setZero();
    }
}

void FramedContacts::accelerate(double beta) {
    const auto advance = [beta](auto& impulse, const auto& before, auto& direction) {
        using Vector = std::remove_cvref_t<decltype(before)>;
        const Vector change = impulse - before;
        const Vector step = beta * direction;
        impulse += step;
        direction = change + step;
    };
    for (Framed& contact : contacts_) {
        advance(contact.impulse, contact.before, contact.direction);
        advance(contact.turning, contact.turning_before, contact.turning_direction);
    }
}

bool FramedContacts::releaseSliding(const PgsBatch& pgs) {
    bool released = false;
    for (Framed& framed : contacts_) {
        const Contact& contact = pgs.contacts[framed.source];
        if (!(contact.kinetic_friction < contact.static_friction)) continue;
        const std::vector<LocalBody>& bodies = pgs.local.bodies;
        if (!slides(framed, bodies[framed.a], bodies[framed.b], pgs.settings.resolution_threshold)) continue;
        framed.friction = contact.kinetic_friction;
        released = true;
    }
    return released;
}

void FramedContacts::finish(const PgsBatch& pgs) {
    LocalBatch& local = pgs.local;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const Framed& framed = contacts_[i];
        Contact& contact = pgs.contacts[framed.source];
        ContactFrame& frame = frames_[i];
        frame.impulse = toVec3(framed.impulse);
        contact.impulse += frame.impulse;
        if (!rolls(frame)) continue;
        RollingContact& rolling = local.rolling[frame.rolling];
        rolling.impulse_W = frame.basis * framed.turning;
        contact.angular_impulse += rolling.impulse_W;
    }
    local.joints.settle(frames_, local.rolling, local.bodies);
    local.joints.scatter();
}

}  // namespace cairn
