/// The loop of C++ that tools/measure_python compares with Python's: step_loop SCENE STEPS
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "cairn/cairn.h"

int main(int count, char** words) {
    if (count != 3) {
        std::cerr << "usage: step_loop SCENE STEPS\n";
        return EXIT_FAILURE;
    }
    const cairn::Scene scene = cairn::builtInScene(words[1]);
    cairn::Settings settings = cairn::settingsFor(scene);
    settings.parallel.threads = 1;
    cairn::SceneRun run(scene, settings);
    cairn::World& world = run.world();
    std::vector<std::int64_t> times(static_cast<std::size_t>(std::atoi(words[2])));
    double sum = 0;
    for (std::int64_t& time : times) {
        const auto begin = std::chrono::steady_clock::now();
        world.step();
        const auto v = world.bodyViews().linear_velocity;
        time = std::chrono::nanoseconds(std::chrono::steady_clock::now() - begin).count();
        sum += v[0].x();
    }
    std::cout << world.stateHash();
    for (const std::int64_t time : times) std::cout << ' ' << time;
    std::cout << '\n';
    return sum == sum ? EXIT_SUCCESS : EXIT_FAILURE;
}
