#include "page.h"

#include <nlohmann/json.hpp>
#include <string_view>

namespace cairn::validation {

namespace {

constexpr unsigned char bytes[] = {
#include "validation_page.inc"
};
constexpr std::string_view placeholder = "/* report */";

}  // namespace

std::optional<std::string> makePage(const Json& report) {
    std::string page(reinterpret_cast<const char*>(bytes), sizeof bytes);
    const std::size_t at = page.find(placeholder);
    if (at == std::string::npos) return {};
    // "</script>" inside a string would end the element that the report stands in.
    std::string text;
    for (const char c : report.dump()) {
        if (c == '/' && text.ends_with('<')) text += '\\';
        text += c;
    }
    return page.replace(at, placeholder.size(), text);
}

}  // namespace cairn::validation
