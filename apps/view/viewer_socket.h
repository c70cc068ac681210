/// @file One WebSocket of a viewer: messages in order, frames only when it is ready for them.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <functional>
#include <memory>

#include "outbox.h"
#include "rate_limit.h"

namespace cairn::view {

/// Lives as long as its connection. Used by the server's thread only.
class ViewerSocket : public std::enable_shared_from_this<ViewerSocket> {
  public:
    using Request = boost::beast::http::request<boost::beast::http::string_body>;

    /// What the socket tells the server.
    struct Events {
        std::function<void()> open;
        std::function<void(std::string_view)> text;
        std::function<void(std::string_view)> binary;
        std::function<void()> closed;  ///< once, if open was called
        std::function<void()> ready;   ///< it can take a frame now
    };

    ViewerSocket(boost::beast::tcp_stream&& stream, std::size_t longest_message, Events events);

    void accept(Request request);
    void send(SharedMessage message);
    void offerFrame(SharedMessage message);
    /// True if a frame would be sent at once.
    bool ready() const { return credit_ > 0 && !frame_ && open_; }
    void close();

  private:
    void read();
    void received(std::size_t bytes);
    void refuse(std::string_view text);
    void write();
    void fail();

    boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
    boost::beast::flat_buffer buffer_;
    Events events_;
    std::deque<SharedMessage> queue_;
    std::size_t queued_bytes_ = 0;
    SharedMessage frame_;      ///< the newest one, not yet sent
    SharedMessage in_flight_;  ///< what is being written
    int credit_ = 2;           ///< frames that the page can still take
    RateLimit commands_{400, 800};
    bool open_ = false;
    bool ended_ = false;
};

}  // namespace cairn::view
