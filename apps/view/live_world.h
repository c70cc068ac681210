/// @file The world of a live view: scene, roster of bodies, springs that hold grabbed bodies, and the dial. Used by the
/// simulation's thread only.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cairn/scene.h"
#include "command.h"
#include "dial.h"
#include "outbox.h"
#include "samples.h"

namespace cairn::view {

/// What viewers have changed in the roster since the last message.
struct RosterChange {
    std::vector<BodyId> added;
    std::vector<std::uint32_t> removed;  ///< slots
};

class LiveWorld {
  public:
    /// @param title as the page shows it @throws InputError
    LiveWorld(Scene scene, std::string title, const Settings& settings);

    const std::string& title() const { return title_; }
    double duration() const { return scene_.duration; }
    World& world() { return run_->world(); }
    const World& world() const { return run_->world(); }
    const std::vector<BodyId>& bodies() const { return bodies_; }
    std::uint32_t epoch() const { return epoch_; }

    /// Begins anew with another scene, keeping the number of threads. Strong guarantee. @throws InputError
    void load(Scene scene, std::string title);
    /// Begins anew with the same scene and the present settings.
    void reset();

    /// One time step. @return the sample, if a simulation step of 1/30 s is complete
    std::optional<Sample> step();

    // What viewers do; all throw InputError.
    void setDial(double value);
    void setField(const SetField& field);
    BodyId throwBall(const ThrowBall& ball);
    BodyId add(const AddBody& body);
    void remove(BodyId body);
    void freeze(const FreezeBody& freeze);
    void grab(ClientId client, const GrabBody& grab);
    void drag(ClientId client, const DragBody& drag);
    void release(ClientId client);

    /// Compares the roster with the world; the epoch grows if they differ.
    RosterChange updateRoster();
    /// Lines of the scene's springs and of the viewers' grips.
    std::vector<SpringLine> springLines() const;
    /// The value of the dial, none if the settings are not on it.
    std::optional<double> dial() const;

    nlohmann::json describeWorld() const;
    nlohmann::json describeChange(const RosterChange& change) const;
    /// State, contacts and batch of a body. @throws StaleIdError
    nlohmann::json describeSelection(BodyId body) const;

  private:
    struct Grip {
        SpringId spring;
        BodyId body;
        Vec3 anchor;  ///< [m, B]
        Vec3 target;  ///< [m, W]
    };

    void begin(const Settings& settings);
    MaterialId material(const std::string& name) const;
    BodyId addBody(const BodyDescription& description);

    Scene scene_;
    std::string title_;
    DialEnds ends_;
    std::unique_ptr<SceneRun> run_;
    std::vector<BodyId> bodies_;
    std::uint32_t epoch_ = 0;
    std::map<ClientId, Grip> grips_;
    std::optional<double> dial_;
    Statistics sum_;
    double next_sample_ = 0;  ///< [s]
};

}  // namespace cairn::view
