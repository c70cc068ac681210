/// @file Bodies of a rigid scene as Bullet has them.
#pragma once

#include <btBulletCollisionCommon.h>
#include <fmt/format.h>

#include <memory>
#include <string>

#include "rigid_scene.h"

namespace cairn::bench {

inline btVector3 toBullet(const Vec3& v) {
    return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

inline btQuaternion toBullet(const Quat& q) {
    return {static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()), static_cast<btScalar>(q.z()),
            static_cast<btScalar>(q.w())};
}

inline Vec3 fromBullet(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}

/// Makes a shape; half-spaces keep their plane in the frame of the body.
struct MakeBulletShape {
    using Pointer = std::unique_ptr<btCollisionShape>;

    Pointer operator()(const Sphere& s) const {
        return std::make_unique<btSphereShape>(static_cast<btScalar>(s.radius));
    }
    Pointer operator()(const Box& b) const {
        // The margin lies inside the half extents, so that the edges keep their full lengths; the usual one of 4 cm
        // would be most of a small box.
        auto box = std::make_unique<btBoxShape>(toBullet(b.size / 2));
        box->setSafeMargin(toBullet(b.size / 2));
        return box;
    }
    Pointer operator()(const Capsule& c) const {
        return std::make_unique<btCapsuleShapeZ>(static_cast<btScalar>(c.radius), static_cast<btScalar>(c.length));
    }
    Pointer operator()(const HalfSpace& h) const {
        const double length = h.normal.norm();
        return std::make_unique<btStaticPlaneShape>(toBullet(h.normal / length), static_cast<btScalar>(h.offset));
    }
};

/// The version, with the precision it was compiled with.
inline std::string bulletVersion() {
    const int number = btGetVersion();
    return fmt::format("Bullet {}.{:02}, {} precision", number / 100, number % 100,
                       sizeof(btScalar) == sizeof(float) ? "single" : "double");
}

}  // namespace cairn::bench
