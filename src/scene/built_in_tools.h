/// @file What the built-in scenes share.
#pragma once

#include <cstdint>
#include <string>

#include "cairn/scene.h"

namespace cairn {

/// The splitmix64 generator: small, seeded by one number, the same on every machine.
/// @source G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number generators, DOI 10.1145/2660193.2660195
class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9E3779B97F4A7C15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }
    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
    /// Uniform in [−1, 1).
    double symmetric() { return 2 * unit() - 1; }
    /// Uniform in [low, high).
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Three symmetric() numbers, in the order x, y, z.
    Vec3 symmetricVector() {
        const double x = symmetric();
        const double y = symmetric();
        return {x, y, symmetric()};
    }

  private:
    std::uint64_t state_;
};

/// Rounds to nine significant digits, so that scene files stay short and equal on every machine.
double tidy(double value);
Vec3 tidy(const Vec3& value);
Quat tidy(const Quat& value);

/// A scene with the thesis's materials (oak, iron, granite) and pair properties, without bodies.
Scene emptyScene(std::string name, double duration, const Vec3& gravity);
/// The half-space below z = 0.
SceneBody ground();
/// A fixed half-space of granite: all p with normal·p ≤ offset [m].
SceneBody fixedPlane(const Vec3& normal, double offset);
/// A fixed box of granite.
SceneBody fixedBox(const Vec3& size, const Vec3& position);
/// A dynamic body; its position is rounded by tidy().
SceneBody dynamicBody(const Shape& shape, std::string material, const Vec3& position);
Quat aboutAxis(const Vec3& axis, double angle);
/// A rotation with every direction equally likely, without functions that differ between machines.
Quat randomOrientation(SplitMix64& random);
/// Convex stones of irregular form. @param radius of the ball that holds each [m]
std::vector<Shape> stoneShapes(SplitMix64& random, int count, double radius);

/// A lattice of stones that fall on what is below them.
struct StoneBed {
    Pose pose;             ///< of the middle of the lowest layer
    int columns = 1;       ///< along x of the pose
    int rows = 1;          ///< along y
    int layers = 1;        ///< along z
    double radius = 0.1;   ///< of the ball that holds a stone [m]
    std::string material;  ///< of one of the scene's
};
void addStones(Scene& scene, const StoneBed& bed, SplitMix64& random);
/// A pyramid-like wall in the y–z plane at x: `rows` boxes in the lowest row, one fewer in each above, half a spacing
/// apart. @param size edge length [m]
void addWall(Scene& scene, int rows, double x, double size);

// Scenes of the thesis (§5.1), equal to the published files.
Scene stacksScene(std::string name, int walls);
Scene wellScene(std::string name, double radius, double well_height, int side, int layers);
Scene cageScene(std::string name, const Vec3& size, double body_size, int side, int layers);

// Scenes of any size, and those of thesis §5.6.
Scene catapultScene(std::string name);
Scene cradleScene(std::string name, int balls, int moving);
Scene swingingCradleScene(std::string name, int balls, int moving);
Scene towerScene(std::string name, int boxes);
Scene wallScene(std::string name, int rows);

// Piles and gases, which may be large: each body is made when it is told.
SceneSource heapScene(std::string name, int bodies);
SceneSource pitScene(std::string name, int boxes);
SceneSource pitsScene(std::string name, int pits, int bodies);
SceneSource gasScene(std::string name, int balls);
SceneSource bedScene(std::string name, int columns, int rows, int layers);
SceneSource grainsScene(std::string name, int grains);

// Terrain, moved ground and machines.
Scene rockfallScene(std::string name);
Scene shakeTableScene(std::string name);
Scene excavatorScene(std::string name);
Scene drumScene(std::string name);

}  // namespace cairn
