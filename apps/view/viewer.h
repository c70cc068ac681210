/// @file The viewer as a whole: a live world or recordings, served to browsers.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server.h"
#include "simulation.h"

namespace cairn::view {

/// Serves until it ends; everything runs in threads of its own.
class Viewer {
  public:
    /// A running simulation. @throws InputError, IoError
    Viewer(const LiveOptions& live, const ServerOptions& serving);
    /// One recording or two. @throws InputError, IoError
    Viewer(const std::vector<std::filesystem::path>& recordings, const ServerOptions& serving);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// What to open in a browser.
    std::string address() const;

  private:
    std::unique_ptr<Server> server_;
    std::unique_ptr<Simulation> simulation_;
};

}  // namespace cairn::view
