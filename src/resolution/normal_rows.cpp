#include "resolution/normal_rows.h"

#include <limits>

namespace cairn {

void NormalRows::count(const LocalBatch& batch) {
    lists_.count.assign(batch.bodies.size(), 0);
    for (const ContactFrame& c : batch.contacts) {
        if (!batch.isFixed(c.a)) ++lists_.count[c.a];
        if (!batch.isFixed(c.b)) ++lists_.count[c.b];
    }
    lists_.begin.resize(batch.bodies.size());
    std::uint32_t end = 0;
    for (std::size_t i = 0; i < lists_.count.size(); ++i) {
        lists_.begin[i] = end;
        end += (lists_.count[i] + 1) / 2 * 2;
        lists_.count[i] = 0;  // counted again by place()
    }
    const auto filler = static_cast<std::uint32_t>(batch.contacts.size());
    lists_.contact.assign(end, filler);
    const NormalRowPair::Lanes zero = NormalRowPair::Lanes::Zero();
    pair_.assign(end / 2, {zero, zero, zero, zero, zero, zero});
}

void NormalRows::place(std::uint32_t body, std::uint32_t contact, const Vec3& direction, const Vec3& r) {
    const std::uint32_t at = lists_.begin[body] + lists_.count[body]++;
    lists_.contact[at] = contact;
    NormalRowPair& pair = pair_[at / 2];
    const Eigen::Index lane = at % 2;
    const Vec3 angular = r.cross(direction);
    pair.linear_x[lane] = direction.x();
    pair.linear_y[lane] = direction.y();
    pair.linear_z[lane] = direction.z();
    pair.angular_x[lane] = angular.x();
    pair.angular_y[lane] = angular.y();
    pair.angular_z[lane] = angular.z();
}

void NormalRows::build(const LocalBatch& batch) {
    count(batch);
    for (std::uint32_t i = 0; i < batch.contacts.size(); ++i) {
        const ContactFrame& c = batch.contacts[i];
        if (!batch.isFixed(c.a)) place(c.a, i, c.basis.col(0), c.r_a);
        if (!batch.isFixed(c.b)) place(c.b, i, -c.basis.col(0), c.r_b);
    }
}

void NormalRows::update(std::uint32_t body, const VelocityChange& change, std::span<double> delta) const {
    using Lanes = NormalRowPair::Lanes;
    const Lanes vx = Lanes::Constant(change.v.x()), wx = Lanes::Constant(change.w.x());
    const Lanes vy = Lanes::Constant(change.v.y()), wy = Lanes::Constant(change.w.y());
    const Lanes vz = Lanes::Constant(change.v.z()), wz = Lanes::Constant(change.w.z());
    // In this order a NaN fails the comparison, and it turns into one instruction.
    const auto finiteOrInfinity = [](double x) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return x < infinity ? x : infinity;
    };
    const std::uint32_t* contact = lists_.contact.data() + lists_.begin[body];
    const NormalRowPair* pair = pair_.data() + lists_.begin[body] / 2;
    for (const std::uint32_t* end = contact + lists_.count[body]; contact < end; contact += 2, ++pair) {
        double& first = delta[contact[0]];
        double& second = delta[contact[1]];
        const Lanes sum = Lanes(first, second) + ((pair->linear_x * vx + pair->linear_y * vy + pair->linear_z * vz) +
                                                  (pair->angular_x * wx + pair->angular_y * wy + pair->angular_z * wz));
        first = finiteOrInfinity(sum[0]);
        second = finiteOrInfinity(sum[1]);
    }
}

}  // namespace cairn
