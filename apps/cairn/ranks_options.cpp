#include "ranks_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <vector>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "cli/output.h"
#include "commands.h"

namespace cairn::cli {

namespace {

/// What the options say.
struct RanksWish {
    int count = 0;  ///< 0 = not said
    Partition partition;
    MessageDelay delay;
    double patience = 0;  ///< [s]; 0 = for ever
};

/// Numbers with a letter between them. @return empty if the text is none such
template <class Number>
std::vector<Number> parseNumbers(std::string_view text, char between) {
    std::vector<Number> numbers;
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (;;) {
        const auto [next, error] = std::from_chars(at, end, numbers.emplace_back());
        if (error != std::errc()) return {};
        if (next == end) return numbers;
        if (*next != between) return {};
        at = next + 1;
    }
}

void parseRanks(const std::string& text, RanksWish& wish) {
    const std::vector<int> parts = parseNumbers<int>(text, 'x');
    const bool sound = (parts.size() == 1 || parts.size() == 3) &&
                       std::ranges::all_of(parts, [](int part) { return part >= 1 && part <= 1024; });
    if (!sound) {
        throw InputError(fmt::format("--ranks is '{}'; it must be a number such as 4, or regions such as 2x2x1", text));
    }
    if (parts.size() == 1) {
        wish.count = parts.front();
        return;
    }
    const std::int64_t product = std::int64_t{parts[0]} * parts[1] * parts[2];
    if (product > 1024) throw InputError(fmt::format("--ranks {} are {} ranks; 1024 are the most", text, product));
    wish.count = static_cast<int>(product);
    wish.partition.kind = PartitionKind::grid;
    wish.partition.parts = {parts[0], parts[1], parts[2]};
}

RanksWish parse(const RanksOptions& options) {
    RanksWish wish;
    if (!options.ranks.empty()) parseRanks(options.ranks, wish);
    if (!options.partition.empty()) {
        if (wish.partition.kind == PartitionKind::grid) {
            throw InputError(fmt::format("--ranks {} says how the world is cut; leave out --partition", options.ranks));
        }
        wish.partition.kind = partitionNamed(options.partition);
    }
    if (options.rebalance_every < 0) {
        throw InputError(fmt::format("--rebalance-every is {}; it must be a number of time steps, or 0 for never",
                                     options.rebalance_every));
    }
    wish.partition.rebalance_every = options.rebalance_every;
    if (!options.delay.empty()) {
        const std::vector<double> times = parseNumbers<double>(options.delay, ',');
        const bool sound = std::ranges::all_of(times, [](double time) { return time >= 0 && time <= 1e6; });
        if (times.size() < 2 || times.size() > 3 || !sound) {
            throw InputError(
                fmt::format("--message-delay is '{}'; it must be microseconds per message, nanoseconds per byte and, "
                            "if need be, microseconds that differ from message to message, such as 5,1 or 5,1,20",
                            options.delay));
        }
        wish.delay = {1e-6 * times[0], 1e-9 * times[1], times.size() > 2 ? 1e-6 * times[2] : 0};
    }
    if (!(options.patience >= 0 && options.patience <= 1e6)) {
        throw InputError(fmt::format("--patience is {}; it must be seconds up to a million, or 0 to wait for ever",
                                     options.patience));
    }
    wish.patience = options.patience;
    return wish;
}

/// Prepares the run of one rank; what is wrong with it on any rank ends all, and the first one tells.
int runShared(Ranks& ranks, const RanksWish& wish, const OutputOptions& outputs, const Prepare& prepare) {
    if (wish.patience > 0) ranks.setPatience(wish.patience);
    std::optional<PreparedRun> prepared;
    std::optional<std::string> wrong;
    std::optional<std::string> failed;
    try {
        prepared.emplace(prepare(&ranks, wish.partition));
    } catch (const InputError& error) {
        wrong = error.what();
    } catch (const IoError& error) {
        failed = error.what();
    }
    Together together(&ranks);
    if (const auto said = together.firstOf(wrong)) {
        if (ranks.rank() == 0) throw InputError(*said);
        return wrong_use;
    }
    if (const auto said = together.firstOf(failed)) {
        if (ranks.rank() == 0) throw IoError(*said);
        return run_failed;
    }
    return runToTheEnd(std::move(prepared->run), outputs, prepared->usual_checkpoint, &ranks);
}

/// Large arrays that are given back go to the system at once, so that a rank of many takes what it has and no more.
void keepNoLargeBlocks() {
#ifdef __GLIBC__
    constexpr int largest_kept = 1 << 18;  // [bytes]
    mallopt(M_MMAP_THRESHOLD, largest_kept);
#endif
}

/// Runs as one of the programs that mpirun started. An error that the others do not know of ends them all.
int runByMpi(const RanksWish& wish, const OutputOptions& outputs, const Prepare& prepare) {
    const std::unique_ptr<Ranks> ranks = mpiRanks();
    const auto tell = [&](const std::string& problem, int exit_code) {
        if (ranks->rank() == 0) printError(problem);
        return exit_code;
    };
    if (wish.count != 0 && wish.count != ranks->size()) {
        return tell(fmt::format("--ranks asks for {} ranks, mpirun started {}; let both be equal or leave out --ranks",
                                wish.count, ranks->size()),
                    wrong_use);
    }
    if (wish.delay.per_message > 0 || wish.delay.per_byte > 0 || wish.delay.jitter > 0) {
        return tell("--message-delay is for ranks that are threads of one program; leave it out under mpirun",
                    wrong_use);
    }
    try {
        return runShared(*ranks, wish, outputs, prepare);
    } catch (const InputError& error) {
        return tell(error.what(), wrong_use);
    } catch (const RankLateError& error) {
        printError(error.what());
    } catch (const std::exception& error) {
        printError(fmt::format("rank {}: {}", ranks->rank(), error.what()));
    } catch (const ReaderGone&) {
    }
    ranks->abandon(run_failed);
    return run_failed;
}

}  // namespace

void addRanksOptions(CLI::App& command, RanksOptions& options) {
    command
        .add_option("--ranks", options.ranks,
                    "Share the world among so many ranks, threads of this program with a part of the bodies each; "
                    "under mpirun: how the world is cut")
        ->type_name("N|AxBxC");
    command.add_option("--partition", options.partition, "How ranks cut the world; default: boxes")
        ->type_name("boxes|x|y|z|hash");
    command.add_option("--rebalance-every", options.rebalance_every, "Time steps after which ranks cut the world anew")
        ->type_name("N");
    command
        .add_option("--message-delay", options.delay,
                    "How late messages between ranks come, on purpose: microseconds each, nanoseconds per byte, and "
                    "up to so many microseconds more, by chance")
        ->type_name("US,NS[,US]");
    command
        .add_option("--patience", options.patience,
                    "Seconds that a rank waits for another before all end, and it says for whom; 0 = for ever; "
                    "default: 600")
        ->type_name("SECONDS");
}

int runOnRanks(const RanksOptions& options, const OutputOptions& outputs, const Prepare& prepare) {
    const RanksWish wish = parse(options);
    if (isStartedByMpi() || wish.count > 0) keepNoLargeBlocks();
    if (isStartedByMpi()) return runByMpi(wish, outputs, prepare);
    if (wish.count == 0) {
        for (const auto& [given, name] : {std::pair(!options.partition.empty(), "--partition"),
                                          std::pair(options.rebalance_every != 0, "--rebalance-every"),
                                          std::pair(!options.delay.empty(), "--message-delay")}) {
            if (given) throw InputError(fmt::format("{} needs --ranks, or mpirun", name));
        }
        PreparedRun prepared = prepare(nullptr, wish.partition);
        return runToTheEnd(std::move(prepared.run), outputs, prepared.usual_checkpoint);
    }
    int exit_code = run_failed;
    const auto work = [&](Ranks& ranks) {
        const int code = runShared(ranks, wish, outputs, prepare);
        if (ranks.rank() == 0) exit_code = code;
    };
    runRanks(wish.count, work, wish.delay);
    return exit_code;
}

}  // namespace cairn::cli
