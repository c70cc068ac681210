#include "server.h"

#include <fmt/format.h>

#include <atomic>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <map>
#include <optional>
#include <thread>

#include "cairn/types.h"
#include "page.h"
#include "viewer_socket.h"

namespace cairn::view {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

namespace {

constexpr std::size_t most_viewers = 16;
constexpr int most_connections = 128;
constexpr auto request_timeout = std::chrono::seconds(20);
constexpr std::uint32_t longest_header = 8 << 10;  // [bytes]

/// The page is one file with its script and style inside and talks to nobody but its server.
constexpr std::string_view content_policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
    "connect-src 'self' ws:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view viewOf(beast::string_view text) {
    return {text.data(), text.size()};
}

}  // namespace

struct Server::Impl {
    explicit Impl(const ServerOptions& given) : options(given), acceptor(context) {
        boost::system::error_code error;
        const auto host = asio::ip::make_address(options.host, error);
        if (error) {
            throw IoError(fmt::format("'{}' is not an address such as 127.0.0.1 or 0.0.0.0", options.host));
        }
        const tcp::endpoint endpoint(host, options.port);
        acceptor.open(endpoint.protocol(), error);
        if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
        if (!error) acceptor.bind(endpoint, error);
        if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
        if (error == asio::error::address_in_use) {
            throw IoError(
                fmt::format("port {} is in use by another program; choose another with --port, or --port 0 "
                            "for any free one",
                            options.port));
        }
        if (error) {
            throw IoError(fmt::format("cannot listen on {} port {}: {}", options.host, options.port, error.message()));
        }
        access = {acceptor.local_endpoint().port(), options.token};
    }

    void acceptNext() {
        acceptor.async_accept([this](boost::system::error_code error, tcp::socket socket) {
            if (error == asio::error::operation_aborted) return;
            if (!error) serve(std::move(socket));
            acceptNext();
        });
    }

    /// One connection; it may ask several times.
    struct Connection {
        Connection(tcp::socket&& socket, int& counter) : stream(std::move(socket)), count(counter) { ++count; }
        ~Connection() { --count; }
        Connection(const Connection&) = delete;
        Connection& operator=(const Connection&) = delete;

        beast::tcp_stream stream;
        int& count;
        beast::flat_buffer buffer{longest_header};
        std::optional<http::request_parser<http::string_body>> parser;
    };

    void serve(tcp::socket&& socket) {
        if (connections >= most_connections) return;
        readRequest(std::make_shared<Connection>(std::move(socket), connections));
    }

    void readRequest(const std::shared_ptr<Connection>& connection) {
        connection->parser.emplace();
        connection->parser->header_limit(longest_header);
        connection->parser->body_limit(0);
        connection->stream.expires_after(request_timeout);
        http::async_read(connection->stream, connection->buffer, *connection->parser,
                         [this, connection](beast::error_code error, std::size_t) {
                             if (error == http::error::end_of_stream) return;
                             if (error) {
                                 // A closed or silent connection gets no answer; anything else was no HTTP.
                                 if (error.category() == http::make_error_code(http::error::bad_method).category()) {
                                     answer(connection, plain(400, "This is not a request."));
                                 }
                                 return;
                             }
                             handle(connection);
                         });
    }

    using TextResponse = http::response<http::string_body>;

    static TextResponse plain(unsigned status, std::string_view text) {
        TextResponse response;
        response.result(status);
        response.set(http::field::content_type, "text/plain; charset=utf-8");
        response.body() = std::string(text);
        return response;
    }

    void handle(const std::shared_ptr<Connection>& connection) {
        auto request = connection->parser->release();
        const bool upgrade = beast::websocket::is_upgrade(request);
        const std::string method(viewOf(request.method_string()));
        const Verdict verdict = judge(
            {method, viewOf(request.target()), viewOf(request[http::field::host]), viewOf(request[http::field::origin]),
             upgrade ? RequestFacts::Kind::upgrade : RequestFacts::Kind::plain},
            access);
        if (verdict.route == Route::socket) {
            join(connection, std::move(request));
            return;
        }
        TextResponse response = plain(verdict.status, verdict.text);
        if (verdict.route == Route::page) {
            response.set(http::field::content_type, "text/html; charset=utf-8");
            response.set(http::field::content_encoding, "gzip");
            response.set("Content-Security-Policy", beast::string_view(content_policy.data(), content_policy.size()));
            response.body() = std::string(compressedPage());
        } else if (verdict.route == Route::recording) {
            if (verdict.recording < options.clips.size()) {
                response.set(http::field::content_type, "application/octet-stream");
                response.body() = *options.clips[verdict.recording];
            } else {
                response = plain(404, "There is no such recording.");
            }
        }
        response.keep_alive(request.keep_alive());
        answer(connection, std::move(response), method == "HEAD" ? Body::without : Body::with);
    }

    enum class Body { with, without };

    void answer(const std::shared_ptr<Connection>& connection, TextResponse response, Body body = Body::with) {
        auto kept = std::make_shared<TextResponse>(std::move(response));
        kept->version(11);
        kept->set("X-Content-Type-Options", "nosniff");
        kept->set("X-Frame-Options", "DENY");
        kept->set("Referrer-Policy", "no-referrer");
        kept->set(http::field::cache_control, "no-store");
        kept->prepare_payload();
        const auto written = [this, connection, kept](beast::error_code error, std::size_t) {
            if (error) return;
            if (kept->keep_alive()) {
                readRequest(connection);
            } else {
                beast::error_code ignored;
                connection->stream.socket().shutdown(tcp::socket::shutdown_send, ignored);
            }
        };
        connection->stream.expires_after(request_timeout);
        if (body == Body::with) {
            http::async_write(connection->stream, *kept, written);
            return;
        }
        auto header = std::make_shared<http::response_serializer<http::string_body>>(*kept);
        http::async_write_header(connection->stream, *header,
                                 [header, written](beast::error_code error, std::size_t n) { written(error, n); });
    }

    void join(const std::shared_ptr<Connection>& connection, ViewerSocket::Request request) {
        if (viewers.size() >= most_viewers) {
            answer(connection, plain(503, "There are too many viewers."));
            return;
        }
        const ClientId id = ++last_client;
        ViewerSocket::Events told;
        told.open = [this, id] { events.joined(id); };
        told.text = [this, id](std::string_view text) { events.text(id, text); };
        if (events.binary) told.binary = [this, id](std::string_view bytes) { events.binary(id, bytes); };
        told.closed = [this, id] {
            events.left(id);
            // Not now: the viewer is still at work.
            asio::post(context, [this, id] {
                viewers.erase(id);
                saveWishes();
            });
        };
        told.ready = [this] { saveWishes(); };
        auto socket =
            std::make_shared<ViewerSocket>(std::move(connection->stream), options.longest_message, std::move(told));
        viewers[id] = socket;
        socket->accept(std::move(request));
    }

    void saveWishes() {
        bool any = false;
        for (const auto& [id, viewer] : viewers) any = any || viewer->ready();
        wanted = any;
    }

    /// At once in the server's own thread: what it says there must not be overtaken by what other threads post.
    void post(std::function<void()> work) { asio::dispatch(context, std::move(work)); }

    ServerOptions options;
    int connections = 0;          ///< before the context, whose end closes what is open
    asio::io_context context{1};  ///< holds the handlers of all connections
    tcp::acceptor acceptor;
    Access access;
    ServerEvents events;
    std::map<ClientId, std::shared_ptr<ViewerSocket>> viewers;
    ClientId last_client = 0;
    std::atomic<bool> wanted{false};
    std::thread thread;
};

Server::Server(const ServerOptions& options) : impl_(std::make_unique<Impl>(options)) {}

Server::~Server() {
    stop();
}

std::uint16_t Server::port() const {
    return impl_->access.port;
}

std::string Server::address() const {
    const bool everywhere = impl_->options.host == "0.0.0.0" || impl_->options.host == "::";
    std::string host = everywhere ? "localhost" : impl_->options.host;
    if (host.find(':') != std::string::npos) host = "[" + host + "]";
    const std::string& token = impl_->access.token;
    return fmt::format("http://{}:{}/{}", host, port(), token.empty() ? "" : "?token=" + token);
}

void Server::start(ServerEvents events) {
    impl_->events = std::move(events);
    impl_->acceptNext();
    impl_->thread = std::thread([impl = impl_.get()] { impl->context.run(); });
}

void Server::stop() {
    if (!impl_->thread.joinable()) return;
    impl_->context.stop();
    impl_->thread.join();
    impl_->viewers.clear();
}

void Server::toAll(SharedMessage message) {
    impl_->post([impl = impl_.get(), message = std::move(message)] {
        for (const auto& [id, viewer] : impl->viewers) viewer->send(message);
    });
}

void Server::toOne(ClientId client, SharedMessage message) {
    impl_->post([impl = impl_.get(), client, message = std::move(message)] {
        const auto viewer = impl->viewers.find(client);
        if (viewer != impl->viewers.end()) viewer->second->send(message);
    });
}

void Server::frame(SharedMessage message) {
    impl_->post([impl = impl_.get(), message = std::move(message)] {
        for (const auto& [id, viewer] : impl->viewers) viewer->offerFrame(message);
        impl->saveWishes();
    });
}

bool Server::frameWanted() const {
    return impl_->wanted;
}

}  // namespace cairn::view
