#include "pairs/warm_start.h"

#include <algorithm>
#include <utility>

#include "body/roundness.h"
#include "math/arrays.h"
#include "pairs/same_point.h"

namespace cairn {

namespace {

/// How a body moved since its contacts were found.
class Motion {
  public:
    Motion(const BodyStorage& bodies, BodyIndex i)
        : from_(bodies.detected_position[i]), to_(bodies.position[i]), turn_(Mat3::Identity()) {
        const Quat& before = bodies.detected_orientation[i];
        const Quat& now = bodies.orientation[i];
        // Where it did not turn the matrix of the product is the same one.
        if (before.coeffs() != now.coeffs()) turn_ = (now * before.conjugate()).toRotationMatrix();
    }
    Vec3 movedPoint(const Vec3& point) const { return to_ + turn_ * (point - from_); }
    Vec3 way() const { return to_ - from_; }
    Vec3 turned(const Vec3& direction) const { return turn_ * direction; }

  private:
    Vec3 from_, to_;
    Mat3 turn_;
};

}  // namespace

void beginContacts(std::span<Contact> contacts, const ContactsBegin& begins, const Executor& executor) {
    executor.forBlocks(contacts.size(), [&](std::size_t begin, std::size_t end, int) {
        for (Contact& c : contacts.subspan(begin, end - begin)) {
            // Adding zero turns −0 into +0, as what is inherited is added to zero.
            c.last_impulse = begins.part * c.impulse + Vec3::Zero();
            c.reference_impulse *= begins.reference_part;
            c.earlier_impulse = begins.goes_on ? c.impulse : Vec3::Zero();
            c.earlier_angular_impulse = begins.goes_on ? c.angular_impulse : Vec3::Zero();
            if (begins.warm_start == WarmStart::off) {
                c.last_impulse.setZero();
                c.reference_impulse.setZero();
            }
            c.impulse.setZero();
            c.slide.setZero();
            c.angular_impulse.setZero();
            c.gap = c.forced = c.fall = c.climb = 0;
        }
    });
}

void inheritImpulses(const BodyStorage& bodies, std::span<const Contact> before, std::span<FoundContact> now,
                     std::vector<const Contact*>& left) {
    left.clear();
    const auto isIdle = [](const Contact& c) {
        return c.last_impulse.isZero(0) && c.reference_impulse.isZero(0) && c.earlier_impulse.isZero(0) &&
               c.earlier_angular_impulse.isZero(0);
    };
    if (std::ranges::all_of(before, isIdle)) return;
    const auto [a, b] = std::pair(before.front().a, before.front().b);
    const Motion with_a(bodies, a);
    const Motion with_b(bodies, b);
    const double size = std::min(bodies.r_max[a], bodies.r_max[b]);
    double reach = same_after_a_step * size;
    // Where one rolls on the other the point goes on over both, as far as the one passes the other. Flat sides do not
    // roll, and of several points one would be taken for another.
    const bool rolls = roundnessOf(bodies, a) != Roundness::none || roundnessOf(bodies, b) != Roundness::none;
    if (rolls && before.size() == 1 && now.size() == 1) reach += (with_a.way() - with_b.way()).norm();
    // Every impulse goes to one contact as a whole: where points of a manifold merge or split, the pair still gets the
    // same push in total.
    for (const Contact& old : before) {
        if (isIdle(old)) continue;
        const Vec3 on_a = with_a.movedPoint(old.point);
        const Vec3 on_b = with_b.movedPoint(old.point);
        const Vec3 normal = with_a.turned(old.normal);
        double nearest = reach * reach;
        FoundContact* heir = nullptr;
        for (FoundContact& contact : now) {
            const double apart = std::min((contact.point - on_a).squaredNorm(), (contact.point - on_b).squaredNorm());
            if (!(apart < nearest)) continue;
            const double distance = apart + squaredTurn(contact.normal, normal, size);
            if (!(distance < nearest)) continue;
            nearest = distance;
            heir = &contact;
        }
        if (heir == nullptr) {
            if (old.normal.dot(old.last_impulse) > 0) left.push_back(&old);
            continue;
        }
        heir->last_impulse += old.last_impulse;
        heir->reference_impulse += old.reference_impulse;
        heir->earlier_impulse += old.earlier_impulse;
        heir->earlier_angular_impulse += old.earlier_angular_impulse;
    }
}

FoundContact foreseenAgain(const BodyStorage& bodies, const Contact& before, double allowed_overlap, double time) {
    const Motion with_a(bodies, before.a);
    const Vec3 on_a = with_a.movedPoint(before.point);
    const Vec3 on_b = Motion(bodies, before.b).movedPoint(before.point);
    const Vec3 normal = with_a.turned(before.normal);
    const Vec3 passed = (on_a - on_b) / 2;
    const double gap = std::max(0.0, before.distance + normal.dot(on_a - on_b));
    return {.a = before.a,
            .b = before.b,
            .point = (on_a + on_b) / 2,
            .normal = normal,
            .distance = gap,
            .allowed_overlap = allowed_overlap,
            .allowed_closing = gap / time,
            .slide = passed - passed.dot(normal) * normal,
            .last_impulse = before.last_impulse,
            .reference_impulse = before.reference_impulse,
            .earlier_impulse = before.earlier_impulse,
            .earlier_angular_impulse = before.earlier_angular_impulse};
}

bool keepAhead(const BodyStorage& bodies, const DetectionRange& range, std::span<const Contact* const> left,
               bool went_back, std::vector<FoundContact>& found) {
    const double time = range.foresight.time;
    if (left.empty() || time == 0) return false;
    const auto [a, b] = std::pair(left.front()->a, left.front()->b);
    if (!went_back && !(bodies.isWhereDetected(a) && bodies.isWhereDetected(b))) return false;
    const double allowed_overlap = range.overlapOf(bodies.r_min[a], bodies.r_min[b]);
    for (const Contact* contact : left) appendTightly(found, foreseenAgain(bodies, *contact, allowed_overlap, time));
    return true;
}

}  // namespace cairn
