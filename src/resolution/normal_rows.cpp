#include "resolution/normal_rows.h"

#include <limits>

namespace cairn {

void NormalRows::count(const LocalBatch& batch) {
    count_.assign(batch.bodies.size(), 0);
    for (const ContactFrame& c : batch.contacts) {
        if (!batch.isFixed(c.a)) ++count_[c.a];
        if (!batch.isFixed(c.b)) ++count_[c.b];
    }
    begin_.resize(batch.bodies.size());
    std::uint32_t end = 0;
    for (std::size_t i = 0; i < count_.size(); ++i) {
        begin_[i] = end;
        end += (count_[i] + 1) / 2 * 2;
        count_[i] = 0;  // counted again by place()
    }
    const auto filler = static_cast<std::uint32_t>(batch.contacts.size());
    contact_.assign(end, filler);
    const NormalRowPair::Lanes zero = NormalRowPair::Lanes::Zero();
    pair_.assign(end / 2, {zero, zero, zero, zero, zero, zero});
}

void NormalRows::place(std::uint32_t body, std::uint32_t contact, const Vec3& direction, const Vec3& r) {
    const std::uint32_t at = begin_[body] + count_[body]++;
    contact_[at] = contact;
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

void NormalRows::update(std::uint32_t body, const VelocityChange& change, std::vector<double>& delta) const {
    using Lanes = NormalRowPair::Lanes;
    const std::uint32_t begin = begin_[body];
    const std::uint32_t end = begin + count_[body];
    for (std::uint32_t i = begin; i < end; i += 2) {
        double& first = delta[contact_[i]];
        double& second = delta[contact_[i + 1]];
        const Lanes sum = Lanes(first, second) + pair_[i / 2].changeOf(change);
        // In this order a NaN fails the comparison, and both turn into one instruction.
        constexpr double infinity = std::numeric_limits<double>::infinity();
        first = sum[0] < infinity ? sum[0] : infinity;
        second = sum[1] < infinity ? sum[1] : infinity;
    }
}

}  // namespace cairn
