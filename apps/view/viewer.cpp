#include "viewer.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cairn/recording.h"
#include "cairn/version.h"
#include "clip.h"
#include "command.h"
#include "describe.h"
#include "samples.h"

namespace cairn::view {

using nlohmann::json;

namespace {

constexpr int protocol_version = 1;

SharedMessage text(const json& object) {
    return std::make_shared<const Message>(
        Message{Message::Kind::text, object.dump(-1, ' ', false, json::error_handler_t::replace)});
}

json hello(std::string_view mode, ClientId client) {
    return {{"type", "hello"},
            {"protocol", protocol_version},
            {"version", version},
            {"mode", mode},
            {"client", client},
            {"scenes", describeScenes()},
            {"fields", describeFields()},
            {"stages", describeStages()},
            {"sampleFields", sampleFields()},
            {"recordings", json::array()}};
}

json errorAnswer(std::string_view message, std::optional<std::int64_t> id) {
    json answer = {{"type", "error"}, {"text", message}};
    if (id) answer["id"] = *id;
    return answer;
}

}  // namespace

Viewer::Viewer(const LiveOptions& live, const ServerOptions& serving) {
    ServerOptions options = serving;
    options.longest_message = longest_upload;
    server_ = std::make_unique<Server>(options);
    simulation_ = std::make_unique<Simulation>(live, *server_);
    ServerEvents events;
    events.joined = [this](ClientId client) {
        server_->toOne(client, text(hello("live", client)));
        simulation_->join(client);
    };
    events.left = [this](ClientId client) { simulation_->leave(client); };
    events.text = [this](ClientId client, std::string_view message) {
        try {
            simulation_->post(client, parseCommand(message));
        } catch (const InputError& error) {
            server_->toOne(client, text(errorAnswer(error.what(), commandId(message))));
        }
    };
    server_->start(std::move(events));
}

Viewer::Viewer(const std::vector<std::filesystem::path>& recordings, const ServerOptions& serving) {
    if (recordings.empty() || recordings.size() > 2) {
        throw InputError(fmt::format("{} recordings cannot be shown; one or two can", recordings.size()));
    }
    ServerOptions options = serving;
    options.longest_message = longest_command;
    json names = json::array();
    for (const std::filesystem::path& file : recordings) {
        options.clips.push_back(std::make_shared<const std::string>(makeClip(RecordingReader(file))));
        names.push_back(file.filename().string());
    }
    server_ = std::make_unique<Server>(options);
    ServerEvents events;
    events.joined = [this, names](ClientId client) {
        json message = hello("replay", client);
        message["recordings"] = names;
        server_->toOne(client, text(message));
    };
    events.left = [](ClientId) {};
    events.text = [this](ClientId client, std::string_view message) {
        server_->toOne(client, text(errorAnswer("a recording takes no commands", commandId(message))));
    };
    server_->start(std::move(events));
}

Viewer::~Viewer() {
    // First nobody asks any more, then the simulation ends, then the server it speaks to.
    server_->stop();
    simulation_.reset();
}

std::string Viewer::address() const {
    return server_->address();
}

}  // namespace cairn::view
