/// @file The HTTP and WebSocket server of the viewer.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "access.h"
#include "outbox.h"

namespace cairn::view {

/// What viewers send; called in the server's thread, must return at once.
struct ServerEvents {
    std::function<void(ClientId)> joined;
    std::function<void(ClientId)> left;
    std::function<void(ClientId, std::string_view text)> text;
    std::function<void(ClientId, std::string_view bytes)> binary;  ///< may be empty: then bytes are an error
};

struct ServerOptions {
    std::string host = "127.0.0.1";
    std::uint16_t port = 0;                                 ///< 0 = any free one
    std::string token;                                      ///< asked for if not empty
    std::vector<std::shared_ptr<const std::string>> clips;  ///< what /recording/0 and /recording/1 give
    std::size_t longest_message = 0;                        ///< of a viewer [bytes]
};

/// Serves the page, the clips and the WebSocket from memory, in one thread of its own.
class Server : public Outbox {
  public:
    /// Binds at once, answers after start(). @throws IoError if the port is busy or the host is not of this machine
    explicit Server(const ServerOptions& options);
    /// Closes all connections and ends the thread.
    ~Server() override;

    std::uint16_t port() const;
    /// The address of the page, with the token.
    std::string address() const;
    void start(ServerEvents events);
    /// No more events after it returns.
    void stop();

    void toAll(SharedMessage message) override;
    void toOne(ClientId client, SharedMessage message) override;
    void frame(SharedMessage message) override;
    bool frameWanted() const override;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cairn::view
