/// @file JSON for files that people write: every value knows where it stands, so that every message can say it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "cairn/types.h"

namespace cairn {

/// JSON with its keys in the order of the file.
using Json = nlohmann::ordered_json;

/// The deepest nesting that is read; scene files need six levels.
inline constexpr std::size_t json_depth_limit = 32;

/// Wrong syntax: no JSON.
class SyntaxError : public InputError {
  public:
    using InputError::InputError;
};

/// Where in a document a value stands that is parsed by itself.
struct ValuePlace {
    std::string path;       ///< such as `bodies[3]`, for messages
    std::size_t depth = 0;  ///< levels around it
};

/// Parses a text. @param source shown in messages, such as the file's name
/// @throws SyntaxError with line and column, InputError with the path for keys given twice or too deep nesting
Json parseJson(std::string_view text, std::string_view source);
/// Parses one value of a document. @throws as above, with line and column in the text of the value
Json parseJsonAt(std::string_view text, std::string_view source, const ValuePlace& place);
/// Reads a text and builds nothing. @throws SyntaxError
void checkJsonSyntax(std::string_view text, std::string_view source);

/// A value's text for messages, shortened when it is long.
std::string shown(const Json& value);
/// Adds a key to a path such as `bodies[3].shape`.
void appendKey(std::string& path, std::string_view key);
/// Adds an index to a path.
void appendIndex(std::string& path, std::size_t index);

/// A value in a document, with the way to it. Holds pointers: parents and the document must outlive it.
class JsonNode {
  public:
    /// The root. @param source shown in messages
    JsonNode(const Json& value, std::string_view source) : value_(&value), source_(source) {}

    const Json& value() const { return *value_; }
    /// Of the document, shown in messages.
    std::string_view source() const { return source_; }
    /// Such as `bodies[3].shape.radius`; empty for the root.
    std::string path() const;

    /// @throws InputError always: "SOURCE: PATH is VALUE; it must be ALLOWED"
    [[noreturn]] void refuse(std::string_view allowed) const;
    /// @throws InputError always: "SOURCE: PATH TEXT", for what a value alone does not explain
    [[noreturn]] void fail(std::string_view text) const;

    // Each throws InputError if the value is of another type or out of the named range.
    void expectKeys(std::initializer_list<std::string_view> allowed) const;
    void expectKeys(std::span<const std::string_view> allowed) const;
    void expectArray(std::string_view allowed) const;
    double number() const;
    double positive() const;
    double nonNegative() const;
    Vec3 vector() const;
    bool flag() const;
    std::string text() const;  ///< not empty
    /// The file that it names, whose path counts from the document's file.
    std::filesystem::path file() const;

    /// A key that must be there. @param allowed what it must be, for the message
    JsonNode required(std::string_view key, std::string_view allowed) const;
    std::optional<JsonNode> find(std::string_view key) const;
    JsonNode member(std::string_view key, const Json& value) const;
    JsonNode element(std::size_t index) const;
    /// An element whose value is kept elsewhere.
    JsonNode element(std::size_t index, const Json& value) const;
    std::size_t size() const { return value_->size(); }

  private:
    JsonNode(const Json& value, const JsonNode& parent, std::string_view key, std::size_t index)
        : value_(&value), source_(parent.source_), parent_(&parent), key_(key), index_(index) {}
    double numberIf(bool allowed, std::string_view what) const;
    void appendPath(std::string& path) const;

    const Json* value_;
    std::string_view source_;
    const JsonNode* parent_ = nullptr;
    std::string_view key_;   ///< empty for elements of arrays
    std::size_t index_ = 0;  ///< of an element of an array
};

}  // namespace cairn
