#include "runner.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cli/interrupt.h"
#include "cli/output.h"
#include "commands.h"

namespace cairn::cli {

namespace {

constexpr double longest_duration = 1e7;  ///< [s]; about four months

std::string describeFault(const SceneRun& run, const FaultInfo& fault) {
    const auto found = std::find(run.ids().begin(), run.ids().end(), fault.body);
    const auto index = static_cast<std::size_t>(found - run.ids().begin());
    const std::string& name = run.scene().bodies.at(index).name;
    return fmt::format("body {}{} failed in time step {} and was fixed: {}", index,
                       name.empty() ? "" : fmt::format(" '{}'", name), fault.step, fault.what);
}

/// A run with its outputs.
class Runner {
  public:
    Runner(SceneRun run, const OutputOptions& options, const std::filesystem::path& usual_checkpoint)
        : run_(std::move(run)) {
        if (options.check) run_.world().setChecks(Checks::on);
        run_.stepsPerSimulationStep();  // refuses a bad number before a file is touched
        if (auto option = parseCheckpoint(options.checkpoint, usual_checkpoint)) checkpoints_.emplace(*option);
        // A place that cannot be written is told now and not after the first hours.
        if (checkpoints_) checkpoints_->write(run_);
        hashed_ = options.hashes;
        if (!options.record.empty()) {
            const double steps = run_.world().settings().steps_per_second;
            recorded_.frame_rate = options.frame_rate;
            recorded_.hashes_per_frame =
                static_cast<std::size_t>(hashed_ ? std::lround(steps / options.frame_rate) : 0);
            recorded_.contacts = options.record_contacts;
            recorded_.joints = options.record_joints;
            recording_.emplace(options.record, run_.scene(), run_.world().settings(), recorded_);
        }
        if (!options.stats.empty()) stats_.emplace(options.stats, run_.world().settings());
    }

    /// @return why the run ended early, if it did. What failed is an output or a body; wrong events throw InputError
    std::optional<std::string> simulate(Progress::Wish progress_wish) {
        const double duration = run_.scene().duration;
        // A duration such as 0.1 s is not exactly three simulation steps.
        const auto all = static_cast<std::int64_t>(std::ceil(duration * simulation_steps_per_second - 1e-6));
        const std::int64_t done = run_.world().stepCount() / run_.stepsPerSimulationStep();
        Progress progress(duration, progress_wish);
        try {
            record();
            for (std::int64_t left = std::max<std::int64_t>(all, 1) - done; left > 0; --left) {
                if (interrupted()) return interruption();
                step();
                if (!run_.world().faults().empty()) return describeFault(run_, run_.world().faults().front());
                if (checkpoints_) checkpoints_->writeIfDue(run_);
                progress.update(run_.world().time());
            }
            if (recording_) recording_->close();
        } catch (const IoError& error) {
            return error.what();
        }
        return std::nullopt;
    }

    Report report() const { return makeReport(run_, measurements_); }

  private:
    /// A simulation step of 1/30 s; frames are recorded within it, too.
    void step() {
        double ms = 0;
        Statistics sum;
        for (int left = run_.stepsPerSimulationStep(); left > 0; --left) {
            ms += timeStep();
            sum.add(run_.world().statistics());
            if (recording_ && isFrameDue(run_, recorded_.frame_rate)) record();
        }
        measurements_.add(ms, sum);
        if (stats_) stats_->add(run_.world(), ms, sum);
    }

    /// @return wall time [ms]
    double timeStep() {
        using Milliseconds = std::chrono::duration<double, std::milli>;
        const auto begin = std::chrono::steady_clock::now();
        run_.step();
        if (hashed_) hashes_.push_back(run_.world().stateHash());
        since_frame_.add(run_.world().statistics());
        return Milliseconds(std::chrono::steady_clock::now() - begin).count();
    }

    void record() {
        if (!recording_) return;
        Frame frame = captureFrame(run_, since_frame_, recorded_);
        frame.step_hashes = std::exchange(hashes_, {});
        since_frame_ = {};
        recording_->append(frame);
    }

    std::string interruption() {
        std::string text = fmt::format("interrupted after {:.6g} of {} s", run_.world().time(), run_.scene().duration);
        if (!checkpoints_) return text;
        checkpoints_->write(run_);
        return text + fmt::format("; 'cairn resume {}' goes on", checkpoints_->file().string());
    }

    SceneRun run_;
    std::optional<Checkpointer> checkpoints_;
    std::optional<RecordingWriter> recording_;
    std::optional<StatsCsv> stats_;
    RecordingOptions recorded_;
    Measurements measurements_;
    bool hashed_ = false;
    std::vector<std::uint64_t> hashes_;  ///< of the time steps since the last frame
    Statistics since_frame_;             ///< of the same
};

/// Fewer time steps per second than this the thesis does not allow.
constexpr double thesis_steps_per_second = 180;

void warnOfLongSteps(const Settings& settings) {
    if (settings.steps_per_second >= thesis_steps_per_second) return;
    printLine(stderr,
              fmt::format("cairn: warning: {} time steps per second are fewer than {}: bodies overlap more, and "
                          "fast ones may pass through each other",
                          settings.steps_per_second, thesis_steps_per_second));
}

}  // namespace

void addOutputOptions(CLI::App& command, OutputOptions& options) {
    command.add_option("--record", options.record, "Write a recording (HDF5)")->type_name("FILE");
    command.add_flag("--hashes", options.hashes, "Record a hash of every time step, for 'cairn replay --verify'");
    command.add_option("--frame-rate", options.frame_rate, "Frames of the recording per simulated second; default: 30")
        ->type_name("F");
    command.add_flag("--record-contacts", options.record_contacts, "Record contacts with their impulses, too");
    command.add_flag("--record-joints", options.record_joints, "Record the forces of joints, too");
    command.add_option("--stats", options.stats, "Write the statistics of every simulation step (CSV)")
        ->type_name("FILE");
    command.add_option("--checkpoint", options.checkpoint, checkpoint_help)->type_name(checkpoint_form);
    command.add_flag("--check", options.check, "Check the invariants of every time step; a broken one ends the run");
    command.add_flag("--json", options.json, "Print the report as one JSON object and nothing else");
    command.add_flag("--quiet", options.quiet, "Print neither progress nor report");
}

void refuseSameFiles(const OutputOptions& options, const std::string& input) {
    if (options.record.empty()) {
        if (options.hashes) throw InputError("--hashes needs --record, which keeps them");
        if (options.record_contacts) throw InputError("--record-contacts needs --record, which keeps them");
        if (options.record_joints) throw InputError("--record-joints needs --record, which keeps them");
        if (options.frame_rate != simulation_steps_per_second) throw InputError("--frame-rate needs --record");
    }
    const auto same = [](const std::string& a, const std::string& b) {
        if (a.empty() || b.empty()) return false;
        std::error_code unknown;
        return a == b || std::filesystem::equivalent(a, b, unknown);
    };
    if (same(options.record, options.stats)) {
        throw InputError(fmt::format("--record and --stats both name '{}'; give two files", options.record));
    }
    for (const std::string& out : {options.record, options.stats}) {
        if (same(out, input)) {
            throw InputError(fmt::format("'{}' is the scene itself; name another file for the output", out));
        }
    }
}

double requireDuration(double duration) {
    if (duration > 0 && duration <= longest_duration) return duration;
    throw InputError(fmt::format("--duration is {}; it must be above 0 and at most {} s", duration, longest_duration));
}

int runToTheEnd(SceneRun run, const OutputOptions& options, const std::filesystem::path& usual_checkpoint) {
    const Settings settings = run.world().settings();
    Runner runner(std::move(run), options, usual_checkpoint);
    warnOfLongSteps(settings);
    noteInterrupts();
    const auto failure = runner.simulate(options.quiet || options.json ? Progress::Wish::hide : Progress::Wish::show);
    const Report report = runner.report();
    if (options.json) {
        printOut(toJson(report).dump(2) + '\n');
    } else if (!options.quiet) {
        printOut(formatTable(report));
    }
    if (!failure) return fine;
    printError(*failure);
    return run_failed;
}

}  // namespace cairn::cli
