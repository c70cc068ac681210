#include "correction/candidate.h"

namespace cairn {

namespace {

Vec3 contactVelocity(BodyIndex body, const Contact& contact, const BodyState& bodies) {  // (2.5.1)
    return bodies.v[body] + bodies.w[body].cross(contact.point - bodies.position[body]);
}

void addIfFinite(const Candidate& candidate, CandidateList& list) {
    if (candidate.displacement.allFinite()) list.add(candidate);
}

/// Adds what `body` can do. @param outward the unit normal that points from the other body to this one.
///
/// With `outward` = n for A and −n for B both lines of (2.3.1)–(2.3.3) become one: the body leaves along −d_c·outward,
/// or back along its step ℓ, if ℓ·outward ≤ d_c: if its step brought it in at least as deep as it has to leave.
void addCandidatesOf(BodyIndex body, BodyIndex other, const Vec3& outward, double d_c, const BodyState& bodies,
                     CandidateList& list) {
    if (bodies.isFixed(body)) return;
    const Vec3& step = bodies.linear_step[body];
    const double inward = step.dot(outward);
    if (inward <= d_c) {
        addIfFinite({body, other, CandidateKind::velocity, (-d_c / inward) * step}, list);
    }
    addIfFinite({body, other, CandidateKind::normal, -d_c * outward}, list);
}

}  // namespace

double closingSpeedOfA(const Contact& contact, const BodyState& bodies) {
    return -contactVelocity(contact.a, contact, bodies).dot(contact.normal);
}

double closingSpeedOfB(const Contact& contact, const BodyState& bodies) {
    return contactVelocity(contact.b, contact, bodies).dot(contact.normal);
}

CandidateList listCandidates(const Contact& contact, const BodyState& bodies, double remaining) {
    CandidateList list;
    const double d_c = correctionDistance(contact, remaining);
    if (closingSpeedOfA(contact, bodies) > closingSpeedOfB(contact, bodies)) {
        addCandidatesOf(contact.a, contact.b, contact.normal, d_c, bodies, list);
        addCandidatesOf(contact.b, contact.a, -contact.normal, d_c, bodies, list);
    } else {
        addCandidatesOf(contact.b, contact.a, -contact.normal, d_c, bodies, list);
        addCandidatesOf(contact.a, contact.b, contact.normal, d_c, bodies, list);
    }
    return list;
}

}  // namespace cairn
