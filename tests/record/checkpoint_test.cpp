/// Checkpoints on disk: whatever happens while one is written, the file is a whole one.
#include "cairn/checkpoint.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "record/atomic_file.h"
#include "temporary_folder.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

class Checkpoint : public testing::Test {
  protected:
    test::TemporaryFolder folder_;
    fs::path file_ = folder_ / "run.checkpoint";
};

SceneRun runOf(const char* name, int steps) {
    const Scene scene = builtInScene(name);
    SceneRun run(scene, settingsFor(scene));
    for (int i = 0; i < steps; ++i) run.step();
    return run;
}

template <class Error, class Action>
std::string messageOf(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST_F(Checkpoint, IsTheRunAndReplacesTheOlderOne) {
    SceneRun run = runOf("tower:5", 20);
    writeCheckpoint(run, file_);
    EXPECT_EQ(readCheckpoint(file_).world().stateHash(), run.world().stateHash());
    run.step();
    writeCheckpoint(run, file_);
    SceneRun copy = readCheckpoint(file_);
    EXPECT_EQ(copy.world().stepCount(), 21);
    run.step();
    copy.step();
    EXPECT_EQ(copy.world().stateHash(), run.world().stateHash());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "nothing else is left";
}

TEST_F(Checkpoint, UnwritablePlacesAreNamed) {
    const SceneRun run = runOf("tower:3", 1);
    const fs::path nowhere = folder_ / "missing" / "a.checkpoint";
    EXPECT_NE(messageOf<IoError>([&] { writeCheckpoint(run, nowhere); }).find("No such file"), std::string::npos);
    fs::create_directory(file_);
    EXPECT_NE(messageOf<IoError>([&] { writeCheckpoint(run, file_); }).find(file_.string()), std::string::npos);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "the partial file is removed";
    EXPECT_NE(messageOf<IoError>([&] { readCheckpoint(file_); }).find("is not a file"), std::string::npos);
    EXPECT_NE(messageOf<IoError>([&] { readCheckpoint(nowhere); }).find("No such file"), std::string::npos);
}

TEST_F(Checkpoint, AFullDiskKeepsTheOlderOne) {
    SceneRun run = runOf("tower:5", 20);
    writeCheckpoint(run, file_);
    const auto size = fs::file_size(file_);
    const pid_t child = fork();
    if (child == 0) {
        // A limit on the size of files ends a write as a full disk does: in the middle, with an error.
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{size / 2, size / 2};
        setrlimit(RLIMIT_FSIZE, &limit);
        const std::string text = messageOf<IoError>([&] { writeCheckpoint(run, file_); });
        _exit(text.find("cannot be written: File too large") != std::string::npos ? 0 : 1);
    }
    int status = 1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(readCheckpoint(file_).world().stateHash(), run.world().stateHash());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "the partial file is removed";
}

TEST_F(Checkpoint, AKillInTheMiddleLeavesAWholeOne) {
    SceneRun run = runOf("tower:5", 20);
    writeCheckpoint(run, file_);
    std::int64_t last = 20;
    bool progressed = false;
    for (int round = 0; round < 25; ++round) {
        const pid_t child = fork();
        if (child == 0) {
            for (;;) {
                run.step();
                writeCheckpoint(run, file_);
            }
        }
        std::this_thread::sleep_for(std::chrono::microseconds(3000 + 1733 * round));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        run = readCheckpoint(file_);
        EXPECT_GE(run.world().stepCount(), last) << "a checkpoint was lost";
        progressed = progressed || run.world().stepCount() > last;
        last = run.world().stepCount();
    }
    EXPECT_TRUE(progressed);
    SceneRun reference = runOf("tower:5", static_cast<int>(last));
    EXPECT_EQ(run.world().stateHash(), reference.world().stateHash());
}

TEST_F(Checkpoint, DamageIsRefusedWithFileAndOffset) {
    const SceneRun run = runOf("tower:5", 20);
    std::vector<std::byte> bytes = run.save();
    bytes[bytes.size() / 3] ^= std::byte{1};
    replaceFile(file_, bytes);
    const std::string damaged = messageOf<InputError>([&] { readCheckpoint(file_); });
    EXPECT_EQ(damaged.find(file_.string() + " is damaged within bytes 32 and"), 0U) << damaged;
    replaceFile(file_, std::span(bytes).first(100));
    const std::string truncated = messageOf<InputError>([&] { readCheckpoint(file_); });
    EXPECT_NE(truncated.find("truncated at byte 100"), std::string::npos) << truncated;
}

}  // namespace
}  // namespace cairn
