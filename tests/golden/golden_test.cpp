/// The golden scenes run as they did when their hashes were kept.
#include <gtest/gtest.h>

#include <string>

#include "golden/rows.h"
#include "golden/scene_names.h"

namespace cairn::golden {
namespace {

const Rows& keptRows() {
    static const Rows rows = readRows(CAIRN_SOURCE_DIR "/tests/golden/hashes.json");
    return rows;
}

class Golden : public testing::TestWithParam<SceneAndKind> {};

TEST_P(Golden, HashesAreTheKeptOnes) {
    const auto [name, kind] = GetParam();
    Rows rows;
    addRows(goldenScene(name), kind, rows);
    for (const auto& [key, hash] : rows) {
        const auto kept = keptRows().find(key);
        ASSERT_NE(kept, keptRows().end()) << describe(key) << " is not kept; `make golden UPDATE=1` keeps it";
        EXPECT_EQ(hash, kept->second) << describe(key) << ": the hash is " << hash << ", the kept one " << kept->second
                                      << "; `make golden` lists all that changed";
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, testing::ValuesIn(everySceneWithEveryKind()), nameOfSceneAndKind);

TEST(GoldenRows, AreThoseOfTheScenes) {
    std::size_t rows = 0;
    for (const GoldenScene& scene : goldenScenes()) {
        for (const Kind kind : kinds) rows += scene.hashSteps(kind).size();
    }
    EXPECT_EQ(keptRows().size(), rows) << "`make golden` lists the rows that are gone";
}

}  // namespace
}  // namespace cairn::golden
