#include "access.h"

#include <fmt/format.h>

#include <random>

namespace cairn::view {

namespace {

constexpr std::string_view recording_path = "/recording/";

/// The value of a query parameter; tokens need no decoding.
std::string_view parameter(std::string_view query, std::string_view name) {
    while (!query.empty()) {
        const std::string_view part = query.substr(0, query.find('&'));
        query.remove_prefix(std::min(query.size(), part.size() + 1));
        if (part.size() > name.size() && part.substr(0, name.size()) == name && part[name.size()] == '=') {
            return part.substr(name.size() + 1);
        }
    }
    return {};
}

bool isOwnHost(std::string_view host, std::uint16_t port) {
    for (const std::string_view name : {"127.0.0.1", "localhost", "[::1]"}) {
        if (host == fmt::format("{}:{}", name, port)) return true;
        if (port == 80 && host == name) return true;
    }
    return false;
}

bool isOwnOrigin(std::string_view origin, std::string_view host) {
    constexpr std::string_view scheme = "http://";
    return origin.substr(0, scheme.size()) == scheme && origin.substr(scheme.size()) == host;
}

Verdict route(std::string_view path) {
    if (path == "/") return {200, Route::page, 0, {}};
    if (path == "/ws") return {101, Route::socket, 0, {}};
    if (path.substr(0, recording_path.size()) == recording_path) {
        const std::string_view index = path.substr(recording_path.size());
        if (index == "0" || index == "1") return {200, Route::recording, index == "1" ? 1U : 0U, {}};
    }
    return {404, Route::none, 0, "There is nothing here."};
}

}  // namespace

bool equalSecrets(std::string_view a, std::string_view b) {
    unsigned difference = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const char other = i < b.size() ? b[i] : '\0';
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(other);
    }
    return difference == 0;
}

std::string makeToken() {
    std::random_device random;
    return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

Verdict judge(const RequestFacts& request, const Access& access) {
    const std::string_view path = request.target.substr(0, request.target.find('?'));
    const std::string_view query = request.target.substr(std::min(request.target.size(), path.size() + 1));
    if (access.token.empty() && !isOwnHost(request.host, access.port)) {
        return {403, Route::none, 0, "This server answers for this machine only."};
    }
    if (!request.origin.empty() && !isOwnOrigin(request.origin, request.host)) {
        return {403, Route::none, 0, "Pages of other origins are refused."};
    }
    if (!access.token.empty() && !equalSecrets(parameter(query, "token"), access.token)) {
        return {403, Route::none, 0, "The address lacks the token that cairn view printed."};
    }
    if (request.method != "GET" && request.method != "HEAD") {
        return {405, Route::none, 0, "Only GET and HEAD are answered."};
    }
    const Verdict verdict = route(path);
    if (verdict.route == Route::socket && request.kind != RequestFacts::Kind::upgrade) {
        return {426, Route::none, 0, "This address is for WebSockets."};
    }
    return verdict;
}

}  // namespace cairn::view
