/// Rows against differences of their errors, groups against a search, and the factors against a dense solution.
#include "joints/joint_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "joints/joint_groups.h"
#include "joints/joint_kinds.h"
#include "math/rotation.h"

namespace cairn {
namespace {

/// A small generator of our own, the same on every machine.
class Random {
  public:
    double symmetric() {
        state_ += 0x9E3779B97F4A7C15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return 2 * static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53 - 1;
    }
    Vec3 vector() {
        const double x = symmetric();
        const double y = symmetric();
        return {x, y, symmetric()};
    }
    Quat orientation() {
        const double w = symmetric();
        const Vec3 v = vector();
        return Quat(w, v.x(), v.y(), v.z()).normalized();
    }

  private:
    std::uint64_t state_ = 7;
};

constexpr std::array all_kinds = {JointKind::distance,    JointKind::rope,  JointKind::ball,      JointKind::hinge,
                                  JointKind::slider,      JointKind::fixed, JointKind::universal, JointKind::planar,
                                  JointKind::cylindrical, JointKind::screw, JointKind::generic};

/// A joint that holds where its bodies stand.
Joint jointAt(JointKind kind, BodyIndex a, const Pose& pose_a, BodyIndex b, const Pose& pose_b, Random& random) {
    Joint joint;
    joint.present = true;
    joint.kind = kind;
    joint.a = a;
    joint.b = b;
    const Vec3 anchor = 0.5 * (pose_a.position + pose_b.position) + 0.2 * random.vector();
    const Vec3 axis = random.vector().normalized();
    joint.anchor_a = pose_a.toInner(anchor);
    joint.anchor_b = pose_b.toInner(kind == JointKind::distance || kind == JointKind::rope ? pose_b.position : anchor);
    joint.axis_a = pose_a.orientation.conjugate() * axis;
    joint.axis_b = pose_b.orientation.conjugate() * axis;
    joint.rest = pose_b.orientation.conjugate() * pose_a.orientation;
    joint.length = (anchor - pose_b.position).norm();
    Mat3 frame;
    frame << axis, anyAcross(axis), axis.cross(anyAcross(axis));
    joint.frame = pose_b.orientation.conjugate() * Quat(frame);
    joint.lead = 0.2;
    for (const JointAlong along : entryOf(kind).free) joint.free.push_back({.along = along});
    if (kind == JointKind::generic) joint.free = {{.along = JointAlong::z}, {.along = JointAlong::turn_y}};
    // The rotation vector of a ball is what its spring follows; as a position it has no exact rate.
    for (FreeAxis& axis_of : joint.free) {
        if (kind == JointKind::ball && axis_of.along != JointAlong::turn_x) continue;
        axis_of.lower = -0.3;
        axis_of.upper = 0.4;
    }
    return joint;
}

Pose moved(const Pose& pose, const Twist& twist, double time) {
    return {pose.position + time * twist.v, (fromRotationVector(time * twist.w) * pose.orientation).normalized()};
}

double rateOf(const JointRow& row, const Twist& a, const Twist& b) {
    return row.linear.dot(a.v - b.v) + row.angular_a.dot(a.w) + row.angular_b.dot(b.w);
}

/// A joint before, at and after a moment, in which its bodies move: what a derivative is taken from.
constexpr double around_time = 1e-5;
std::array<JointBlock, 3> around(const Joint& joint, const Pose& a, const Twist& u, const Pose& b, const Twist& w) {
    std::array<JointBlock, 3> blocks;
    double time = -around_time;
    for (JointBlock& block : blocks) {
        evaluate(joint, moved(a, u, time), moved(b, w, time), 0.01, block);
        time += around_time;
    }
    return blocks;
}

class RowsOf : public ::testing::TestWithParam<JointKind> {};
INSTANTIATE_TEST_SUITE_P(Joints, RowsOf, ::testing::ValuesIn(all_kinds));

TEST_P(RowsOf, AreTheDerivativesOfTheErrorsAndOfThePositions) {
    Random random;
    for (int i = 0; i < 200; ++i) {
        const Pose a{random.vector(), random.orientation()};
        const Pose b{2 * random.vector(), random.orientation()};
        const Joint joint = jointAt(GetParam(), 0, a, 1, b, random);
        const Twist u{random.vector(), random.vector()};
        const Twist w{random.vector(), random.vector()};
        const auto [before, here, after] = around(joint, a, u, b, w);
        for (std::uint32_t k = 0; k < here.size; ++k) {
            EXPECT_NEAR(here.error[k], 0, 1e-14);
            EXPECT_NEAR((after.error[k] - before.error[k]) / (2 * around_time), rateOf(here.rows[k], u, w), 1e-8) << k;
        }
        for (std::uint32_t k = 0; k < here.bounds; ++k) {
            const double rate = (before.bound[k].to_upper - after.bound[k].to_upper) / (2 * around_time);
            EXPECT_NEAR(rate, rateOf(here.bound[k].row, u, w), 1e-8);
        }
    }
}

TEST_P(RowsOf, FollowTheFreeAxesFarFromWhereTheyBegan) {
    Random random;
    for (int i = 0; i < 200; ++i) {
        const Pose b{random.vector(), random.orientation()};
        Pose a{2 * random.vector(), random.orientation()};
        Joint joint = jointAt(GetParam(), 0, a, 1, b, random);
        if (joint.kind == JointKind::ball) joint.cone = 0.5;
        // Along the free axes only, so that all else stays.
        for (int k = 0; k < 40; ++k) {
            Twist u;
            for (std::size_t n = 0; n < joint.free.size(); ++n) {
                const JointRow row = motionOf(joint, n, a, b).row;
                u.v += 0.03 * (1 + random.symmetric()) * row.linear;
                u.w += 0.03 * (1 + random.symmetric()) * row.angular_a;
            }
            a = moved(a, u, 1);
        }
        const Twist u{random.vector(), random.vector()};
        const Twist w{random.vector(), random.vector()};
        const auto [before, here, after] = around(joint, a, u, b, w);
        ASSERT_GE(here.bounds, joint.free.empty() ? 0U : 1U);
        for (std::uint32_t k = 0; k < here.bounds; ++k) {
            const double rate = (before.bound[k].to_upper - after.bound[k].to_upper) / (2 * around_time);
            EXPECT_NEAR(rate, rateOf(here.bound[k].row, u, w), 1e-7) << k;
        }
    }
}

/// Bodies 0 … n−1 with random joints between them and to the world.
struct Mechanism {
    std::vector<Joint> joints;
    std::vector<Pose> poses;
    std::vector<BodyKind> kind;
    std::vector<BodyResponse> response;
    Random random;

    explicit Mechanism(BodyIndex bodies) {
        for (BodyIndex i = 0; i < bodies; ++i) {
            poses.push_back({Vec3(i, 0, 0) + 0.2 * random.vector(), random.orientation()});
            kind.push_back(BodyKind::dynamic);
            const Mat3 turn = random.orientation().toRotationMatrix();
            const Vec3 moments = (2 * random.vector().cwiseAbs()).array() + 0.5;
            response.push_back({0.5 + std::abs(random.symmetric()), turn * moments.asDiagonal() * turn.transpose()});
        }
    }
    void join(JointKind joint_kind, BodyIndex a, BodyIndex b) {
        const Pose world{};
        joints.push_back(jointAt(joint_kind, a, poses[a], b, b == Joint::world ? world : poses[b], random));
    }
    std::vector<JointBlock> blocks(std::span<const std::uint32_t> slots) const {
        std::vector<JointBlock> result;
        for (const std::uint32_t slot : slots) {
            const Joint& joint = joints[slot];
            const Pose b = joint.b == Joint::world ? Pose{} : poses[joint.b];
            evaluate(joint, poses[joint.a], b, 0.01, result.emplace_back());
        }
        return result;
    }
};

TEST(JointSystem, SolvesWhatADenseFactorisationSolves) {
    Mechanism m(8);
    for (BodyIndex i = 1; i < 8; ++i) m.join(all_kinds[i % 4 + 2], i, i - 1);
    m.join(JointKind::ball, 0, Joint::world);
    m.join(JointKind::distance, 7, 2);  // a loop
    JointGroups groups;
    JointGrouping().build(m.joints, m.kind, groups);
    ASSERT_EQ(groups.size(), 1U);
    std::vector<JointBlock> blocks = m.blocks(groups.jointsOf(0));
    JointSystem system;
    system.begin(groups.bodiesOf(0), blocks, JointSystem::Rows::all);
    system.factorise(m.response);
    const auto rows = static_cast<Eigen::Index>(system.rows());
    Eigen::MatrixXd j = Eigen::MatrixXd::Zero(rows, 48);
    Eigen::MatrixXd mass_inv = Eigen::MatrixXd::Zero(48, 48);
    Eigen::Index row = 0;
    for (const JointBlock& block : blocks) {
        for (std::uint32_t i = 0; i < block.size; ++i, ++row) {
            j.block<1, 3>(row, 6 * block.a) = block.rows[i].linear.transpose();
            j.block<1, 3>(row, 6 * block.a + 3) = block.rows[i].angular_a.transpose();
            if (block.b == Joint::world) continue;
            j.block<1, 3>(row, 6 * block.b) = -block.rows[i].linear.transpose();
            j.block<1, 3>(row, 6 * block.b + 3) = block.rows[i].angular_b.transpose();
        }
    }
    for (Eigen::Index i = 0; i < 8; ++i) {
        mass_inv.block<3, 3>(6 * i, 6 * i) = m.response[i].mass_inv * Mat3::Identity();
        mass_inv.block<3, 3>(6 * i + 3, 6 * i + 3) = m.response[i].inertia_inv;
    }
    const Eigen::VectorXd wanted = Eigen::VectorXd::LinSpaced(rows, -1, 2);
    const Eigen::VectorXd expected = (j * mass_inv * j.transpose()).fullPivLu().solve(wanted);
    std::vector<double> found(wanted.begin(), wanted.end());
    system.solve(found);
    for (Eigen::Index i = 0; i < rows; ++i) {
        EXPECT_NEAR(found[static_cast<std::size_t>(i)], expected[i], 1e-9 * expected.norm()) << i;
    }
    std::vector<Twist> velocity(8);
    system.addImpulses(found, velocity);
    std::vector<double> rates(system.rows());
    system.rates(velocity, rates);
    for (Eigen::Index i = 0; i < rows; ++i) EXPECT_NEAR(rates[static_cast<std::size_t>(i)], wanted[i], 1e-9);
}

TEST(JointSystem, AnImpulseThroughJointsLeavesThemHolding) {
    Mechanism m(5);
    for (BodyIndex i = 1; i < 5; ++i) m.join(all_kinds[i + 1], i, i - 1);
    JointGroups groups;
    JointGrouping().build(m.joints, m.kind, groups);
    std::vector<JointBlock> blocks = m.blocks(groups.jointsOf(0));
    JointSystem system;
    system.begin(groups.bodiesOf(0), blocks, JointSystem::Rows::all);
    system.factorise(m.response);
    system.respond(1, {Vec3(1, 2, 3), Vec3(0, 1, 0)}, 4, {Vec3(0, 0, -1), Vec3::Zero()});
    std::vector<double> rates(system.rows());
    system.rates(system.changes(), rates);
    for (const double rate : rates) EXPECT_NEAR(rate, 0, 1e-12);
    EXPECT_GT(system.changes()[0].v.norm(), 1e-3) << "the others are dragged along";
}

TEST(JointGroups, AreWhatBodiesThatMoveConnect) {
    Mechanism m(7);
    m.kind[3] = BodyKind::fixed;
    m.join(JointKind::ball, 1, 0);
    m.join(JointKind::ball, 5, 4);
    m.join(JointKind::ball, 2, 1);
    m.join(JointKind::ball, 3, 2);
    m.join(JointKind::ball, 4, 3);
    m.join(JointKind::ball, 6, Joint::world);
    m.join(JointKind::ball, 3, Joint::world);
    m.joints[5].present = false;
    JointGroups groups;
    JointGrouping().build(m.joints, m.kind, groups);
    ASSERT_EQ(groups.size(), 2U) << "a fixed body connects nothing";
    const auto list = [](std::span<const std::uint32_t> span) {
        return std::vector<std::uint32_t>(span.begin(), span.end());
    };
    EXPECT_EQ(list(groups.bodiesOf(0)), (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(list(groups.bodiesOf(1)), (std::vector<std::uint32_t>{4, 5}));
    const std::vector<std::uint32_t> walk = list(groups.jointsOf(0));
    EXPECT_TRUE(walk == (std::vector<std::uint32_t>{0, 2, 3}) || walk == (std::vector<std::uint32_t>{3, 2, 0}))
        << "from one end to the other";
    EXPECT_EQ(groups.jointsOf(1).size(), 2U);
}

}  // namespace
}  // namespace cairn
