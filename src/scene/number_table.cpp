#include "scene/number_table.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <string>

namespace cairn {
namespace {

/// Largest file that is read [bytes].
constexpr std::uintmax_t largest_table = std::uintmax_t{256} << 20U;

bool isSeparator(char c) {
    return c == ',' || c == ';' || c == ' ' || c == '\t' || c == '\r';
}

/// @return whether all of the line is numbers; some may have been added if not
bool addNumbers(std::string_view line, std::vector<double>& values) {
    const char* at = line.data();
    const char* const end = at + line.size();
    while (true) {
        while (at != end && isSeparator(*at)) ++at;
        if (at == end) return true;
        double value = 0;
        const std::from_chars_result read = std::from_chars(*at == '+' ? at + 1 : at, end, value);
        if (read.ec != std::errc{} || (read.ptr != end && !isSeparator(*read.ptr))) return false;
        values.push_back(value);
        at = read.ptr;
    }
}

void addLine(const JsonNode& node, std::string_view line, std::size_t number, NumberTable& table) {
    const std::size_t before = table.values.size();
    if (!addNumbers(line, table.values)) {
        table.values.resize(before);
        // A line of names.
        if (before == 0) return;
        node.fail(fmt::format("has '{}' in line {}; it must be numbers between commas", line.substr(0, 40), number));
    }
    const std::size_t columns = table.values.size() - before;
    if (before == 0) table.columns = columns;
    if (columns == table.columns) return;
    node.fail(fmt::format("has {} numbers in line {} and {} above; all lines must have as many", columns, number,
                          table.columns));
}

}  // namespace

NumberTable readNumberTable(const JsonNode& node) {
    const std::filesystem::path file = node.file();
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        throw IoError(
            fmt::format("{}: {} names {}, which is no file that can be read; its path counts from the scene file",
                        node.source(), node.path(), file.string()));
    }
    if (std::filesystem::file_size(file, error) > largest_table) {
        node.fail(fmt::format("names a file of more than {} bytes; take a shorter one", largest_table));
    }
    std::ifstream stream(file);
    NumberTable table;
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos || line[first] == '#') continue;
        addLine(node, line, number, table);
    }
    if (stream.bad()) throw IoError(fmt::format("{}: cannot be read", file.string()));
    if (table.rows() < 2) node.fail("names a file with fewer than two lines of numbers");
    return table;
}

}  // namespace cairn
