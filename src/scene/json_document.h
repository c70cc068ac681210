/// @file Documents of which one array may be too large to be held as values.
#pragma once

#include <functional>
#include <optional>

#include "scene/json_node.h"

namespace cairn {

/// A document that keeps one array of its root as text and parses its elements one after the other, so that a large
/// file takes the memory of its text and of a single element.
class JsonDocument {
  public:
    /// @param text must outlive this @param source shown in messages @param array key of the root
    /// @throws InputError as parseJson()
    JsonDocument(std::string_view text, std::string_view source, std::string_view array);

    /// Everything; the array is empty here if it is kept as text.
    JsonNode root() const { return {root_, source_}; }
    /// Calls visit for every element of the array. @param array its node @throws InputError as parseJson()
    void forEachElement(const JsonNode& array, const std::function<void(const JsonNode&)>& visit) const;

  private:
    std::string_view text_;
    std::string_view source_;
    std::string_view array_;
    std::optional<TextRange> range_;  ///< between the brackets of the array; none = its elements are in the root
    Json root_;
};

}  // namespace cairn
