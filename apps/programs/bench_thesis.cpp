/// @file cairn-bench-thesis: the thesis's benchmarks beside ours.
#include "bench_thesis/bench.h"

#include <fmt/format.h>

#include <memory>

#include "cli/bench_progress.h"
#include "cli/companions.h"
#include "cli/interrupt.h"
#include "cli/output.h"
#include "cli/program.h"
#include "cli/view_exports.h"

namespace cairn::cli {

namespace {

struct BenchArguments {
    std::vector<std::string> only;
    std::string out = "report";
    bool quick = false;
    bool no_pictures = false;
    std::optional<double> rating;
};

void drawPicture(const thesis::Picture& picture) {
    ViewExports exports;
    exports.png = picture.file.string();
    exports.time = picture.time;
    exports.camera = picture.camera;
    exports.size = {720, 450};
    if (writeViewExports(picture.recording.string(), exports) != fine) {
        throw IoError("cairn-view could not draw them; its message stands above");
    }
}

thesis::BenchOutcome measure(const BenchArguments& arguments) {
    BenchProgress progress;
    thesis::BenchOptions options;
    options.out = arguments.out;
    options.only = arguments.only;
    options.extent = arguments.quick ? thesis::Extent::quick : thesis::Extent::full;
    options.rating = arguments.rating;
    options.progress = [&](const thesis::Position& position) { progress.update(position.part, position.what); };
    options.interrupted = interrupted;
    if (!arguments.no_pictures) options.picture = drawPicture;
    return thesis::runBench(options);
}

int runThesis(const BenchArguments& arguments) {
    catchInterrupts();
    try {
        const thesis::BenchOutcome outcome = measure(arguments);
        printOut(outcome.summary);
        for (const std::string& warning : outcome.warnings) printLine(stderr, "cairn: warning: " + warning);
        for (const std::string& broken : outcome.broken) printError(broken);
        const std::string files = outcome.page.empty() ? outcome.results.string() : outcome.page.string();
        printOut(fmt::format("written: {}\n", files));
        return outcome.broken.empty() ? fine : run_failed;
    } catch (const thesis::Interrupted&) {
        printError("interrupted; the same command goes on where it was");
        return run_failed;
    }
}

void addOptions(CLI::App& command, int& exit_code) {
    auto arguments = std::make_shared<BenchArguments>();
    command.add_option("--only", arguments->only, "Sections such as 5.3; default: all")->delimiter(',');
    command.add_option("--out", arguments->out, "Folder of the report; default: report")->type_name("DIR");
    command.add_flag("--quick", arguments->quick, "Shortened, once: for the signs of the results, not the numbers");
    command.add_flag("--no-pictures", arguments->no_pictures, "Draw no pictures");
    command
        .add_option("--rating", arguments->rating,
                    "PassMark single-thread rating of this processor, for the factor to the thesis's")
        ->check(CLI::PositiveNumber);
    command.callback([arguments, &exit_code] { exit_code = runThesis(*arguments); });
}

}  // namespace

}  // namespace cairn::cli

int main(int argc, char** argv) {
    using namespace cairn::cli;
    return runProgram(argc, argv, "cairn bench thesis", std::string(thesis_companion.description), addOptions);
}
