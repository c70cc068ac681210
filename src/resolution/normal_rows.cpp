#include "resolution/normal_rows.h"

#include <limits>

namespace cairn {

void NormalRows::begin(const LocalBatch& batch) {
    batch_ = &batch;
    count();
    for (std::uint32_t i = 0; i < batch.ends.size(); ++i) {
        for (const std::uint32_t body : {batch.ends[i].a, batch.ends[i].b}) {
            if (!batch.isFixed(body)) lists_.contact[lists_.begin[body] + lists_.count[body]++] = i;
        }
    }
    packed_.assign(batch.bodies.size(), 0);
}

/// Makes room for the lists, which are empty then.
void NormalRows::count() {
    lists_.count.assign(batch_->bodies.size(), 0);
    for (const ContactEnds& ends : batch_->ends) {
        ++lists_.count[ends.a];
        ++lists_.count[ends.b];
    }
    lists_.begin.resize(lists_.count.size());
    std::uint32_t end = 0;
    for (std::uint32_t i = 0; i < lists_.count.size(); ++i) {
        lists_.begin[i] = end;
        if (!batch_->isFixed(i)) end += (lists_.count[i] + 1) / 2 * 2;
        lists_.count[i] = 0;
    }
    lists_.contact.assign(end, static_cast<std::uint32_t>(batch_->ends.size()));
    pair_.resize(end / 2);
}

void NormalRows::pack(std::uint32_t body) {
    const std::span<const std::uint32_t> contacts = lists_[body];
    NormalRowPair* pairs = &pair_[lists_.begin[body] / 2];
    if (contacts.size() % 2 == 1) {
        const NormalRowPair::Lanes zero = NormalRowPair::Lanes::Zero();
        pairs[contacts.size() / 2] = {zero, zero, zero, zero, zero, zero};
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const NormalArms arms = batch_->armsOf(contacts[i]);
        const bool is_a = batch_->ends[contacts[i]].a == body;
        const Vec3 linear = is_a ? arms.normal : Vec3(-arms.normal);
        const Vec3 angular = (is_a ? arms.r_a : arms.r_b).cross(linear);
        NormalRowPair& pair = pairs[i / 2];
        const auto lane = static_cast<Eigen::Index>(i % 2);
        pair.linear_x[lane] = linear.x();
        pair.linear_y[lane] = linear.y();
        pair.linear_z[lane] = linear.z();
        pair.angular_x[lane] = angular.x();
        pair.angular_y[lane] = angular.y();
        pair.angular_z[lane] = angular.z();
    }
    packed_[body] = 1;
}

void NormalRows::update(std::uint32_t body, double v_x, double v_y, double v_z, double w_x, double w_y, double w_z,
                        double* delta) const {
    using Pair = NormalRowPair::Lanes;
    const Pair vx = Pair::Constant(v_x), wx = Pair::Constant(w_x);
    const Pair vy = Pair::Constant(v_y), wy = Pair::Constant(w_y);
    const Pair vz = Pair::Constant(v_z), wz = Pair::Constant(w_z);
    const Pair infinity = Pair::Constant(std::numeric_limits<double>::infinity());
    const std::uint32_t* contact = lists_.contact.data() + lists_.begin[body];
    const NormalRowPair* pair = pair_.data() + lists_.begin[body] / 2;
    for (const std::uint32_t* end = contact + lists_.count[body]; contact < end; contact += 2, ++pair) {
        double& first = delta[contact[0]];
        double& second = delta[contact[1]];
        const Pair sum = Pair(first, second) + ((pair->linear_x * vx + pair->linear_y * vy + pair->linear_z * vz) +
                                                (pair->angular_x * wx + pair->angular_y * wy + pair->angular_z * wz));
        // In this order, as with std::min, a NaN fails the comparison.
        const Pair finite = infinity.min(sum);
        first = finite[0];
        second = finite[1];
    }
}

}  // namespace cairn
