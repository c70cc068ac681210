/// @file A world that runs in its own thread in real time and does what viewers ask.
#pragma once

#include <memory>
#include <optional>

#include "cairn/scene.h"
#include "command.h"
#include "outbox.h"

namespace cairn::view {

/// How a live view begins.
struct LiveOptions {
    Scene scene;
    std::string scene_name;                                       ///< as given on the command line
    SettingOverrides overrides;                                   ///< for the first scene
    enum class Begin { playing, paused } begin = Begin::playing;  ///< playing begins with the first viewer
};

/// The simulation and its thread.
class Simulation {
  public:
    /// @throws InputError if the scene cannot be run
    Simulation(const LiveOptions& options, Outbox& outbox);
    /// Ends the thread after the step it is in.
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    // From any thread; they return at once.
    void join(ClientId client);
    void leave(ClientId client);
    void post(ClientId client, Command command);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cairn::view
