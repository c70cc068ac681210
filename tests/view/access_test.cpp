/// @file Who may ask for what.
#include "view/access.h"

#include <gtest/gtest.h>

#include "view/rate_limit.h"

namespace cairn::view {
namespace {

const Access local{8137, {}};

unsigned statusOf(std::string_view target, std::string_view host = "127.0.0.1:8137", std::string_view origin = "",
                  std::string_view method = "GET") {
    return judge({method, target, host, origin}, local).status;
}

TEST(Access, ServesTheFixedRoutesAndNothingElse) {
    EXPECT_EQ(judge({"GET", "/", "localhost:8137", ""}, local).route, Route::page);
    EXPECT_EQ(judge({"GET", "/recording/1?x=y", "localhost:8137", ""}, local).recording, 1U);
    for (const char* target :
         {"/index.html", "/recording/2", "/recording/", "/recording/../..", "/../../etc/passwd", "//",
          "/%2e%2e/etc/passwd", "/recording/0/../1", "", "*", "http://127.0.0.1:8137/", "/ws/x"}) {
        EXPECT_EQ(statusOf(target), 404U) << target;
    }
}

TEST(Access, RefusesOtherHostsAndOrigins) {
    EXPECT_EQ(statusOf("/", "evil.example:8137"), 403U);
    EXPECT_EQ(statusOf("/", ""), 403U);
    EXPECT_EQ(statusOf("/", "127.0.0.1:80"), 403U);
    EXPECT_EQ(statusOf("/ws", "127.0.0.1:8137", "http://evil.example"), 403U);
    EXPECT_EQ(statusOf("/ws", "127.0.0.1:8137", "null"), 403U);
    EXPECT_EQ(statusOf("/", "127.0.0.1:8137", "http://127.0.0.1:8137"), 200U);
}

TEST(Access, OnlyWebSocketsGetTheSocket) {
    EXPECT_EQ(statusOf("/ws"), 426U);
    const Verdict verdict =
        judge({"GET", "/ws", "127.0.0.1:8137", "http://127.0.0.1:8137", RequestFacts::Kind::upgrade}, local);
    EXPECT_EQ(verdict.route, Route::socket);
    EXPECT_EQ(statusOf("/", "127.0.0.1:8137", "", "POST"), 405U);
}

TEST(Access, WithATokenEveryAddressNeedsIt) {
    const Access open{8137, "secret"};
    EXPECT_EQ(judge({"GET", "/", "192.168.0.2:8137", ""}, open).status, 403U);
    EXPECT_EQ(judge({"GET", "/?token=wrong", "192.168.0.2:8137", ""}, open).status, 403U);
    EXPECT_EQ(judge({"GET", "/?token=secre", "192.168.0.2:8137", ""}, open).status, 403U);
    EXPECT_EQ(judge({"GET", "/?xtoken=secret", "192.168.0.2:8137", ""}, open).status, 403U);
    EXPECT_EQ(judge({"GET", "/?a=b&token=secret", "192.168.0.2:8137", ""}, open).route, Route::page);
    EXPECT_EQ(judge({"GET", "/recording/0?token=secret", "h:1", "http://h:1"}, open).route, Route::recording);
}

TEST(Access, TokensAreLongAndNeverTheSame) {
    EXPECT_EQ(makeToken().size(), 32U);
    EXPECT_NE(makeToken(), makeToken());
    EXPECT_TRUE(equalSecrets("abc", "abc"));
    EXPECT_FALSE(equalSecrets("abc", "abcd"));
    EXPECT_FALSE(equalSecrets("abc", "abd"));
}

TEST(RateLimit, LetsABurstThroughAndThenSoManyASecond) {
    RateLimit limit(10, 5);
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(limit.take(100));
    EXPECT_FALSE(limit.take(100));
    EXPECT_TRUE(limit.take(100.125));
    EXPECT_FALSE(limit.take(100.125));
    EXPECT_FALSE(limit.take(50));  // a clock that goes back gives nothing
}

}  // namespace
}  // namespace cairn::view
