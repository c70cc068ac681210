/// @file The up to four first displacements with which the correction of one contact can begin. @source thesis §2.3
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "body/contact.h"

namespace cairn {

/// Where a first displacement points.
enum class CandidateKind : std::uint8_t {
    velocity,  ///< back along the body's last linear step (2.3.3)
    normal,    ///< along the contact normal (2.3.1)
};

/// One way to begin the correction of a contact.
struct Candidate {
    BodyIndex body = 0;   ///< the body that moves first, dynamic
    BodyIndex other = 0;  ///< the other body of the contact, which must not move
    CandidateKind kind = CandidateKind::normal;
    Vec3 displacement = Vec3::Zero();  ///< [m, W], finite
};

/// The candidates of a contact, in the order of trial.
class CandidateList {
  public:
    void add(const Candidate& candidate) { items_[count_++] = candidate; }
    std::size_t size() const { return count_; }
    const Candidate& operator[](std::size_t i) const { return items_[i]; }
    const Candidate* begin() const { return items_.data(); }
    const Candidate* end() const { return items_.data() + count_; }

  private:
    std::array<Candidate, 4> items_;
    std::size_t count_ = 0;
};

/// The part of a contact's distance that its correction removes. @param remaining f·thr_pen [m], ≤ 0
/// @return [m] @source thesis (2.5.4)
inline double correctionDistance(const Contact& contact, double remaining) {
    return contact.distance - remaining;
}

/// How fast A moves against the contact. @return [m/s] @source thesis (2.5.2)
double closingSpeedOfA(const Contact& contact, const BodyState& bodies);

/// How fast B moves against the contact. @return [m/s] @source thesis (2.5.3)
double closingSpeedOfB(const Contact& contact, const BodyState& bodies);

/// All candidates of a penetrating contact: the body with the larger closing speed first (B if they are equal), for
/// each body the step back along its velocity before the normal. A fixed body has none, and one whose displacement
/// would not be finite is left out.
/// @param remaining f·thr_pen [m], ≤ 0 @source thesis (2.3.1)–(2.3.3), §2.5
CandidateList listCandidates(const Contact& contact, const BodyState& bodies, double remaining);

}  // namespace cairn
