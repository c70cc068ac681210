// Saves a run, goes on from there twice, and once more with twice the gravity.
#include <cairn/cairn.h>

#include <cstdio>

/// Runs on to a time [s]. @return the height of the ball then [m]
double runTo(double time, cairn::SceneRun& run) {
    while (run.world().time() < time) run.step();
    return run.world().pose(run.ids().back()).position.z();
}

int main() {
    const auto scene = cairn::readScene("pyramid.json");
    cairn::SceneRun run(scene, cairn::settingsFor(scene));
    std::printf("snapshot after 0.5 s: the ball is at %.2f m\n", runTo(0.5, run));
    const auto snapshot = run.save();
    std::printf("first: at %.2f m after 2 s\n", runTo(2, run));

    auto again = cairn::SceneRun::restore(snapshot);
    std::printf("again: at %.2f m after 2 s\n", runTo(2, again));
    const bool same = again.world().stateHash() == run.world().stateHash();
    std::printf("the same state: %s\n", same ? "yes" : "no");

    auto other = cairn::SceneRun::restore(snapshot);
    other.world().setGravity({0, 0, -20});
    std::printf("with twice the gravity: at %.2f m after 2 s\n", runTo(2, other));

    cairn::writeCheckpoint(run, "pyramid.checkpoint");
}
