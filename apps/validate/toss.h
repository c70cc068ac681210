/// @file Recorded tosses of a cube: reading them, and comparing the simulation with them. @source docs/cube-tosses.md
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cairn/settings.h"
#include "cairn/types.h"

namespace cairn::validation {

/// The cube at one moment.
struct TossSample {
    double time = 0;        ///< [s]
    Pose pose{};            ///< of the cube's centre; z is up, the table is z = 0
    Vec3 v = Vec3::Zero();  ///< [m/s, W]
    Vec3 w = Vec3::Zero();  ///< [rad/s, W]
};

/// A cube that was thrown onto a table. The defaults are those of the ContactNets data set.
struct Toss {
    std::string name;
    double side = 0.1048;             ///< [m]
    double mass = 0.37;               ///< [kg]
    double friction = 0.18;           ///< µ
    double restitution = 0.125;       ///< e
    double gravity = 9.81;            ///< [m/s²]
    std::vector<TossSample> samples;  ///< at least two, in the order of time
};

/// Reads a file of the format in docs/cube-tosses.md: .csv or .json.
/// @throws IoError if it cannot be read, InputError if it is no such file; the text names the place
Toss readToss(const std::filesystem::path& file);

/// As a CSV file that readToss() takes.
std::string formatTossCsv(const Toss& toss);

/// How far the simulation is off.
struct TossErrors {
    std::vector<double> time;      ///< of the samples since the first [s]
    std::vector<double> position;  ///< [m]
    std::vector<double> angle;     ///< [rad]

    double meanPosition() const;  ///< [m]
    double meanAngle() const;     ///< [rad]
};

/// Simulates a toss from the state at its first sample and compares every later one.
TossErrors compareToss(const Toss& toss, const Settings& settings);

/// A toss as the simulation sees it: the samples are what comes out. @param rate of the samples [1/s]
Toss simulateToss(const Toss& begin, const Settings& settings, double rate, double duration);

}  // namespace cairn::validation
