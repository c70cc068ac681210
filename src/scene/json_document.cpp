#include "scene/json_document.h"

#include <fmt/format.h>

#include <utility>

namespace cairn {
namespace {

/// Goes over JSON only to find where values end. Where the syntax is wrong it stops anywhere; the parser tells.
class Skimmer {
  public:
    Skimmer(PagedText& text, TextRange range) : text_(text), at_(range.begin), end_(range.end) {}

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

    PagedText& text_;
    std::size_t at_;
    std::size_t end_;
};

/// Between the brackets of an array that is a member of the root; none if there is none or the syntax is wrong.
std::optional<TextRange> arrayOfRoot(PagedText text, std::string_view key) {
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
        if (is_array && text.part(name) == fmt::format("\"{}\"", key)) {
            if (text[value.end - 1] != ']') return std::nullopt;
            return TextRange{value.begin + 1, value.end - 1};
        }
        skimmer.skipSpace();
    } while (skimmer.take(','));
    return std::nullopt;
}

/// Parses a part of a text. What is wrong with it is told with its place in the whole text.
Json parsePart(std::string_view part, PagedText text, std::string_view source, const ValuePlace& place) {
    try {
        return parseJsonAt(part, source, place);
    } catch (const SyntaxError&) {
        checkJsonSyntax(text.all(), source);
        throw;
    }
}

/// The document with nothing in the array.
Json parseAround(PagedText text, std::string_view source, std::optional<TextRange> hole) {
    if (!hole) return parseJson(text.all(), source);
    std::string rest(text.part({0, hole->begin}));
    rest += text.part({hole->end, text.size()});
    return parsePart(rest, std::move(text), source, {});
}

}  // namespace

JsonDocument::JsonDocument(PagedText text, std::string source, std::string_view array)
    : text_(std::move(text)),
      source_(std::move(source)),
      array_(array),
      range_(arrayOfRoot(text_, array_)),
      root_(parseAround(text_, source_, range_)) {}

void JsonDocument::forEachElement(const JsonNode& array, const std::function<void(const JsonNode&)>& visit) const {
    if (!range_) {
        for (std::size_t i = 0; i < array.size(); ++i) visit(array.element(i));
        return;
    }
    PagedText text = text_;
    Skimmer skimmer(text, *range_);
    skimmer.skipSpace();
    if (skimmer.isAtEnd()) return;
    std::size_t index = 0;
    do {
        skimmer.skipSpace();
        const TextRange range = skimmer.skipValue();
        ValuePlace place{array_, 2};
        appendIndex(place.path, index);
        const Json value = parsePart(text.part(range), text_, source_, place);
        visit(array.element(index, value));
        ++index;
        skimmer.skipSpace();
    } while (skimmer.take(','));
    if (!skimmer.isAtEnd()) checkJsonSyntax(text.all(), source_);
}

}  // namespace cairn
