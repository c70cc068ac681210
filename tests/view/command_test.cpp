/// @file Commands of viewers: what is understood, what is refused, and that nothing at all crashes the parser.
#include "view/command.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

namespace cairn::view {
namespace {

template <typename Kind>
Kind parsed(std::string_view text) {
    return std::get<Kind>(parseCommand(text).action);
}

std::string refusal(std::string_view text) {
    try {
        parseCommand(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(Command, ReadsWhatThePageSends) {
    EXPECT_EQ(parsed<Step>(R"({"do":"step","count":8})").count, 8);
    EXPECT_EQ(parsed<SetSpeed>(R"({"do":"speed","value":0.25})").speed, 0.25);
    EXPECT_EQ(std::get<std::int64_t>(parsed<SetField>(R"({"do":"set","field":"threads","value":2})").value), 2);
    EXPECT_EQ(std::get<bool>(parsed<SetField>(R"({"do":"set","field":"sleeping","value":false})").value), false);
    const auto ball =
        parsed<ThrowBall>(R"({"do":"throw","origin":[0,1,2],"velocity":[3,4,5],"radius":0.1,"material":"iron"})");
    EXPECT_EQ(ball.origin, Vec3(0, 1, 2));
    EXPECT_EQ(ball.velocity, Vec3(3, 4, 5));
    EXPECT_EQ(ball.radius, 0.1);
    const auto box =
        parsed<AddBody>(R"({"do":"add","shape":{"type":"box","size":[1,2,3]},"material":"oak","position":[0,0,9]})");
    EXPECT_EQ(std::get<Box>(box.shape).size, Vec3(1, 2, 3));
    const auto cylinder = parsed<AddBody>(
        R"({"do":"add","shape":{"type":"cylinder","radius":0.1,"length":0.3},"material":"oak","position":[0,0,9]})");
    EXPECT_EQ(std::get<Cylinder>(cylinder.shape).radius, 0.1);
    EXPECT_EQ(std::get<Cylinder>(cylinder.shape).length, 0.3);
    EXPECT_EQ(parsed<DeleteBody>(R"({"do":"delete","body":[7,2]})").body, (BodyId{7, 2}));
    EXPECT_EQ(parsed<SelectBody>(R"({"do":"select","body":null})").body, std::nullopt);
    EXPECT_EQ(parsed<ChooseLayers>(R"({"do":"layers","layers":["speed","contacts"]})").layers,
              bit(Layer::speed) | bit(Layer::contacts));
    const auto cast = parsed<CastRays>(R"({"do":"rays","origin":[1,2,3],"directions":[[0,0,-1],[1,0,0]]})");
    ASSERT_EQ(cast.rays.size(), 2U);
    EXPECT_EQ(cast.rays[1].origin, Vec3(1, 2, 3));
    EXPECT_EQ(cast.rays[1].direction, Vec3::UnitX());
    EXPECT_TRUE(parsed<CastRays>(R"({"do":"rays","origin":[0,0,0],"directions":[]})").rays.empty());
}

TEST(Command, KeepsTheNumberForTheAnswer) {
    EXPECT_EQ(parseCommand(R"({"do":"play","id":12})").id, 12);
    EXPECT_EQ(parseCommand(R"({"do":"play"})").id, std::nullopt);
    EXPECT_EQ(commandId(R"({"do":"nonsense","id":3})"), 3);
    EXPECT_EQ(commandId("["), std::nullopt);
    EXPECT_EQ(commandId(R"({"id":-1})"), std::nullopt);
    EXPECT_EQ(commandId(R"({"id":1e300})"), std::nullopt);
}

TEST(Command, RefusalsNameTheMemberTheValueAndWhatIsAllowed) {
    EXPECT_NE(refusal(R"({"do":"step","count":0})").find("'count' is 0; allowed is 1"), std::string::npos);
    EXPECT_NE(refusal(R"({"do":"step"})").find("'count' is missing"), std::string::npos);
    EXPECT_NE(refusal(R"({"do":"dial","value":1.5})").find("1.5"), std::string::npos);
    EXPECT_NE(refusal(R"({"do":"fly"})").find("'fly' is unknown"), std::string::npos);
    EXPECT_NE(refusal(R"({"do":"play","speed":1})").find("unknown member 'speed'"), std::string::npos);
    EXPECT_NE(refusal(R"({"do":"drag","target":[0,1e300,0]})").find("1e+300"), std::string::npos);
    EXPECT_NE(refusal(R"({"do":"layers","layers":["x-ray"]})").find("speed"), std::string::npos);
    EXPECT_NE(refusal(R"({"do":"rays","origin":[0,0,0],"directions":[[0,0,0]]})").find("no length"), std::string::npos);
    EXPECT_NE(refusal(R"({"do":"rays","origin":[0,0,0],"directions":[[2,0,0]]})").find("allowed is -1 to 1"),
              std::string::npos);
    EXPECT_NE(refusal("").find("JSON"), std::string::npos);
    EXPECT_NE(refusal("[]").find("object"), std::string::npos);
    EXPECT_NE(refusal(R"({"do":7})").find("'do'"), std::string::npos);
}

TEST(Command, WrongTypesAreRefusedEverywhere) {
    for (const char* wrong : {"null", "true", "7", "\"text\"", "[]", "[1]", "{}", "1e999", "[null,null,null]"}) {
        for (const std::string verb :
             {"drag\",\"target", "select\",\"bodies", "grab\",\"body", "add\",\"shape", "freeze\",\"fixed"}) {
            EXPECT_NE(refusal(fmt::format(R"({{"do":"{}":{}}})", verb, wrong)), "") << verb << " " << wrong;
        }
    }
}

TEST(Command, LongTextsAreRefusedUnlessTheyAreSceneFiles) {
    const std::string text(longest_command, 'a');
    EXPECT_NE(refusal(R"({"do":"load","scene":")" + text + "\"}"), "");
    EXPECT_EQ(parsed<LoadText>(R"({"do":"upload","name":"a.json","text":")" + text + "\"}").text, text);
}

/// Cuts, doubles and exchanges bytes of good commands; a fixed seed, so that a failure can be found again.
TEST(Command, NoChangedBytesDoMoreThanRefuse) {
    const std::vector<std::string> seeds = {
        R"({"do":"throw","origin":[0,1,2],"velocity":[3,4,5],"radius":0.1,"material":"iron","id":5})",
        R"({"do":"add","shape":{"type":"capsule","radius":0.1,"length":2},"material":"oak","position":[0,0,9]})",
        R"({"do":"set","field":"damping","value":0.5})",
        R"({"do":"grab","body":[1,0],"point":[0,0,1]})",
        R"({"do":"layers","layers":["speed","batch","bounds"]})",
        R"({"do":"rays","origin":[0,1,2],"directions":[[0,0,-1],[1,0,0.5]]})"};
    std::mt19937_64 random(7);
    int understood = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string text = seeds[random() % seeds.size()];
        for (std::uint64_t changes = random() % 4; changes > 0; --changes) {
            const std::size_t at = random() % text.size();
            switch (random() % 4) {
                case 0:
                    text[at] = static_cast<char>(random());
                    break;
                case 1:
                    text.erase(at, 1 + random() % 8);
                    break;
                case 2:
                    text.insert(at, text.substr(at, random() % 12));
                    break;
                default:
                    text.insert(at, 1, "0123456789eE+-.,:[]{}\"\\"[random() % 23]);
                    break;
            }
            if (text.empty()) text.push_back('{');
        }
        commandId(text);
        if (refusal(text).empty()) ++understood;
    }
    EXPECT_GT(understood, 1000);  // unchanged ones come through
}

TEST(Command, DeepNestingIsNoDanger) {
    EXPECT_NE(refusal(std::string(50000, '[')), "");
    EXPECT_NE(refusal(R"({"do":"play","x":)" + std::string(20000, '[') + std::string(20000, ']') + "}"), "");
}

}  // namespace
}  // namespace cairn::view
