/// @file What the tests of the scenes share.
#pragma once

#include <string>
#include <string_view>

#include "cairn/scene.h"

namespace cairn::testing {

/// The text of the InputError that an action throws; empty if it throws none.
template <typename Action>
std::string messageOf(Action action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// The message for a text that is no good scene.
inline std::string parseMessage(std::string_view json) {
    return messageOf([json] { parseScene(json, "test.json"); });
}

/// A scene file with a ground, a ball and a sleeping box; the parameter is put between the bodies and the end, such as
/// `,"events":[…]`.
inline std::string sceneText(std::string_view rest = "") {
    return std::string(R"({"name":"test","duration":2,"gravity":[0,0,-10],
"materials":{"oak":{"density":800},"iron":{"density":7874}},
"contacts":{"default":{"restitution":0.5}},
"bodies":[
{"shape":{"type":"plane","normal":[0,0,1],"offset":0},"material":"oak","fixed":true},
{"shape":{"type":"sphere","radius":0.5},"material":"iron","name":"ball","position":[0,0,5]},
{"shape":{"type":"box","size":[1,2,3]},"material":"oak","name":"crate","position":[5,0,1.5],"asleep":true}
])") + std::string(rest) +
           "}\n";
}

/// The same scene with one more body, `bodies[3]`.
inline std::string sceneWithBody(std::string_view body) {
    std::string text = sceneText();
    text.insert(text.rfind("\n]"), ",\n" + std::string(body));
    return text;
}

}  // namespace cairn::testing
