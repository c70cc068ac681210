#include "resolution/sweeps.h"

#include <algorithm>

#include "resolution/rolling.h"

namespace cairn {

namespace {

/// Sweeps before the first direct step: they find out which contacts push and stick.
constexpr std::int64_t sweeps_before_direct_step = 3;

/// A direct step is taken back unless it leaves less than this part of the squared change of a sweep.
constexpr double worthwhile = 0.25;

/// The bodies that joints of a batch tie to others, ascending.
std::vector<BodyIndex> jointedOf(const BatchView& batch, const BodyState& bodies) {
    std::vector<BodyIndex> jointed;
    for (const JointBlock& joint : batch.joints) {
        for (const BodyIndex body : {joint.a, joint.b}) {
            if (body != Joint::world && !bodies.isImmovable(body)) jointed.push_back(body);
        }
    }
    std::ranges::sort(jointed);
    return jointed;
}

}  // namespace

template <class Number>
std::int64_t Sweeps<Number>::resolve(std::span<const BatchView> batches, std::span<const BatchKind> kinds,
                                     std::span<Contact> contacts, const BodyState& bodies,
                                     const ResolutionSettings& settings, const Executor& executor) {
    gather(batches, kinds, contacts, bodies, settings);
    const std::span<JointBlock> joints = batches.size() == 1 ? batches[0].joints : std::span<JointBlock>();
    const BatchView all{bodies_, contacts_, joints};
    const PgsBatch pgs{local_, all, contacts, bodies, settings, executor};
    begin(pgs, kinds[0]);
    const std::int64_t visits = sweepAll(pgs);
    for (std::size_t i = 0; i < local_.dynamic_bodies; ++i) local_.bodies[i].struck = 1;
    if (coloured_) sweeper_.finish(pgs);
    if (kinds[0].framed) framed_.finish(pgs);
    local_.scatterBodies(bodies);
    return visits;
}

/// Lists the bodies and contacts of all, framed ones last.
template <class Number>
void Sweeps<Number>::gather(std::span<const BatchView> batches, std::span<const BatchKind> kinds,
                            std::span<const Contact> contacts, const BodyState& bodies,
                            const ResolutionSettings& settings) {
    bodies_.clear();
    contacts_.clear();
    framed_contacts_.clear();
    for (std::size_t n = 0; n < lanes; ++n) {
        Course& course = courses_[n];
        course.range = {};
        course.sweeps = 0;
        course.active = n < batches.size();
        if (!course.active) continue;
        const BatchView& batch = batches[n];
        course.range.body_begin = bodies_.size();
        course.range.contact_begin = contacts_.size();
        bodies_.insert(bodies_.end(), batch.bodies.begin(), batch.bodies.end());
        if (kinds[n].framed) {
            const std::vector<BodyIndex> jointed = jointedOf(batch, bodies);
            const auto isTied = [&](BodyIndex i) { return std::ranges::binary_search(jointed, i); };
            for (const std::uint32_t i : batch.contacts) {
                const Contact& c = contacts[i];
                const bool framed = resistsRolling(c) || isTied(c.a) || isTied(c.b);
                (framed ? framed_contacts_ : contacts_).push_back(i);
            }
        } else {
            contacts_.insert(contacts_.end(), batch.contacts.begin(), batch.contacts.end());
        }
        course.range.body_end = bodies_.size();
        course.range.contact_end = contacts_.size();
        course.plan = planOf(kinds[n], bodies, settings);
        course.progress = SweepProgress(course.plan);
        course.two_frictions = kinds[n].two_frictions;
        course.may_step_directly = kinds[n].may_step_directly;
        course.stepped_directly = false;
    }
    coloured_ = kinds[0].coloured;
    plain_ = contacts_.size();
    contacts_.insert(contacts_.end(), framed_contacts_.begin(), framed_contacts_.end());
}

template <class Number>
void Sweeps<Number>::begin(const PgsBatch& pgs, const BatchKind& kind) {
    if (kind.framed) {
        local_.gatherUnprepared(pgs.batch, pgs.contacts, pgs.bodies);
    } else {
        local_.gatherBodies(pgs.batch, pgs.contacts, pgs.bodies);
    }
    if (coloured_) {
        sweeper_.beginColours(pgs, plain_);
    } else {
        std::array<LaneRange, lanes> ranges;
        for (std::size_t n = 0; n < lanes; ++n) ranges[n] = courses_[n].range;
        sweeper_.beginLanes(pgs, plain_, ranges);
    }
    framed_.begin(pgs, static_cast<std::uint32_t>(plain_), static_cast<std::uint32_t>(contacts_.size()));
}

/// @return contacts visited
template <class Number>
std::int64_t Sweeps<Number>::sweepAll(const PgsBatch& pgs) {
    std::int64_t visits = 0;
    const auto isActive = [](const Course& course) { return course.active; };
    while (std::ranges::any_of(courses_, isActive)) {
        const bool bounds_changed = local_.joints.resolveBounds(local_.bodies, pgs.settings.resolution_threshold);
        // Nobody asks what the last sweep changes.
        const bool measured = std::ranges::any_of(
            courses_, [](const Course& c) { return c.active && (c.stepped_directly || !c.progress.isLast()); });
        sweepOnce(pgs, measured);
        for (std::size_t n = 0; n < lanes; ++n) {
            Course& course = courses_[n];
            course.advances = false;
            if (!course.active) continue;
            ++course.sweeps;
            visits += 2 * static_cast<std::int64_t>(course.range.contact_end - course.range.contact_begin +
                                                    contacts_.size() - plain_);
            judge(n, bounds_changed, pgs);
        }
        accelerate(pgs);
    }
    return visits;
}

/// Sweeps forth and back, and finds what that changes.
template <class Number>
void Sweeps<Number>::sweepOnce(const PgsBatch& pgs, bool measured) {
    if (measured) {
        sweeper_.save(pgs);
        framed_.save();
        direction_.save(local_, pgs.executor);
    }
    sweeper_.sweepForth(pgs);
    framed_.sweepForth(local_);
    framed_.sweepBack(local_);
    sweeper_.sweepBack(pgs);
    if (!measured) return;
    if (coloured_) {
        changes_[0] = sweeper_.change(pgs);
    } else {
        changes_ = sweeper_.changeOfLanes();
    }
    changes_[0].add(framed_.change(local_));
}

/// Decides how a batch goes on after a sweep.
template <class Number>
void Sweeps<Number>::judge(std::size_t n, bool bounds_changed, const PgsBatch& pgs) {
    Course& course = courses_[n];
    SweepProgress& progress = course.progress;
    const SweepChange& change = changes_[n];
    const bool last = progress.isLast();
    progress.countSweep();
    if (last && !course.stepped_directly) {
        course.active = !endPass(n, pgs);
        return;
    }
    const bool fails = course.stepped_directly && !(change.squared < worthwhile * progress.gradient());
    if (fails) revert(course);
    if (course.stepped_directly) progress.forgetDirection();
    course.stepped_directly = false;
    course.may_step_directly = course.may_step_directly && !fails;
    if ((progress.isSteady(change) && !bounds_changed) || last) {
        course.active = !endPass(n, pgs);
        return;
    }
    if (fails) return;
    course.stepped_directly =
        course.may_step_directly && progress.sweeps() >= sweeps_before_direct_step && takeDirectStep(course, pgs);
    course.advances = !course.stepped_directly;
    if (course.advances) {
        course.starts = !progress.hasDirection();
        course.beta = bounds_changed ? 0 : progress.beta(change);
    }
    progress.advance(change);
}

/// @return whether the batch is done: nothing slides that sweeps took as sticking
template <class Number>
bool Sweeps<Number>::endPass(std::size_t n, const PgsBatch& pgs) {
    Course& course = courses_[n];
    // Only what static friction cannot hold slides. Where both frictions are the same this costs nothing.
    if (course.two_frictions) {
        const bool plain = sweeper_.releaseSliding(pgs, course.range);
        const bool framed = framed_.releaseSliding(pgs);
        if (plain || framed) {
            course.two_frictions = false;
            course.progress = SweepProgress(course.plan);
            return false;
        }
    }
    if (!coloured_) sweeper_.finishLane(n, course.range, pgs);
    return true;
}

/// Takes the direct step, as far as the friction cones allow it. @return whether there is one
template <class Number>
bool Sweeps<Number>::takeDirectStep(Course& course, const PgsBatch& pgs) {
    gathered_.clear();
    for (std::size_t i = course.range.contact_begin; i < course.range.contact_end; ++i) {
        gathered_.push_back(sweeper_.contactAt(i, pgs));
    }
    const BodyRange moving{static_cast<std::uint32_t>(course.range.body_begin),
                           static_cast<std::uint32_t>(course.range.body_end)};
    if (!direct_.compute(local_.bodies, moving, gathered_)) return false;
    course.kept.clear();
    for (std::size_t i = 0; i < gathered_.size(); ++i) {
        const PgsContact& s = gathered_[i];
        course.kept.push_back(s.impulse);
        const Triple1 wanted = s.impulse + Triple1(direct_.changes()[i]);
        const double normal = s.normal.dot(wanted);
        const Triple1 allowed = normal > 0 ? ontoCone(s, normal, wanted - normal * s.normal) : Triple1();
        sweeper_.setImpulse(course.range.contact_begin + i, allowed, local_);
    }
    return true;
}

/// Undoes it.
template <class Number>
void Sweeps<Number>::revert(const Course& course) {
    for (std::size_t i = 0; i < course.kept.size(); ++i) {
        sweeper_.setImpulse(course.range.contact_begin + i, course.kept[i], local_);
    }
}

template <class Number>
void Sweeps<Number>::accelerate(const PgsBatch& pgs) {
    std::array<double, lanes> beta{};
    std::array<double, lanes> advances{};
    bool any = false;
    for (std::size_t n = 0; n < lanes; ++n) {
        const Course& course = courses_[n];
        if (!course.advances) continue;
        any = true;
        advances[n] = 1;
        beta[n] = course.beta;
        const std::size_t begin = course.range.body_begin, end = course.range.body_end;
        if (course.starts) {
            direction_.restart(begin, end);
            framed_.restart();
            if (!coloured_) sweeper_.restartLane(n);
        }
        if (!coloured_) direction_.accelerate(course.beta, local_, begin, end);
    }
    if (!any) return;
    if (coloured_) {
        if (courses_[0].starts) sweeper_.restart();
        direction_.accelerate(beta[0], local_, pgs.executor);
        sweeper_.accelerate(beta[0], pgs);
    } else {
        sweeper_.accelerateLanes(beta, advances);
    }
    if (advances[0] != 0) framed_.accelerate(beta[0]);
}

template class Sweeps<double>;
template class Sweeps<Lanes>;

}  // namespace cairn
