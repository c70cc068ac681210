/// @file Arrays that follow a number which changes a little from step to step.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cairn {

/// Resizes an array; where it must grow it gets an eighth more than asked for, not twice what it had.
template <class Element>
void resizeTightly(std::vector<Element>& array, std::size_t size) {
    if (size > array.capacity()) array.reserve(size + size / 8);
    array.resize(size);
}

/// The first elements of an array that only grows: they are what was there before.
template <class Element>
std::span<Element> firstOf(std::vector<Element>& array, std::size_t size) {
    if (array.size() < size) resizeTightly(array, size);
    return std::span(array).first(size);
}

/// Appends an element likewise.
template <class Element>
void appendTightly(std::vector<Element>& array, const Element& element) {
    if (array.size() == array.capacity()) array.reserve(array.size() + array.size() / 8 + 1);
    array.push_back(element);
}

}  // namespace cairn
