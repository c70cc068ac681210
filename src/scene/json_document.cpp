#include "scene/json_document.h"

#include <fmt/format.h>

#include <utility>

namespace cairn {
namespace {

/// Goes over JSON only to find where values end. Where the syntax is wrong it stops anywhere; the parser tells.
class Skimmer {
  public:
    Skimmer(std::string_view text, TextRange range) : text_(text), at_(range.begin), end_(range.end) {}

    std::size_t position() const { return at_; }
    bool isAtEnd() const { return at_ >= end_; }
    char next() const { return isAtEnd() ? '\0' : text_[at_]; }

    void skipSpace() {
        while (!isAtEnd() && (next() == ' ' || next() == '\n' || next() == '\r' || next() == '\t')) ++at_;
    }
    /// Steps over a character if it is the next one.
    bool take(char c) {
        if (next() != c) return false;
        ++at_;
        return true;
    }
    /// Steps over a value. @return where it stands
    TextRange skipValue() {
        const std::size_t begin = at_;
        if (next() == '"') {
            skipText();
        } else if (next() == '[' || next() == '{') {
            skipContainer();
        } else {
            while (!isAtEnd() && std::string_view(",:[]{} \n\r\t").find(next()) == std::string_view::npos) ++at_;
        }
        return {begin, at_};
    }

  private:
    void skipText() {
        for (++at_; !isAtEnd() && next() != '"'; ++at_) {
            if (next() == '\\') ++at_;
        }
        if (!isAtEnd()) ++at_;
        at_ = std::min(at_, end_);
    }

    void skipContainer() {
        std::size_t depth = 0;
        while (!isAtEnd()) {
            const char c = next();
            if (c == '"') {
                skipText();
                continue;
            }
            ++at_;
            if (c == '[' || c == '{') ++depth;
            if ((c == ']' || c == '}') && --depth == 0) return;
        }
    }

    std::string_view text_;
    std::size_t at_;
    std::size_t end_;
};

/// Between the brackets of an array that is a member of the root; none if there is none or the syntax is wrong.
std::optional<TextRange> arrayOfRoot(std::string_view text, std::string_view key) {
    Skimmer skimmer(text, {0, text.size()});
    skimmer.skipSpace();
    if (!skimmer.take('{')) return std::nullopt;
    do {
        skimmer.skipSpace();
        const TextRange name = skimmer.skipValue();
        skimmer.skipSpace();
        if (!skimmer.take(':')) return std::nullopt;
        skimmer.skipSpace();
        const bool is_array = skimmer.next() == '[';
        const TextRange value = skimmer.skipValue();
        if (is_array && text.substr(name.begin, name.end - name.begin) == fmt::format("\"{}\"", key)) {
            if (text[value.end - 1] != ']') return std::nullopt;
            return TextRange{value.begin + 1, value.end - 1};
        }
        skimmer.skipSpace();
    } while (skimmer.take(','));
    return std::nullopt;
}

/// The document with nothing in the array.
Json parseAround(std::string_view text, std::string_view source, TextRange hole) {
    std::string rest(text.substr(0, hole.begin));
    rest += text.substr(hole.end);
    try {
        return parseJson(rest, source);
    } catch (const SyntaxError&) {
        checkJsonSyntax(text, source);  // says where it is in the whole text
        throw;
    }
}

}  // namespace

JsonDocument::JsonDocument(std::string_view text, std::string_view source, std::string_view array)
    : text_(text),
      source_(source),
      array_(array),
      range_(arrayOfRoot(text, array)),
      root_(range_ ? parseAround(text, source, *range_) : parseJson(text, source)) {}

void JsonDocument::forEachElement(const JsonNode& array, const std::function<void(const JsonNode&)>& visit) const {
    if (!range_) {
        for (std::size_t i = 0; i < array.size(); ++i) visit(array.element(i));
        return;
    }
    Skimmer skimmer(text_, *range_);
    skimmer.skipSpace();
    if (skimmer.isAtEnd()) return;
    std::size_t index = 0;
    do {
        skimmer.skipSpace();
        ValuePlace place{skimmer.skipValue(), std::string(array_), 2};
        appendIndex(place.path, index);
        Json value;
        try {
            value = parseJsonAt(text_, source_, place);
        } catch (const SyntaxError&) {
            checkJsonSyntax(text_, source_);  // in the whole text another character may be the wrong one
            throw;
        }
        visit(array.element(index, value));
        ++index;
        skimmer.skipSpace();
    } while (skimmer.take(','));
    if (!skimmer.isAtEnd()) checkJsonSyntax(text_, source_);
}

}  // namespace cairn
