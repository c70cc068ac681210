/// The loop of C++ that tools/measure_python compares with Python's, a step at a time.
#include <ctime>
#include <memory>

#include "cairn/cairn.h"

namespace {

/// Processor time of this thread [ns]: other load on the machine does not count.
std::int64_t now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return std::int64_t{1'000'000'000} * time.tv_sec + time.tv_nsec;
}

}  // namespace

extern "C" {

/// A built-in scene on one thread; for the other functions. @return null for an unknown one
cairn::SceneRun* cairn_loop_begin(const char* name) {
    try {
        const cairn::Scene scene = cairn::builtInScene(name);
        cairn::Settings settings = cairn::settingsFor(scene);
        settings.parallel.threads = 1;
        return std::make_unique<cairn::SceneRun>(scene, settings).release();
    } catch (const cairn::InputError&) {
        return nullptr;
    }
}

/// A step and a view. @return the time they take [ns]
std::int64_t cairn_loop_step(cairn::SceneRun* run) {
    now();  // the first reading after a while costs microseconds itself
    const std::int64_t begin = now();
    run->world().step();
    const auto v = run->world().bodyViews().linear_velocity;
    const std::int64_t end = now();
    return v.size() > 0 ? end - begin : 0;
}

std::uint64_t cairn_loop_hash(const cairn::SceneRun* run) {
    return run->world().stateHash();
}
}
