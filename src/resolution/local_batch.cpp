#include "resolution/local_batch.h"

#include "resolution/impulse.h"

namespace cairn {

namespace {

LocalBody copyOf(BodyIndex slot, const BodyState& state) {
    LocalBody body;
    body.v = state.v[slot];
    body.w = state.w[slot];
    body.inertia_inv = Symmetric3::from(state.inertiaInv_W[slot]);
    body.mass_inv = state.mass_inv[slot];
    body.slot = slot;
    return body;
}

}  // namespace

/// A body that is not of the batch, a fixed one or one that sleeps on, stands for itself in each run of contacts with
/// it. If its surface moves, it is another one in each contact: its velocity there is along the surface.
std::uint32_t LocalBatch::localEnd(const Contact& contact, BodyIndex slot, const BodyState& state) {
    if (isMember(slot, state)) return state.place[slot];
    const bool slides = !state.surface.empty() && !state.surface[slot].isZero(0);
    if (slides || bodies.size() == dynamic_bodies || bodies.back().slot != slot) {
        bodies.push_back(copyOf(slot, state));
        if (slides) bodies.back().v += state.surfaceVelocity(slot, contact.normal);
    }
    return static_cast<std::uint32_t>(bodies.size() - 1);
}

void LocalBatch::gatherBodies(const BatchView& batch, std::span<const Contact> all_contacts, const BodyState& state) {
    bodies.clear();
    for (const BodyIndex slot : batch.bodies) bodies.push_back(copyOf(slot, state));
    state.writePlaces(batch.bodies);
    dynamic_bodies = bodies.size();
    joints.gather(batch.joints, bodies, state.place);
    ends.resize(batch.contacts.size());
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const Contact& contact = all_contacts[batch.contacts[i]];
        ends[i].a = localEnd(contact, contact.a, state);
        ends[i].b = localEnd(contact, contact.b, state);
    }
    // Bodies that sleep on may be left out of a batch.
    for (std::size_t i = dynamic_bodies; i < bodies.size(); ++i) {
        bodies[i].mass_inv = 0;
        bodies[i].inertia_inv = {};
    }
}

void LocalBatch::gather(const BatchView& batch, std::span<const Contact> all_contacts, const BodyState& state) {
    gatherUnprepared(batch, all_contacts, state);
    for (std::uint32_t i = 0; i < contacts.size(); ++i) build(i);
}

void LocalBatch::gatherUnprepared(const BatchView& batch, std::span<const Contact> all_contacts,
                                  const BodyState& state) {
    gatherBodies(batch, all_contacts, state);
    contacts.resize(batch.contacts.size());
    rolling.clear();
    source_contacts_ = batch.contacts;
    source_ = all_contacts;
    source_position_ = state.position;
    preparation_.assign(contacts.size(), Preparation::none);
}

void LocalBatch::build(std::uint32_t contact) {
    if (preparation_[contact] == Preparation::none) buildFrame(contact);
    updateCollisionMatrixOf(contacts[contact]);
    preparation_[contact] = Preparation::complete;
}

void LocalBatch::buildFrame(std::uint32_t i) {
    const Contact& contact = source_[source_contacts_[i]];
    const NormalArms arms = armsOf(i);
    ContactFrame& frame = contacts[i];
    frame.a = ends[i].a;
    frame.b = ends[i].b;
    frame.basis = contactBasis(arms.normal);
    frame.r_a = arms.r_a;
    frame.r_b = arms.r_b;
    frame.restitution = contact.restitution;
    frame.static_friction = contact.static_friction;
    frame.kinetic_friction = contact.kinetic_friction;
    frame.impulse.setZero();
    frame.rolling = ContactFrame::rolls_freely;
    if (!resistsRolling(contact)) return;
    frame.rolling = static_cast<std::uint32_t>(rolling.size());
    rolling.push_back({.rolling = contact.rolling_friction, .spinning = contact.spinning_friction});
}

void LocalBatch::pushWorld(const ContactFrame& c, const Vec3& impulse) {
    if (joints.holds(c)) {
        joints.push(c, impulse, bodies);
        return;
    }
    apply(velocityChange(bodies[c.a], c.r_a, impulse), bodies[c.a]);
    apply(velocityChange(bodies[c.b], c.r_b, -impulse), bodies[c.b]);
}

void LocalBatch::turn(const ContactFrame& c, const Vec3& impulse) {
    const Vec3 impulse_W = c.basis * impulse;
    rolling[c.rolling].impulse_W += impulse_W;
    if (joints.holds(c)) {
        joints.turn(c, impulse_W, bodies);
        return;
    }
    apply(angularChange(bodies[c.a], impulse_W), bodies[c.a]);
    apply(angularChange(bodies[c.b], -impulse_W), bodies[c.b]);
}

void LocalBatch::updateRolling(const ContactFrame& c) {
    rolling[c.rolling].setMatrix(joints.holds(c) ? joints.wrenchMatrix(c, bodies)
                                                 : wrenchMatrix(c, bodies[c.a], bodies[c.b]));
}

void LocalBatch::scatterBodies(const BodyState& state) const {
    for (std::size_t i = 0; i < dynamic_bodies; ++i) {
        const LocalBody& body = bodies[i];
        if (!state.shock_stage.empty()) state.shock_stage[body.slot] = body.shock_stage;
        if (body.struck == 0) continue;
        state.wake(body.slot, WakeReason::struck);
        state.v[body.slot] = body.v;
        state.w[body.slot] = body.w;
    }
}

void LocalBatch::scatter(const BatchView& batch, std::span<Contact> all_contacts, const BodyState& state) const {
    scatterBodies(state);
    joints.scatter();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (preparation_[i] == Preparation::none) continue;
        const ContactFrame& frame = contacts[i];
        Contact& contact = all_contacts[batch.contacts[i]];
        contact.impulse += frame.impulse;
        if (frame.rolling != ContactFrame::rolls_freely) contact.angular_impulse += rolling[frame.rolling].impulse_W;
    }
}

void LocalBatch::save(ResolvedSoFar& resolved) const {
    resolved.motion.clear();
    for (std::size_t i = 0; i < dynamic_bodies; ++i) resolved.motion.push_back({bodies[i].v, bodies[i].w});
    resolved.impulse.clear();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const bool prepared = preparation_[i] != Preparation::none;
        resolved.impulse.push_back(prepared ? contacts[i].impulse : Vec3::Zero());
    }
    resolved.angular_impulse.clear();
    for (const RollingContact& contact : rolling) resolved.angular_impulse.push_back(contact.impulse_W);
    joints.save(resolved.joint_impulse);
}

void LocalBatch::keepPartSince(const ResolvedSoFar& resolved, double part) {
    const auto keep = [part](const Vec3& before, Vec3& value) { value = before + part * (value - before); };
    for (std::size_t i = 0; i < dynamic_bodies; ++i) {
        keep(resolved.motion[i].v, bodies[i].v);
        keep(resolved.motion[i].w, bodies[i].w);
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (preparation_[i] != Preparation::none) keep(resolved.impulse[i], contacts[i].impulse);
    }
    for (std::size_t i = 0; i < rolling.size(); ++i) {
        // Those that were prepared later had received nothing.
        const bool saved = i < resolved.angular_impulse.size();
        keep(saved ? resolved.angular_impulse[i] : Vec3::Zero(), rolling[i].impulse_W);
    }
    joints.keepPartSince(resolved.joint_impulse, part);
}

}  // namespace cairn
