/// @file Documents of which one array may be too large to be held as values.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "scene/json_node.h"
#include "scene/paged_text.h"

namespace cairn {

/// A document that leaves one array of its root as text and parses its elements one after the other, so that a large
/// file takes the memory of a single element.
class JsonDocument {
  public:
    /// @param source shown in messages @param array key of the root @throws InputError as parseJson(), IoError
    JsonDocument(PagedText text, std::string source, std::string_view array);

    /// Everything; the array is empty here if it is kept as text.
    JsonNode root() const { return {root_, source_}; }
    /// Calls visit for every element of the array. @param array its node @throws InputError as parseJson(), IoError
    void forEachElement(const JsonNode& array, const std::function<void(const JsonNode&)>& visit) const;

  private:
    PagedText text_;
    std::string source_;
    std::string array_;
    std::optional<TextRange> range_;  ///< between the brackets of the array; none = its elements are in the root
    Json root_;
};

}  // namespace cairn
