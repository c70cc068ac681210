#include "resolution/rolling.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace cairn {

namespace {

/// At most so many rounds of projection, until nothing changes any more.
constexpr int most_projections = 400;

/// Parts of a wrench: the sizes that bounds are about.
constexpr Eigen::Index normal_row = 0, slide_rows = 1, spin_row = 3, roll_rows = 4;

double length2(const Vec6& x, Eigen::Index row) {
    return std::sqrt(x[row] * x[row] + x[row + 1] * x[row + 1]);
}

double largestEigenvalue(const Mat6& k, Eigen::Index row) {
    const double mean = (k(row, row) + k(row + 1, row + 1)) / 2;
    const double half = (k(row, row) - k(row + 1, row + 1)) / 2;
    return mean + std::sqrt(half * half + k(row, row + 1) * k(row, row + 1));
}

/// Of a body of decimetres 1. A factor that rounds nothing and follows the size: equations in two units are then solved
/// alike whatever the size is.
double leverOf(const Mat6& k) {
    int linear = 0;
    int angular = 0;
    std::frexp(k.diagonal().head<3>().maxCoeff(), &linear);
    std::frexp(k.diagonal().tail<3>().maxCoeff(), &angular);
    constexpr int of_decimetres = 6;
    return std::ldexp(1.0, (linear - angular + of_decimetres) >> 1);
}

/// K·x = excess, the rows of turns first.
template <class Excess>
auto solved(const Mat6& k, double lever, const Excess& excess) {
    constexpr double first = 1024;
    Vec6 unit = Vec6::Ones();
    unit.tail<3>().setConstant(first * lever);
    const Mat6 even = unit.asDiagonal() * k * unit.asDiagonal();
    return (unit.asDiagonal() * even.ldlt().solve(unit.asDiagonal() * excess)).eval();
}

/// The largest part, turns as ways.
double largestOf(const Vec6& x, double lever) {
    return std::max(x.head<3>().cwiseAbs().maxCoeff(), x.tail<3>().cwiseAbs().maxCoeff() / lever);
}

bool isWithin(const RollingContact& contact, double friction, const Vec6& x) {
    return x[normal_row] > 0 && length2(x, slide_rows) <= friction * x[normal_row] &&
           std::abs(x[spin_row]) <= contact.spinning * x[normal_row] &&
           length2(x, roll_rows) <= contact.rolling * x[normal_row];
}

/// The parts in turns, each put back within its bound, which follows the normal part.
class Turns {
  public:
    Turns(const RollingContact& contact, double friction, const Vec6& excess, const Vec6& present)
        : contact_(contact), friction_(friction), x(present), c_(excess) {}

    void turn() {
        set(normal_row, std::max(0.0, x[normal_row] - c_[normal_row] / contact_.k(normal_row, normal_row)));
        move2(slide_rows, contact_.slide_mass, friction_ * x[normal_row]);
        const double spin = contact_.spinning * x[normal_row];
        set(spin_row, std::clamp(x[spin_row] - c_[spin_row] / contact_.k(spin_row, spin_row), -spin, spin));
        move2(roll_rows, contact_.roll_mass, contact_.rolling * x[normal_row]);
    }

  private:
    void set(Eigen::Index row, double value) {
        c_ += contact_.k.col(row) * (value - x[row]);
        x[row] = value;
    }
    void move2(Eigen::Index row, double step, double limit) {
        const double u = x[row] - step * c_[row];
        const double v = x[row + 1] - step * c_[row + 1];
        const double length = std::sqrt(u * u + v * v);
        const double scale = length > limit ? limit / length : 1;
        set(row, u * scale);
        set(row + 1, v * scale);
    }

    const RollingContact& contact_;
    double friction_;

  public:
    Vec6 x;

  private:
    Vec6 c_;
};

Vec6 inTurns(const RollingContact& contact, double friction, const Vec6& excess, const Vec6& present) {
    Turns turns(contact, friction, excess, present);
    for (int i = 0; i < most_projections; ++i) {
        const Vec6 before = turns.x;
        turns.turn();
        if (largestOf(turns.x - before, contact.lever) <= 1e-15 * largestOf(turns.x, contact.lever)) break;
    }
    return turns.x;
}

}  // namespace

void RollingContact::setMatrix(const Mat6& matrix) {
    k = matrix;
    lever = leverOf(k);
    slide_mass = 1 / largestEigenvalue(k, slide_rows);
    roll_mass = 1 / largestEigenvalue(k, roll_rows);
}

Mat6 wrenchMatrix(const ContactFrame& frame, const LocalBody& a, const LocalBody& b) {
    Mat6 k = Mat6::Zero();
    const auto add = [&](const LocalBody& body, const Vec3& r) {
        // Impulse and angular impulse about the centre of mass per unit of each row; K = Jᵀ·M⁻¹·J.
        Eigen::Matrix<double, 3, 6> linear = Eigen::Matrix<double, 3, 6>::Zero();
        Eigen::Matrix<double, 3, 6> angular;
        linear.leftCols<3>() = frame.basis;
        for (Eigen::Index i = 0; i < 3; ++i) angular.col(i) = r.cross(frame.basis.col(i));
        angular.rightCols<3>() = frame.basis;
        k += body.mass_inv * linear.transpose() * linear + angular.transpose() * body.inertia_inv.toMatrix() * angular;
    };
    add(a, frame.r_a);
    add(b, frame.r_b);
    return k;
}

Vec6 solveRolling(const RollingContact& contact, double static_friction, double sliding_friction, const Vec6& excess,
                  const Vec6& present) {
    const Vec6 rigid = present - solved(contact.k, contact.lever, excess);
    if (rigid.allFinite() && isWithin(contact, static_friction, rigid)) return rigid;
    const Vec6 held = inTurns(contact, static_friction, excess, present);
    const double most = static_friction * held[normal_row];
    const bool slides = sliding_friction < static_friction && length2(held, slide_rows) >= most * (1 - 1e-9);
    return slides ? inTurns(contact, sliding_friction, excess, present) : held;
}

Vec3 rollingImpulse(const RollingContact& contact, double normal_impulse, const Vec3& angular_velocity) {
    const double roll = contact.rolling * normal_impulse;
    const double spin = contact.spinning * normal_impulse;
    const Mat3 k = contact.k.bottomRightCorner<3, 3>();
    const Vec3 stop = -k.ldlt().solve(angular_velocity);
    if (!stop.allFinite()) return Vec3::Zero();
    if (std::abs(stop[0]) <= spin && stop[1] * stop[1] + stop[2] * stop[2] <= roll * roll) return stop;
    Vec3 t = Vec3::Zero();
    const double step = contact.roll_mass;
    for (int i = 0; i < most_projections; ++i) {
        t[0] = std::clamp(t[0] - (angular_velocity + k * t)[0] / k(0, 0), -spin, spin);
        const Vec3 c = angular_velocity + k * t;
        const double u = t[1] - step * c[1];
        const double v = t[2] - step * c[2];
        const double length = std::sqrt(u * u + v * v);
        const double scale = length > roll ? roll / length : 1;
        t[1] = u * scale;
        t[2] = v * scale;
    }
    return t;
}

}  // namespace cairn
