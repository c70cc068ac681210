/// @file Who may ask the server for what: routes, hosts, origins and the token.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cairn::view {

/// What the server was started with.
struct Access {
    std::uint16_t port = 0;
    std::string token;  ///< asked for in every address if not empty
};

/// The parts of an HTTP request that decide.
struct RequestFacts {
    std::string_view method;
    std::string_view target;
    std::string_view host;
    std::string_view origin;  ///< empty if not given
    enum class Kind { plain, upgrade } kind = Kind::plain;
};

enum class Route { none, page, socket, recording };

/// What is to be answered.
struct Verdict {
    unsigned status = 404;
    Route route = Route::none;
    std::size_t recording = 0;  ///< index, for Route::recording
    std::string_view text;      ///< why it was refused
};

/// Everything that is served is in memory; there are four fixed routes and no file names. Requests for another host
/// (a rebound name), from another page, or without the token are refused.
Verdict judge(const RequestFacts& request, const Access& access);

/// 128 random bits as text.
std::string makeToken();

/// Takes the same time wherever the texts differ.
bool equalSecrets(std::string_view a, std::string_view b);

}  // namespace cairn::view
