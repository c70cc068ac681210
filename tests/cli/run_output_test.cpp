/// @file What `cairn run` reports, records and exports.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>

#include "cairn/recording.h"
#include "cli/cli_fixture.h"

namespace cairn::test {
namespace {

using nlohmann::json;

std::set<std::string> keysOf(const json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.insert(key);
    return keys;
}

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST_F(CommandLine, jsonIsOneObjectWithAllKeys) {
    const Finished done = cairn({"run", "tower:3", "--threads", "1", "--duration", "0.5", "--json"});
    ASSERT_EQ(done.code, 0) << done.error;
    EXPECT_EQ(done.error, "");
    const json report = json::parse(done.out);
    EXPECT_EQ(keysOf(report),
              (std::set<std::string>{"scene", "bodies", "threads", "steps", "steps_per_second", "seconds",
                                     "wall_seconds", "ms_per_simulation_step", "real_time", "stages_ms", "contacts",
                                     "iterations", "corrected_contacts", "displaced_bodies", "overlap_mm", "energy_J",
                                     "asleep", "lost", "state_hash"}));
    EXPECT_EQ(keysOf(report["ms_per_simulation_step"]), (std::set<std::string>{"average", "median", "p99", "worst"}));
    EXPECT_EQ(keysOf(report["iterations"]), (std::set<std::string>{"global", "shock"}));
    EXPECT_EQ(keysOf(report["overlap_mm"]), (std::set<std::string>{"largest", "mean", "last"}));
    EXPECT_EQ(keysOf(report["energy_J"]), (std::set<std::string>{"kinetic", "potential"}));
    EXPECT_EQ(keysOf(report["stages_ms"]), std::set<std::string>(stage_names.begin(), stage_names.end()));
    EXPECT_EQ(report["bodies"], 4);
    EXPECT_EQ(report["threads"], 1);
    EXPECT_EQ(report["steps"], 15);
    EXPECT_NEAR(report["seconds"].get<double>(), 0.5, 1e-9);
    EXPECT_EQ(report["lost"], 0);
    const json& ms = report["ms_per_simulation_step"];
    EXPECT_LE(ms["median"].get<double>(), ms["p99"].get<double>());
    EXPECT_LE(ms["p99"].get<double>(), ms["worst"].get<double>());
    EXPECT_NEAR(ms["average"].get<double>() * 15, report["wall_seconds"].get<double>() * 1000, 1e-6);
    EXPECT_EQ(report["real_time"].get<bool>(), ms["worst"].get<double>() <= 100.0 / 3);
    const std::string hash = report["state_hash"];
    EXPECT_EQ(hash.size(), 16U);
    EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos) << hash;
}

TEST_F(CommandLine, recordsForcesAndFramesAtAnyRate) {
    const std::filesystem::path recorded = file("forces.h5");
    const Finished done = cairn({"run", "tower:3", "--duration", "0.5", "--quiet", "--record", recorded.string(),
                                 "--frame-rate", "50", "--record-contacts", "--record-joints"});
    ASSERT_EQ(done.code, 0) << done.error;
    const RecordingReader recording(recorded);
    EXPECT_EQ(recording.info().frames, 26U);
    EXPECT_FALSE(recording.frame(25).contact_impulse.empty());
    EXPECT_EQ(cairn({"export", recorded.string(), "--vtk", (folder() / "out").string()}).code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder() / "out_forces.pvd"));
    for (const std::vector<std::string>& alone :
         {std::vector<std::string>{"--frame-rate", "50"}, {"--record-contacts"}, {"--record-joints"}}) {
        std::vector<std::string> arguments{"run", "tower:3"};
        arguments.insert(arguments.end(), alone.begin(), alone.end());
        const Finished refused = cairn(arguments);
        EXPECT_EQ(refused.code, 2);
        EXPECT_NE(refused.error.find(alone[0] + " needs --record"), std::string::npos) << refused.error;
    }
    EXPECT_EQ(cairn({"run", "tower:3", "--record", recorded.string(), "--frame-rate", "1e9"}).code, 2);
}

TEST_F(CommandLine, farTooLongTimeStepsAreWarnedOfWithTheNumberThatWouldDo) {
    const auto errorsAt = [&](const char* steps_per_second) {
        const Finished done =
            cairn({"run", "tower:2", "--steps-per-second", steps_per_second, "--duration", "0.1", "--json"});
        EXPECT_EQ(done.code, 0) << done.error;
        EXPECT_TRUE(json::accept(done.out)) << done.out;
        return done.error;
    };
    const std::string few = errorsAt("50");
    EXPECT_NE(few.find("warning: 50 time steps per second are too few"), std::string::npos) << few;
    EXPECT_NE(few.find("240 would do"), std::string::npos) << few;
    EXPECT_EQ(errorsAt("60"), "");
}

TEST_F(CommandLine, anyNumberOfTimeStepsRunsForAsLong) {
    for (const char* steps : {"7.5", "29", "100", "1000"}) {
        const std::string recording = file(std::string("at") + steps + ".h5");
        const Finished done =
            cairn({"run", "tower:2", "--steps-per-second", steps, "--duration", "2", "--json", "--record", recording});
        EXPECT_EQ(done.code, 0) << done.error;
        const json report = json::parse(done.out);
        EXPECT_EQ(report["steps_per_second"], std::stod(steps));
        EXPECT_GE(report["seconds"], 2 - 1e-9) << steps;
        EXPECT_LT(report["seconds"], 2 + 1 / std::stod(steps)) << steps;
        EXPECT_NEAR(report["steps"].get<double>(), 60, 4) << steps;
    }
}

/// Copies a recording with one number changed: where body 2 was in frame 10, which ends with time step 80.
void forge(const std::filesystem::path& from, const std::filesystem::path& to) {
    const RecordingReader reader(from);
    const RecordingInfo& info = reader.info();
    RecordingWriter writer(to, info.scene, settingsFor(info.scene), {.hashes_per_frame = info.hashes_per_frame});
    for (std::size_t i = 0; i < info.frames; ++i) {
        Frame frame = reader.frame(i);
        if (i == 10) frame.position[2].x() += 1e-9;
        writer.append(frame);
    }
    writer.close();
}

TEST_F(CommandLine, checksChangeNothingOfASoundRun) {
    const std::vector<std::string> arguments = {"run", "tower:3", "--duration", "0.5", "--json"};
    std::vector<std::string> checked = arguments;
    checked.emplace_back("--check");
    const Finished without = cairn(arguments);
    const Finished with = cairn(checked);
    ASSERT_EQ(with.code, 0) << with.error;
    EXPECT_EQ(json::parse(with.out)["state_hash"], json::parse(without.out)["state_hash"]);
}

TEST_F(CommandLine, aReplayIsProvedAndTheFirstDifferenceIsNamed) {
    for (const bool hashes : {false, true}) {
        std::vector<std::string> arguments = {"run", "tower:3", "--duration", "0.5", "--quiet", "--record", "r.h5"};
        if (hashes) arguments.emplace_back("--hashes");
        ASSERT_EQ(cairn(arguments).code, 0);
        const Finished same = cairn({"replay", "r.h5", "--verify"});
        EXPECT_EQ(same.code, 0) << same.error;
        EXPECT_TRUE(same.out.starts_with(hashes ? "verified: 120 time steps" : "verified: 15 frames")) << same.out;

        forge(file("r.h5"), file("forged.h5"));
        const Finished other = cairn({"replay", "forged.h5", "--verify"});
        EXPECT_EQ(other.code, 1);
        EXPECT_EQ(other.out, "");
        EXPECT_NE(other.error.find("the replay differs from time step 80 on, first body 2"), std::string::npos)
            << other.error;
    }
}

TEST_F(CommandLine, theReportIsThatOfTheLibrary) {
    Scene scene = builtInScene("tower:3");
    const Settings settings = settingsFor(scene, {Preset::accuracy, 480, {{"sleeping", "false"}}});
    SceneRun run(scene, settings);
    Statistics total;
    for (int i = 0; i < 6; ++i) total.add(run.simulationStep());
    const Finished done = cairn({"run", "tower:3", "--preset", "accuracy", "--steps-per-second", "480", "--set",
                                 "sleeping=false", "--duration", "0.2", "--threads", "1", "--json"});
    ASSERT_EQ(done.code, 0) << done.error;
    const json report = json::parse(done.out);
    EXPECT_EQ(std::stoull(report["state_hash"].get<std::string>(), nullptr, 16), run.world().stateHash());
    EXPECT_EQ(report["contacts"], total.contacts);
    EXPECT_EQ(report["iterations"]["global"], total.global_iterations);
    EXPECT_EQ(report["iterations"]["shock"], total.shock_iterations);
    EXPECT_EQ(report["energy_J"]["potential"], run.world().potentialEnergy());
    EXPECT_EQ(report["overlap_mm"]["largest"], 1000 * total.largest_overlap);
}

TEST_F(CommandLine, theTableNamesEveryFigureAndQuietNone) {
    const Finished table = cairn({"run", "tower:2", "--threads", "1", "--duration", "0.1"});
    ASSERT_EQ(table.code, 0) << table.error;
    EXPECT_EQ(table.error, "") << "no progress bar, as nobody watches";
    for (const char* word : {"tower",
                             "3 bodies",
                             "total",
                             "average",
                             "median",
                             "99 %",
                             "worst",
                             "real time",
                             "resolution",
                             "contacts",
                             "global",
                             "shock",
                             "corrected contacts",
                             "displaced bodies",
                             "overlap",
                             "kinetic",
                             "potential",
                             "asleep",
                             "lost",
                             "state hash"}) {
        EXPECT_NE(table.out.find(word), std::string::npos) << word;
    }
    const Finished quiet = cairn({"run", "tower:2", "--threads", "1", "--duration", "0.1", "--quiet"});
    EXPECT_EQ(quiet.code, 0);
    EXPECT_EQ(quiet.out + quiet.error, "");
}

TEST_F(CommandLine, runsWithAllCoresByDefault) {
    const Finished done = cairn({"run", "tower:2", "--duration", "0.03", "--json"});
    ASSERT_EQ(done.code, 0) << done.error;
    EXPECT_EQ(json::parse(done.out)["threads"], std::thread::hardware_concurrency());
}

TEST_F(CommandLine, anEmptySceneRuns) {
    write("empty.json",
          "{\"name\": \"empty\", \"duration\": 0.1, \"gravity\": [0, 0, -10], \"materials\": {}, "
          "\"bodies\": []}");
    const Finished done = cairn({"run", "empty.json", "--record", "a.h5", "--json"});
    ASSERT_EQ(done.code, 0) << done.error;
    EXPECT_EQ(json::parse(done.out)["bodies"], 0);
    EXPECT_EQ(RecordingReader(file("a.h5")).info().frames, 4U);
}

TEST_F(CommandLine, statisticsHaveARowPerSimulationStep) {
    const Finished done =
        cairn({"run", "tower:3", "--threads", "1", "--duration", "0.5", "--stats", "a.csv", "--json"});
    ASSERT_EQ(done.code, 0) << done.error;
    const std::string text = read("a.csv");
    EXPECT_EQ(text.substr(0, text.find('\n')),
              "step,time,ms,events_ms,positions_ms,detection_ms,batches_ms,correction_ms,velocities_ms,resolution_ms,"
              "sleeping_ms,output_ms,contacts,penetrating_contacts,corrected_contacts,uncorrected_contacts,"
              "displaced_bodies,global_iterations,shock_iterations,shock_batches,batches,largest_batch,asleep,woken,"
              "largest_overlap_m,mean_overlap_m,kinetic_energy_J,potential_energy_J");
    EXPECT_EQ(lines(text), 16U);
    // The contacts of all rows are those of the report.
    std::istringstream rows(text);
    std::string row;
    std::getline(rows, row);
    std::int64_t contacts = 0;
    while (std::getline(rows, row)) {
        EXPECT_EQ(std::count(row.begin(), row.end(), ','), 27) << row;
        std::size_t at = 0;
        for (int column = 0; column < 12; ++column) at = row.find(',', at) + 1;
        contacts += std::stoll(row.substr(at));
    }
    EXPECT_EQ(json::parse(done.out)["contacts"], contacts);
}

TEST_F(CommandLine, recordsDescribesAndExports) {
    ASSERT_EQ(cairn({"run", "tower:3", "--threads", "1", "--duration", "0.2", "--record", "a.h5", "--quiet"}).code, 0);
    {
        const RecordingReader reader(file("a.h5"));
        EXPECT_EQ(reader.info().frames, 7U) << "the initial state and six simulation steps";
        EXPECT_EQ(reader.info().scene.duration, 0.2);
        EXPECT_EQ(reader.frame(0).time, 0);
        EXPECT_EQ(reader.frame(0).position[1], builtInScene("tower:3").bodies[1].position);
        EXPECT_NEAR(reader.frame(6).time, 0.2, 1e-9);
        EXPECT_GT(reader.frame(6).statistics.contacts, 0);
    }
    const Finished info = cairn({"info", "a.h5"});
    EXPECT_EQ(info.code, 0) << info.error;
    for (const char* word : {"7 frames", "0 to 0.2 s", "tower", "threads = 1", "machine"}) {
        EXPECT_NE(info.out.find(word), std::string::npos) << word << info.out;
    }
    ASSERT_EQ(cairn({"export", "a.h5", "--csv", "a.csv", "--vtk", "a.pvd"}).code, 0);
    EXPECT_EQ(lines(read("a.csv")), 1U + 7 * 4);
    EXPECT_TRUE(std::filesystem::exists(file("a/a_000006.vtp")));
    const Finished same = cairn({"export", "a.h5", "--csv", "a.h5"});
    EXPECT_EQ(same.code, 2);
    EXPECT_EQ(RecordingReader(file("a.h5")).info().frames, 7U);
}

TEST_F(CommandLine, outputsThatCannotBeWrittenEndTheRun) {
    for (const std::string option : {"--record", "--stats"}) {
        const Finished done = cairn({"run", "tower:2", "--threads", "1", option, "no/such/file"});
        EXPECT_EQ(done.code, 1);
        EXPECT_NE(done.error.find("cairn: error: no/such/file: "), std::string::npos) << done.error;
    }
    const Finished full =
        cairn({"run", "tower:2", "--threads", "1", "--duration", "0.1", "--stats", "/dev/full", "--quiet"});
    EXPECT_EQ(full.code, 1);
    EXPECT_NE(full.error.find("/dev/full: cannot be written: No space left"), std::string::npos) << full.error;
}

/// A hull whose points all lie above the origin of their frame stands on the ground, with that origin below it.
TEST_F(CommandLine, aHullIsNotLostWhereTheOriginOfItsFrameIs) {
    write("hull.json", R"({"name":"hull","duration":0.1,"gravity":[0,0,-10],"materials":{"oak":{"density":800}},
        "bodies":[{"shape":{"type":"plane","normal":[0,0,1],"offset":0},"material":"oak","fixed":true},
          {"shape":{"type":"hull","points":[[0,0,0.3],[1,0,0.3],[0,1,0.3],[0,0,1.3]]},"material":"oak",
           "position":[0,0,-0.3]}]})");
    const Finished done = cairn({"run", "hull.json", "--threads", "1", "--json"});
    EXPECT_EQ(done.code, 0) << done.error;
    EXPECT_EQ(json::parse(done.out)["lost"], 0);
}

TEST_F(CommandLine, aBodyThatBecomesNonFiniteEndsTheRunAndKeepsTheRecording) {
    Scene scene = builtInScene("tower:2");
    scene.bodies[2].name = "victim";
    scene.events = {{0.1, GiveImpulse{2, Vec3(1e28, 0, 0)}}};
    write("fault.json", formatScene(scene));
    const Finished done = cairn({"run", "fault.json", "--threads", "1", "--record", "a.h5", "--json"});
    EXPECT_EQ(done.code, 1);
    EXPECT_NE(done.error.find("body 2 'victim' failed in time step 25"), std::string::npos) << done.error;
    EXPECT_EQ(json::parse(done.out)["lost"], 1);
    const RecordingReader reader(file("a.h5"));
    EXPECT_EQ(reader.info().frames, 5U) << "the last one is that of the simulation step with the fault";
    for (std::size_t i = 0; i < 5; ++i) EXPECT_TRUE(reader.frame(i).position[2].allFinite());
}

/// Frames that are in a recording so far; 0 while it is being made.
std::size_t framesSoFar(const std::filesystem::path& recording) {
    try {
        return RecordingReader(recording).info().frames;
    } catch (const IoError&) {
        return 0;
    }
}

TEST_F(CommandLine, anInterruptEndsTheRunAfterItsStepAndKeepsTheRecording) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        Program program(folder(), {"run", "tower:3", "--threads", "1", "--duration", "1e6", "--record", "a.h5"});
        while (framesSoFar(file("a.h5")) < 3) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        program.send(signal);
        const Finished done = program.finish();
        EXPECT_EQ(done.code, 1);
        EXPECT_NE(done.error.find("cairn: error: interrupted after "), std::string::npos) << done.error;
        EXPECT_NE(done.out.find("state hash"), std::string::npos) << done.out;
        const RecordingReader reader(file("a.h5"));
        ASSERT_GE(reader.info().frames, 3U);
        const std::size_t last = reader.info().frames - 1;
        EXPECT_NEAR(reader.frame(last).time, static_cast<double>(last) / 30, 1e-9);
        std::filesystem::remove(file("a.h5"));
    }
}

TEST_F(CommandLine, aKilledRunLeavesAReadableRecording) {
    Program program(folder(), {"run", "tower:3", "--threads", "1", "--duration", "1e6", "--record", "a.h5"});
    while (framesSoFar(file("a.h5")) < 3) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    program.send(SIGKILL);
    EXPECT_EQ(program.finish().code, -1);
    const Finished info = cairn({"info", "a.h5"});
    EXPECT_EQ(info.code, 0) << info.error;
    EXPECT_EQ(cairn({"export", "a.h5", "--csv", "a.csv"}).code, 0);
    EXPECT_EQ(lines(read("a.csv")), 1 + 4 * RecordingReader(file("a.h5")).info().frames);
}

}  // namespace
}  // namespace cairn::test
