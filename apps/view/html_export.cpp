#include "html_export.h"

#include <fmt/format.h>

#include <fstream>

#include "clip.h"
#include "page.h"

namespace cairn::view {

namespace {

constexpr std::string_view place = "<!-- clip -->";

std::string base64(std::string_view bytes) {
    constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= left ? letters[group >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

}  // namespace

void exportHtml(const RecordingReader& recording, const std::filesystem::path& file) {
    std::string html = page();
    const std::size_t at = html.find(place);
    if (at == std::string::npos) throw IoError("the built page has no place for a recording");
    html.replace(at, place.size(),
                 R"(<script type="application/octet-stream" id="clip">)" + base64(makeClip(recording)) + "</script>");
    std::ofstream out(file, std::ios::binary);
    out.write(html.data(), static_cast<std::streamsize>(html.size()));
    out.close();
    if (!out) throw IoError(fmt::format("'{}' cannot be written", file.string()));
}

}  // namespace cairn::view
