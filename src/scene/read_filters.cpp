#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scene/scene_reading.h"

namespace cairn {
namespace {

std::string knownGroups(const SceneReading& reading) {
    const std::vector<std::string>& groups = reading.scene.filters.groups;
    if (groups.empty()) return "'filters.groups' lists none";
    return fmt::format("known are {}", fmt::join(groups, ", "));
}

/// Two texts or two references in an array.
void expectPair(const JsonNode& node, std::string_view allowed) {
    if (!node.value().is_array() || node.size() != 2) node.refuse(allowed);
}

void readApart(const JsonNode& node, SceneReading& reading) {
    node.expectArray("an array of pairs of groups");
    std::set<std::pair<std::string, std::string>> seen;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const JsonNode pair = node.element(i);
        expectPair(pair, "an array of the names of two groups");
        const std::string a = readGroup(pair.element(0), reading);
        const std::string b = readGroup(pair.element(1), reading);
        if (!seen.insert(std::minmax(a, b)).second) {
            pair.fail("is a pair that was given before; both orders of the names mean the same pair");
        }
        reading.scene.filters.apart.emplace_back(a, b);
    }
}

void readExceptions(const JsonNode& node, SceneReading& reading) {
    node.expectArray("an array of exceptions");
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const JsonNode entry = node.element(i);
        entry.expectKeys({"a", "b", "touch"});
        SceneException exception;
        exception.a = readBodyReference(entry.required("a", "the index or the name of a body"), reading);
        exception.b = readBodyReference(entry.required("b", "the index or the name of a body"), reading);
        exception.touch = entry.required("touch", "true or false").flag() ? Touch::always : Touch::never;
        if (exception.a == exception.b) entry.fail("names one body twice; an exception is about two bodies");
        if (!seen.insert(std::minmax(exception.a, exception.b)).second) {
            entry.fail("is about a pair of bodies that was given before; give it once");
        }
        reading.scene.filters.exceptions.push_back(exception);
    }
}

}  // namespace

std::string readGroup(const JsonNode& node, const SceneReading& reading) {
    const std::string name = node.text();
    const std::vector<std::string>& groups = reading.scene.filters.groups;
    if (std::ranges::find(groups, name) == groups.end()) {
        node.fail(fmt::format("is the unknown group '{}'; {}", name, knownGroups(reading)));
    }
    return name;
}

void readGroups(const JsonNode& node, SceneReading& reading) {
    node.expectKeys({"groups", "apart", "exceptions"});
    const auto list = node.find("groups");
    if (list) {
        list->expectArray("an array of names");
        std::vector<std::string>& groups = reading.scene.filters.groups;
        for (std::size_t i = 0; i < list->size(); ++i) {
            const JsonNode entry = list->element(i);
            if (i >= most_groups)
                entry.fail(fmt::format("is one too many; a scene has at most {} groups", most_groups));
            const std::string name = entry.text();
            if (std::ranges::find(groups, name) != groups.end()) {
                entry.fail(fmt::format("is the group '{}' a second time; a name must be unique", name));
            }
            groups.push_back(name);
        }
    }
    if (const auto apart = node.find("apart")) readApart(*apart, reading);
}

void readFilterExceptions(const JsonNode& node, SceneReading& reading) {
    if (const auto exceptions = node.find("exceptions")) readExceptions(*exceptions, reading);
}

}  // namespace cairn
