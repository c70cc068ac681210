/// @file cairn settings: all fields of the settings, as a table for the terminal or for docs/settings.md.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "cairn/settings.h"
#include "cli/output.h"
#include "commands.h"

namespace cairn::cli {

namespace {

/// A field: name, unit, value in each preset, what is allowed, meaning.
using Row = std::vector<std::string>;

Row headings() {
    Row row{"field", "unit"};
    row.insert(row.end(), presetNames().begin(), presetNames().end());
    row.insert(row.end(), {"allowed", "meaning"});
    return row;
}

std::string valueText(const SettingValue& value) {
    return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

std::string allowedText(const SettingField& field, const SettingValue& value) {
    if (std::holds_alternative<bool>(value)) return "true, false";
    if (std::holds_alternative<std::string>(value)) return fmt::format("{}", fmt::join(field.choices, ", "));
    // The smallest number above zero stands for a range without zero.
    if (field.minimum == std::numeric_limits<double>::min()) return fmt::format("above 0, up to {}", field.maximum);
    return fmt::format("{} to {}", field.minimum, field.maximum);
}

std::vector<Row> rowsOf(std::string_view stage) {
    std::vector<Row> rows;
    for (const SettingField& field : settingFields()) {
        if (field.stage != stage) continue;
        Row row{std::string(field.name), std::string(field.unit)};
        for (const std::string_view preset : presetNames()) {
            row.push_back(valueText(field.get(Settings::preset(presetNamed(preset)))));
        }
        row.push_back(allowedText(field, field.get(Settings{})));
        row.emplace_back(field.meaning);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<std::string_view> stages() {
    std::vector<std::string_view> names;
    for (const SettingField& field : settingFields()) {
        if (std::find(names.begin(), names.end(), field.stage) == names.end()) names.push_back(field.stage);
    }
    return names;
}

std::string markdown() {
    std::string text =
        "# Settings\n\n"
        "Printed by `cairn settings --markdown`. Every field can be set with `--set field=value` and in the\n"
        "`settings` of a scene file. The speeds of the presets are given for 10 m/s² and the preset's own steps per\n"
        "second; both scale them.\n\n"
        "## Time steps\n\n"
        "How often bodies must be looked at depends on how long they take to fall by their own size. So the numbers\n"
        "of `performance` and `accuracy` are for bodies of 0.12 m, the thesis's, under 10 m/s². Unless a number is\n"
        "given they are multiplied by 2ᵏ when a world takes its first step with bodies that move:\n"
        "k = −round(½·log₂(d·10 m/s² / (0.12 m·|g|))), where d is the median over these bodies of the middle one of\n"
        "a body's three extents. Grains of 1 mm get 1920, blocks of 1 m 60. The number is saved and changes only\n"
        "when a program sets another one; the presets of the thesis have the same for all sizes. `cairn run` warns\n"
        "of less than a quarter of the number for the sizes.\n";
    for (const std::string_view stage : stages()) {
        const Row top = headings();
        text += fmt::format("\n## {}\n\n| {} |\n|", stage, fmt::join(top, " | "));
        for (std::size_t i = 0; i < top.size(); ++i) text += "---|";
        text += '\n';
        for (Row row : rowsOf(stage)) {
            row.front() = fmt::format("`{}`", row.front());
            text += fmt::format("| {} |\n", fmt::join(row, " | "));
        }
    }
    return text;
}

std::string plain() {
    const Row top = headings();
    std::vector<std::size_t> width(top.size() - 1);
    for (std::size_t i = 0; i < width.size(); ++i) width[i] = top[i].size();
    for (const std::string_view stage : stages()) {
        for (const Row& row : rowsOf(stage)) {
            for (std::size_t i = 0; i < width.size(); ++i) width[i] = std::max(width[i], row[i].size());
        }
    }
    const auto line = [&](const Row& cells) {
        std::string text;
        for (std::size_t i = 0; i < width.size(); ++i) text += fmt::format("{:<{}}  ", cells[i], width[i]);
        return text + cells.back() + '\n';
    };
    std::string text = line(top);
    for (const std::string_view stage : stages()) {
        text += fmt::format("\n{}\n", stage);
        for (const Row& row : rowsOf(stage)) text += line(row);
    }
    return text;
}

}  // namespace

void addSettings(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("settings", "Print every setting with its unit, presets, range and meaning");
    auto as_markdown = std::make_shared<bool>(false);
    command->add_flag("--markdown", *as_markdown, "Print the page docs/settings.md");
    command->callback([as_markdown] { printOut(*as_markdown ? markdown() : plain()); });
}

}  // namespace cairn::cli
