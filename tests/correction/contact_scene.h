/// @file Bodies and contacts made by hand: what a correction sees, without shapes and without contact detection.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "correction/correction.h"

namespace cairn::test {

inline const Vec3 right = Vec3::UnitX();
inline const Vec3 up = Vec3::UnitZ();

/// A small world of contacts. Bodies get the slots 0, 1, 2, … in the order in which they are added.
struct ContactScene : BodyStorage {
    std::vector<Contact> contacts;
    CorrectionSettings settings;
    double remaining_part = 0.5;  ///< that a correction leaves

    /// A threshold and a remaining part so small that contacts behave as in §2.3, before (2.5.4) refines it.
    ContactScene() { settings.penetration_threshold = 1e-9; }

    BodyIndex add(BodyKind new_kind, const Vec3& at) {
        const BodyIndex i = allocate(new_kind);
        position[i] = at;
        if (new_kind == BodyKind::dynamic) {
            mass_inv[i] = 1;
            inertiaInv_B[i].setOnes();
            inertiaInv_W[i].setIdentity();
        }
        return i;
    }
    BodyIndex addBody(const Vec3& at = Vec3::Zero()) { return add(BodyKind::dynamic, at); }
    BodyIndex addFixed(const Vec3& at = Vec3::Zero()) { return add(BodyKind::fixed, at); }

    /// Adds a contact halfway between two bodies; the one with the lower slot becomes A.
    /// @param to_x unit normal from y to x @return its index
    std::uint32_t touch(BodyIndex x, BodyIndex y, const Vec3& to_x, double distance) {
        Contact contact;
        contact.a = x < y ? x : y;
        contact.b = x < y ? y : x;
        contact.normal = x < y ? to_x : Vec3(-to_x);
        contact.point = 0.5 * (position[x] + position[y]);
        contact.distance = distance;
        contact.allowed_overlap = settings.penetration_threshold;
        contacts.push_back(contact);
        return static_cast<std::uint32_t>(contacts.size() - 1);
    }

    /// A body moved by this step in the last time step, with the velocity that belongs to it at 240 steps per second.
    void moveBy(BodyIndex body, const Vec3& step) {
        linear_step[body] = step;
        v[body] = 240 * step;
    }

    ContactsOfBodies contactsOfBodies() const {
        ContactsOfBodies table;
        table.begin.push_back(0);
        for (BodyIndex body = 0; body < kind.size(); ++body) {
            for (std::uint32_t i = 0; i < contacts.size() && kind[body] == BodyKind::dynamic; ++i) {
                if (contacts[i].a == body || contacts[i].b == body) table.contacts.push_back(i);
            }
            table.begin.push_back(static_cast<std::uint32_t>(table.contacts.size()));
        }
        return table;
    }

    std::vector<BodyIndex> movingBodies() const {
        std::vector<BodyIndex> bodies;
        for (BodyIndex body = 0; body < kind.size(); ++body) {
            if (kind[body] == BodyKind::dynamic) bodies.push_back(body);
        }
        return bodies;
    }

    /// All contacts as one batch.
    CorrectionCounts correctWith(Correction& correction) {
        const std::vector<BodyIndex> bodies = movingBodies();
        std::vector<std::uint32_t> indices(contacts.size());
        std::iota(indices.begin(), indices.end(), 0U);
        return correction.correct({bodies, indices}, contactsOfBodies(), contacts, state(), remaining_part);
    }

    CorrectionCounts correct() { return correctWith(*makeCorrection(CorrectionKind::propagated)); }

    double remaining() const { return -remaining_part * settings.penetration_threshold; }
};

inline bool near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
    return (a - b).cwiseAbs().maxCoeff() <= tolerance;
}

}  // namespace cairn::test
