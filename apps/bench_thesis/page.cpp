#include "page.h"

#include <array>
#include <string_view>

#include "cairn/types.h"
#include "store.h"

namespace cairn::thesis {

namespace {

constexpr unsigned char bytes[] = {
#include "report_page.inc"
};
constexpr std::string_view placeholder = "/* report */";

std::string base64(std::string_view data) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((data.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < data.size(); i += 3) {
        std::uint32_t word = 0;
        const std::size_t count = std::min<std::size_t>(3, data.size() - i);
        for (std::size_t k = 0; k < 3; ++k) {
            word = word << 8 | (k < count ? static_cast<unsigned char>(data[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= count ? digits[word >> (18 - 6 * k) & 63] : '=';
        }
    }
    return text;
}

/// "</script>" inside a string would end the element that the report stands in.
std::string safeInScript(std::string_view text) {
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text) {
        if (c == '/' && !safe.empty() && safe.back() == '<') safe += '\\';
        safe += c;
    }
    return safe;
}

/// The report with the pictures' bytes, each once.
Json withPictures(Json report, const std::filesystem::path& out) {
    Json pictures = Json::object();
    for (const Json& section : report.at("sections")) {
        for (const Json& row : section.at("pictures")) {
            for (const Json& picture : row.at("files")) {
                const std::string file = picture.at("file");
                if (!pictures.contains(file)) pictures[file] = "data:image/png;base64," + base64(readWhole(out / file));
            }
        }
    }
    report["picture_data"] = std::move(pictures);
    return report;
}

}  // namespace

std::optional<std::string> fillPage(std::span<const unsigned char> built, const Json& report) {
    std::string page(reinterpret_cast<const char*>(built.data()), built.size());
    const std::size_t at = page.find(placeholder);
    if (at == std::string::npos) return {};
    return page.replace(at, placeholder.size(), safeInScript(report.dump()));
}

std::optional<std::string> makePage(const Json& report, const std::filesystem::path& out) {
    return fillPage(bytes, withPictures(report, out));
}

}  // namespace cairn::thesis
