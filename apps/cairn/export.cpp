/// @file cairn export: recordings as files of other programs.
#include <fmt/format.h>

#include <memory>

#include "cairn/recording.h"
#include "cli/view_exports.h"
#include "commands.h"

namespace cairn::cli {

namespace {

struct ExportOptions {
    std::string recording;
    std::string csv;
    std::string vtk;
    ViewExports view;
};

/// The recording must not be emptied before it is read.
void refuseSameFile(const std::string& recording, const std::string& out) {
    std::error_code unknown;
    if (std::filesystem::equivalent(recording, out, unknown)) {
        throw InputError(fmt::format("'{}' is the recording itself; name another file for the export", out));
    }
}

int runExport(const ExportOptions& options) {
    for (const std::string& out : {options.csv, options.view.html, options.view.png, options.view.mp4}) {
        refuseSameFile(options.recording, out);
    }
    if (!options.csv.empty() || !options.vtk.empty()) {
        const RecordingReader recording(options.recording);
        if (!options.csv.empty()) exportCsv(recording, options.csv);
        if (!options.vtk.empty()) exportVtk(recording, options.vtk);
    }
    return options.view.any() ? writeViewExports(options.recording, options.view) : fine;
}

}  // namespace

void addExport(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("export", "Turn a recording into tables, a page, a picture or a film");
    auto options = std::make_shared<ExportOptions>();
    command->add_option("RECORDING", options->recording, "A recording made by 'cairn run --record'")
        ->required()
        ->check(CLI::ExistingFile);
    CLI::Option_group* formats = command->add_option_group("formats", "At least one of them");
    formats->add_option("--csv", options->csv, "Write one row per frame and body to this file");
    formats->add_option("--vtk", options->vtk,
                        "Write OUT.pvd, a time series for ParaView, and a folder OUT of .vtp files");
    addViewExports(*command, *formats, options->view);
    formats->require_option(1, 0);
    command->callback([options, &exit_code] { exit_code = runExport(*options); });
}

}  // namespace cairn::cli
