#include "resolution/plain_sweeper.h"

#include <limits>

#include "math/arrays.h"
#include "resolution/contact_law.h"

namespace cairn {

namespace {

/// False for what velocities give that are not finite: it would spread.
[[gnu::always_inline]] inline bool isFinite(const Triple1& impulse) {
    return impulse.squaredNorm() < std::numeric_limits<double>::infinity();
}

/// Calls use(a, b) with copies of the bodies at some ends, and writes back those that move.
template <class Use>
[[gnu::always_inline]] inline void withBodies(const ContactEnds& ends, LocalBatch& local, const Use& use) {
    LocalBody& a = local.bodies[ends.a];
    LocalBody& b = local.bodies[ends.b];
    if (local.isFixed(ends.a)) {
        SweptBody<double> swept_b = read(b);
        use(readFixed(a), swept_b);
        write(swept_b, b);
        return;
    }
    SweptBody<double> swept_a = read(a);
    if (local.isFixed(ends.b)) {
        use(swept_a, readFixed(b));
    } else {
        SweptBody<double> swept_b = read(b);
        use(swept_a, swept_b);
        write(swept_b, b);
    }
    write(swept_a, a);
}

template <class A, class B>
[[gnu::always_inline]] inline void visit(SweptContact& contact, A& a, B& b) {
    const Triple1 impulse = projectedImpulse(contact, relativeVelocity(contact, a, b));
    if (!isFinite(impulse) || !isResolvable(contact)) return;
    push(contact, impulse - contact.impulse, a, b);
    contact.impulse = impulse;
}

}  // namespace

void PlainSweeper::begin(const SweptBatch& swept) {
    const std::size_t count = swept.batch.contacts.size();
    framed_ = swept.framed;
    rolling_.assign(framed_ ? swept.local.rolling.size() : 0, {});
    contacts_ = firstOf(memory_, count);
    pair_begin_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        beginContact(i, swept);
        if (i == 0 || swept.local.ends[i] != swept.local.ends[i - 1]) pair_begin_.push_back(i);
    }
    pair_begin_.push_back(count);
    if (framed_) {
        for (std::size_t i = 0; i < count; ++i) {
            swept.local.pushWorld(swept.local.contacts[i], toVec3(contacts_[i].impulse));
        }
        return;
    }
    for (std::size_t pair = 0; pair + 1 < pair_begin_.size(); ++pair) {
        visitPair(pair, swept.local, [&](std::size_t begin, std::size_t end, auto& a, auto& b) {
            for (std::size_t i = begin; i < end; ++i) push(contacts_[i], contacts_[i].impulse, a, b);
        });
    }
}

/// Calls visit(first contact, end, a, b). What follows each other meets its bodies in registers.
template <class Visit>
void PlainSweeper::visitPair(std::size_t pair, LocalBatch& local, const Visit& visit) {
    const std::size_t begin = pair_begin_[pair];
    withBodies(contacts_[begin], local, [&](auto&& a, auto&& b) { visit(begin, pair_begin_[pair + 1], a, b); });
}

void PlainSweeper::beginContact(std::size_t i, const SweptBatch& swept) {
    const Contact& contact = swept.contacts[swept.batch.contacts[i]];
    LocalBatch& local = swept.local;
    SweptContact& s = contacts_[i];
    s.a = local.ends[i].a;
    s.b = local.ends[i].b;
    s.normal = Triple1(contact.normal);
    s.r_a = Triple1(contact.point - swept.bodies.position[contact.a]);
    s.r_b = Triple1(contact.point - swept.bodies.position[contact.b]);
    const SweptBody<double> a = read(local.bodies[s.a]);
    const SweptBody<double> b = read(local.bodies[s.b]);
    Symmetric3 k;
    if (framed_ && local.joints.holds(local.contacts[i])) {
        const ContactFrame& frame = local.contacts[i];
        const Mat3 in_contact = local.joints.collisionMatrix(frame, local.bodies).toMatrix();
        k = Symmetric3::from(frame.basis * in_contact * frame.basis.transpose());
    } else {
        if (!local.isFixed(s.a)) addCollisionMatrix(a.mass_inv, a.inertia_inv, s.r_a, k);
        if (!local.isFixed(s.b)) addCollisionMatrix(b.mass_inv, b.inertia_inv, s.r_b, k);
    }
    setInvertible(s, k);
    mendSingular(s);
    s.friction = contact.static_friction;
    const double closing = s.normal.dot(relativeVelocity(s, a, b));
    s.target = ContactLaw::separatingSpeed(swept.settings, contact, closing);
    s.impulse = Triple1(contact.last_impulse);
    if (!(s.normal.dot(s.impulse) > 0) || !isResolvable(s)) s.impulse = Triple1();
}

void PlainSweeper::sweep(const SweptBatch& swept) {
    if (framed_) {
        for (std::size_t i = 0; i < contacts_.size(); ++i) visitFramed(i, swept.local);
        for (std::size_t i = contacts_.size(); i-- > 0;) visitFramed(i, swept.local);
        return;
    }
    const std::size_t pairs = pair_begin_.size() - 1;
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        visitPair(pair, swept.local, [&](std::size_t begin, std::size_t end, auto& a, auto& b) {
            for (std::size_t i = begin; i < end; ++i) visit(contacts_[i], a, b);
        });
    }
    for (std::size_t pair = pairs; pair-- > 0;) {
        visitPair(pair, swept.local, [&](std::size_t begin, std::size_t end, auto& a, auto& b) {
            for (std::size_t i = end; i-- > begin;) visit(contacts_[i], a, b);
        });
    }
}

void PlainSweeper::visitFramed(std::size_t i, LocalBatch& local) {
    SweptContact& contact = contacts_[i];
    const ContactFrame& frame = local.contacts[i];
    const Triple1 velocity = relativeVelocity(contact, read(local.bodies[contact.a]), read(local.bodies[contact.b]));
    if (!isResolvable(contact) || !isFinite(velocity)) return;
    if (frame.rolling != ContactFrame::rolls_freely) {
        visitRolling(contact, frame, local);
        return;
    }
    const Triple1 impulse = projectedImpulse(contact, velocity);
    if (!isFinite(impulse)) return;
    local.pushWorld(frame, toVec3(impulse - contact.impulse));
    contact.impulse = impulse;
}

void PlainSweeper::visitRolling(SweptContact& contact, const ContactFrame& frame, LocalBatch& local) {
    Rolling& turned = rolling_[frame.rolling];
    Vec6 excess = relativeTwist(frame, local.bodies[frame.a], local.bodies[frame.b]);
    excess[0] -= contact.target;
    Vec6 present;
    present << frame.basis.transpose() * toVec3(contact.impulse), turned.impulse;
    const Vec6 next = solveRolling(local.rolling[frame.rolling], contact.friction, contact.friction, excess, present,
                                   RollingRounds::few);
    const Vec3 impulse = frame.basis * next.head<3>();
    local.pushWorld(frame, impulse - toVec3(contact.impulse));
    local.turn(frame, next.tail<3>() - turned.impulse);
    contact.impulse = Triple1(impulse);
    turned.impulse = next.tail<3>();
}

void PlainSweeper::setImpulse(std::size_t contact, const Triple1& impulse, LocalBatch& local) {
    SweptContact& s = contacts_[contact];
    withBodies(s, local, [&](auto&& a, auto&& b) { push(s, impulse - s.impulse, a, b); });
    s.impulse = impulse;
}

void PlainSweeper::note(const SweptBatch&) {
    before_ = firstOf(memory_before_, contacts_.size());
    for (std::size_t i = 0; i < contacts_.size(); ++i) before_[i] = contacts_[i].impulse;
    for (Rolling& r : rolling_) r.before = r.impulse;
}

SweepChange PlainSweeper::change(const SweptBatch& swept) {
    SweepChange change;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const SweptContact& s = contacts_[i];
        if (!isResolvable(s)) continue;
        const Triple1 difference = s.impulse - before_[i];
        change.add({difference.squaredNorm() / s.normal_mass, squareRoot((s.k * difference).squaredNorm())});
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
    direction_.assign(contacts_.size(), Triple1());
    for (Rolling& r : rolling_) r.direction.setZero();
}

void PlainSweeper::accelerate(double beta, const SweptBatch&) {
    const auto advance = [beta](auto& impulse, const auto& before, auto& direction) {
        using Vector = std::remove_cvref_t<decltype(before)>;
        const Vector change = impulse - before;
        const Vector step = beta * direction;
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
        swept.contacts[swept.batch.contacts[i]].impulse += toVec3(contacts_[i].impulse);
    }
}

/// Finds the impulses of the joints, and writes those of the rolling contacts.
void PlainSweeper::settleFrames(const SweptBatch& swept) {
    LocalBatch& local = swept.local;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        ContactFrame& frame = local.contacts[i];
        frame.impulse = toVec3(contacts_[i].impulse);
        if (frame.rolling == ContactFrame::rolls_freely) continue;
        RollingContact& rolling = local.rolling[frame.rolling];
        rolling.impulse_W = frame.basis * rolling_[frame.rolling].impulse;
        swept.contacts[swept.batch.contacts[i]].angular_impulse += rolling.impulse_W;
    }
    local.joints.settle(local.contacts, local.rolling, local.bodies);
    local.joints.scatter();
}

}  // namespace cairn
