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

template <class Sweeper>
std::int64_t Sweeps<Sweeper>::resolve(const BatchView& batch, const BatchKind& kind, std::span<Contact> contacts,
                                      const BodyState& bodies, const ResolutionSettings& settings,
                                      const Executor& executor) {
    prepare(batch, kind, contacts, bodies, settings, executor);
    // How contacts close is found before anything is pushed.
    if (rolls()) rolling_.fill(*pgs_);
    sweeper_.fill(*pgs_);
    sweeper_.start(*pgs_);
    if (rolls()) rolling_.start(*pgs_);
    framed_.begin(*pgs_, static_cast<std::uint32_t>(unframed_), static_cast<std::uint32_t>(contacts_.size()));
    while (!isDone()) {
        beginSweep();
        sweeper_.sweepForth(*pgs_);
        if (rolls()) rolling_.sweepForth(*pgs_);
        framed_.sweepForth(local_);
        framed_.sweepBack(local_);
        if (rolls()) rolling_.sweepBack(*pgs_);
        sweeper_.sweepBack(*pgs_);
        endSweep();
    }
    return finish();
}

template <class Sweeper>
void Sweeps<Sweeper>::prepare(const BatchView& batch, const BatchKind& kind, std::span<Contact> contacts,
                              const BodyState& bodies, const ResolutionSettings& settings, const Executor& executor) {
    gather(batch, kind, contacts, bodies);
    pgs_.emplace(PgsBatch{local_, batch_, contacts, bodies, settings, executor, kind.order});
    plan_ = planOf(kind, bodies, settings);
    progress_ = SweepProgress(plan_);
    sweeps_ = 0;
    visits_ = 0;
    done_ = false;
    two_frictions_ = kind.two_frictions;
    may_step_directly_ = kind.may_step_directly;
    stepped_directly_ = false;
    if (kind.framed) {
        local_.gatherUnprepared(batch_, contacts, bodies);
    } else {
        local_.gatherBodies(batch_, contacts, bodies);
    }
    sweeper_.prepare(*pgs_, plain_);
    if (rolls()) rolling_.prepare(*pgs_, unframed_ - plain_, plain_);
}

/// Lists the contacts: those that resist rolling after the others, and framed ones last.
template <class Sweeper>
void Sweeps<Sweeper>::gather(const BatchView& batch, const BatchKind& kind, std::span<const Contact> contacts,
                             const BodyState& bodies) {
    framed_kind_ = kind.framed;
    contacts_.assign(batch.contacts.begin(), batch.contacts.end());
    plain_ = unframed_ = contacts_.size();
    if (kind.framed || kind.rolling > 0) {
        const std::vector<BodyIndex> jointed = jointedOf(batch, bodies);
        const auto isTied = [&](BodyIndex i) { return std::ranges::binary_search(jointed, i); };
        const auto isFree = [&](std::uint32_t i) { return !isTied(contacts[i].a) && !isTied(contacts[i].b); };
        const auto isPlain = [&](std::uint32_t i) { return !resistsRolling(contacts[i]); };
        const auto placeOf = [&](auto it) { return static_cast<std::size_t>(it - contacts_.begin()); };
        unframed_ = placeOf(std::stable_partition(contacts_.begin(), contacts_.end(), isFree));
        const auto end = contacts_.begin() + static_cast<std::ptrdiff_t>(unframed_);
        plain_ = placeOf(std::stable_partition(contacts_.begin(), end, isPlain));
    }
    batch_ = {batch.bodies, contacts_, batch.joints};
}

template <class Sweeper>
std::int64_t Sweeps<Sweeper>::finish() {
    for (std::size_t i = 0; i < local_.dynamic_bodies; ++i) local_.bodies[i].struck = 1;
    sweeper_.finish(*pgs_);
    if (rolls()) rolling_.finish(*pgs_);
    if (framed_kind_) framed_.finish(*pgs_);
    local_.scatterBodies(pgs_->bodies);
    return visits_;
}

template <class Sweeper>
void Sweeps<Sweeper>::beginSweep() {
    bounds_changed_ = local_.joints.resolveBounds(local_.bodies, pgs_->settings.resolution_threshold);
    // Nobody asks what the last sweep changes.
    measured_ = stepped_directly_ || !progress_.isLast();
    if (!measured_) return;
    sweeper_.save(*pgs_);
    if (rolls()) rolling_.save(*pgs_);
    framed_.save();
    direction_.save(local_, pgs_->executor);
}

template <class Sweeper>
void Sweeps<Sweeper>::endSweep() {
    ++sweeps_;
    visits_ += 2 * static_cast<std::int64_t>(contacts_.size());
    SweepChange change;
    if (measured_) {
        change = sweeper_.change(*pgs_);
        if (rolls()) change.add(rolling_.change(*pgs_));
        change.add(framed_.change());
    }
    judge(change);
}

/// Takes the direct step, as far as the friction cones allow it. @return whether there is one
template <class Sweeper>
bool Sweeps<Sweeper>::takeDirectStep() {
    if constexpr (Sweeper::steps_directly) {
        gathered_.clear();
        for (std::size_t i = 0; i < plain_; ++i) gathered_.push_back(sweeper_.contactAt(i, *pgs_));
        const BodyRange moving{0, static_cast<std::uint32_t>(local_.dynamic_bodies)};
        if (!direct_.compute(local_.bodies, moving, gathered_)) return false;
        kept_.clear();
        for (std::size_t i = 0; i < gathered_.size(); ++i) {
            const PgsContact& s = gathered_[i];
            kept_.push_back(s.impulse);
            const Triple1 wanted = s.impulse + Triple1(direct_.changes()[i]);
            const double normal = s.normal.dot(wanted);
            const Triple1 allowed = normal > 0 ? ontoCone(s, normal, wanted - normal * s.normal) : Triple1();
            sweeper_.setImpulse(i, allowed, local_);
        }
        return true;
    } else {
        return false;
    }
}

/// Undoes it.
template <class Sweeper>
void Sweeps<Sweeper>::revert() {
    if constexpr (Sweeper::steps_directly) {
        for (std::size_t i = 0; i < kept_.size(); ++i) sweeper_.setImpulse(i, kept_[i], local_);
    }
}

/// Decides how to go on after a sweep.
template <class Sweeper>
void Sweeps<Sweeper>::judge(const SweepChange& change) {
    const bool last = progress_.isLast();
    progress_.countSweep();
    if (last && !stepped_directly_) {
        done_ = endPass();
        return;
    }
    const bool fails = stepped_directly_ && !(change.squared < worthwhile * progress_.gradient());
    if (fails) revert();
    if (stepped_directly_) progress_.forgetDirection();
    stepped_directly_ = false;
    may_step_directly_ = may_step_directly_ && !fails;
    if ((progress_.isSteady(change) && !bounds_changed_) || last) {
        done_ = endPass();
        return;
    }
    if (fails) return;
    stepped_directly_ = may_step_directly_ && progress_.sweeps() >= sweeps_before_direct_step && takeDirectStep();
    if (!stepped_directly_) accelerate(bounds_changed_ ? 0 : progress_.beta(change));
    progress_.advance(change);
}

/// @return whether the batch is done: nothing slides that sweeps took as sticking
template <class Sweeper>
bool Sweeps<Sweeper>::endPass() {
    // Only what static friction cannot hold slides. Where both frictions are the same this costs nothing.
    if (!two_frictions_) return true;
    const bool plain = sweeper_.releaseSliding(*pgs_);
    const bool rolling = rolls() && rolling_.releaseSliding(*pgs_);
    const bool framed = framed_.releaseSliding(*pgs_);
    if (!plain && !rolling && !framed) return true;
    two_frictions_ = false;
    progress_ = SweepProgress(plan_);
    return false;
}

template <class Sweeper>
void Sweeps<Sweeper>::accelerate(double beta) {
    if (!progress_.hasDirection()) {
        direction_.restart();
        framed_.restart();
        sweeper_.restart();
        if (rolls()) rolling_.restart();
    }
    direction_.accelerate(beta, local_, pgs_->executor);
    sweeper_.accelerate(beta, *pgs_);
    if (rolls()) rolling_.accelerate(beta, *pgs_);
    framed_.accelerate(beta);
}

template class Sweeps<OrderedSweeper>;
template class Sweeps<LaneSweeper>;

}  // namespace cairn
