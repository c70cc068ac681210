/// @file What a visit does to a contact and its bodies: one or several in lanes, free or tied to others.
#pragma once

#include <limits>

#include "resolution/pgs_contact.h"
#include "resolution/rolling_contact.h"

namespace cairn {

/// The bodies of a contact, which nothing ties to others.
template <class Number>
struct FreePair {
    PgsBody<Number>& a;
    PgsBody<Number>& b;

    [[gnu::always_inline]] Triple<Number> velocityAt(const BasicPgsContact<Number>& contact) const {
        return relativeVelocity(contact, a, b);
    }
    [[gnu::always_inline]] Triple<Number> spin() const { return a.w - b.w; }
    [[gnu::always_inline]] void push(const BasicPgsContact<Number>& contact, const Triple<Number>& change) const {
        cairn::push(contact, change, a, b);
    }
    [[gnu::always_inline]] void turn(const Triple<Number>& change) const {
        a.w += a.inertia_inv * change;
        b.w -= b.inertia_inv * change;
    }
};

/// Where an impulse is finite, of a contact whose K can be inverted. Others would spread.
template <class Number>
[[gnu::always_inline]] inline auto isUsable(const BasicPgsContact<Number>& contact, const Triple<Number>& impulse) {
    return (impulse.squaredNorm() < std::numeric_limits<double>::infinity()) & (contact.normal_mass > 0);
}

/// A visit.
template <class Number, class Pair>
[[gnu::always_inline]] inline void visit(BasicPgsContact<Number>& contact, const Pair& pair) {
    const Triple<Number> impulse = projectedImpulse(contact, pair.velocityAt(contact));
    const Triple<Number> next = where(isUsable(contact, impulse), impulse, contact.impulse);
    pair.push(contact, next - contact.impulse);
    contact.impulse = next;
}

/// A visit on the way back, which does the same in reverse.
template <class Number, class Pair>
[[gnu::always_inline]] inline void visitBack(BasicPgsContact<Number>& contact, const Pair& pair) {
    visit(contact, pair);
}

/// A visit of a contact that resists rolling: all of it at once where bounds allow that; else the impulse and what
/// there is against turning, one after the other.
template <class Number, class Pair>
class RollingVisit {
    using Vector = Triple<Number>;

  public:
    [[gnu::always_inline]] RollingVisit(BasicRollingContact<Number>& contact, const Pair& pair)
        : contact_(contact),
          pair_(pair),
          rigid_(rigidWrench(contact, pair.velocityAt(contact) - contact.target * contact.normal, pair.spin())),
          within_(isWithin(contact, rigid_)) {}

    [[gnu::always_inline]] void push() {
        const bool all = holdsInAll(within_);
        const Vector impulse =
            all ? rigid_.impulse
                : where(within_, rigid_.impulse, projectedImpulse(contact_, pair_.velocityAt(contact_)));
        const Vector next = where(isUsable(contact_, impulse), impulse, contact_.impulse);
        pair_.push(contact_, next - contact_.impulse);
        contact_.impulse = next;
    }
    [[gnu::always_inline]] void turn() {
        const bool all = holdsInAll(within_);
        const Vector turning =
            all ? rigid_.turning : where(within_, rigid_.turning, turningSteps(contact_, pair_.spin()));
        set(where(isUsable(contact_, turning), turning, contact_.turning));
    }
    /// Takes back what an impulse that came later does not allow.
    [[gnu::always_inline]] void bound() {
        if (!holdsInAll(within_)) set(where(within_, contact_.turning, boundedTurning(contact_)));
    }

  private:
    [[gnu::always_inline]] void set(const Vector& turning) {
        pair_.turn(turning - contact_.turning);
        contact_.turning = turning;
    }

    BasicRollingContact<Number>& contact_;
    const Pair& pair_;
    BasicWrench<Number> rigid_;
    decltype(Number{} > 0) within_;
};

template <class Number, class Pair>
[[gnu::always_inline]] inline void visit(BasicRollingContact<Number>& contact, const Pair& pair) {
    RollingVisit<Number, Pair> visit(contact, pair);
    visit.push();
    visit.turn();
}
template <class Number, class Pair>
[[gnu::always_inline]] inline void visitBack(BasicRollingContact<Number>& contact, const Pair& pair) {
    RollingVisit<Number, Pair> visit(contact, pair);
    visit.turn();
    visit.push();
    visit.bound();
}

}  // namespace cairn
