/// What `make golden` runs: `golden FILE` lists the rows that changed and ends with 1 if there are any; `golden FILE
/// --update` lists and keeps them.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string_view>

#include "golden/rows.h"

namespace cairn::golden {
namespace {

Rows computeAll() {
    Rows rows;
    for (const GoldenScene& scene : goldenScenes()) {
        for (const Kind kind : kinds) addRows(scene, kind, rows);
    }
    return rows;
}

/// Lists what differs. @return number of rows that do
std::size_t listChanges(const Rows& kept, const Rows& now) {
    std::size_t changes = 0;
    const auto list = [&](const RowKey& key, std::string_view before, std::string_view after) {
        fmt::print("{}: {} -> {}\n", describe(key), before, after);
        ++changes;
    };
    for (const auto& [key, hash] : now) {
        const auto found = kept.find(key);
        if (found == kept.end()) {
            list(key, "(new)", hash);
        } else if (found->second != hash) {
            list(key, found->second, hash);
        }
    }
    for (const auto& [key, hash] : kept) {
        if (!now.contains(key)) list(key, hash, "(gone)");
    }
    fmt::print("{} of {} rows changed\n", changes, now.size());
    return changes;
}

int update(const std::filesystem::path& file) {
    const Rows now = computeAll();
    const Rows kept = std::filesystem::exists(file) ? readRows(file) : Rows();
    if (listChanges(kept, now) > 0) writeRows(now, file);
    return 0;
}

int compare(const std::filesystem::path& file) {
    return listChanges(readRows(file), computeAll()) > 0 ? 1 : 0;
}

}  // namespace
}  // namespace cairn::golden

int main(int argc, char** argv) {
    using namespace cairn::golden;
    try {
        if (argc == 2) return compare(argv[1]);
        if (argc == 3 && std::string_view(argv[2]) == "--update") return update(argv[1]);
        fmt::print(stderr, "usage: golden FILE [--update]\n");
    } catch (const std::exception& error) {
        fmt::print(stderr, "golden: {}\n", error.what());
    }
    return 2;
}
