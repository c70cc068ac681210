/// @file Basic quantities of the public interface: vectors, poses, ids and errors.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <compare>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace cairn {

/// A 3-vector; unit and frame are named where it is used.
using Vec3 = Eigen::Vector3d;
/// A 3×3 matrix; unit and frame are named where it is used.
using Mat3 = Eigen::Matrix3d;
/// A unit quaternion; constructed and written as (w, x, y, z).
using Quat = Eigen::Quaterniond;

/// Position and orientation of a frame F in another frame.
struct Pose {
    Vec3 position = Vec3::Zero();         ///< origin of F [m]
    Quat orientation = Quat::Identity();  ///< rotation from F (unit quaternion)

    /// Maps a point of the posed frame into the outer frame. @param p [m, posed frame]
    Vec3 toOuter(const Vec3& p) const { return position + orientation * p; }
    /// A pose in the posed frame as one in the outer frame.
    Pose toOuter(const Pose& inner) const { return {toOuter(inner.position), orientation * inner.orientation}; }
    /// The pose of the outer frame in the posed one.
    Pose inverse() const {
        const Quat back = orientation.conjugate();
        return {back * Vec3(-position), back};
    }
    /// Maps a point of the outer frame into the posed frame. @param p [m, outer frame]
    Vec3 toInner(const Vec3& p) const { return orientation.conjugate() * (p - position); }
};

/// A stable name of a body: it never names another body, also after the body was removed.
struct BodyId {
    std::uint32_t index = UINT32_MAX;  ///< slot in the world
    std::uint32_t generation = 0;      ///< how many bodies lived in the slot before

    friend auto operator<=>(const BodyId&, const BodyId&) = default;
};

/// A stable name of a spring, with the same rules as BodyId.
struct SpringId {
    std::uint32_t index = UINT32_MAX;  ///< slot in the world
    std::uint32_t generation = 0;      ///< how many springs lived in the slot before

    friend auto operator<=>(const SpringId&, const SpringId&) = default;
};

/// A stable name of a joint, with the same rules as BodyId.
struct JointId {
    std::uint32_t index = UINT32_MAX;  ///< slot in the world
    std::uint32_t generation = 0;      ///< how many joints lived in the slot before

    friend auto operator<=>(const JointId&, const JointId&) = default;
};

/// The index of a material of a world.
enum class MaterialId : std::uint32_t {};

/// What the user gave is not allowed; the text names the value, what is allowed and the remedy.
class InputError : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

/// An id names a body, spring or joint that is no longer (or was never) in the world.
class StaleIdError : public InputError {
  public:
    using InputError::InputError;
};

/// A mistake of Cairn itself, found by the checks of World::setChecks(); the text names step, body and what is wrong.
class InvariantError : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

/// Something outside the program failed: a file cannot be read or written, a disk is full.
class IoError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace cairn
