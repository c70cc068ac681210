#include "viewer_socket.h"

#include <boost/asio/post.hpp>
#include <chrono>

namespace cairn::view {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

namespace {

/// A viewer that takes nothing any more is let go.
constexpr std::size_t most_queued_bytes = std::size_t{256} << 20;
constexpr int most_credit = 4;
/// The page drew a frame; kept apart from commands since it comes with every picture.
constexpr std::string_view next_frame = R"({"do":"next"})";

double secondsNow() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

ViewerSocket::ViewerSocket(beast::tcp_stream&& stream, std::size_t longest_message, Events events)
    : socket_(std::move(stream)), events_(std::move(events)) {
    // The WebSocket has its own timeouts: it pings, and ends a connection that does not answer.
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(longest_message);
    socket_.auto_fragment(false);
}

void ViewerSocket::accept(Request request) {
    // The request must outlive the handshake.
    auto kept = std::make_shared<Request>(std::move(request));
    socket_.async_accept(*kept, [self = shared_from_this(), kept](beast::error_code error) {
        if (error) return;
        self->open_ = true;
        beast::error_code ignored;
        beast::get_lowest_layer(self->socket_).socket().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
        self->events_.open();
        self->read();
    });
}

void ViewerSocket::read() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t bytes) {
        if (error) {
            self->fail();
            return;
        }
        self->received(bytes);
        self->buffer_.consume(self->buffer_.size());
        if (!self->ended_) self->read();
    });
}

void ViewerSocket::received(std::size_t bytes) {
    const std::string_view data(static_cast<const char*>(buffer_.data().data()), bytes);
    if (!commands_.take(secondsNow())) {
        refuse("too many messages; at most 400 a second are taken");
        return;
    }
    if (socket_.got_binary()) {
        if (events_.binary)
            events_.binary(data);
        else
            refuse("binary messages are not understood here");
    } else if (data == next_frame) {
        credit_ = std::min(most_credit, credit_ + 1);
        write();
        if (ready()) events_.ready();
    } else {
        events_.text(data);
    }
}

void ViewerSocket::refuse(std::string_view text) {
    send(std::make_shared<const Message>(
        Message{Message::Kind::text, R"({"type":"error","text":")" + std::string(text) + "\"}"}));
}

/// Before it is open nothing is kept: the first thing that a viewer hears is the greeting.
void ViewerSocket::send(SharedMessage message) {
    if (!open_ || ended_) return;
    queued_bytes_ += message->bytes.size();
    if (queued_bytes_ > most_queued_bytes) {
        close();
        return;
    }
    queue_.push_back(std::move(message));
    write();
}

void ViewerSocket::offerFrame(SharedMessage message) {
    if (!open_ || ended_) return;
    frame_ = std::move(message);
    write();
}

/// Messages first, so that a frame never comes before the roster it needs.
void ViewerSocket::write() {
    if (in_flight_ || !open_ || ended_) return;
    if (!queue_.empty()) {
        in_flight_ = std::move(queue_.front());
        queue_.pop_front();
        queued_bytes_ -= in_flight_->bytes.size();
    } else if (frame_ && credit_ > 0) {
        in_flight_ = std::move(frame_);
        frame_.reset();
        --credit_;
    } else {
        return;
    }
    socket_.binary(in_flight_->kind == Message::Kind::binary);
    socket_.async_write(boost::asio::buffer(in_flight_->bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                            self->in_flight_.reset();
                            if (error) {
                                self->fail();
                                return;
                            }
                            self->write();
                            if (self->ready()) self->events_.ready();
                        });
}

void ViewerSocket::close() {
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(boost::asio::ip::tcp::socket::shutdown_both, ignored);
    beast::get_lowest_layer(socket_).close();
    fail();
}

void ViewerSocket::fail() {
    if (ended_) return;
    ended_ = true;
    queue_.clear();
    frame_.reset();
    if (open_) events_.closed();
}

}  // namespace cairn::view
