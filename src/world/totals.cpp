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

ExactSum kineticEnergyOf(const BodyStorage& b) {
    ExactSum energy;
    forDynamic(b, [&](BodyIndex i) { energy.add(0.5 * (b.mass[i] * b.v[i].squaredNorm() + b.w[i].dot(spin(b, i)))); });
    return energy;
}

ExactSum potentialEnergyOf(const BodyStorage& b, const Vec3& acceleration) {
    ExactSum energy;
    forDynamic(b, [&](BodyIndex i) { energy.add(-b.gravity_factor[i] * b.mass[i] * acceleration.dot(b.position[i])); });
    return energy;
}

ExactVectorSum linearMomentumOf(const BodyStorage& b) {
    ExactVectorSum momentum;
    forDynamic(b, [&](BodyIndex i) { momentum.add(Vec3(b.mass[i] * b.v[i])); });
    return momentum;
}

ExactVectorSum angularMomentumOf(const BodyStorage& b) {
    ExactVectorSum momentum;
    forDynamic(b, [&](BodyIndex i) { momentum.add(Vec3(spin(b, i) + b.position[i].cross(b.mass[i] * b.v[i]))); });
    return momentum;
}

}  // namespace cairn
