/// Built-in scenes on ground that is uneven, or moves.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/built_in_tools.h"

namespace cairn {
namespace {

/// Smooth noise over the plane, from −1 to 1: random numbers on a lattice, with cubic steps between.
class Noise {
  public:
    Noise(SplitMix64& random, double cell) : cell_(cell) {
        for (double& value : values_) value = random.symmetric();
    }
    double at(double x, double y) const {
        const double u = x / cell_ + 0.5 * size;
        const double v = y / cell_ + 0.5 * size;
        const double i = std::floor(u);
        const double j = std::floor(v);
        const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
        const double s = smooth(u - i);
        const double t = smooth(v - j);
        return (1 - t) * ((1 - s) * value(i, j) + s * value(i + 1, j)) +
               t * ((1 - s) * value(i, j + 1) + s * value(i + 1, j + 1));
    }

  private:
    static constexpr int size = 64;

    double value(double i, double j) const {
        const int column = std::clamp(static_cast<int>(i), 0, size - 1);
        const int row = std::clamp(static_cast<int>(j), 0, size - 1);
        return values_[static_cast<std::size_t>(row * size + column)];
    }

    double cell_;
    std::vector<double> values_ = std::vector<double>(static_cast<std::size_t>(size) * size);
};

/// A mountain side that rises along y from a valley, with a gully down its middle.
class MountainSide {
  public:
    explicit MountainSide(SplitMix64& random) : broad_(random, 5), middle_(random, 1.9), fine_(random, 0.7) {}

    double height(double x, double y) const {
        const double up = std::clamp((y + 5) / 13, 0.0, 1.0);
        const double slope = 8.5 * up * up * (3 - 2 * up);
        const double across = x + 0.8 * broad_.at(0, y);
        const double gully = 1.6 * up * std::min(across * across / 9, 1.6);
        const double rough = 0.15 + 0.85 * up;
        return slope + gully + rough * (0.9 * broad_.at(x, y) + 0.42 * middle_.at(x, y) + 0.14 * fine_.at(x, y));
    }

    SceneBody body() const {
        constexpr int columns = 97;
        constexpr int rows = 105;
        constexpr double spacing = 0.2;
        std::vector<double> heights;
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                const double x = (column - 0.5 * (columns - 1)) * spacing;
                const double y = (row - 0.5 * (rows - 1)) * spacing;
                heights.push_back(tidy(height(x, y)));
            }
        }
        SceneBody body;
        body.shape = HeightField(columns, std::move(heights), {spacing, spacing});
        body.material = "earth";
        body.name = "mountain";
        body.fixed = true;
        return body;
    }

  private:
    Noise broad_;
    Noise middle_;
    Noise fine_;
};

/// A quake of up to about the acceleration of gravity: swings whose strength grows and fades. @return places of the
/// table over time
TableMotion quake() {
    TableMotion motion;
    constexpr double interval = 0.05;
    constexpr double length = 6;
    for (int i = 0; i * interval <= length + 1e-9; ++i) {
        const double t = i * interval;
        const double envelope = std::sin(std::numbers::pi * t / length);
        const double phase = 2 * std::numbers::pi * t;
        const double x = 0.1 * std::sin(1.1 * phase) + 0.02 * std::sin(2.9 * phase + 1);
        const double y = 0.012 * std::sin(1.9 * phase + 2);
        motion.times.push_back(tidy(t));
        motion.displacements.push_back(tidy(Vec3(envelope * envelope * Vec3(x, y, 0))));
    }
    return motion;
}

/// A façade of courses of stones in the x–z plane, with windows under lintels, and a gable.
class Facade {
  public:
    Facade(Scene& scene, double ground) : scene_(&scene), ground_(ground) {}

    void build() const {
        for (int course = 0; course < courses; ++course) addCourse(course);
    }

  private:
    static constexpr double length = 0.4;  // of a stone, along x [m]
    static constexpr double depth = 0.45;
    static constexpr double height = 0.2;
    static constexpr int wide = 12;  // stones in a course of the walls
    static constexpr int straight = 13;
    static constexpr int courses = 24;

    /// An opening and the course of its lintel.
    struct Opening {
        double left, right;  ///< [m]
        int bottom, lintel;  ///< courses
    };
    static constexpr Opening openings[] = {{-0.4, 0.4, 0, 6},   {-1.8, -1.0, 2, 6}, {1.0, 1.8, 2, 6},
                                           {-1.8, -1.0, 8, 12}, {1.0, 1.8, 8, 12},  {-0.4, 0.4, 8, 12}};

    void addStone(double left, double right, int course) const {
        constexpr double joint = 0.004;
        if (right - left < 0.05) return;
        scene_->bodies.push_back(dynamicBody(Box{tidy(Vec3(right - left - joint, depth, height))}, "travertine",
                                             {0.5 * (left + right), 0, ground_ + (course + 0.5) * height}));
    }

    void addCourse(int course) const {
        // The gable: every second course is a stone shorter.
        const double half = 0.5 * length * (wide - std::max(0, course - straight + 1));
        double left = -half;
        // Every second course begins with half a stone, so that no joint stands above another.
        double right = left + (course % 2 == 0 ? length : 0.5 * length);
        while (left < half - 1e-9) {
            left = addUntil(left, std::min(right, half), course);
            right = left + length;
            // Joints keep to the lattice of their course behind an opening.
            const double shift = course % 2 == 0 ? 0 : 0.5 * length;
            right = -half + shift + length * std::floor((left + half - shift) / length + 1 + 1e-9);
        }
    }

    /// A stone, a lintel in its place, or what an opening leaves of it. @return where the next one begins
    double addUntil(double left, double right, int course) const {
        for (const Opening& opening : openings) {
            const bool is_lintel = course == opening.lintel;
            const double begin = opening.left - (is_lintel ? 0.2 : 0);
            const double end = opening.right + (is_lintel ? 0.2 : 0);
            if (course < opening.bottom || course > opening.lintel || right <= begin + 1e-9 || left >= end - 1e-9)
                continue;
            if (left < begin - 1e-9) {
                addStone(left, begin, course);
            }
            if (is_lintel) addStone(begin, end, course);
            return end;
        }
        addStone(left, right, course);
        return right;
    }

    Scene* scene_;
    double ground_;
};

}  // namespace

Scene rockfallScene(std::string name) {
    Scene scene = emptyScene(std::move(name), 12, {0, 0, -9.81});
    scene.materials = {{"sensor", 1000}, {"earth", 2000}, {"granite", 2800}};
    scene.default_pair = {
        .restitution = 0.15, .static_friction = 0.6, .kinetic_friction = 0.5, .rolling_friction = 0.01};
    SplitMix64 random(1881);
    const MountainSide mountain(random);
    scene.bodies.push_back(mountain.body());
    // Tells which stones reached the valley.
    SceneBody valley = fixedBox({9, 1.2, 1.6}, {0, -6.2, 1.0});
    valley.material = "sensor";
    valley.name = "valley";
    valley.sensor = true;
    scene.bodies.push_back(valley);
    for (const auto& [radius, y, columns] : {std::tuple{0.32, 7.2, 5}, {0.22, 5.6, 7}, {0.15, 4.2, 10}}) {
        const StoneBed bed{
            {Vec3(0, y, mountain.height(0, y) + 1.4 + 2 * radius), Quat::Identity()}, columns, 4, 4, radius, "granite"};
        addStones(scene, bed, random);
    }
    return scene;
}

Scene shakeTableScene(std::string name) {
    Scene scene = emptyScene(std::move(name), 7, {0, 0, -9.81});
    scene.materials = {{"iron", 7874}, {"travertine", 2400}, {"granite", 2800}};
    scene.default_pair = {.restitution = 0, .static_friction = 0.6, .kinetic_friction = 0.5};
    scene.bodies.push_back(ground());
    SceneBody table = fixedBox({6.4, 2.4, 0.3}, {0, 0, 0.25});
    table.material = "iron";
    table.name = "table";
    table.motion = quake();
    scene.bodies.push_back(table);
    Facade(scene, 0.4).build();
    return scene;
}

}  // namespace cairn
