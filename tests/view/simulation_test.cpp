/// @file The running simulation under commands that are well formed and unreasonable.
#include "view/simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>

namespace cairn::view {
namespace {

using nlohmann::json;

/// Remembers what the simulation says.
class Listener : public Outbox {
  public:
    void toAll(SharedMessage message) override { note(*message); }
    void toOne(ClientId, SharedMessage message) override { note(*message); }
    void frame(SharedMessage message) override {
        const std::lock_guard lock(mutex_);
        frame_ = std::move(message);
    }
    bool frameWanted() const override { return true; }

    /// Waits until as many commands were answered. @return false if that takes too long
    bool waitFor(std::size_t answers) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(240), [&] { return done_ + refused_ >= answers; });
    }
    std::size_t done() const {
        const std::lock_guard lock(mutex_);
        return done_;
    }
    std::vector<std::string> stops() const {
        const std::lock_guard lock(mutex_);
        return stops_;
    }
    SharedMessage lastFrame() const {
        const std::lock_guard lock(mutex_);
        return frame_;
    }

  private:
    void note(const Message& message) {
        if (message.kind != Message::Kind::text) return;
        const json object = json::parse(message.bytes);
        const std::lock_guard lock(mutex_);
        if (object["type"] == "done") ++done_;
        if (object["type"] == "error") {
            if (object.contains("id"))
                ++refused_;
            else
                stops_.push_back(object["text"]);
        }
        changed_.notify_all();
    }

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::size_t done_ = 0;
    std::size_t refused_ = 0;
    std::vector<std::string> stops_;
    SharedMessage frame_;
};

/// Well-formed commands with values that nobody would think of.
class OddCommands {
  public:
    explicit OddCommands(std::uint64_t seed) : random_(seed) {}

    json next() {
        switch (random_() % 16) {
            case 0:
                return {{"do", "throw"},
                        {"origin", point()},
                        {"velocity", point()},
                        {"radius", size()},
                        {"material", material()}};
            case 1:
            case 2:
            case 3:
                return {{"do", "add"}, {"shape", shape()}, {"material", material()}, {"position", point()}};
            case 4:
                return {{"do", "delete"}, {"body", body()}};
            case 5:
                return {{"do", "freeze"}, {"body", body()}, {"fixed", random_() % 2 == 0}};
            case 6:
                return {{"do", "grab"}, {"body", body()}, {"point", point()}};
            case 7:
                return {{"do", "drag"}, {"target", point()}};
            case 8:
                return {{"do", random_() % 2 == 0 ? "release" : "play"}};
            case 9:
            case 10:
                return {{"do", "step"}, {"count", 1 + random_() % 3}};
            case 11:
                return {{"do", "dial"}, {"value", static_cast<double>(random_() % 101) / 100}};
            case 12:
                return {{"do", "select"}, {"body", body()}};
            case 13:
                return {{"do", "layers"},
                        {"layers",
                         {"contacts", "moves", "stage", "bounds", "level", "joints", "batch", "overlap", "speed"}}};
            case 14:
                return {{"do", "rays"}, {"origin", point()}, {"directions", {{0, 0, -1}, {0.5, 1, -0.1}}}};
            default:
                return setting();
        }
    }

  private:
    json setting() {
        const auto fields = settingFields();
        const SettingField& field = fields[random_() % fields.size()];
        json value;
        if (!field.choices.empty()) {
            value = field.choices[random_() % field.choices.size()];
        } else {
            const std::array numbers = {field.minimum, field.maximum, 0.0, 1.0, 1e-300, 1e300, -1.0, 0.5, 1000.0};
            const double number = numbers[random_() % numbers.size()];
            if (random_() % 4 == 0)
                value = random_() % 2 == 0;
            else if (number == std::floor(number) && std::abs(number) < 1e15)
                value = static_cast<std::int64_t>(number);
            else
                value = number;
        }
        return {{"do", "set"}, {"field", field.name}, {"value", value}};
    }
    json shape() {
        switch (random_() % 4) {
            case 0:
                return {{"type", "box"}, {"size", {size(), size(), size()}}};
            case 1:
                return {{"type", "sphere"}, {"radius", size()}};
            case 2:
                return {{"type", "capsule"}, {"radius", size()}, {"length", size()}};
            default:
                return {{"type", "cylinder"}, {"radius", size()}, {"length", size()}};
        }
    }
    double size() { return std::array{1e-4, 0.1, 0.1, 0.1, 2.0, 1e3}[random_() % 6]; }
    double coordinate() { return std::array{0.0, 0.1, -0.2, 1.0, 1e6, -1e6, 1e-300}[random_() % 7]; }
    json point() { return {coordinate(), coordinate(), coordinate()}; }
    json body() { return {random_() % 40, random_() % 3}; }
    std::string material() { return std::array{"oak", "iron", "granite", "butter"}[random_() % 4]; }

    std::mt19937_64 random_;
};

LiveOptions pausedScene(const std::string& name) {
    LiveOptions live;
    live.scene = builtInScene(name);
    live.scene_name = name;
    live.begin = LiveOptions::Begin::paused;
    return live;
}

TEST(Simulation, OddCommandsAreDoneOrRefusedAndNeverEndIt) {
    constexpr std::size_t commands = 120;
    for (const std::uint64_t seed : {1, 2}) {
        Listener listener;
        Simulation simulation(pausedScene(seed % 2 == 0 ? "cradle_swing:3:1" : "tower:5"), listener);
        simulation.join(1);
        OddCommands odd(seed);
        for (std::size_t i = 0; i < commands; ++i) {
            json command = odd.next();
            command["id"] = i;
            simulation.post(1, parseCommand(command.dump()));
            // In small groups, so that steps come between them.
            if (i % 4 != 3) continue;
            ASSERT_TRUE(listener.waitFor(i + 1)) << "seed " << seed << ", command " << command;
        }
        EXPECT_GT(listener.done(), commands / 4);
        simulation.leave(1);
    }
}

}  // namespace
}  // namespace cairn::view
