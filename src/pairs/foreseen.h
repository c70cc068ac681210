/// @file Foreseen (speculative) contacts: those of bodies that are apart and would meet before the next detection.
/// @source Catto: Continuous collision, GDC 2013 (the idea); which contacts are foreseen and which are not is our own
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "body/body_storage.h"
#include "broad_phase/broad_phase.h"
#include "geometry/geometry.h"
#include "narrow_phase/narrow_phase.h"
#include "parallel/function_ref.h"

namespace cairn {

/// How far ahead a detection looks.
struct Foresight {
    double time = 0;           ///< of the next time step [s]; 0 = only what touches now is found
    Vec3 fall = Vec3::Zero();  ///< what gravity adds to a velocity before then [m/s, W]
};

/// What a detection reports.
struct DetectionRange {
    double margin = 0;           ///< contacts are found up to this distance [m]; 0 without a threshold = a part of it
    double threshold = 0;        ///< overlap that the correction leaves alone [m]; 0 = a part of the smaller body
    double allowed_overlap = 0;  ///< that part, of the smaller body's smallest extent
    Foresight foresight{};

    /// Whether the other finds the same between bodies that rest.
    bool looksAlike(const DetectionRange& other) const {
        return margin == other.margin && threshold == other.threshold && allowed_overlap == other.allowed_overlap &&
               (foresight.time > 0) == (other.foresight.time > 0);
    }
    /// For two bodies with these inner radii [m], of which one is finite.
    double overlapOf(double r_min_a, double r_min_b) const {
        return threshold > 0 ? threshold : allowed_overlap * 2 * std::min(r_min_a, r_min_b);
    }
    double marginOf(double r_min_a, double r_min_b) const {
        return margin > 0 || threshold > 0 ? margin : overlapOf(r_min_a, r_min_b) * margin_part;
    }
    static constexpr double margin_part = 1.0 / 16;
};

/// A body now and at the end of the next time step, if nothing stops it.
struct BodyAhead {
    Bounds now;             ///< grown by the contact margin [m, W]
    Bounds way;             ///< of all places from now until then [m, W]
    Vec3 v = Vec3::Zero();  ///< with what gravity adds [m/s, W]
    Vec3 w = Vec3::Zero();  ///< [rad/s, W]
    double turning = 0;     ///< largest speed of a surface point about the centre, 0 for a ball [m/s]
    double reach = 0;       ///< largest way of a surface point [m]; 0 if it is no more than a small part of the body

    bool isStill() const { return reach == 0 && turning == 0 && v.isZero(0); }
};

/// Fills in all but the bounds of now. @pre ahead.now
void lookAhead(const BodyStorage& bodies, const DetectionRange& range, BodyIndex i, BodyAhead& ahead);

/// The bounds that a detection searches a body with: grown by the margin, and by the way ahead [m, W].
/// @param ahead out: how the body goes on, where the range looks ahead
Bounds searchedBounds(const BodyStorage& bodies, const DetectionRange& range, BodyIndex i, BodyAhead& ahead);

/// Whether contacts move a body.
bool flies(const BodyStorage& bodies, BodyIndex i);

/// Whether a body, with the velocities that it has after the resolution, ends the step so far from where it was
/// foreseen that others may be in the way there. @param ahead what was foreseen
bool isStruck(const BodyStorage& bodies, const DetectionRange& range, BodyIndex i, const BodyAhead& ahead);

/// Whether a body may get far into others in a step. @param v, w its velocities, or by how much they are others than
/// foreseen [m/s, rad/s; W]
bool movesFar(const BodyStorage& bodies, const DetectionRange& range, BodyIndex i, const Vec3& v, const Vec3& w);

/// Which contacts of one pair a detection reports.
class PairAhead {
  public:
    PairAhead(const BodyStorage& bodies, const DetectionRange& range, const BodyPair& pair,
              std::span<const BodyAhead> ahead)
        : bodies_(bodies), range_(range), pair_(pair), a_(ahead[pair.a]), b_(ahead[pair.b]) {}

    /// Whether one of them moves far enough to look ahead.
    bool isAny() const { return a_.reach > 0 || b_.reach > 0; }
    /// Whether two bodies that do not touch would meet before the next detection, rather than pass each other by: with
    /// the motion of both, or of one of them alone, as another body may stop the other. Those that would overlap by no
    /// more than they are allowed pass: what slides over a seam between two others is not to be stopped by the edge of
    /// the next.
    bool wouldMeet() const;
    /// How far they can come closer until then, likewise [m].
    double way() const;
    /// Whether they close fast enough, likewise, to touch in a point that is apart now.
    /// @param normal from B to A @param distance [m]
    bool closes(const Vec3& point, const Vec3& normal, double distance) const;
    /// Where two bodies meet later than now.
    struct AtEnd {
        Vec3 point;       ///< now: between the places of the two that meet then [m, W]
        Vec3 slide;       ///< Contact::slide
        Vec3 normal;      ///< then [W]
        double distance;  ///< from which the velocities that they have now lead there [m]
    };
    /// Calls use() for where the bodies overlap by more than they are allowed to when the step ends, if nothing stops
    /// them.
    void forEachAtEnd(Manifold& manifold, FunctionRef<void(const AtEnd&)> use) const;
    /// Whether one is a surface, and they move so far past each other that a solid could be through it in the end.
    bool mayCross() const {
        if (!isAny()) return false;
        // Most pairs have none, and this is quickly told.
        const bool surface_a = surfaceOf(bodies_.shape[pair_.a]) != nullptr;
        const bool surface_b = surfaceOf(bodies_.shape[pair_.b]) != nullptr;
        return surface_a != surface_b && passesFar(surface_a ? pair_.b : pair_.a);
    }
    /// Calls use(point, normal, distance [m, W]), likewise, for where the middle of a solid, or of a part of it, would
    /// pass through a surface within the step: the contact of a ball as thick as the part with the plane of the
    /// triangle that is in its way. On rough ground what is nearest now does not stop a body that goes elsewhere. @pre
    /// mayCross()
    void forEachCrossing(FunctionRef<void(const Vec3&, const Vec3&, double)> use) const;

  private:
    struct Crossing;
    /// A solid and a surface, each with how it goes on.
    struct OverSurface {
        BodyIndex solid, ground;
        const BodyAhead& solid_ahead;
        const BodyAhead& ground_ahead;
    };

    bool passesFar(BodyIndex solid) const;
    bool meetsWith(const BodyAhead* a, const BodyAhead* b, double depth) const;
    bool forEachAfter(double time, double depth, Manifold& manifold, FunctionRef<void(const AtEnd&)> use) const;
    Pose afterTime(BodyIndex i, const BodyAhead& ahead, double time) const;
    Pose endOf(BodyIndex i, const BodyAhead& ahead) const;
    Pose fallenEndOf(BodyIndex i, const BodyAhead& ahead) const;
    OverSurface overSurface() const;
    std::optional<Crossing> crossingOf(const OverSurface& pair, const Shape& part, const Pose& now,
                                       const Pose& end) const;

    const BodyStorage& bodies_;
    const DetectionRange& range_;
    const BodyPair& pair_;
    const BodyAhead& a_;
    const BodyAhead& b_;
};

}  // namespace cairn
