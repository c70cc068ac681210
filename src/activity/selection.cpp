#include "activity/selection.h"

#include <algorithm>
#include <utility>

namespace cairn {

namespace {

/// Stands for no index.
constexpr std::uint32_t none = UINT32_MAX;

/// Fewest batches worth a thread of their own.
constexpr std::size_t batch_grain = 64;

/// Whether what a body would move by is beyond its limit, as the motion that falling asleep is about. What is not a
/// number is, too.
bool isPush(const Vec3& v, const Vec3& w, double squared_reach, double limit) {
    return !(2 * (v.squaredNorm() + w.squaredNorm() * squared_reach) <= limit * limit);
}

/// Calls take(body) for those of some bodies that joints tie to certain others, until there is none left.
template <class IsOther, class IsSome, class Take>
void spreadOverJoints(const BatchView& batch, const IsOther& is_other, const IsSome& is_some, const Take& take) {
    for (bool changed = true; changed;) {
        changed = false;
        for (const JointBlock& joint : batch.joints) {
            if (joint.a == Joint::world || joint.b == Joint::world) continue;
            for (const auto& [end, other] : {std::pair(joint.a, joint.b), std::pair(joint.b, joint.a)}) {
                if (!is_other(end) || !is_some(other)) continue;
                take(other);
                changed = true;
            }
        }
    }
}

/// Whether no fixed body that moves is at the other end of a joint.
bool hasStillAnchors(const BatchView& batch, const BodyState& bodies) {
    if (!bodies.supports_move) return true;
    const auto holds = [&](BodyIndex i) { return i == Joint::world || !bodies.isFixed(i) || isAtRest(bodies, i); };
    return std::ranges::all_of(batch.joints, [&](const JointBlock& j) { return holds(j.a) && holds(j.b); });
}

}  // namespace

void Selection::begin(const SelectionInput& input) {
    input_.emplace(input);
    parts_.clear();
    held_.clear();
    choice_.assign(input.batches.size(), Choice::whole);
    anybody_sleeps_ = std::ranges::find(input.bodies.asleep, 1) != input.bodies.asleep.end();
    if (input.selecting == Selecting::everything || !anybody_sleeps_) {
        chosen_.assign(input.batches.begin(), input.batches.end());
        return;
    }
    part_.assign(input.bodies.size(), Part::free);
    held_.assign(input.bodies.size(), 0);
    index_of_.resize(input.bodies.size(), none);
    squared_reach_.resize(input.bodies.size());
    scratch_.resize(static_cast<std::size_t>(input.executor.threads()));
    input.executor.forBlocks(
        choice_.size(),
        [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t b = begin; b < end; ++b) {
                const BatchView& batch = input.batches[b];
                choice_[b] = choiceOf(batch);
                for (const BodyIndex i : batch.bodies) {
                    if (!sleeps(i)) continue;
                    if (choice_[b] != Choice::whole) {
                        hold(i);
                    } else if (!input.without_contacts.empty()) {
                        release(i);
                    }
                }
            }
        },
        batch_grain);
    addParts();
    forParts([&](PartOfBatch& part, Scratch&) { beginPart(part); });
    listChosen();
}

Selection::Choice Selection::choiceOf(const BatchView& batch) const {
    const auto sleeping =
        static_cast<std::size_t>(std::ranges::count_if(batch.bodies, [&](BodyIndex i) { return sleeps(i); }));
    const bool all = sleeping == batch.bodies.size();
    const bool some = input_->selecting == Selecting::awake_parts && sleeping > 0 && input_->wake_speed > 0;
    if (!all && !some) return Choice::whole;
    if (!hasStillSupports(batch, input_->contacts, bodies()) || !hasStillAnchors(batch, bodies())) return Choice::whole;
    return all ? Choice::none : Choice::part;
}

/// Holds a body still, without what gravity gave it.
void Selection::hold(BodyIndex i) {
    bodies().v[i].setZero();
    bodies().w[i].setZero();
    part_[i] = Part::held;
    held_[i] = 1;
}

/// Gives a sleeper what its contacts hold it against.
void Selection::release(BodyIndex i) {
    const std::span<const BodyMotion> known = input_->without_contacts;
    bodies().v[i] = known.empty() ? bodies().fallOf(i) : known[i].v;
    bodies().w[i] = known.empty() ? Vec3(Vec3::Zero()) : known[i].w;
}

/// Gives the batches that are resolved in part their places.
void Selection::addParts() {
    PartOfBatch next;
    for (std::uint32_t b = 0; b < choice_.size(); ++b) {
        if (choice_[b] != Choice::part) continue;
        const BatchView& batch = input_->batches[b];
        next.batch = b;
        parts_.push_back(next);
        next.body_begin += batch.bodies.size();
        next.contact_begin += batch.contacts.size();
        next.joint_begin += batch.joints.size();
    }
    part_bodies_.resize(next.body_begin);
    before_.resize(next.body_begin);
    part_contacts_.resize(next.contact_begin);
    part_joints_.resize(next.joint_begin);
    joint_of_part_.resize(next.joint_begin);
}

/// Calls work(part, memory of the thread) for every batch that is resolved in part.
template <class Work>
void Selection::forParts(const Work& work) {
    input_->executor.forEachDynamic(
        parts_.size(), [&](std::size_t n, int thread) { work(parts_[n], scratch_[static_cast<std::size_t>(thread)]); });
}

void Selection::beginPart(PartOfBatch& part) {
    takeTiedAlong(part);
    takeAllAlongUnlessWorthwhile(part);
    select(part);
}

bool Selection::widen() {
    forParts([&](PartOfBatch& part, Scratch& scratch) {
        if (!part.again) return;
        const bool holds_some = part.bodies < batchOf(part).bodies.size();
        part.again = holds_some && findDisturbed(part, scratch);
        if (!part.again) return;
        revert(part);
        takeAroundAlong(part, scratch.taken);
        part.reach *= 4;
        takeTiedAlong(part);
        takeAllAlongUnlessWorthwhile(part);
        select(part);
    });
    std::ranges::fill(choice_, Choice::none);
    listChosen();
    return !chosen_.empty();
}

void Selection::finish() {
    if (input_->selecting == Selecting::everything) return;
    forParts([&](PartOfBatch& part, Scratch&) {
        const BatchView& batch = batchOf(part);
        for (std::size_t n = part.joint_begin; n < part.joint_begin + part.joints; ++n) {
            batch.joints[joint_of_part_[n]] = part_joints_[n];
        }
        if (part.took_along) wakePushed(part);
    });
    if (!anybody_sleeps_ && input_->selecting != Selecting::awake_parts) return;
    // What is in no batch was not resolved now, and held by others than these if at all.
    input_->executor.forBlocks(
        input_->batches.size(),
        [&](std::size_t begin, std::size_t end, int) {
            for (const BatchView& batch : input_->batches.subspan(begin, end - begin)) {
                for (const std::uint32_t c : batch.contacts) finishContact(input_->contacts[c]);
            }
        },
        batch_grain);
}

/// Gives back what a contact of two held bodies had, and notes what others end with.
void Selection::finishContact(Contact& contact) const {
    if (anybody_sleeps_ && !isFree(contact.a) && !isFree(contact.b)) contact.impulse += contact.last_impulse;
    if (input_->selecting != Selecting::awake_parts) return;
    if (anybody_sleeps_ && (isHeld(contact.a) || isHeld(contact.b))) return;
    contact.reference_impulse = contact.impulse;
}

/// Unless most of a batch is held, resolving a part saves less than it may waste.
void Selection::takeAllAlongUnlessWorthwhile(PartOfBatch& part) {
    const BatchView& batch = batchOf(part);
    const auto held = std::ranges::count_if(batch.bodies, [&](BodyIndex i) { return isHeld(i); });
    if (4 * static_cast<std::size_t>(held) > 3 * batch.bodies.size()) return;
    for (const BodyIndex i : batch.bodies) {
        if (isHeld(i)) takeAlong(part, i);
    }
}

/// Bodies that joints tie together are held together or not at all.
void Selection::takeTiedAlong(PartOfBatch& part) {
    spreadOverJoints(
        batchOf(part), [&](BodyIndex i) { return isFree(i); }, [&](BodyIndex i) { return isHeld(i); },
        [&](BodyIndex i) { takeAlong(part, i); });
}

void Selection::takeAlong(PartOfBatch& part, BodyIndex i) {
    if (!isHeld(i)) return;
    part_[i] = Part::along;
    held_[i] = 0;
    part.took_along = true;
    squared_reach_[i] = 0;
    release(i);
}

/// Takes the disturbed bodies along and all that so many contacts lead to from there.
void Selection::takeAroundAlong(PartOfBatch& part, std::vector<BodyIndex>& disturbed) {
    const std::span<const Contact> contacts = input_->contacts;
    for (const BodyIndex i : disturbed) takeAlong(part, i);
    for (int step = 0; step < part.reach; ++step) {
        disturbed.clear();
        for (const std::uint32_t c : batchOf(part).contacts) {
            const auto [a, b] = std::pair(contacts[c].a, contacts[c].b);
            if (isHeld(a) && part_[b] == Part::along) disturbed.push_back(a);
            if (isHeld(b) && part_[a] == Part::along) disturbed.push_back(b);
        }
        for (const BodyIndex i : disturbed) takeAlong(part, i);
    }
}

/// Finds the bodies that are not held with their contacts and joints, and notes their velocities.
void Selection::select(PartOfBatch& part) {
    const BatchView& batch = batchOf(part);
    const std::span<const Contact> contacts = input_->contacts;
    part.again = true;
    part.bodies = part.contacts = part.joints = 0;
    for (const BodyIndex i : batch.bodies) {
        if (isHeld(i)) continue;
        const std::size_t place = part.body_begin + part.bodies++;
        part_bodies_[place] = i;
        before_[place] = {bodies().v[i], bodies().w[i]};
    }
    for (const std::uint32_t c : batch.contacts) {
        if (!isFree(contacts[c].a) && !isFree(contacts[c].b)) continue;
        part_contacts_[part.contact_begin + part.contacts++] = c;
    }
    for (std::uint32_t j = 0; j < batch.joints.size(); ++j) {
        const JointBlock& joint = batch.joints[j];
        if (isHeld(joint.a) || (joint.b != Joint::world && isHeld(joint.b))) continue;
        const std::size_t place = part.joint_begin + part.joints++;
        part_joints_[place] = joint;
        joint_of_part_[place] = j;
    }
}

BatchView Selection::viewOf(const PartOfBatch& part) {
    return {std::span(part_bodies_).subspan(part.body_begin, part.bodies),
            std::span(part_contacts_).subspan(part.contact_begin, part.contacts),
            std::span(part_joints_).subspan(part.joint_begin, part.joints)};
}

void Selection::listChosen() {
    chosen_.clear();
    std::size_t n = 0;
    for (std::uint32_t b = 0; b < choice_.size(); ++b) {
        if (n < parts_.size() && parts_[n].batch == b) {
            if (parts_[n].again) chosen_.push_back(viewOf(parts_[n]));
            ++n;
        } else if (choice_[b] == Choice::whole) {
            chosen_.push_back(input_->batches[b]);
        }
    }
}

/// @param scratch out: taken are the disturbed bodies @return whether there are any
bool Selection::findDisturbed(const PartOfBatch& part, Scratch& scratch) {
    scratch.taken.clear();
    scratch.disturbances.clear();
    for (const std::uint32_t c : std::span(part_contacts_).subspan(part.contact_begin, part.contacts)) {
        const Contact& contact = input_->contacts[c];
        const Vec3 difference = contact.impulse - contact.reference_impulse;
        if (isHeld(contact.a))
            disturb(contact.a, difference, contact.pointOn(contact.a) - bodies().position[contact.a], scratch);
        if (isHeld(contact.b))
            disturb(contact.b, -difference, contact.pointOn(contact.b) - bodies().position[contact.b], scratch);
    }
    for (const Disturbance& d : scratch.disturbances) {
        const Vec3 v = bodies().mass_inv[d.body] * d.linear;
        const Vec3 w = bodies().inertiaInv_W[d.body] * d.angular;
        if (isPush(v, w, d.squared_reach, input_->wake_speed)) scratch.taken.push_back(d.body);
        index_of_[d.body] = none;
    }
    return !scratch.taken.empty();
}

void Selection::disturb(BodyIndex i, const Vec3& impulse, const Vec3& r, Scratch& scratch) {
    if (index_of_[i] == none) {
        index_of_[i] = static_cast<std::uint32_t>(scratch.disturbances.size());
        scratch.disturbances.push_back({.body = i});
    }
    Disturbance& d = scratch.disturbances[index_of_[i]];
    d.linear += impulse;
    d.angular += r.cross(impulse);
    d.squared_reach = std::max(d.squared_reach, r.squaredNorm());
}

/// Goes back to before the resolution of a part, whose contacts then begin with what it found: most of that stays. But
/// who was held was pressed like a wall, and gives way now: its contacts begin with what they gave as it slept.
void Selection::revert(const PartOfBatch& part) {
    for (std::size_t n = part.body_begin; n < part.body_begin + part.bodies; ++n) {
        bodies().v[part_bodies_[n]] = before_[n].v;
        bodies().w[part_bodies_[n]] = before_[n].w;
    }
    for (const std::uint32_t c : std::span(part_contacts_).subspan(part.contact_begin, part.contacts)) {
        Contact& contact = input_->contacts[c];
        const bool pressed = isHeld(contact.a) || isHeld(contact.b);
        contact.last_impulse = pressed ? contact.reference_impulse : contact.impulse;
        contact.impulse.setZero();
        contact.angular_impulse.setZero();
    }
}

/// Whether a body that is resolved along goes elsewhere. Whose last flight was denied goes nowhere with what gravity
/// gives it, as long as it is supported: else those who jam wake each other for ever.
bool Selection::isPushed(BodyIndex i) const {
    const auto moves = [&](const Vec3& v) { return isPush(v, bodies().w[i], squared_reach_[i], input_->wake_speed); };
    const Vec3& v = bodies().v[i];
    return moves(v) && (!bodies().isDenied(i) || moves(v - bodies().fallOf(i)));
}

/// Wakes who was resolved along and pushed, with those tied to it, and leaves the others as they were.
void Selection::wakePushed(const PartOfBatch& part) {
    const BatchView& batch = batchOf(part);
    for (const std::uint32_t c : std::span(part_contacts_).subspan(part.contact_begin, part.contacts)) {
        const Contact& contact = input_->contacts[c];
        for (const BodyIndex i : {contact.a, contact.b}) {
            if (part_[i] != Part::along) continue;
            squared_reach_[i] = std::max(squared_reach_[i], (contact.point - bodies().position[i]).squaredNorm());
        }
    }
    const auto wake = [&](BodyIndex i) {
        part_[i] = Part::free;
        bodies().wake(i, WakeReason::struck);
    };
    for (const BodyIndex i : batch.bodies) {
        if (part_[i] != Part::along) continue;
        // Who is resolved along slept until now; that it was struck by the resolution says nothing.
        bodies().asleep[i] = 1;
        bodies().woken[i] = WakeReason::none;
        if (isPushed(i)) wake(i);
    }
    spreadOverJoints(
        batch, [&](BodyIndex i) { return part_[i] == Part::free && !bodies().isFixed(i); },
        [&](BodyIndex i) { return part_[i] == Part::along; }, wake);
    for (const BodyIndex i : batch.bodies) {
        if (part_[i] != Part::along) continue;
        bodies().v[i].setZero();
        bodies().w[i].setZero();
    }
}

}  // namespace cairn
