/// The part of World that adds, removes and reads bodies.
#include <fmt/core.h>

#include <cmath>

#include "activity/sleeping.h"
#include "cairn/world.h"
#include "geometry/body_mass.h"
#include "sharing/body_records.h"
#include "world/couplings.h"
#include "world/division.h"
#include "world/limits.h"
#include "world/locks.h"
#include "world/motions.h"
#include "world/requirements.h"
#include "world/step_rate.h"
#include "world/stillness.h"
#include "world/world_state.h"

namespace cairn {

namespace {

/// Wakes what touches a body that is about to be removed.
void wakeTouching(WorldState& w, BodyId id) {
    const BodyIndex i = id.index;
    const BodyState bodies = w.bodies.state();
    const auto wakeOther = [&](const Contact& contact) {
        // Slots that were removed and filled again since the last step do not know these contacts.
        const BodyIndex other = contact.a == i ? contact.b : contact.a;
        if (contact.a != i && contact.b != i) return;
        if (w.data.generation[i] != id.generation || w.data.generation[other] != w.bodies.generation[other]) return;
        if (!bodies.isFixed(other)) bodies.wake(other, WakeReason::neighbour_removed);
    };
    // Contacts are listed of bodies that can move; of others there are few, or many that touch them.
    if (bodies.isFixed(i)) {
        for (const Contact& contact : w.data.contacts) wakeOther(contact);
        return;
    }
    ContactsOfBodies& contacts_of = w.data.contacts_of;
    if (contacts_of.begin.empty()) listContacts(w.bodies.kind, w.data.contacts, contacts_of);
    if (i + 1 >= contacts_of.begin.size()) return;  // came after the last step
    for (const std::uint32_t contact : contacts_of[i]) wakeOther(w.data.contacts[contact]);
}

/// Removes a spring or joint, if it is still that of a body, and wakes its other end.
template <class Tie>
void removeTie(Tie& tie, BodyIndex i, const BodyState& bodies) {
    if (!tie.present || (tie.a != i && tie.b != i)) return;
    const BodyIndex other = tie.a == i ? tie.b : tie.a;
    // The world as an end is beyond all slots.
    if (other < bodies.size() && !bodies.isFixed(other)) bodies.wake(other, WakeReason::changed);
    tie.present = false;
    ++tie.generation;
}

/// @throws InputError if the response could not reckon with it
void requireUsableMass(double mass) {
    if (isUsableMass(mass)) return;
    throw InputError(
        fmt::format("mass is {} kg; it must be within {} and {} kg: change the size, the density or the mass", mass,
                    smallest_mass, largest_mass));
}

void validateDescription(const BodyDescription& d, const MaterialTable& materials) {
    validateShape(d.shape);
    if (!materials.contains(d.material)) {
        throw InputError(fmt::format("material {} is unknown; add it with World::addMaterial first",
                                     static_cast<std::uint32_t>(d.material)));
    }
    if (d.mass && !(*d.mass > 0 && std::isfinite(*d.mass))) {
        throw InputError(fmt::format("mass is {} kg; it must be finite and above 0", *d.mass));
    }
    requireWithin(d.pose.position, distance_limit, "position", "m");
    requireWithin(d.linear_velocity, speed_limit, "linear_velocity", "m/s");
    requireWithin(d.angular_velocity, speed_limit, "angular_velocity", "rad/s");
    if (!isSolid(d.shape) && !d.fixed) {
        const bool surface = surfaceOf(d.shape) != nullptr;
        throw InputError(fmt::format("a {} has no mass and must be fixed{}", shapeName(d.shape),
                                     surface ? "; give it a motion, or build what moves of convex shapes" : ""));
    }
    requireGravityFactor(d.gravity_factor);
    requireDamping(d.linear_damping, "linear");
    requireDamping(d.angular_damping, "angular");
    requireWithin(d.pivot, distance_limit, "pivot", "m");
    requireWithin(d.surface_velocity, speed_limit, "surface_velocity", "m/s");
    if (!d.fixed && !d.surface_velocity.isZero(0)) {
        throw InputError("only the surface of a fixed body runs; make it fixed or leave surface_velocity zero");
    }
    if (d.motion && !d.fixed) throw InputError("a body with a motion is not moved by forces; make it fixed");
    const bool moves = !d.linear_velocity.isZero(0) || !d.angular_velocity.isZero(0);
    if (d.fixed && moves) throw InputError("a fixed body has no velocity; leave its velocities zero");
    if (d.asleep && moves) throw InputError("a sleeping body has no velocity; leave its velocities zero");
}

/// Mass, inertia and where the shape's frame is, from density or as given. @throws InputError
void setMass(BodyStorage& bodies, BodyIndex i, const BodyDescription& d, double density) {
    if (!isSolid(d.shape)) {
        if (d.centre_of_mass || d.inertia) {
            throw InputError(
                fmt::format("a {} has no centre of mass and no inertia; leave them out", shapeName(d.shape)));
        }
        bodies.r_max[i] = largestRadius(d.shape);
        bodies.r_min[i] = smallestRadius(d.shape);
        return;
    }
    const BodyMass found = bodyMass(d.shape, density, {d.mass, d.centre_of_mass, d.inertia});
    const double mass = found.mass;
    const Vec3& inertia = found.inertia;
    // Of what is long and thin enough rounding leaves a negative moment.
    const double least = inertia.minCoeff();
    if (!(std::isnormal(mass) && std::isnormal(least) && least > 0 && std::isfinite(inertia.maxCoeff()))) {
        throw InputError(
            fmt::format("mass {} kg with inertia ({}, {}, {}) kg·m² cannot be represented; change the "
                        "size, the density or the mass",
                        mass, inertia.x(), inertia.y(), inertia.z()));
    }
    bodies.mass[i] = mass;
    bodies.inertia_B[i] = inertia;
    const Pose shape = found.body_in_shape.inverse();
    bodies.p_BS[i] = shape.position;
    bodies.R_BS[i] = shape.orientation;
    const Vec3 moved = found.body_in_shape.position - unitMassProperties(bodies.shape[i]).centre;
    bodies.r_max[i] = largestRadius(bodies.shape[i]) + moved.norm();
    bodies.r_min[i] = smallestRadius(bodies.shape[i]);
}

/// @throws InputError for what a rank that does not get the body would have to know
void requireDealable(const BodyDescription& d) {
    if (d.fixed) return;
    if (!isSent(d.shape)) {
        throw InputError(
            fmt::format("a {} that moves cannot be dealt out to ranks, only balls, boxes, capsules and "
                        "cylinders can: add the bodies before World::share(), without places",
                        shapeName(d.shape)));
    }
    if (!d.locked.empty()) {
        throw InputError(
            "a body that is locked cannot be dealt out to ranks: add the bodies before World::share(), "
            "without places");
    }
}

/// The shape as the world keeps it: parts of compounds with unit quaternions, and a tree over them.
Shape normalised(const Shape& shape) {
    Shape result = shape;
    if (auto* compound = std::get_if<Compound>(&result)) {
        for (CompoundPart& part : compound->parts) part.pose.orientation.normalize();
    }
    indexParts(result);
    return result;
}

}  // namespace

BodyId World::addBody(const BodyDescription& d) {
    WorldState& w = *state_;
    if (isDealing(w)) {
        requireDealable(d);
    } else {
        beginChange(w, "World::addBody");
    }
    validateDescription(d, w.materials);
    const Quat orientation = requireRotation(d.pose.orientation);
    BodyStorage& b = w.bodies;
    const std::uint64_t groups = b.filter.maskOf(d.groups);
    const std::uint8_t locked = lockMaskOf(d.locked);
    if (locked != 0 && d.fixed) throw InputError("a fixed body moves along no axis; leave locked out");
    auto curve = d.motion ? std::make_shared<const MotionCurve>(*d.motion) : nullptr;
    requireRoom(b.wholeSlots() - b.slots() + b.count());
    w.lasting.reset();
    ++w.places_version;
    const BodyIndex i = b.allocate(d.fixed ? BodyKind::fixed : BodyKind::dynamic);
    b.shape[i] = normalised(d.shape);
    try {
        setMass(b, i, d, w.materials.all()[static_cast<std::size_t>(d.material)].density);
        if (isSolid(d.shape)) requireUsableMass(b.mass[i]);
    } catch (...) {
        b.release(i);
        throw;
    }
    b.material[i] = static_cast<std::uint32_t>(d.material);
    b.name[i] = d.name;
    b.setShapePose(i, {d.pose.position, orientation});
    w.launched = true;
    b.v[i] = d.linear_velocity;
    b.w[i] = d.angular_velocity;
    b.asleep[i] = d.asleep && !d.fixed ? 1 : 0;
    const double threshold = w.settings.sleep.sleep_threshold;
    b.motion[i] = b.asleep[i] != 0 ? threshold * threshold : initialMotion(w.settings.sleep);
    b.groups[i] = groups;
    b.sensor[i] = d.sensor ? 1 : 0;
    b.gravity_factor[i] = d.gravity_factor;
    b.linear_damping[i] = d.linear_damping;
    b.angular_damping[i] = d.angular_damping;
    b.user_data[i] = d.user_data;
    b.surface_velocity[i] = d.surface_velocity;
    b.updateMassProperties(i);
    if (locked != 0) {
        setLocks(w, i, locked);
        b.asleep[i] = d.asleep ? 1 : 0;
    }
    if (curve != nullptr) addLaw(w, {i, w.time, b.shapePose(i), d.pivot, std::move(curve)});
    const BodyId id = b.idOf(i);
    if (isDealing(w)) {
        if (!d.fixed) w.dealt_extents.push_back(middleExtent(b.shape[i]));
        w.shared->dealOut(b, i, d.pose.position);
    }
    return id;
}

void World::removeBody(BodyId id) {
    beginChange(*state_, "World::removeBody");
    WorldState& w = *state_;
    const BodyIndex i = w.bodies.indexOf(id);
    w.lasting.reset();
    ++w.places_version;
    wakeTouching(w, id);
    w.ties.list(w.springs, w.joints, w.bodies.slots());
    for (const std::uint32_t slot : w.ties.springsOf(i)) removeTie(w.springs[slot], i, w.bodies.state());
    for (const std::uint32_t slot : w.ties.jointsOf(i)) removeTie(w.joints[slot], i, w.bodies.state());
    if (!w.ties.jointsOf(i).empty()) removeLooseCouplings(w);
    removeLaw(w, i);
    w.bodies.release(i);
}

bool World::contains(BodyId id) const noexcept {
    return state_->bodies.contains(id);
}

std::vector<BodyId> World::bodies() const {
    std::vector<BodyId> ids;
    ids.reserve(state_->bodies.count());
    for (BodyIndex i = 0; i < state_->bodies.slots(); ++i) {
        if (state_->bodies.kind[i] != BodyKind::hole) ids.push_back(state_->bodies.idOf(i));
    }
    return ids;
}

std::size_t World::bodyCount() const noexcept {
    return state_->bodies.count();
}

const Shape& World::shape(BodyId id) const {
    return state_->bodies.shape[state_->bodies.indexOf(id)];
}

const std::string& World::name(BodyId id) const {
    return state_->bodies.name[state_->bodies.indexOf(id)];
}

MaterialId World::material(BodyId id) const {
    return static_cast<MaterialId>(state_->bodies.material[state_->bodies.indexOf(id)]);
}

Pose World::pose(BodyId id) const {
    const BodyIndex i = state_->bodies.indexOf(id);
    return state_->bodies.shapePose(i);
}

Vec3 World::centreOfMass(BodyId id) const {
    return state_->bodies.position[state_->bodies.indexOf(id)];
}

Quat World::principalAxes(BodyId id) const {
    return state_->bodies.orientation[state_->bodies.indexOf(id)];
}

Vec3 World::linearVelocity(BodyId id) const {
    return state_->bodies.v[state_->bodies.indexOf(id)];
}

Vec3 World::angularVelocity(BodyId id) const {
    return state_->bodies.w[state_->bodies.indexOf(id)];
}

double World::mass(BodyId id) const {
    const BodyIndex i = state_->bodies.indexOf(id);
    return state_->bodies.kind[i] == BodyKind::dynamic ? state_->bodies.mass[i]
                                                       : std::numeric_limits<double>::infinity();
}

Vec3 World::principalInertia(BodyId id) const {
    const BodyIndex i = state_->bodies.indexOf(id);
    if (state_->bodies.kind[i] == BodyKind::dynamic) return state_->bodies.inertia_B[i];
    return Vec3::Constant(std::numeric_limits<double>::infinity());
}

std::uint64_t World::layoutVersion() const noexcept {
    return state_->bodies.layoutVersion();
}

BodyViews World::bodyViews() const {
    requireWhole(*state_, "World::bodyViews");
    const BodyStorage& b = state_->bodies;
    const auto view = [&](const auto& field) { return BodyView(field.share(), field.size()); };
    return {.kind = view(b.kind),
            .generation = view(b.generation),
            .centre_of_mass = view(b.position),
            .principal_axes = view(b.orientation),
            .linear_velocity = view(b.v),
            .angular_velocity = view(b.w),
            .mass = view(b.mass),
            .asleep = view(b.asleep)};
}

void World::posesTo(std::vector<Pose>& poses) const {
    requireWhole(*state_, "World::posesTo");
    const BodyStorage& b = state_->bodies;
    poses.resize(b.slots());
    for (BodyIndex i = 0; i < b.slots(); ++i) poses[i] = b.shapePose(i);
}

bool World::isFixed(BodyId id) const {
    return state_->bodies.kind[state_->bodies.indexOf(id)] == BodyKind::fixed;
}

bool World::isAsleep(BodyId id) const {
    return state_->bodies.asleep[state_->bodies.indexOf(id)] != 0;
}

}  // namespace cairn
