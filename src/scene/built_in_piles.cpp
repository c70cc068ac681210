#include <utility>

#include "scene/built_in_tools.h"

namespace cairn {
namespace {

using Take = SceneSource::Take;

constexpr double usual_wall = 0.2;  ///< thickness [m]

/// The numbers that a body is drawn from, whatever bodies were made before it.
SplitMix64 randomOf(int body) {
    return SplitMix64(0x5eed0000U + static_cast<std::uint64_t>(body));
}

/// A box, ball or capsule that fits into a ball. @param radius of that ball [m]
Shape randomShape(SplitMix64& random, double radius) {
    const std::uint64_t kind = random.next() % 3;
    if (kind == 0) return Sphere{tidy(radius)};
    if (kind == 1) {
        const Vec3 edges = Vec3::Constant(0.75) + 0.25 * random.symmetricVector();
        return Box{tidy(Vec3(edges * (2 * radius / edges.norm())))};
    }
    const double thickness = radius * random.between(0.4, 0.7);
    return Capsule{tidy(thickness), tidy(2 * (radius - thickness))};
}

/// The ground, and fixed walls on it around fields. @param field inner size of each, and the walls' height [m]
/// @param columns of fields along x @param rows of them along y @param wall thickness [m]
void tellWalls(const Take& take, const Vec3& field, int columns = 1, int rows = 1, double wall = usual_wall) {
    take(ground());
    const Vec3 pitch = field + Vec3(wall, wall, 0);
    const double length_x = columns * pitch.x();
    const double length_y = rows * pitch.y();
    for (int i = 0; i <= columns; ++i) {
        take(fixedBox({wall, length_y + wall, field.z()}, {(i - 0.5 * columns) * pitch.x(), 0, field.z() / 2}));
    }
    for (int i = 0; i <= rows; ++i) {
        take(fixedBox({length_x - wall, wall, field.z()}, {0, (i - 0.5 * rows) * pitch.y(), field.z() / 2}));
    }
}

/// The middle of the cell of a body, cells filled layer by layer. @param side cells in a row
Vec3 cellIndex(int body, int side) {
    const Vec3 index(body % side, body / side % side, body / (side * side));
    return index + Vec3(0.5 - 0.5 * side, 0.5 - 0.5 * side, 0.5);
}

/// Layers that so many bodies fill. @param side cells in a row
int layersOf(int bodies, int side) {
    return (bodies + side * side - 1) / (side * side);
}

/// A pile is poured from cells so wide, of bodies within balls of these radii [m].
constexpr double largest = 0.08;
constexpr double smallest = 0.03;
constexpr double pile_cell = 2.1 * largest;

/// A body of a pile, somewhere in its cell.
SceneBody pouredBody(int body, int side, SplitMix64& random) {
    const double radius = random.between(smallest, largest);
    const Shape shape = randomShape(random, radius);
    const Vec3 shift = (0.49 * pile_cell - radius) * random.symmetricVector();
    SceneBody poured = dynamicBody(shape, "oak", pile_cell * cellIndex(body, side) + shift);
    poured.orientation = randomOrientation(random);
    return poured;
}

Scene emptyPit(std::string name) {
    return emptyScene(std::move(name), 6, {0, 0, -10});
}

}  // namespace

SceneSource heapScene(std::string name, int bodies) {
    return {emptyPit(std::move(name)), [bodies](const Take& take) {
                // As many layers as columns: poured out they fill about a fifth of their height, so that the pile is
                // wider than high and the last bodies do not fall too far, whatever its size.
                int side = 2;
                while (side * side * side < bodies) ++side;
                const double width = side * pile_cell;
                tellWalls(take, {width, width, tidy((layersOf(bodies, side) + 1) * pile_cell)});
                SplitMix64 random(2010);
                for (int i = 0; i < bodies; ++i) take(pouredBody(i, side, random));
            }};
}

SceneSource grainsScene(std::string name, int grains) {
    return {emptyPit(std::move(name)), [grains](const Take& take) {
                constexpr int layers = 20;
                int side = 2;
                while (layers * side * side < grains) ++side;
                const double width = side * pile_cell;
                tellWalls(take, {width, width, tidy((layers + 1) * pile_cell)});
                for (int i = 0; i < grains; ++i) {
                    SplitMix64 random = randomOf(i);
                    take(pouredBody(i, side, random));
                }
            }};
}

SceneSource pitScene(std::string name, int boxes) {
    return {emptyPit(std::move(name)), [boxes](const Take& take) {
                constexpr double cell = 0.18;  // wider than the largest diagonal
                constexpr int side = 8;
                tellWalls(take, {1.5, 1.5, tidy((layersOf(boxes, side) + 1) * cell)});
                SplitMix64 random(2026);
                for (int i = 0; i < boxes; ++i) {
                    Vec3 size;
                    for (double& edge : size) edge = random.between(0.06, 0.1);
                    SceneBody body = dynamicBody(Box{size}, "oak", cell * cellIndex(i, side));
                    body.orientation = randomOrientation(random);
                    take(body);
                }
            }};
}

SceneSource pitsScene(std::string name, int pits, int bodies) {
    return {emptyPit(std::move(name)), [pits, bodies](const Take& take) {
                constexpr int side = 5;
                constexpr double width = side * pile_cell;
                constexpr double wall = 0.6;  // so that bodies of two pits are never near each other
                int columns = 1;
                while (columns * columns < pits) ++columns;
                const int rows = (pits + columns - 1) / columns;
                // Walls go from pit to pit, so they are few; batches end at them.
                tellWalls(take, {width, width, tidy((layersOf(bodies, side) + 1) * pile_cell)}, columns, rows, wall);
                for (int pit = 0; pit < pits; ++pit) {
                    const Vec3 middle((pit % columns + 0.5 - 0.5 * columns) * (width + wall),
                                      (pit / columns + 0.5 - 0.5 * rows) * (width + wall), 0);
                    for (int i = 0; i < bodies; ++i) {
                        SplitMix64 random = randomOf(pit * bodies + i);
                        SceneBody body = pouredBody(i, side, random);
                        body.position = tidy(Vec3(body.position + middle));
                        take(body);
                    }
                }
            }};
}

SceneSource gasScene(std::string name, int balls) {
    Scene scene = emptyScene(std::move(name), 2, Vec3::Zero());
    scene.default_pair = {.restitution = 1, .static_friction = 0, .kinetic_friction = 0};
    return {std::move(scene), [balls](const Take& take) {
                constexpr double cell = 1;
                constexpr double fastest = 2;  // along each axis [m/s]
                int side = 1;
                while (side * side * side < balls) ++side;
                for (int i = 0; i < balls; ++i) {
                    SplitMix64 random = randomOf(i);
                    const double radius = tidy(random.between(0.05, 0.1));
                    SceneBody ball = dynamicBody(Sphere{radius}, "oak", cell * cellIndex(i, side));
                    ball.linear_velocity = tidy(Vec3(fastest * random.symmetricVector()));
                    take(ball);
                }
            }};
}

SceneSource bedScene(std::string name, int columns, int rows, int layers) {
    return {emptyPit(std::move(name)), [=](const Take& take) {
                constexpr double radius = 0.05;
                constexpr double cell = 2.2 * radius;
                tellWalls(take, {columns * cell, rows * cell, tidy((layers + 1) * cell)});
                for (int i = 0; i < columns * rows * layers; ++i) {
                    SplitMix64 random = randomOf(i);
                    const Vec3 index(i % columns + 0.5 - 0.5 * columns, i / columns % rows + 0.5 - 0.5 * rows,
                                     i / (columns * rows) + 0.5);
                    const Vec3 shift = (0.49 * cell - radius) * random.symmetricVector();
                    take(dynamicBody(Sphere{radius}, "oak", cell * index + shift));
                }
            }};
}

}  // namespace cairn
