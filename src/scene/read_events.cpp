#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "scene/body_title.h"
#include "scene/scene_reading.h"

namespace cairn {

std::size_t readBodyReference(const JsonNode& node, const SceneReading& reading) {
    const std::size_t count = reading.scene.bodies.size();
    const Json& value = node.value();
    if (value.is_string()) {
        const auto found = reading.by_name.find(value.get_ref<const std::string&>());
        if (found == reading.by_name.end()) {
            node.fail(
                fmt::format("names the unknown body {}; it must be the name of a body or an index", shown(value)));
        }
        return found->second;
    }
    if (!value.is_number_integer()) node.refuse("the index or the name of a body");
    if (!(value.is_number_unsigned() && value.get<std::uint64_t>() < count)) {
        node.fail(fmt::format("is {}, a body that does not exist; {}", shown(value),
                              count == 0 ? std::string("the scene has no bodies")
                                         : fmt::format("allowed are indices 0 to {} and names", count - 1)));
    }
    return value.get<std::size_t>();
}

namespace {

constexpr std::string_view event_rule =
    "an event has either gravity, or a body with exactly one of set_velocity, impulse, force, torque and remove";

EventAction readBodyAction(const JsonNode& node, const JsonNode& action, std::string_view kind, std::size_t body) {
    if (kind == "set_velocity") return SetVelocity{body, action.vector()};
    if (kind == "impulse") return GiveImpulse{body, action.vector()};
    if (kind == "force") return SetForce{body, action.vector()};
    if (kind == "torque") return SetTorque{body, action.vector()};
    if (!action.flag()) node.fail("has remove false and so does nothing; remove must be true");
    return RemoveBody{body};
}

SceneEvent readEvent(const JsonNode& node, const SceneReading& reading) {
    node.expectKeys({"time", "gravity", "body", "set_velocity", "impulse", "force", "torque", "remove"});
    SceneEvent event;
    event.time = node.required("time", "a number, 0 or above [s]").nonNegative();
    std::vector<std::string_view> kinds;
    for (const std::string_view key : {"gravity", "set_velocity", "impulse", "force", "torque", "remove"}) {
        if (node.find(key)) kinds.push_back(key);
    }
    if (kinds.size() != 1) {
        node.fail(fmt::format("has {}; {}", kinds.empty() ? "no action" : fmt::format("{}", fmt::join(kinds, " and ")),
                              event_rule));
    }
    const JsonNode action = *node.find(kinds.front());
    const auto body_node = node.find("body");
    if (kinds.front() == "gravity") {
        if (body_node) node.fail(fmt::format("has gravity and body; {}", event_rule));
        event.action = SetGravity{action.vector()};
        return event;
    }
    if (!body_node) node.fail(fmt::format("has {} without body; {}", kinds.front(), event_rule));
    const std::size_t body = readBodyReference(*body_node, reading);
    event.action = readBodyAction(node, action, kinds.front(), body);
    if (reading.scene.bodies[body].fixed && kinds.front() != "remove") {
        body_node->fail(fmt::format("is {}, which is fixed and so ignores {}; a fixed body can only be removed",
                                    bodyTitle(reading.scene.bodies[body], body), kinds.front()));
    }
    return event;
}

/// Refuses events for bodies that an earlier one removed.
void checkRemovals(const JsonNode& node, const Scene& scene) {
    std::vector<std::size_t> order(scene.events.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&scene](std::size_t a, std::size_t b) { return scene.events[a].time < scene.events[b].time; });
    std::map<std::size_t, std::size_t> removed_by;  // event of each removed body
    for (const std::size_t i : order) {
        std::visit(
            [&](const auto& action) {
                if constexpr (!std::is_same_v<std::decay_t<decltype(action)>, SetGravity>) {
                    if (const auto found = removed_by.find(action.body); found != removed_by.end()) {
                        const JsonNode event = node.element(i);
                        event.required("body", "a body")
                            .fail(fmt::format("is {}, which events[{}] removed at {} s; events must come before it",
                                              bodyTitle(scene.bodies[action.body], action.body), found->second,
                                              scene.events[found->second].time));
                    }
                    if constexpr (std::is_same_v<std::decay_t<decltype(action)>, RemoveBody>) {
                        removed_by.emplace(action.body, i);
                    }
                }
            },
            scene.events[i].action);
    }
}

SceneSpring readSpring(const JsonNode& node, const SceneReading& reading) {
    node.expectKeys({"a", "b", "anchor_a", "anchor_b", "stiffness", "damping", "rest_length"});
    SceneSpring spring;
    spring.a = readBodyReference(node.required("a", "the index or the name of a body"), reading);
    const auto b = node.find("b");
    if (b) {
        spring.b = readBodyReference(*b, reading);
        if (*spring.b == spring.a) b->fail("is the same body as a; a spring joins two bodies, or one and a point");
    }
    const std::vector<SceneBody>& bodies = reading.scene.bodies;
    if (bodies[spring.a].fixed && (!spring.b || bodies[*spring.b].fixed)) {
        node.fail("joins nothing that can move; at least one of its bodies must not be fixed");
    }
    if (const auto value = node.find("anchor_a")) spring.anchor_a = value->vector();
    if (const auto value = node.find("anchor_b")) spring.anchor_b = value->vector();
    spring.stiffness = node.required("stiffness", "a number, 0 or above [N/m]").nonNegative();
    if (const auto value = node.find("damping")) spring.damping = value->nonNegative();
    if (const auto value = node.find("rest_length")) spring.rest_length = value->nonNegative();
    return spring;
}

}  // namespace

void readEvents(const JsonNode& node, SceneReading& reading) {
    node.expectArray("an array of events");
    for (std::size_t i = 0; i < node.size(); ++i) {
        const JsonNode entry = node.element(i);
        reading.scene.events.push_back(readEvent(entry, reading));
    }
    checkRemovals(node, reading.scene);
}

void readSprings(const JsonNode& node, SceneReading& reading) {
    node.expectArray("an array of springs");
    for (std::size_t i = 0; i < node.size(); ++i) {
        const JsonNode entry = node.element(i);
        reading.scene.springs.push_back(readSpring(entry, reading));
    }
}

}  // namespace cairn
