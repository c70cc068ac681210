/// @file The server with a running world, spoken to as a browser would, and as no browser would.
#include "view/viewer.h"

#include <gtest/gtest.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>
#include <random>

#include "view/command.h"

namespace cairn::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using nlohmann::json;

std::uint16_t portOf(const Viewer& viewer) {
    const std::string address = viewer.address();
    return static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
}

/// A viewer without a page.
class Client {
  public:
    explicit Client(std::uint16_t port) : socket_(context_) {
        socket_.next_layer().connect({asio::ip::make_address("127.0.0.1"), port});
        socket_.read_message_max(0);
        socket_.handshake("127.0.0.1:" + std::to_string(port), "/ws");
    }

    void send(const json& command) { socket_.write(asio::buffer(command.dump())); }
    void sendRaw(const std::string& bytes) {
        socket_.text(true);
        socket_.write(asio::buffer(bytes));
    }
    void sendBinary(const std::string& bytes) {
        socket_.binary(true);
        socket_.write(asio::buffer(bytes));
        socket_.text(true);
    }

    /// The next text message of a type; frames are counted.
    json next(const std::string& type) {
        for (int i = 0; i < 5000; ++i) {
            beast::flat_buffer buffer;
            socket_.read(buffer);
            if (socket_.got_binary()) {
                ++frames;
                continue;
            }
            json message = json::parse(beast::buffers_to_string(buffer.data()));
            if (message["type"] == type) return message;
        }
        ADD_FAILURE() << "no message of type " << type;
        return {};
    }

    /// The next text message of whatever type.
    json nextText() {
        for (;;) {
            beast::flat_buffer buffer;
            socket_.read(buffer);
            if (!socket_.got_binary()) return json::parse(beast::buffers_to_string(buffer.data()));
        }
    }

    /// The first state that fits.
    template <typename Fits>
    json stateWhere(const Fits& fits) {
        for (int i = 0; i < 500; ++i) {
            json state = next("state");
            if (fits(state)) return state;
        }
        ADD_FAILURE() << "no such state";
        return {};
    }

    int frames = 0;

  private:
    asio::io_context context_;
    beast::websocket::stream<tcp::socket> socket_;
};

LiveOptions pausedTower() {
    LiveOptions live;
    live.scene = builtInScene("tower:4");
    live.scene_name = "tower:4";
    live.begin = LiveOptions::Begin::paused;
    return live;
}

TEST(Viewer, GreetsWithEverythingThePageNeeds) {
    const Viewer viewer(pausedTower(), {});
    Client client(portOf(viewer));
    const json hello = client.next("hello");
    EXPECT_EQ(hello["mode"], "live");
    EXPECT_EQ(hello["fields"].size(), settingFields().size());
    EXPECT_EQ(hello["scenes"].size(), builtInScenes().size());
    const json world = client.next("world");
    EXPECT_EQ(world["bodies"].size(), builtInScene("tower:4").bodies.size());
}

TEST(Viewer, TheGreetingComesFirst) {
    const Viewer viewer(pausedTower(), {});
    for (int i = 0; i < 40; ++i) {
        Client client(portOf(viewer));
        EXPECT_EQ(client.nextText()["type"], "hello");
    }
}

TEST(Viewer, StepsGiveTheStateOfTheLibrary) {
    const Viewer viewer(pausedTower(), {});
    Client client(portOf(viewer));
    client.send({{"do", "step"}, {"count", 40}});
    const json state = client.stateWhere([](const json& s) { return s["steps"] == 40 && !s["hash"].is_null(); });
    SceneRun run(builtInScene("tower:4"), settingsFor(builtInScene("tower:4")));
    for (int i = 0; i < 40; ++i) run.step();
    std::ostringstream hash;
    hash << std::hex << std::setw(16) << std::setfill('0') << run.world().stateHash();
    EXPECT_EQ(state["hash"], hash.str());
}

TEST(Viewer, AllViewersSeeTheSameWorld) {
    const Viewer viewer(pausedTower(), {});
    Client first(portOf(viewer)), second(portOf(viewer));
    second.next("world");
    first.next("world");
    first.send(
        {{"do", "throw"}, {"origin", {0, -3, 1}}, {"velocity", {0, 1, 0}}, {"radius", 0.1}, {"material", "iron"}});
    const json change = second.next("bodies");
    EXPECT_EQ(change["added"].size(), 1U);
    EXPECT_EQ(first.next("bodies")["epoch"], change["epoch"]);
}

TEST(Viewer, MalformedMessagesAreAnsweredAndChangeNothing) {
    const Viewer viewer(pausedTower(), {});
    Client client(portOf(viewer));
    client.sendRaw("this is not JSON");
    EXPECT_NE(client.next("error")["text"].get<std::string>().find("JSON"), std::string::npos);
    client.sendRaw(R"({"do":"step","count":-1,"id":7})");
    EXPECT_EQ(client.next("error")["id"], 7);
    client.sendBinary("bytes");
    EXPECT_NE(client.next("error")["text"], "");
    client.send({{"do", "load"}, {"scene", "../../etc/passwd"}});
    EXPECT_NE(client.next("error")["text"].get<std::string>().find("no built-in scene"), std::string::npos);
    client.send({{"do", "upload"}, {"name", "bad.json"}, {"text", "{\"name\": 1}"}});
    EXPECT_NE(client.next("error")["text"].get<std::string>().find("bad.json"), std::string::npos);
    client.send({{"do", "delete"}, {"body", {9999, 0}}});
    client.next("error");
    client.send({{"do", "pause"}, {"id", 8}});
    EXPECT_EQ(client.next("done")["id"], 8);
}

TEST(Viewer, RandomMessagesNeverEndIt) {
    const Viewer viewer(pausedTower(), {});
    Client client(portOf(viewer));
    std::mt19937_64 random(11);
    const std::vector<std::string> verbs = {"play", "pause", "reset",  "release", "dial",   "set",
                                            "grab", "drag",  "freeze", "add",     "select", "step"};
    const std::vector<json> values = {
        nullptr, true, -1, 0.5, 1e300, "oak", json::array({1, 0}), json::array({0, 0, 1}), json::object()};
    for (int i = 0; i < 300; ++i) {
        json command = {{"do", verbs[random() % verbs.size()]}, {"id", i}};
        for (const char* key :
             {"value", "body", "point", "target", "count", "field", "material", "position", "fixed"}) {
            if (random() % 3 == 0) command[key] = values[random() % values.size()];
        }
        client.send(command);
    }
    client.send({{"do", "pause"}, {"id", 1000}});
    for (int i = 0; i < 400; ++i) {
        if (client.next("done")["id"] == 1000) return;
    }
    ADD_FAILURE() << "the last command was not answered";
}

TEST(Viewer, TooManyMessagesAreRefused) {
    const Viewer viewer(pausedTower(), {});
    Client client(portOf(viewer));
    for (int i = 0; i < 2000; ++i) client.sendRaw(R"({"do":"pause"})");
    EXPECT_NE(client.next("error")["text"].get<std::string>().find("too many"), std::string::npos);
}

TEST(Viewer, AViewerWhoNeverAsksGetsTwoFramesAndStopsNobody) {
    LiveOptions live = pausedTower();
    const Viewer viewer(live, {});
    Client silent(portOf(viewer)), other(portOf(viewer));
    other.next("world");
    other.send({{"do", "step"}, {"count", 2000}});
    other.stateWhere([](const json& s) { return s["steps"] == 2000; });
    silent.frames = 0;
    silent.stateWhere([](const json& s) { return s["steps"] == 2000; });
    // Samples are binary as well: 250 simulation steps at most, but only two frames can be among them.
    EXPECT_LE(silent.frames, 252);
}

TEST(Viewer, AViewerWhoLeavesWithABodyInHandLetsItGo) {
    const Viewer viewer(pausedTower(), {});
    Client other(portOf(viewer));
    {
        Client leaving(portOf(viewer));
        leaving.next("world");
        leaving.send({{"do", "grab"}, {"body", {2, 0}}, {"point", {0, 0, 0.15}}, {"id", 1}});
        leaving.next("done");
    }
    const json state = other.stateWhere([](const json& s) { return s["clients"] == 1; });
    EXPECT_EQ(state["clients"], 1);
}

TEST(Viewer, ABusyPortGivesAClearMessage) {
    const Viewer first(pausedTower(), {});
    ServerOptions same;
    same.port = portOf(first);
    try {
        const Viewer second(pausedTower(), same);
        ADD_FAILURE() << "two servers on one port";
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find("in use"), std::string::npos);
    }
}

TEST(Viewer, ForeignPagesCannotConnect) {
    const Viewer viewer(pausedTower(), {});
    asio::io_context context;
    beast::websocket::stream<tcp::socket> socket(context);
    socket.next_layer().connect({asio::ip::make_address("127.0.0.1"), portOf(viewer)});
    socket.set_option(beast::websocket::stream_base::decorator([](beast::websocket::request_type& request) {
        request.set(beast::http::field::origin, "http://evil.example");
    }));
    beast::error_code error;
    socket.handshake("127.0.0.1:" + std::to_string(portOf(viewer)), "/ws", error);
    EXPECT_EQ(error, beast::websocket::error::upgrade_declined);
}

TEST(Viewer, BytesThatAreNoRequestDoNoHarm) {
    const Viewer viewer(pausedTower(), {});
    std::mt19937_64 random(3);
    for (int round = 0; round < 20; ++round) {
        asio::io_context context;
        tcp::socket socket(context);
        socket.connect({asio::ip::make_address("127.0.0.1"), portOf(viewer)});
        std::string noise(1 + random() % 4000, ' ');
        for (char& c : noise) c = static_cast<char>(random());
        boost::system::error_code ignored;
        asio::write(socket, asio::buffer(noise), ignored);
    }
    Client client(portOf(viewer));
    EXPECT_EQ(client.next("hello")["mode"], "live");
}

}  // namespace
}  // namespace cairn::view
