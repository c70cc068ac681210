/// @file Surfaces from files: meshes of STL, OBJ and PLY, heights of PNG.
#pragma once

#include <filesystem>
#include <string_view>

#include "cairn/shape.h"
#include "cairn/types.h"

namespace cairn {

/// Reads a mesh: STL (text or binary), OBJ or PLY (text or binary little-endian), as its content tells. Faces of more
/// than three corners become fans of triangles; all but places and faces is passed over.
/// @param sides, scale as Mesh: files have no unit, so scale makes theirs metres
/// @throws IoError if the file cannot be read; InputError with the file's name for what is no such mesh, as Mesh, and
/// for a file that is shorter than it says
Mesh readMesh(const std::filesystem::path& file, SurfaceSides sides = SurfaceSides::one,
              const Vec3& scale = Vec3::Ones());

/// The same of a file's content. @param source shown in messages
Mesh parseMesh(std::string_view bytes, std::string_view source, SurfaceSides sides = SurfaceSides::one,
               const Vec3& scale = Vec3::Ones());

/// Reads heights from a greyscale PNG of 8 or 16 bits and at most 2²⁴ pixels: black is 0, its upper edge lies towards
/// +y. @param spacing of columns and rows [m] @param scale height of white [m], not 0
/// @throws IoError if the file cannot be read; InputError with the file's name for another picture, and as HeightField
HeightField readHeightField(const std::filesystem::path& file, const Eigen::Vector2d& spacing, double scale);

/// The same of a file's content. @param source shown in messages
HeightField parseHeightField(std::string_view bytes, std::string_view source, const Eigen::Vector2d& spacing,
                             double scale);

}  // namespace cairn
