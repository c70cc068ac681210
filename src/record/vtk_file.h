/// @file VTK's XML files of polygons, as ParaView reads them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cairn {

/// Polygons with a value of each kind per polygon.
struct VtkPolygons {
    std::vector<float> points;          ///< x, y, z of each point [m, W]
    std::vector<std::int32_t> corners;  ///< indices of points, polygon after polygon
    std::vector<std::int32_t> ends;     ///< where each polygon ends in corners
    std::vector<std::int32_t> body;     ///< index of the body in the scene
    std::vector<std::int32_t> material;
    std::vector<std::uint8_t> asleep;
    std::vector<std::uint8_t> fixed;
    std::vector<float> speed;  ///< of the body's centre [m/s]

    void clear();
};

/// Writes a .vtp file, its arrays in binary form. @throws IoError
void writeVtp(const VtkPolygons& polygons, const std::filesystem::path& file);

/// Lines with a value of each kind per line.
struct VtkLines {
    std::vector<float> points;        ///< x, y, z of both ends of each line [m, W]
    std::vector<float> force;         ///< magnitude [N]
    std::vector<float> normal_force;  ///< of contacts: its part along the normal [N]; of joints the force
    std::vector<float> vector;        ///< x, y, z of the force on the body that the line comes from [N, W]
    std::vector<std::int32_t> body;   ///< that the line comes from: index in the scene
    std::vector<std::int32_t> other;  ///< from which the force comes; −1 = the world
    std::vector<std::uint8_t> joint;  ///< 1 = a joint's, 0 = a contact's

    void clear();
};

/// Writes a .vtp file, its arrays in binary form. @throws IoError
void writeVtp(const VtkLines& lines, const std::filesystem::path& file);

/// A file of a time series.
struct VtkTimeStep {
    double time;           ///< [s]
    std::string file;      ///< relative to the .pvd file
    std::size_t part = 0;  ///< of what is there at that time
};

/// Writes a .pvd file, which names the files of a time series. @throws IoError
void writePvd(const std::vector<VtkTimeStep>& steps, const std::filesystem::path& file);

}  // namespace cairn
