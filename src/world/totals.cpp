#include "world/totals.h"

namespace cairn {

namespace {

template <class Work>
void forDynamic(const BodyStorage& bodies, const Work& work) {
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] == BodyKind::dynamic) work(i);
    }
}

/// Angular momentum about the centre of mass [N·m·s, W].
Vec3 spin(const BodyStorage& b, BodyIndex i) {
    return b.orientation[i] * b.inertia_B[i].cwiseProduct(b.orientation[i].conjugate() * b.w[i]);
}

}  // namespace

double kineticEnergyOf(const BodyStorage& b) {
    double energy = 0;
    forDynamic(b, [&](BodyIndex i) { energy += 0.5 * (b.mass[i] * b.v[i].squaredNorm() + b.w[i].dot(spin(b, i))); });
    return energy;
}

double potentialEnergyOf(const BodyStorage& b, const Vec3& acceleration) {
    double energy = 0;
    forDynamic(b, [&](BodyIndex i) { energy -= b.gravity_factor[i] * b.mass[i] * acceleration.dot(b.position[i]); });
    return energy;
}

Vec3 linearMomentumOf(const BodyStorage& b) {
    Vec3 momentum = Vec3::Zero();
    forDynamic(b, [&](BodyIndex i) { momentum += b.mass[i] * b.v[i]; });
    return momentum;
}

Vec3 angularMomentumOf(const BodyStorage& b) {
    Vec3 momentum = Vec3::Zero();
    forDynamic(b, [&](BodyIndex i) { momentum += spin(b, i) + b.position[i].cross(b.mass[i] * b.v[i]); });
    return momentum;
}

}  // namespace cairn
