/// @file Runs that ranks share.
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cairn/recording.h"
#include "cli/cli_fixture.h"

namespace cairn::test {
namespace {

using nlohmann::json;

class SharedRuns : public CommandLine {
  protected:
    json reportOf(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--json"});
        const Finished done = cairn(arguments);
        EXPECT_EQ(done.code, 0) << done.error;
        return json::parse(done.out);
    }
};

/// Bit by bit, but for wall times.
void expectEqual(const Frame& a, const Frame& b) {
    EXPECT_EQ(a.time, b.time);
    const auto same = [](const auto& some, const auto& others) {
        return some.size() == others.size() &&
               std::memcmp(some.data(), others.data(), some.size() * sizeof(*some.data())) == 0;
    };
    EXPECT_TRUE(same(a.position, b.position));
    EXPECT_TRUE(same(a.orientation, b.orientation));
    EXPECT_TRUE(same(a.linear_velocity, b.linear_velocity));
    EXPECT_TRUE(same(a.angular_velocity, b.angular_velocity));
    EXPECT_EQ(a.asleep, b.asleep);
    EXPECT_EQ(a.step_hashes, b.step_hashes);
    EXPECT_EQ(a.kinetic_energy, b.kinetic_energy);
    EXPECT_EQ(a.potential_energy, b.potential_energy);
    EXPECT_EQ(a.statistics.contacts, b.statistics.contacts);
    EXPECT_EQ(a.statistics.mean_overlap, b.statistics.mean_overlap);
    EXPECT_EQ(a.contact_a, b.contact_a);
    EXPECT_EQ(a.contact_b, b.contact_b);
    EXPECT_EQ(a.contact_impulse, b.contact_impulse);
    EXPECT_TRUE(same(a.joint_point, b.joint_point));
    EXPECT_TRUE(same(a.joint_force, b.joint_force));
    EXPECT_TRUE(same(a.joint_torque, b.joint_torque));
}

TEST_F(SharedRuns, EndAsThoseOfOneRank) {
    const std::vector<std::string> run{"run", "stacks5", "--duration", "1"};
    const json one = reportOf(run);
    EXPECT_FALSE(one.contains("ranks"));
    for (const std::vector<std::string>& division :
         {std::vector<std::string>{"--ranks", "1"},
          {"--ranks", "2", "--partition", "x"},
          {"--ranks", "4"},
          {"--ranks", "2x2x1"},
          {"--ranks", "3", "--partition", "hash"},
          {"--ranks", "3", "--rebalance-every", "5", "--message-delay", "20,1,50"}}) {
        std::vector<std::string> shared = run;
        shared.insert(shared.end(), division.begin(), division.end());
        json report = reportOf(shared);
        for (const std::string key : {"state_hash", "contacts", "iterations", "energy_J", "asleep", "lost"}) {
            EXPECT_EQ(report[key], one[key]) << key;
        }
        EXPECT_EQ(report["overlap_mm"], one["overlap_mm"]);
        const int count = report["ranks"]["count"];
        EXPECT_EQ(count, division[1] == "2x2x1" ? 4 : std::stoi(division[1]));
        EXPECT_EQ(report["ranks"]["bytes"] > 0, count > 1);
        EXPECT_GT(report["ranks"]["rounds"], 0);
    }
}

TEST_F(SharedRuns, SayWhatTheRanksTold) {
    const Finished done = cairn({"run", "tower:3", "--duration", "0.1", "--ranks", "2"});
    EXPECT_NE(done.out.find("ranks                     2; waiting"), std::string::npos) << done.out;
    EXPECT_NE(done.out.find("rounds"), std::string::npos) << done.out;
}

TEST_F(SharedRuns, RecordWhatOneRankRecords) {
    const std::vector<std::string> run{"run",      "stacks5",           "--duration", "0.5",
                                       "--hashes", "--record-contacts", "--quiet",    "--record"};
    std::vector<std::string> alone = run;
    alone.emplace_back("one.h5");
    std::vector<std::string> shared = run;
    shared.insert(shared.end(), {"three.h5", "--ranks", "3", "--partition", "hash", "--stats", "three.csv"});
    ASSERT_EQ(cairn(alone).code, 0);
    ASSERT_EQ(cairn(shared).code, 0);
    EXPECT_TRUE(std::filesystem::exists(file("three.rank2.h5")));
    const Finished merged = cairn({"merge", "three.h5", "three.rank0.h5", "--out", "merged.h5"});
    EXPECT_EQ(merged.code, 0) << merged.error;
    const RecordingReader one(file("one.h5"));
    for (const std::string name : {"three.h5", "merged.h5"}) {
        const Finished verified = cairn({"replay", name, "--verify"});
        EXPECT_EQ(verified.code, 0) << verified.error;
        const RecordingReader other(file(name));
        ASSERT_EQ(one.info().frames, other.info().frames);
        EXPECT_EQ(other.info().parts, name == "three.h5" ? 3 : 0);
        for (std::size_t i = 0; i < one.info().frames; ++i) expectEqual(one.frame(i), other.frame(i));
    }
    // Each moving body is in the part of one rank.
    const RecordingReader three(file("three.h5"));
    const Frame whole = three.frame(7);
    std::vector<int> found(three.info().bodies);
    for (std::size_t part = 0; part < 3; ++part) {
        const Frame of_rank = three.framePart(7, part);
        EXPECT_EQ(of_rank.time, whole.time);
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (!of_rank.position[i].allFinite()) continue;
            ++found[i];
            EXPECT_EQ(of_rank.position[i], whole.position[i]);
        }
    }
    for (const int times : found) EXPECT_EQ(times, 1);
    EXPECT_THROW(three.framePart(7, 3), InputError);
    EXPECT_THROW(one.framePart(7, 0), InputError);
    EXPECT_EQ(cairn({"export", "three.h5", "--vtk", "three.pvd"}).code, 0);
    const std::string series = read("three.pvd");
    for (const std::string rank : {"0", "1", "2"}) {
        const std::string piece = "three/three_rank" + rank + "_000007.vtp";
        EXPECT_TRUE(std::filesystem::exists(file(piece)));
        EXPECT_NE(series.find("part=\"" + rank + "\" file=\"" + piece + "\""), std::string::npos) << piece;
    }
    expectWrongUse({"merge", "merged.h5", "--out", "again.h5"}, {"nothing to merge"});
    expectWrongUse({"merge", "three.h5", "--out", "three.rank1.h5"}, {"name another for --out"});
    expectWrongUse({"merge", "three.h5", "one.h5", "--out", "x.h5"}, {"'one.h5' is no part"});
    // A part of another run must not be taken for one of this.
    shared[8] = "other.h5";
    ASSERT_EQ(cairn(shared).code, 0);
    std::filesystem::copy_file(file("other.rank1.h5"), file("three.rank1.h5"),
                               std::filesystem::copy_options::overwrite_existing);
    const Finished mixed = cairn({"replay", "three.h5", "--verify"});
    EXPECT_EQ(mixed.code, 1);
    EXPECT_NE(mixed.error.find("a part of another recording"), std::string::npos) << mixed.error;
    std::filesystem::remove(file("three.rank1.h5"));
    EXPECT_NE(cairn({"info", "three.h5"}).error.find("a part of the recording"), std::string::npos);
}

TEST_F(SharedRuns, RecordTheForcesOfJoints) {
    const std::vector<std::string> run{"run",     "cradle_swing:5:2", "--duration", "0.3",
                                       "--quiet", "--record-joints",  "--record"};
    std::vector<std::string> alone = run;
    alone.emplace_back("one.h5");
    std::vector<std::string> shared = run;
    shared.insert(shared.end(), {"two.h5", "--ranks", "2", "--partition", "hash"});
    ASSERT_EQ(cairn(alone).code, 0);
    ASSERT_EQ(cairn(shared).code, 0);
    const RecordingReader one(file("one.h5"));
    const RecordingReader two(file("two.h5"));
    ASSERT_EQ(one.info().frames, two.info().frames);
    ASSERT_TRUE(two.info().joints);
    for (std::size_t i = 0; i < one.info().frames; ++i) expectEqual(one.frame(i), two.frame(i));
}

TEST_F(SharedRuns, GoOnFromCheckpointsOnAnyNumberOfRanks) {
    ASSERT_EQ(cairn({"run", "stacks5", "--duration", "0.5", "--quiet", "--checkpoint", "every=0s,file=half", "--ranks",
                     "4", "--partition", "hash"})
                  .code,
              0);
    const json whole = reportOf({"run", "stacks5", "--duration", "1"});
    for (const std::vector<std::string>& ranks :
         {std::vector<std::string>{}, {"--ranks", "2"}, {"--ranks", "5", "--partition", "y"}}) {
        std::vector<std::string> resume{"resume", "half", "--duration", "1"};
        resume.insert(resume.end(), ranks.begin(), ranks.end());
        EXPECT_EQ(reportOf(resume)["state_hash"], whole["state_hash"]);
    }
    // A checkpoint consists of all its parts, and of no others.
    std::size_t parts = 0;
    std::filesystem::path last;
    for (const auto& entry : std::filesystem::directory_iterator(file("half.parts"))) {
        ++parts;
        if (entry.path().extension() == ".rank3") last = entry.path();
    }
    EXPECT_EQ(parts, 5) << "of four ranks, and the scene";
    std::ofstream(last, std::ios::app) << "x";
    const Finished damaged = cairn({"resume", "half", "--duration", "1"});
    EXPECT_EQ(damaged.code, 2);
    EXPECT_NE(damaged.error.find("is not the part that"), std::string::npos) << damaged.error;
    std::filesystem::remove(last);
    EXPECT_NE(cairn({"resume", "half", "--duration", "1"}).error.find("copy the folder"), std::string::npos);
}

TEST_F(SharedRuns, TellWhatCannotBe) {
    expectWrongUse({"run", "stacks5", "--ranks", "0"}, {"--ranks is '0'", "such as 4"});
    expectWrongUse({"run", "stacks5", "--ranks", "2x2"}, {"--ranks is '2x2'", "2x2x1"});
    expectWrongUse({"run", "stacks5", "--ranks", "100x100x1"}, {"10000 ranks; 1024 are the most"});
    expectWrongUse({"run", "stacks5", "--ranks", "2x1x1", "--partition", "x"}, {"leave out --partition"});
    expectWrongUse({"run", "stacks5", "--ranks", "2", "--partition", "q"}, {"partition 'q' is unknown", "hash"});
    expectWrongUse({"run", "stacks5", "--partition", "x"}, {"--partition needs --ranks, or mpirun"});
    expectWrongUse({"run", "stacks5", "--ranks", "2", "--message-delay", "5"}, {"--message-delay is '5'", "5,1"});
    expectWrongUse({"run", "stacks5", "--ranks", "2", "--patience", "-1"}, {"--patience is -1", "0 to wait for ever"});
    expectWrongUse({"run", "stacks5", "--ranks", "2", "--rebalance-every", "-1"}, {"--rebalance-every is -1"});
    expectWrongUse({"run", "nothing", "--ranks", "3"}, {"no built-in scene and no file 'nothing'"});
}

TEST_F(SharedRuns, EndOnAllRanksWhenAnOutputFails) {
    const Finished done =
        cairn({"run", "tower:3", "--ranks", "3", "--quiet", "--checkpoint", "every=0s,file=missing/c"});
    EXPECT_EQ(done.code, 1);
    EXPECT_NE(done.error.find("missing/c"), std::string::npos) << done.error;
    const Finished full = cairn({"run", "tower:3", "--ranks", "3", "--quiet", "--stats", "/dev/full"});
    EXPECT_EQ(full.code, 1);
    EXPECT_NE(full.error.find("/dev/full"), std::string::npos) << full.error;
    // A part that cannot be written ends all ranks, with a whole checkpoint.
    std::filesystem::create_symlink("/dev/full", file("part.rank1.h5"));
    const Finished part = cairn(
        {"run", "tower:3", "--ranks", "3", "--quiet", "--checkpoint", "every=0s,file=kept", "--record", "part.h5"});
    EXPECT_EQ(part.code, 1);
    EXPECT_NE(part.error.find("part.rank1.h5"), std::string::npos) << part.error;
    EXPECT_EQ(part.error.find("part.rank1.h5"), part.error.rfind("part.rank1.h5")) << "told once: " << part.error;
    const Finished resumed = cairn({"resume", "kept", "--json"});
    EXPECT_EQ(resumed.code, 0) << resumed.error;
    EXPECT_EQ(json::parse(resumed.out)["state_hash"], reportOf({"run", "tower:3"})["state_hash"]);
}

#ifdef CAIRN_MPIRUN
/// Runs the program by mpirun. @return its exit code; the output is in the file "out"
class MpiRuns : public SharedRuns {
  protected:
    int mpirun(int count, const std::string& arguments) const {
        const std::string command = "cd " + folder().string() +
                                    " && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
                                    "OMPI_MCA_btl_vader_single_copy_mechanism=none "
                                    "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_plm_rsh_agent=false " CAIRN_MPIRUN
                                    " -n " +
                                    std::to_string(count) + " " CAIRN_PROGRAM " " + arguments + " >out 2>error";
        const int status = std::system(command.c_str());
        return WEXITSTATUS(status);
    }
};

TEST_F(MpiRuns, EndAsThoseOfOneRank) {
    const json one = reportOf({"run", "stacks5", "--duration", "0.5"});
    for (const int count : {2, 4}) {
        ASSERT_EQ(mpirun(count, "run stacks5 --duration 0.5 --json"), 0) << read("error");
        const json report = json::parse(read("out"));
        EXPECT_EQ(report["state_hash"], one["state_hash"]);
        EXPECT_EQ(report["ranks"]["count"], count);
    }
    ASSERT_EQ(mpirun(4, "run stacks5 --duration 0.5 --json --ranks 2x1x2"), 0) << read("error");
    EXPECT_EQ(json::parse(read("out"))["state_hash"], one["state_hash"]);
}

TEST_F(MpiRuns, TellOnceWhatIsWrong) {
    EXPECT_EQ(mpirun(2, "run nothing"), 2);
    const std::string error = read("error");
    const std::string text = "cairn: error: there is no built-in scene";
    const std::size_t first = error.find(text);
    ASSERT_NE(first, std::string::npos) << error;
    EXPECT_EQ(error.find(text, first + 1), std::string::npos) << error;
    EXPECT_EQ(mpirun(2, "run stacks5 --ranks 3"), 2);
    EXPECT_NE(read("error").find("--ranks asks for 3 ranks, mpirun started 2"), std::string::npos);
}

TEST_F(MpiRuns, EndAllRanksWhenOneFails) {
    EXPECT_EQ(mpirun(3, "run tower:3 --quiet --checkpoint every=0s,file=missing/c"), 1);
    const std::string error = read("error");
    const std::size_t first = error.find("missing/c");
    ASSERT_NE(first, std::string::npos) << error;
    EXPECT_EQ(error.find("cairn: error", error.find("cairn: error") + 1), std::string::npos) << "told once: " << error;
}
#endif

}  // namespace
}  // namespace cairn::test
