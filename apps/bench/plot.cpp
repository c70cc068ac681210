#include "plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace cairn::bench {

namespace {

constexpr double row_height = 17;
constexpr double group_gap = 13;
constexpr double top = 62;
constexpr double bottom = 16;
constexpr double panel_width = 300;
constexpr double width = 920;
constexpr std::array<const char*, 6> colours = {"#1d6fa5", "#d1495b", "#5b8c5a", "#8d6a9f", "#c98b1b", "#4c5b6b"};

/// Text as XML may have it.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') {
            result += "&amp;";
        } else if (c == '<') {
            result += "&lt;";
        } else {
            result += c;
        }
    }
    return result;
}

/// One of the two panels: where a value stands on its logarithmic scale.
struct Panel {
    const char* value;  ///< name in the entries
    const char* title;
    double left;         ///< [px]
    double lower = 0;    ///< power of ten at the left edge
    double decades = 1;  ///< up to the right edge

    double x(double amount) const {
        const double power = std::clamp(std::log10(std::max(amount, 1e-300)), lower, lower + decades);
        return left + panel_width * (power - lower) / decades;
    }
};

double valueOf(const Json& entry, const Panel& panel) {
    return entry.at("values").at(panel.value).get<double>();
}

/// A panel is not wider than this: what is smaller than all others by more is as good as zero.
constexpr double most_decades = 6;

/// Scales a panel to whole decades around its values; what is smaller or zero stands at the left edge.
void fit(Panel& panel, const Json& entries) {
    double least = 1e300;
    double most = 0;
    for (const Json& entry : entries) {
        const double value = valueOf(entry, panel);
        if (!(value > 0) || !std::isfinite(value)) continue;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    if (most == 0) return;
    const double upper = std::ceil(std::log10(most));
    panel.lower = std::max(std::floor(std::log10(least)), upper - most_decades);
    panel.decades = std::max(1.0, upper - panel.lower);
}

std::string textAt(double x, double y, const char* style, const std::string& text) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, style, escaped(text));
}

std::string scaleOf(const Panel& panel, double height) {
    std::string svg = textAt(panel.left, 22, "title", panel.title);
    for (int i = 0; i <= static_cast<int>(panel.decades); ++i) {
        const double tick = std::pow(10, panel.lower + i);
        svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" class=\"grid\"/>\n",
                           panel.x(tick), top - 10, height - bottom);
        svg += textAt(panel.x(tick), top - 16, "tick", fmt::format("{:g}", tick));
    }
    return svg;
}

std::string dotOf(const Panel& panel, const Json& entry, double y, const char* colour) {
    const double value = valueOf(entry, panel);
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"{}\"><title>{:.4g}</title></circle>\n",
                       panel.x(value), y, colour, value);
}

const char* colourOf(const Json& result, const std::string& engine) {
    std::size_t number = 0;
    for (const auto& [name, description] : result.at("engines").items()) {
        if (name == engine) break;
        ++number;
    }
    return colours[number % colours.size()];
}

}  // namespace

std::string peersPlot(const Json& result) {
    const Json& entries = result.at("entries");
    Panel time{"processor_ms", "ms of processor time per simulation step of 1/30 s", 240};
    Panel overlap{"largest_overlap_mm", "largest overlap of the run [mm]", 240 + panel_width + 50};
    fit(time, entries);
    fit(overlap, entries);

    std::string rows;
    double y = top;
    std::string scene;
    for (const Json& entry : entries) {
        const auto name = entry.at("scene").get<std::string>();
        const auto engine = entry.at("engine").get<std::string>();
        if (name != scene) {
            y += scene.empty() ? 0 : group_gap;
            rows += textAt(12, y + 4, "scene", name);
        }
        scene = name;
        const char* const colour = colourOf(result, engine);
        rows += textAt(225, y + 4, "engine", engine);
        rows += dotOf(time, entry, y, colour) + dotOf(overlap, entry, y, colour);
        y += row_height;
    }
    const double height = y + bottom;
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
               "height=\"{1:.0f}\">\n"
               "<style>text{{font:12px sans-serif;fill:#222}}.title,.scene{{font-weight:bold}}"
               ".engine{{text-anchor:end}}.tick{{text-anchor:middle;fill:#666}}.grid{{stroke:#ddd}}</style>\n"
               "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
               width, height) +
           scaleOf(time, height) + scaleOf(overlap, height) + rows + "</svg>\n";
}

}  // namespace cairn::bench
