#include "resolution/framed_contacts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "resolution/contact_law.h"
#include "resolution/contact_visit.h"
#include "resolution/lane_contact.h"

namespace cairn {

namespace {

/// The bodies of a contact with all that joints tie to them.
struct TiedPair {
    LocalBatch& local;
    const ContactFrame& frame;

    const LocalBody& a() const { return local.bodies[frame.a]; }
    const LocalBody& b() const { return local.bodies[frame.b]; }
    Triple1 velocityAt(const BasicPgsContact<double>& contact) const {
        return relativeVelocity(contact, read(a()), read(b()));
    }
    Triple1 spin() const { return Triple1(a().w) - Triple1(b().w); }
    void push(const BasicPgsContact<double>&, const Triple1& change) const { local.pushWorld(frame, toVec3(change)); }
    void turn(const Triple1& change) const { local.turn(frame, frame.basis.transpose() * toVec3(change)); }
};

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
    if (rolls(frame)) beginRolling(framed, frame, local);
    framed.friction = contact.static_friction;
    const double closing = framed.normal.dot(relativeVelocity(framed, a, b));
    framed.target = ContactLaw::separatingSpeed(pgs.settings, contact, closing);
    framed.impulse = Triple1(contact.last_impulse);
    if (!(framed.normal.dot(framed.impulse) > 0) || !isResolvable(framed)) framed.impulse = Triple1();
}

/// @pre K is known
void FramedContacts::beginRolling(Framed& framed, const ContactFrame& frame, const LocalBatch& local) {
    const RollingContact& contact = local.rolling[frame.rolling];
    framed.rolling = contact.rolling;
    framed.spinning = contact.spinning;
    const auto inWorld = [&](const Mat3& m) -> Mat3 { return frame.basis * m * frame.basis.transpose(); };
    const Mat3 c = inWorld(contact.k.topRightCorner<3, 3>());
    setTurning(framed, Symmetric3::from(inWorld(contact.k.bottomRightCorner<3, 3>())),
               {Triple1(Vec3(c.row(0))), Triple1(Vec3(c.row(1))), Triple1(Vec3(c.row(2)))});
    for (const auto& [body, r] : {std::pair(framed.a, framed.r_a), std::pair(framed.b, framed.r_b)}) {
        if (!local.isFixed(body)) framed.squared_lever = std::max(framed.squared_lever, r.squaredNorm());
    }
}

void FramedContacts::sweepForth(LocalBatch& local) {
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        withSelf(i, [&](auto& contact) { visit(contact, TiedPair{local, frames_[i]}); });
    }
}

void FramedContacts::sweepBack(LocalBatch& local) {
    for (std::size_t i = contacts_.size(); i-- > 0;) {
        withSelf(i, [&](auto& contact) { visitBack(contact, TiedPair{local, frames_[i]}); });
    }
}

/// Calls work(contact) with a contact that resists rolling, or with one that does not.
template <class Work>
void FramedContacts::withSelf(std::size_t i, const Work& work) {
    BasicRollingContact<double>& contact = contacts_[i];
    if (rolls(frames_[i])) {
        work(contact);
    } else {
        work(static_cast<BasicPgsContact<double>&>(contact));
    }
}

void FramedContacts::save() {
    for (Framed& contact : contacts_) contact.before = contact.accumulated();
}

SweepChange FramedContacts::change() const {
    SweepChange change;
    for (const Framed& contact : contacts_) {
        if (!isResolvable(contact)) continue;
        const BasicChange<double> by = changeBy(contact, contact.accumulated() - contact.before);
        change.add({by.squared, std::sqrt(by.squared_speed)});
    }
    return change;
}

void FramedContacts::restart() {
    for (Framed& contact : contacts_) contact.direction = {};
}

void FramedContacts::accelerate(double beta) {
    for (Framed& contact : contacts_) {
        const BasicWrench<double> change = contact.accumulated() - contact.before;
        const BasicWrench<double> step = beta * contact.direction;
        contact.add(step);
        contact.direction = change + step;
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
        rolling.impulse_W = toVec3(framed.turning);
        contact.angular_impulse += rolling.impulse_W;
    }
    local.joints.settle(frames_, local.rolling, local.bodies);
    local.joints.scatter();
}

}  // namespace cairn
