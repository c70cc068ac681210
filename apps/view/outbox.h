/// @file What the simulation needs of the server: somewhere to put its messages.
#pragma once

#include <cstdint>

#include "wire.h"

namespace cairn::view {

using ClientId = std::uint32_t;

/// Takes messages for viewers; called by the simulation's thread, must return at once.
class Outbox {
  public:
    virtual ~Outbox() = default;
    /// Every viewer gets it, in order.
    virtual void toAll(SharedMessage message) = 0;
    virtual void toOne(ClientId client, SharedMessage message) = 0;
    /// The newest frame: a viewer that is not ready for it gets a later one instead.
    virtual void frame(SharedMessage message) = 0;
    /// True if at least one viewer waits for a frame.
    virtual bool frameWanted() const = 0;
};

}  // namespace cairn::view
