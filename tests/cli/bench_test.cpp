/// @file The suites of `cairn bench` on the command line.
#include <nlohmann/json.hpp>

#include "cli/cli_fixture.h"

namespace cairn::test {
namespace {

using Json = nlohmann::json;

TEST_F(CommandLine, benchComparesResolversAndPresetsSideBySide) {
    const Finished done = cairn({"bench", "scenes", "--quick", "--scenes", "tower:2", "--resolver", "sweep,none",
                                 "--variant", "exact:preset=accuracy,iterations=3", "--json", "--save", "saved.json"});
    ASSERT_EQ(done.code, 0) << done.error;
    const Json result = Json::parse(done.out);
    EXPECT_EQ(result, Json::parse(read("saved.json")));
    std::vector<std::string> names;
    for (const Json& entry : result.at("entries")) names.push_back(entry.at("name"));
    EXPECT_EQ(names, (std::vector<std::string>{"tower:2/threads1", "tower:2/sweep/threads1", "tower:2/none/threads1",
                                               "tower:2/exact/threads1"}));
}

TEST_F(CommandLine, benchPeersNeedsNoPeers) {
    const Finished done = cairn(
        {"bench", "peers", "--quick", "--engines", "cairn", "--scenes", "tower:2", "--awake", "--plot", "peers.svg"});
    ASSERT_EQ(done.code, 0) << done.error;
    EXPECT_NE(done.out.find("sleeping off"), std::string::npos) << done.out;
    EXPECT_TRUE(read("peers.svg").starts_with("<svg "));
}

TEST_F(CommandLine, benchRefusesWhatItCannotMeasure) {
    expectWrongUse({"bench", "scenes", "--scenes", "nonsense"}, {"nonsense", "cairn scenes"});
    expectWrongUse({"bench", "scenes", "--variant", "noname"}, {"noname", "NAME:FIELD=VALUE"});
    expectWrongUse({"bench", "scenes", "--variant", "a:preset=fast"}, {"fast", "performance, accuracy"});
    expectWrongUse({"bench", "scenes", "--resolver", "magic"}, {"magic", "impulse_queue"});
    expectWrongUse({"bench", "scaling", "--sizes", "0"}, {"0 bodies"});
    expectWrongUse({"bench", "peers", "--engines", "cairn,havok"}, {"havok", "bullet"});
    expectWrongUse({"bench", "peers", "--engines", "cairn", "--scenes", "cradle_swing:5:2"}, {"joints"});
    expectWrongUse({"bench", "peers", "--save", "out", "--plot", "out"}, {"'out'", "two names"});
}

}  // namespace
}  // namespace cairn::test
