/// @file Stopping and going on: `cairn run --checkpoint` and `cairn resume`.
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "cairn/checkpoint.h"
#include "cli/cli_fixture.h"

namespace cairn::test {
namespace {

using nlohmann::json;
using Strings = std::vector<std::string>;

std::string hashOf(const Finished& done) {
    EXPECT_EQ(done.code, 0) << done.error;
    return done.code == 0 ? json::parse(done.out)["state_hash"] : "";
}

TEST_F(CommandLine, aResumedRunEndsInTheStateOfOneThatNeverStopped) {
    const std::string whole = hashOf(cairn({"run", "tower:8", "--duration", "2", "--json"}));
    const Strings first = {"run", "tower:8", "--duration", "1", "--json", "--checkpoint", "every=0s,file=half"};
    ASSERT_EQ(cairn(first).code, 0);
    EXPECT_EQ(hashOf(cairn({"resume", "half", "--duration", "2", "--json"})), whole);
    EXPECT_EQ(hashOf(cairn({"resume", "half", "--duration", "2", "--threads", "3", "--json"})), whole);
    expectWrongUse({"resume", "half"}, {"is at its end", "--duration"});
}

TEST_F(CommandLine, aKilledRunGoesOnFromItsLastCheckpoint) {
    // So many checkpoints take far longer than it takes to kill the run.
    const std::string whole = hashOf(cairn({"run", "tower:8", "--duration", "500", "--json"}));
    {
        Program run(folder(), {"run", "tower:8", "--duration", "500", "--quiet", "--checkpoint", "every=0s"});
        for (int i = 0; i < 2000 && !std::filesystem::exists(file("tower-8.checkpoint")); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        run.send(SIGKILL);
        run.finish();
    }
    ASSERT_TRUE(std::filesystem::exists(file("tower-8.checkpoint")));
    const SceneRun run = readCheckpoint(file("tower-8.checkpoint"));
    ASSERT_LT(run.world().time(), 499) << "the run ended before it could be killed";
    EXPECT_EQ(hashOf(cairn({"resume", "tower-8.checkpoint", "--json"})), whole);
}

TEST_F(CommandLine, anInterruptedRunSaysHowToGoOn) {
    // A wall that slept would be at the end by then.
    Program run(folder(), {"run", "wall:20", "--set", "sleeping=false", "--duration", "500", "--quiet", "--checkpoint",
                           "every=1000s,file=w"});
    for (int i = 0; i < 2000 && !std::filesystem::exists(file("w")); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    run.send(SIGINT);
    const Finished done = run.finish();
    EXPECT_EQ(done.code, 1);
    EXPECT_NE(done.error.find("interrupted after"), std::string::npos) << done.error;
    EXPECT_NE(done.error.find("'cairn resume w' goes on"), std::string::npos) << done.error;
    EXPECT_GT(readCheckpoint(file("w")).world().stepCount(), 0);
}

TEST_F(CommandLine, badCheckpointsAreRefused) {
    const auto refuse = [&](const std::string& text, const Strings& parts) {
        expectWrongUse({"run", "tower:2", "--duration", "0.1", "--checkpoint", text}, parts);
    };
    refuse("10s", {"--checkpoint is '10s'", "every=10s"});
    refuse("every=10", {"every '10'"});
    refuse("every=-1s", {"every '-1s'"});
    refuse("every=1s,file=", {"empty file"});
    const Finished unwritable =
        cairn({"run", "tower:2", "--duration", "0.1", "--checkpoint", "every=1s,file=missing/x"});
    EXPECT_EQ(unwritable.code, 1);
    EXPECT_NE(unwritable.error.find("missing/x.partial: cannot be written: No such file"), std::string::npos)
        << unwritable.error;
    write("text", "not a checkpoint, but long enough to have a head");
    expectWrongUse({"resume", "text"}, {"text is not a snapshot"});
    EXPECT_EQ(cairn({"resume", "nothing"}).code, 1);
}

}  // namespace
}  // namespace cairn::test
