/// @file Tables of numbers in text files.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/json_node.h"

namespace cairn {

/// Rows of numbers of equal length.
struct NumberTable {
    std::size_t columns = 0;
    std::vector<double> values;  ///< row after row

    std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
    double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

/// Reads a CSV file: numbers between commas, semicolons or blanks; empty lines, those that begin with # and a first
/// line of names are left out. @param node its path, from where the scene file is
/// @throws InputError with the line for other texts, IoError if it cannot be read
NumberTable readNumberTable(const JsonNode& node);

}  // namespace cairn
