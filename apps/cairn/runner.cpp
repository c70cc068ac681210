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
    const std::string& name = run.world().name(fault.body);
    return fmt::format("body {}{} failed in time step {} and was fixed: {}", index,
                       name.empty() ? "" : fmt::format(" '{}'", name), fault.step, fault.what);
}

/// A run with its outputs.
class Runner {
  public:
    Runner(SceneRun run, const OutputOptions& options, const std::filesystem::path& usual_checkpoint, Ranks* ranks)
        : run_(std::move(run)), together_(ranks) {
        if (options.check) run_.world().setChecks(Checks::on);
        if (auto option = parseCheckpoint(options.checkpoint, usual_checkpoint)) checkpoints_.emplace(*option);
        hashed_ = options.hashes;
        records_ = !options.record.empty();
        counts_ = !options.stats.empty();
        const double steps = run_.world().settings().steps_per_second;
        recorded_.frame_rate = options.frame_rate.value_or(std::min(simulation_steps_per_second, steps));
        recorded_.hashes_per_frame = static_cast<std::size_t>(hashed_ ? std::lround(steps / recorded_.frame_rate) : 0);
        recorded_.contacts = options.record_contacts;
        recorded_.joints = options.record_joints;
        if (records_ && together_.isShared()) {
            recorded_.parts = together_.size();
            const auto now = std::chrono::system_clock::now().time_since_epoch();
            recorded_.mark = together_.numberOfFirst(
                static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count()));
        }
        openOutputs(options);
    }

    /// @return what cannot be written, so that nothing is to be simulated
    std::optional<std::string> problem() { return together_.firstOf(failure_); }

    /// @return why the run ended early, if it did. What failed is an output or a body; wrong events throw InputError
    std::optional<std::string> simulate(Progress::Wish progress_wish) {
        const double duration = run_.scene().duration;
        // A duration such as 0.1 s is not exactly three simulation steps.
        const double all = std::max(1.0, std::ceil(duration * simulation_steps_per_second - 1e-6));
        Progress progress(duration, progress_wish);
        record();
        while (run_.world().time() * simulation_steps_per_second < all - 1e-6) {
            if (const auto end = together_.firstOf(failure_)) return afterFailure(*end);
            if (together_.anywhere(interrupted())) return interruption();
            step();
            if (!failure_ && !run_.world().faults().empty()) {
                failure_ = describeFault(run_, run_.world().faults().front());
            }
            if (checkpoints_ && together_.anywhere(together_.isFirst() && checkpoints_->isDue()) &&
                !together_.anywhere(failure_.has_value())) {
                writeCheckpoint();
            }
            progress.update(run_.world().time());
        }
        tryTo([&] {
            if (recording_) recording_->close();
            if (part_) part_->close();
        });
        return together_.firstOf(failure_);
    }

    /// To be called by all ranks, on the first one for what it tells.
    Report report() {
        const std::optional<RanksReport> ranks = together_.report();
        // Who failed is known to one rank.
        if (together_.anywhere(!run_.world().faults().empty())) run_.world().gather();
        const WorldSums sums = run_.world().sums();
        const std::size_t lost = together_.sum(countLost(run_));
        if (!together_.isFirst()) return {};
        Report report = makeReport(run_, measurements_, sums);
        report.lost = lost;
        report.ranks = ranks;
        return report;
    }

  private:
    /// Writes outputs of this rank. What fails ends the run, on all ranks, when they agree on that next.
    template <class Work>
    void tryTo(const Work& work) {
        if (failure_) return;
        try {
            work();
        } catch (const IoError& error) {
            failure_ = error.what();
            is_output_ = true;
        }
    }

    /// A place that cannot be written is told now and not after the first hours.
    void openOutputs(const OutputOptions& options) {
        const Settings& settings = run_.world().settings();
        if (checkpoints_) writeCheckpoint();
        tryTo([&] {
            if (records_ && together_.isFirst()) {
                recording_.emplace(options.record, run_.source(), settings, recorded_);
            }
            if (records_ && together_.isShared()) part_.emplace(options.record, together_.rank(), recorded_);
            if (counts_ && together_.isFirst()) stats_.emplace(options.stats, settings);
        });
    }

    /// All ranks write it, and it fails on all if it fails on one.
    void writeCheckpoint() {
        tryTo([&] { checkpoints_->write(run_); });
    }

    /// When an output failed, the run is kept as it is, so that it can go on when there is room again.
    std::string afterFailure(const std::string& text) {
        if (!checkpoints_ || !together_.anywhere(is_output_)) return text;
        try {
            checkpoints_->write(run_);
        } catch (const IoError&) {
            return text;
        }
        return text + "; " + remedy();
    }

    std::string remedy() const { return fmt::format("'cairn resume {}' goes on", checkpoints_->file().string()); }

    /// A simulation step of 1/30 s, or longer if the time steps are; frames are recorded within it, too.
    void step() {
        const double begin = run_.world().time();
        double ms = 0;
        Statistics sum;
        for (int left = run_.stepsPerSimulationStep(); left > 0; --left) {
            ms += timeStep();
            sum.add(run_.world().statistics());
            if (records_ && isFrameDue(run_, recorded_.frame_rate)) record();
        }
        if (together_.isShared()) sum = together_.total(sum, run_.world().meanOverlap());
        const double simulated = (run_.world().time() - begin) * simulation_steps_per_second;
        measurements_.add(ms, static_cast<std::size_t>(std::max(1.0, std::round(simulated))), sum);
        if (!counts_) return;
        const WorldSums sums = run_.world().sums();
        tryTo([&] {
            if (stats_) stats_->add(run_.world(), ms, sum, sums);
        });
    }

    /// @return wall time [ms]
    double timeStep() {
        using Milliseconds = std::chrono::duration<double, std::milli>;
        const auto begin = std::chrono::steady_clock::now();
        run_.step();
        if (hashed_) hashes_.push_back(together_.hash(run_.world()));
        since_frame_.add(run_.world().statistics());
        return Milliseconds(std::chrono::steady_clock::now() - begin).count();
    }

    void record() {
        if (!records_) return;
        const Statistics own = std::exchange(since_frame_, {});
        if (!together_.isShared()) {
            tryTo([&] {
                Frame frame = captureFrame(run_, own, recorded_);
                frame.step_hashes = std::exchange(hashes_, {});
                recording_->append(frame);
            });
            return;
        }
        const WorldSums sums = run_.world().sums();
        Frame frame;
        frame.time = run_.world().time();
        frame.statistics = together_.total(own, sums.mean_overlap);
        frame.kinetic_energy = sums.kinetic_energy;
        frame.potential_energy = sums.potential_energy;
        frame.step_hashes = std::exchange(hashes_, {});
        tryTo([&] {
            part_->append(captureFramePart(run_, recorded_));
            if (recording_) recording_->append(frame);
        });
    }

    std::string interruption() {
        std::string text = fmt::format("interrupted after {:.6g} of {} s", run_.world().time(), run_.scene().duration);
        if (!checkpoints_) return text;
        writeCheckpoint();
        if (const auto end = together_.firstOf(failure_)) return *end;
        return text + "; " + remedy();
    }

    SceneRun run_;
    Together together_;
    std::optional<std::string> failure_;  ///< that ends the run
    bool is_output_ = false;              ///< that failed
    std::optional<Checkpointer> checkpoints_;
    std::optional<RecordingWriter> recording_;
    std::optional<RecordingPartWriter> part_;  ///< of a run that ranks share
    std::optional<StatsCsv> stats_;
    RecordingOptions recorded_;
    Measurements measurements_;
    bool hashed_ = false;
    bool records_ = false;
    bool counts_ = false;                ///< statistics are written, by the first rank
    std::vector<std::uint64_t> hashes_;  ///< of the time steps since the last frame
    Statistics since_frame_;             ///< of the same
};

/// Piles have been tried with so small a part of the time steps that the sizes of bodies ask for.
constexpr double least_part = 0.25;

void warnOfLongSteps(const World& world) {
    const double steps = world.settings().steps_per_second;
    const double usual = world.stepsPerSecondBySize();
    if (steps >= least_part * usual) return;
    printLine(stderr, fmt::format("cairn: warning: {} time steps per second are too few for bodies as small as these: "
                                  "they overlap more, and fast ones may pass through each other; {} would do",
                                  steps, usual));
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
        if (options.frame_rate) throw InputError("--frame-rate needs --record");
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

int runToTheEnd(SceneRun run, const OutputOptions& options, const std::filesystem::path& usual_checkpoint,
                Ranks* ranks) {
    const bool tells = ranks == nullptr || ranks->rank() == 0;
    if (tells) warnOfLongSteps(run.world());
    Runner runner(std::move(run), options, usual_checkpoint, ranks);
    if (const auto problem = runner.problem()) {
        if (tells) printError(*problem);
        return run_failed;
    }
    catchInterrupts();
    const bool shows = tells && !options.quiet && !options.json;
    const auto failure = runner.simulate(shows ? Progress::Wish::show : Progress::Wish::hide);
    const Report report = runner.report();
    if (!tells) return failure ? run_failed : fine;
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
