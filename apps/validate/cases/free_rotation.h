/// @file What the cases of free rotation share.
#pragma once

#include <algorithm>

#include "validate/world_tools.h"

namespace cairn::validation {

/// How well a free rotation keeps what must stay.
struct Conservation {
    double momentum = 0;  ///< largest relative change of the angular momentum, with its direction
    double energy = 0;    ///< largest relative change of the energy
};

/// A rotating body in weightlessness, watched while it turns.
class FreeRotation {
  public:
    /// @param w [rad/s, W]
    FreeRotation(double rate, const Shape& shape, double mass, const Vec3& w)
        : world_(makeWorld(accurateSettings(rate), Vec3::Zero(), {})) {
        BodyDescription description = body(shape, mass, Vec3::Zero());
        description.angular_velocity = w;
        id_ = world_.addBody(description);
        momentum_ = world_.angularMomentum();
        energy_ = world_.kineticEnergy();
    }

    void step() {
        world_.step();
        const double dl = (world_.angularMomentum() - momentum_).norm() / momentum_.norm();
        const double de = std::abs(world_.kineticEnergy() - energy_) / energy_;
        worst_.momentum = std::max(worst_.momentum, dl);
        worst_.energy = std::max(worst_.energy, de);
    }

    double time() const { return world_.time(); }
    Quat orientation() const { return world_.pose(id_).orientation; }
    Vec3 inertia() const { return world_.principalInertia(id_); }
    /// [rad/s, B]
    Vec3 bodyRate() const { return orientation().conjugate() * world_.angularVelocity(id_); }
    const Conservation& worst() const { return worst_; }

  private:
    World world_;
    BodyId id_;
    Vec3 momentum_ = Vec3::Zero();
    double energy_ = 0;
    Conservation worst_;
};

}  // namespace cairn::validation
