#include "joints/joint_system.h"

#include <algorithm>
#include <cmath>

namespace cairn {

namespace {

/// A pivot below this part of its row's own diagonal is rounding.
constexpr double redundant = 1e-9;

}  // namespace

std::uint32_t JointSystem::memberOf(BodyIndex body) const {
    if (body == Joint::world) return none;
    const auto at = std::lower_bound(members_.begin(), members_.end(), body);
    return at != members_.end() && *at == body ? static_cast<std::uint32_t>(at - members_.begin()) : none;
}

void JointSystem::addEnd(BodyIndex body, const Vec3& linear, const Vec3& angular) {
    const std::uint32_t member = memberOf(body);
    if (member != none) ends_.push_back({member, linear, angular, {}});
}

void JointSystem::addRow(const JointBlock& block, const JointRow& row) {
    const auto ends = static_cast<std::uint32_t>(ends_.size());
    addEnd(block.a, row.linear, row.angular_a);
    addEnd(block.b, -row.linear, row.angular_b);
    rows_.push_back({ends, static_cast<std::uint32_t>(ends_.size())});
}

void JointSystem::addCoupling(const JointBlock& block) {
    const auto ends = static_cast<std::uint32_t>(ends_.size());
    for (const RowEnd& end : block.ends) addEnd(end.body, end.linear, end.angular);
    rows_.push_back({ends, static_cast<std::uint32_t>(ends_.size())});
}

void JointSystem::begin(std::span<const BodyIndex> members, std::span<JointBlock> blocks, Rows which) {
    members_ = members;
    blocks_ = blocks;
    which_ = which;
    rows_.clear();
    ends_.clear();
    block_end_.clear();
    for (const JointBlock& block : blocks) {
        if (!block.ends.empty()) {
            addCoupling(block);
        } else {
            for (std::uint32_t i = 0; i < block.size; ++i) addRow(block, block.rows[i]);
        }
        for (const BoundRow& bound : block.bound) {
            if (!bound.is_linear || which == Rows::rigid) continue;
            addRow(block, bound.row);
            rows_.back().softness = bound.softness;
            // What it received before in this step counts.
            rows_.back().target = bound.highest - bound.softness * bound.impulse;
        }
        block_end_.push_back(static_cast<std::uint32_t>(rows_.size()));
    }
    findProfile();
    changes_.resize(members.size());
    reactions_.resize(rows_.size());
    pivot_inv_.resize(rows_.size());
}

/// The first row that shares a body with a row is the first row of that body, unless it is a row of the same block.
void JointSystem::findProfile() {
    first_row_.assign(members_.size(), none);
    std::size_t entries = 0;
    std::uint32_t block_begin = 0;
    for (const std::uint32_t block_end : block_end_) {
        if (block_end == block_begin) continue;
        std::uint32_t first = block_begin;
        for (const End& end : endsOf(rows_[block_begin])) {
            first_row_[end.member] = std::min(first_row_[end.member], block_begin);
            first = std::min(first, first_row_[end.member]);
        }
        for (std::uint32_t i = block_begin; i < block_end; ++i) {
            rows_[i].first = first;
            rows_[i].begin = entries;
            entries += i - first;
        }
        block_begin = block_end;
    }
    lower_.resize(entries);
}

Twist JointSystem::perImpulse(std::uint32_t member, const Vec3& linear, const Vec3& angular) const {
    if (member == none) return {};
    return {response_[member].mass_inv * linear, response_[member].inertia_inv * angular};
}

/// x·M⁻¹·yᵀ.
double JointSystem::coupling(const Row& x, const Row& y) const {
    double sum = 0;
    for (const End& to : endsOf(x)) {
        for (const End& by : endsOf(y)) {
            if (to.member == by.member) sum += to.linear.dot(by.per.v) + to.angular.dot(by.per.w);
        }
    }
    return sum;
}

void JointSystem::factorise(std::span<const BodyResponse> response) {
    response_.assign(response.begin(), response.end());
    for (End& end : ends_) end.per = perImpulse(end.member, end.linear, end.angular);
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
        const Row& row = rows_[i];
        double* const l = lower_.data() + row.begin;
        const double diagonal = coupling(row, row) + row.softness;
        for (std::uint32_t j = row.first; j < i; ++j) {
            const Row& other = rows_[j];
            const double* const m = lower_.data() + other.begin;
            double sum = coupling(row, other);
            for (std::uint32_t k = std::max(row.first, other.first); k < j; ++k) {
                sum -= l[k - row.first] * m[k - other.first];
            }
            l[j - row.first] = sum;
        }
        double pivot = diagonal;
        for (std::uint32_t j = row.first; j < i; ++j) {
            const double scaled = l[j - row.first] * pivot_inv_[j];
            pivot -= l[j - row.first] * scaled;
            l[j - row.first] = scaled;
        }
        const bool usable = pivot > redundant * diagonal && std::isfinite(1 / pivot);
        pivot_inv_[i] = usable ? 1 / pivot : 0;
    }
}

void JointSystem::solve(std::span<double> x) const {
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
        const Row& row = rows_[i];
        const double* const l = lower_.data() + row.begin;
        for (std::uint32_t j = row.first; j < i; ++j) x[i] -= l[j - row.first] * x[j];
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) x[i] *= pivot_inv_[i];
    for (auto i = static_cast<std::uint32_t>(rows_.size()); i-- > 0;) {
        const Row& row = rows_[i];
        const double* const l = lower_.data() + row.begin;
        if (pivot_inv_[i] == 0) x[i] = 0;
        for (std::uint32_t j = row.first; j < i; ++j) x[j] -= l[j - row.first] * x[i];
    }
}

void JointSystem::rates(std::span<const Twist> velocity, std::span<double> out) const {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        double rate = 0;
        for (const End& end : endsOf(rows_[i])) {
            rate += end.linear.dot(velocity[end.member].v) + end.angular.dot(velocity[end.member].w);
        }
        out[i] = rate;
    }
}

void JointSystem::subtractTargets(std::span<double> rates) const {
    for (std::size_t i = 0; i < rows_.size(); ++i) rates[i] -= rows_[i].target;
}

void JointSystem::addImpulses(std::span<const double> impulses, std::span<Twist> velocity) const {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        for (const End& end : endsOf(rows_[i])) {
            velocity[end.member].v += impulses[i] * end.per.v;
            velocity[end.member].w += impulses[i] * end.per.w;
        }
    }
}

std::uint32_t JointSystem::redundantOf(std::size_t block) const {
    const auto begin = pivot_inv_.begin() + (block == 0 ? 0 : block_end_[block - 1]);
    return static_cast<std::uint32_t>(std::count(begin, pivot_inv_.begin() + block_end_[block], 0.0));
}

void JointSystem::report(std::span<const double> impulses) const {
    std::size_t row = 0;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
        JointBlock& block = blocks_[k];
        for (std::uint32_t i = 0; i < block.size; ++i) block.impulse[i] = impulses[row++];
        block.redundant = redundantOf(k);
        if (which_ == Rows::rigid) continue;
        for (BoundRow& bound : block.bound) {
            if (bound.is_linear) bound.impulse += impulses[row++];
        }
    }
}

void JointSystem::respond(std::uint32_t a, const Twist& direct_a, std::uint32_t b, const Twist& direct_b) {
    std::fill(changes_.begin(), changes_.end(), Twist{});
    if (a != none) changes_[a] = direct_a;
    if (b != none) {
        changes_[b].v += direct_b.v;
        changes_[b].w += direct_b.w;
    }
    rates(changes_, reactions_);
    for (double& reaction : reactions_) reaction = -reaction;
    solve(reactions_);
    addImpulses(reactions_, changes_);
}

double JointSystem::rateOf(const JointBlock& block, const JointRow& row, std::span<const Twist> velocity) const {
    const std::uint32_t a = memberOf(block.a);
    const std::uint32_t b = memberOf(block.b);
    double rate = 0;
    if (a != none) rate += row.linear.dot(velocity[a].v) + row.angular_a.dot(velocity[a].w);
    if (b != none) rate += row.angular_b.dot(velocity[b].w) - row.linear.dot(velocity[b].v);
    return rate;
}

void JointSystem::addAlong(const JointBlock& block, const JointRow& row, double impulse,
                           std::span<Twist> velocity) const {
    const auto add = [&](BodyIndex body, const Vec3& linear, const Vec3& angular) {
        const std::uint32_t member = memberOf(body);
        if (member == none) return;
        const Twist change = perImpulse(member, linear, angular);
        velocity[member].v += impulse * change.v;
        velocity[member].w += impulse * change.w;
    };
    add(block.a, row.linear, row.angular_a);
    add(block.b, -row.linear, row.angular_b);
}

double JointSystem::respondAlong(const JointBlock& block, const JointRow& row) {
    const std::uint32_t a = memberOf(block.a);
    const std::uint32_t b = memberOf(block.b);
    respond(a, perImpulse(a, row.linear, row.angular_a), b, perImpulse(b, -row.linear, row.angular_b));
    return rateOf(block, row, changes_);
}

}  // namespace cairn
