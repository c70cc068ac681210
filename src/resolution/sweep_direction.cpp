#include "resolution/sweep_direction.h"

#include <algorithm>

namespace cairn {

namespace {

/// Fewest contacts or bodies worth a thread of their own.
constexpr std::size_t grain = 256;

/// Contacts whose changes are added up together: fixed, so that sums do not depend on the number of threads.
constexpr std::size_t sum_block = 256;

template <class Work>
void forEach(std::size_t count, const Executor& executor, const Work& work) {
    executor.forBlocks(
        count,
        [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) work(i);
        },
        grain);
}

/// Part of the change by contacts that resist rolling.
void addRolling(const SweepDirection::Swept& swept, SweepChange& change) {
    for (const ContactFrame& frame : swept.batch.contacts) {
        if (frame.rolling == ContactFrame::rolls_freely) continue;
        const Mat6& k = swept.batch.rolling[frame.rolling].k;
        const Vec3 difference = swept.rolling[frame.rolling].impulse - swept.rolling[frame.rolling].before;
        change.squared += k(3, 3) * difference.squaredNorm();
        change.largest_speed = std::max(change.largest_speed, (k.topRightCorner<3, 3>() * difference).norm());
    }
}

}  // namespace

void SweepDirection::note(const Swept& swept) {
    impulses_before_.resize(swept.contacts.size());
    bodies_before_.resize(swept.batch.dynamic_bodies);
    for (SweptRolling& s : swept.rolling) s.before = s.impulse;
    forEach(impulses_before_.size(), swept.executor,
            [&](std::size_t i) { impulses_before_[i] = swept.contacts[i].impulse; });
    forEach(bodies_before_.size(), swept.executor, [&](std::size_t i) {
        bodies_before_[i] = {swept.batch.bodies[i].v, swept.batch.bodies[i].w};
    });
}

SweepChange SweepDirection::change(const Swept& swept) {
    sums_.resize((swept.contacts.size() + sum_block - 1) / sum_block);
    swept.executor.forBlocks(
        sums_.size(),
        [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t block = begin; block < end; ++block) sums_[block] = changeOfBlock(block, swept.contacts);
        },
        1);
    SweepChange change;
    for (const SweepChange& part : sums_) {
        change.squared += part.squared;
        change.largest_speed = std::max(change.largest_speed, part.largest_speed);
    }
    if (!swept.rolling.empty()) addRolling(swept, change);
    return change;
}

SweepChange SweepDirection::changeOfBlock(std::size_t block, std::span<const SweptContact> contacts) const {
    SweepChange change;
    const std::size_t end = std::min(contacts.size(), (block + 1) * sum_block);
    for (std::size_t i = block * sum_block; i < end; ++i) {
        const SweptContact& s = contacts[i];
        if (!isResolvable(s)) continue;
        const Vec3 difference = s.impulse - impulses_before_[i];
        change.squared += difference.squaredNorm() / s.normal_mass;
        change.largest_speed = std::max(change.largest_speed, (s.k * difference).norm());
    }
    return change;
}

void SweepDirection::restart(const Swept& swept) {
    direction_.assign(swept.contacts.size(), Vec3::Zero());
    body_direction_.assign(swept.batch.dynamic_bodies, {Vec3::Zero(), Vec3::Zero()});
    for (SweptRolling& s : swept.rolling) s.direction.setZero();
}

void SweepDirection::accelerate(double beta, const Swept& swept) {
    forEach(direction_.size(), swept.executor, [&](std::size_t i) {
        const Vec3 change = swept.contacts[i].impulse - impulses_before_[i];
        const Vec3 step = beta * direction_[i];
        swept.contacts[i].impulse += step;
        direction_[i] = change + step;
    });
    for (SweptRolling& s : swept.rolling) {
        const Vec3 change = s.impulse - s.before;
        const Vec3 step = beta * s.direction;
        s.impulse += step;
        s.direction = change + step;
    }
    forEach(bodies_before_.size(), swept.executor, [&](std::size_t i) {
        LocalBody& body = swept.batch.bodies[i];
        const Twist change{body.v - bodies_before_[i].v, body.w - bodies_before_[i].w};
        const Twist step{beta * body_direction_[i].v, beta * body_direction_[i].w};
        body.v += step.v;
        body.w += step.w;
        body_direction_[i] = {change.v + step.v, change.w + step.w};
    });
}

}  // namespace cairn
