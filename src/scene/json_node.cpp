#include "scene/json_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

namespace cairn {
namespace {

/// Longest value quoted in a message [bytes].
constexpr std::size_t shown_limit = 80;

/// Cuts a text without cutting a UTF-8 character.
std::string shortened(std::string text, std::size_t limit) {
    if (text.size() <= limit) return text;
    std::size_t end = limit;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    text.resize(end);
    return text + "...";
}

/// Line and column, from 1, of a byte.
std::pair<std::size_t, std::size_t> lineAndColumn(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t last = before.rfind('\n');
    return {line, before.size() - (last == std::string_view::npos ? 0 : last + 1) + 1};
}

/// What the parser says, without its own prefix and position.
std::string plainReason(std::string reason) {
    if (const std::size_t end = reason.find("] "); reason.starts_with('[') && end != std::string::npos) {
        reason.erase(0, end + 2);
    }
    if (const std::size_t end = reason.find(": "); reason.starts_with("parse error") && end != std::string::npos) {
        reason.erase(0, end + 2);
    }
    return shortened(std::move(reason), 200);
}

/// Reads JSON for its syntax alone.
class SyntaxReader : public nlohmann::json_sax<Json> {
  public:
    SyntaxReader(std::string_view text, std::string_view source) : text_(text), source_(source) {}

    bool null() override { return true; }
    bool boolean(bool /*value*/) override { return true; }
    bool number_integer(number_integer_t /*value*/) override { return true; }
    bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
    bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
    bool string(string_t& /*value*/) override { return true; }
    bool binary(binary_t& /*value*/) override { return false; }
    bool start_object(std::size_t /*elements*/) override { return true; }
    bool start_array(std::size_t /*elements*/) override { return true; }
    bool end_object() override { return true; }
    bool end_array() override { return true; }
    bool key(string_t& /*name*/) override { return true; }

    bool parse_error(std::size_t position, const std::string& /*token*/, const Json::exception& error) override {
        const std::size_t offset = position > 0 ? position - 1 : 0;
        const auto [line, column] = lineAndColumn(text_, offset);
        const bool not_finite = offset < text_.size() && (text_[offset] == 'N' || text_[offset] == 'I');
        throw SyntaxError(fmt::format("{}:{}:{}: {}{}", source_, line, column, plainReason(error.what()),
                                      not_finite ? "; numbers must be finite, NaN and Infinity are not JSON" : ""));
    }

  protected:
    std::string_view source() const { return source_; }

  private:
    std::string_view text_;
    std::string_view source_;
};

/// Builds a value, refusing what JSON allows but a scene must not have: keys given twice and endless nesting.
class DocumentBuilder : public SyntaxReader {
  public:
    DocumentBuilder(std::string_view text, std::string_view source, const ValuePlace& place)
        : SyntaxReader(text, source), place_(place) {}

    Json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t& /*text*/) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t& /*value*/) override { return false; }
    bool start_object(std::size_t /*elements*/) override { return open(Json::object()); }
    bool start_array(std::size_t /*elements*/) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        Level& level = levels_.back();
        level.key = name;
        if (!level.keys.insert(name).second) {
            throw InputError(fmt::format("{}: {} is given twice; every key may stand once in an object", source(),
                                         shortened(path(), shown_limit)));
        }
        return true;
    }

  private:
    struct Level {
        Json* container;
        std::string key;             ///< of the member that is read (objects only)
        std::set<std::string> keys;  ///< all so far (objects only)
    };

    Json* append(Json&& value) {
        if (levels_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        Level& level = levels_.back();
        if (level.container->is_array()) {
            level.container->push_back(std::move(value));
            return &level.container->back();
        }
        auto& members = level.container->get_ref<Json::object_t&>();
        // The key is new (checked in key()), so the linear search of the map's own insertion is not needed.
        return &static_cast<Json::object_t::Container&>(members).emplace_back(level.key, std::move(value)).second;
    }

    bool add(Json&& value) {
        append(std::move(value));
        return true;
    }

    bool open(Json&& container) {
        Json* const opened = append(std::move(container));
        if (place_.depth + levels_.size() >= json_depth_limit) {
            throw InputError(fmt::format("{}: {} is nested more than {} levels deep; no scene needs that", source(),
                                         shortened(path(), shown_limit), json_depth_limit));
        }
        levels_.push_back({opened, {}, {}});
        return true;
    }

    bool close() {
        levels_.pop_back();
        return true;
    }

    std::string path() const {
        std::string result = place_.path;
        for (const Level& level : levels_) {
            if (level.container->is_array()) {
                appendIndex(result, level.container->empty() ? 0 : level.container->size() - 1);
            } else {
                appendKey(result, level.key);
            }
        }
        return result;
    }

    const ValuePlace& place_;
    Json root_;
    std::vector<Level> levels_;
};

}  // namespace

Json parseJson(std::string_view text, std::string_view source) {
    return parseJsonAt(text, source, {});
}

Json parseJsonAt(std::string_view text, std::string_view source, const ValuePlace& place) {
    DocumentBuilder builder(text, source, place);
    Json::sax_parse(text.begin(), text.end(), &builder);
    return builder.take();
}

void checkJsonSyntax(std::string_view text, std::string_view source) {
    SyntaxReader reader(text, source);
    Json::sax_parse(text.begin(), text.end(), &reader);
}

std::string shown(const Json& value) {
    return shortened(value.dump(-1, ' ', false, Json::error_handler_t::replace), shown_limit);
}

void appendKey(std::string& path, std::string_view key) {
    const bool plain = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    });
    if (!plain) {
        path += '[' + shown(Json(key)) + ']';
        return;
    }
    if (!path.empty()) path += '.';
    path += key;
}

void appendIndex(std::string& path, std::size_t index) {
    path += fmt::format("[{}]", index);
}

void JsonNode::appendPath(std::string& path) const {
    if (parent_ == nullptr) return;
    parent_->appendPath(path);
    if (parent_->value_->is_array()) {
        appendIndex(path, index_);
    } else {
        appendKey(path, key_);
    }
}

std::string JsonNode::path() const {
    std::string result;
    appendPath(result);
    return result;
}

void JsonNode::refuse(std::string_view allowed) const {
    fail(fmt::format("is {}; it must be {}", shown(*value_), allowed));
}

void JsonNode::fail(std::string_view text) const {
    const std::string where = path();
    throw InputError(fmt::format("{}: {} {}", source_, where.empty() ? "the scene" : where, text));
}

void JsonNode::expectKeys(std::initializer_list<std::string_view> allowed) const {
    expectKeys(std::span(allowed.begin(), allowed.size()));
}

void JsonNode::expectKeys(std::span<const std::string_view> allowed) const {
    if (!value_->is_object()) {
        refuse(fmt::format("an object with the keys {}", fmt::join(allowed, ", ")));
    }
    for (const auto& [key, value] : value_->items()) {
        if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
            fail(fmt::format("has the unknown key {}; allowed are {}", shown(Json(key)), fmt::join(allowed, ", ")));
        }
    }
}

void JsonNode::expectArray(std::string_view allowed) const {
    if (!value_->is_array()) refuse(allowed);
}

double JsonNode::numberIf(bool allowed, std::string_view what) const {
    if (!value_->is_number() || !allowed) refuse(what);
    return value_->get<double>();
}

double JsonNode::number() const {
    return numberIf(true, "a number");
}

double JsonNode::positive() const {
    return numberIf(value_->is_number() && value_->get<double>() > 0, "a number above 0");
}

double JsonNode::nonNegative() const {
    return numberIf(value_->is_number() && value_->get<double>() >= 0, "a number, 0 or above");
}

Vec3 JsonNode::vector() const {
    if (!value_->is_array() || value_->size() != 3) refuse("an array of three numbers");
    return {element(0).number(), element(1).number(), element(2).number()};
}

bool JsonNode::flag() const {
    if (!value_->is_boolean()) refuse("true or false");
    return value_->get<bool>();
}

std::string JsonNode::text() const {
    if (!value_->is_string() || value_->get_ref<const std::string&>().empty()) refuse("a text that is not empty");
    return value_->get<std::string>();
}

std::filesystem::path JsonNode::file() const {
    // An absolute path replaces what it is appended to.
    return std::filesystem::path(source_).parent_path() / text();
}

JsonNode JsonNode::required(std::string_view key, std::string_view allowed) const {
    if (const std::optional<JsonNode> found = find(key)) return *found;
    const Json nothing;
    member(key, nothing).fail(fmt::format("is missing; it must be {}", allowed));
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
    if (!value_->is_object()) refuse(fmt::format("an object, for instance with the key {}", key));
    for (const auto& entry : value_->get_ref<const Json::object_t&>()) {
        if (entry.first == key) return member(entry.first, entry.second);
    }
    return std::nullopt;
}

JsonNode JsonNode::member(std::string_view key, const Json& value) const {
    return {value, *this, key, 0};
}

JsonNode JsonNode::element(std::size_t index) const {
    return element(index, (*value_)[index]);
}

JsonNode JsonNode::element(std::size_t index, const Json& value) const {
    return {value, *this, {}, index};
}

}  // namespace cairn
