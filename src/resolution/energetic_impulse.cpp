#include "resolution/energetic_impulse.h"

#include <algorithm>
#include <cmath>

namespace cairn {

namespace {

/// Steps in which the normal impulse grows to what would stop the closing without friction. Sliding in one direction,
/// and sticking, are exact with any number; it is for sliding whose direction turns.
constexpr double compression_steps = 64;
/// A contact that friction jams needs more; it ends with what it has.
constexpr int most_steps = 100 * static_cast<int>(compression_steps);
/// Rounds that find the step at whose end something happens.
constexpr int most_rounds = 8;
constexpr int direction_rounds = 12;

/// An impact while its normal impulse grows; contact coordinates.
class Impact {
  public:
    Impact(const ContactFrame& frame, const Vec3& velocity)
        : frame_(frame), k_(inverse(frame.k_inv)), before_(velocity), velocity_(velocity) {
        const double mean = (k_.yy + k_.zz) / 2;
        const double half = (k_.yy - k_.zz) / 2;
        largest_tangential_ = mean + std::sqrt(half * half + k_.yz * k_.yz);
        sticks_ = velocity[1] == 0 && velocity[2] == 0;
    }

    /// Until the contact no longer closes. @return work that it took [J]
    double compress() {
        const double step = -velocity_[0] / k_.xx / compression_steps;
        double work = 0;
        for (int i = 0; i < most_steps && velocity_[0] < 0; ++i) {
            const double begin = velocity_[0];
            double normal = step;
            Vec3 impulse = stepOf(normal);
            for (int round = 0; round < most_rounds; ++round) {
                const double end = begin + (k_ * impulse)[0];
                // Within rounding of its end the compression is over.
                if (end <= -1e-14 * std::abs(before_[0]) || end == begin) break;
                if (end <= 1e-14 * std::abs(before_[0])) break;
                normal *= begin / (begin - end);
                impulse = stepOf(normal);
            }
            take(impulse);
            if (std::abs(velocity_[0]) <= 1e-13 * std::abs(before_[0])) velocity_[0] = 0;
            work -= impulse[0] * 0.5 * (begin + velocity_[0]);
        }
        compression_ = impulse_;
        return work;
    }

    /// Until the normal impulse gave the work back. @param work [J]
    void restitute(double work) {
        const double step = compression_[0] / compression_steps;
        double left = work;
        for (int i = 0; i < most_steps && left > 1e-15 * work; ++i) {
            const double begin = velocity_[0];
            double normal = step;
            Vec3 impulse = stepOf(normal);
            double given = workOf(begin, impulse);
            if (given > left) {
                for (int round = 0; round < most_rounds && std::abs(given - left) > 1e-15 * work; ++round) {
                    // w = n·(begin + ½·slope·n), solved for n in the form that suffers no cancellation.
                    const double slope = (k_ * impulse)[0] / normal;
                    const double root = std::sqrt(std::max(0.0, begin * begin + 2 * slope * left));
                    normal = 2 * left / (begin + root);
                    impulse = stepOf(normal);
                    given = workOf(begin, impulse);
                }
                take(impulse);
                return;
            }
            take(impulse);
            left -= given;
        }
    }

    /// The impulse, drawn back towards that of the compression should the steps have left more energy than there was.
    Vec3 impulse() const {
        const double energy = energyChange(k_, before_, impulse_);
        if (!(energy > 0)) return impulse_;
        const Vec3 rest = impulse_ - compression_;
        // ΔE(s) of compression_ + s·rest is a parabola with ΔE(0) ≤ 0 < ΔE(1).
        const double c = std::min(0.0, energyChange(k_, before_, compression_));
        const double a = 0.5 * rest.dot(k_ * rest);
        const double b = energy - a - c;
        if (!(a > 0)) return compression_;
        const double s = (-b + std::sqrt(std::max(0.0, b * b - 4 * a * c))) / (2 * a);
        return compression_ + std::clamp(s, 0.0, 1.0) * rest;
    }

  private:
    double workOf(double begin, const Vec3& impulse) const { return impulse[0] * (begin + 0.5 * (k_ * impulse)[0]); }

    void take(const Vec3& impulse) {
        impulse_ += impulse;
        velocity_ = before_ + k_ * impulse_;
        const double tangential = impulse[1] * impulse[1] + impulse[2] * impulse[2];
        const double cone = frame_.kinetic_friction * impulse[0];
        sticks_ =
            tangential < cone * cone || (sticks_ && coneOf(impulse[0]) > 0 && tangential <= square(coneOf(impulse[0])));
    }

    static double square(double x) { return x * x; }
    double coneOf(double normal) const { return (sticks_ ? frame_.static_friction : frame_.kinetic_friction) * normal; }

    /// A step of the normal impulse with its friction: what opposes the sliding at its end most, within the cone.
    Vec3 stepOf(double normal) const {
        // Sliding at the end of the step without friction.
        const double y = velocity_[1] + k_.xy * normal;
        const double z = velocity_[2] + k_.xz * normal;
        const double determinant = k_.yy * k_.zz - k_.yz * k_.yz;
        const double stick_y = -(k_.zz * y - k_.yz * z) / determinant;
        const double stick_z = -(k_.yy * z - k_.yz * y) / determinant;
        const double cone = coneOf(normal);
        if (stick_y * stick_y + stick_z * stick_z <= cone * cone) return {normal, stick_y, stick_z};
        const double kinetic = frame_.kinetic_friction * normal;
        const double speed = std::sqrt(y * y + z * z);
        if (!(speed > 0) || kinetic == 0) return {normal, 0, 0};
        double jy = -kinetic * y / speed;
        double jz = -kinetic * z / speed;
        for (int round = 0; round < direction_rounds; ++round) {
            const double next_y = jy - (y + k_.yy * jy + k_.yz * jz) / largest_tangential_;
            const double next_z = jz - (z + k_.yz * jy + k_.zz * jz) / largest_tangential_;
            const double length = std::sqrt(next_y * next_y + next_z * next_z);
            const double scale = length > kinetic ? kinetic / length : 1;
            jy = next_y * scale;
            jz = next_z * scale;
        }
        return {normal, jy, jz};
    }

    const ContactFrame& frame_;
    Symmetric3 k_;
    Vec3 before_;                      ///< velocity [m/s]
    Vec3 velocity_;                    ///< now [m/s]
    Vec3 impulse_ = Vec3::Zero();      ///< so far [N·s]
    Vec3 compression_ = Vec3::Zero();  ///< at the end of the compression [N·s]
    double largest_tangential_ = 0;    ///< eigenvalue of K's tangential part [1/kg]
    bool sticks_ = false;              ///< friction is static
};

}  // namespace

Vec3 energeticImpulse(const ContactFrame& frame, const Vec3& velocity, double restitution) {
    // A contact of which only the normal part exists has neither friction nor coupling.
    if (!(frame.k_inv.yy > 0 && frame.k_inv.zz > 0)) return {-(1 + restitution) * velocity[0] / frame.k_row[0], 0, 0};
    Impact impact(frame, velocity);
    const double work = impact.compress();
    if (restitution > 0 && work > 0) impact.restitute(restitution * restitution * work);
    return impact.impulse();
}

}  // namespace cairn
