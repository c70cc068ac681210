#include "markdown.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace cairn::validation {

namespace {

std::string number(const Json& value) {
    return value.is_null() ? "–" : fmt::format("{:.6g}", value.get<double>());
}

/// A text of the report inside a table, where a bar would end the cell.
std::string cell(const Json& text) {
    std::string escaped;
    for (const char c : text.get<std::string>()) {
        if (c == '|') escaped += '\\';
        escaped += c;
    }
    return escaped;
}

std::string limitOf(const Json& q) {
    const std::string rule = q.at("rule");
    if (rule == "relative")
        return fmt::format("{} ± {:.3g} %", number(q.at("expected")), 100 * q.at("allowed").get<double>());
    if (rule == "absolute") return fmt::format("{} ± {}", number(q.at("expected")), number(q.at("allowed")));
    if (rule == "shown") return q.at("expected").is_null() ? "–" : number(q.at("expected"));
    return fmt::format("{} {}", rule, number(q.at("allowed")));
}

/// Bounds judge the measured value itself.
std::string errorOf(const Json& q) {
    const std::string rule = q.at("rule");
    if (rule == "at most" || rule == "at least" || q.at("error").is_null()) return "";
    const double error = q.at("error").get<double>();
    return rule == "relative" ? fmt::format("{:.2g} %", 100 * error) : fmt::format("{:.2g}", error);
}

std::string rowOf(const Json& q) {
    const bool judged = !q.at("passed").is_null();
    const std::string verdict = !judged ? "shown" : q.at("passed").get<bool>() ? "yes" : "**no**";
    const std::string unit = q.at("unit");
    return fmt::format("| {}{} | {} | {} | {} | {} | {} | {} | {} |\n", cell(q.at("what")),
                       unit.empty() ? "" : " [" + unit + "]", cell(q.at("setup")), limitOf(q), number(q.at("measured")),
                       errorOf(q), q.at("order").get<std::string>(), verdict, cell(q.at("note")));
}

}  // namespace

std::string overviewMarkdown(const Json& report) {
    std::string text = "| case | group | targets met | seconds |\n|---|---|---|---|\n";
    for (const Json& c : report.at("cases")) {
        int judged = 0;
        int met = 0;
        for (const Json& q : c.at("quantities")) {
            if (q.at("passed").is_null()) continue;
            ++judged;
            if (q.at("passed").get<bool>()) ++met;
        }
        const std::string name = c.at("name");
        text += fmt::format("| [`{}`](validation/{}.md) | {} | {} of {} | {:.0f} |\n", name, name,
                            c.at("group").get<std::string>(), met, judged, c.at("seconds").get<double>());
    }
    return text;
}

std::string caseMarkdown(const Json& c) {
    std::string text = fmt::format("# {} (`{}`)\n\n{} Source: {}. [All cases](../validation.md).\n\n",
                                   c.at("title").get<std::string>(), c.at("name").get<std::string>(),
                                   c.at("setup").get<std::string>(), c.at("source").get<std::string>());
    text +=
        "| quantity | conditions | expected | measured | error | order | met | remark "
        "|\n|---|---|---|---|---|---|---|---|\n";
    for (const Json& q : c.at("quantities")) text += rowOf(q);
    return text;
}

}  // namespace cairn::validation
