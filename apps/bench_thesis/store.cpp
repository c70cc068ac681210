#include "store.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "cairn/types.h"

namespace cairn::thesis {

namespace {

constexpr int format = 1;

[[noreturn]] void fail(const std::filesystem::path& file, const char* what) {
    throw IoError(fmt::format("{}: {}: {}", file.string(), what, std::strerror(errno)));
}

}  // namespace

void writeWhole(const std::filesystem::path& file, const std::string& text) {
    const std::filesystem::path fresh = file.string() + ".new";
    std::ofstream stream(fresh, std::ios::binary);
    stream << text << std::flush;
    if (!stream) fail(fresh, "cannot be written");
    stream.close();
    std::error_code error;
    std::filesystem::rename(fresh, file, error);
    if (error) throw IoError(fmt::format("{}: cannot be replaced: {}", file.string(), error.message()));
}

std::string readWhole(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) fail(file, "cannot be read");
    return text.str();
}

Store::Store(std::filesystem::path file, Json origin) : file_(std::move(file)), origin_(std::move(origin)) {
    if (!std::filesystem::exists(file_)) return;
    Json before;
    try {
        before = Json::parse(readWhole(file_));
    } catch (const Json::exception& error) {
        throw IoError(fmt::format("{}: is not a results file ({}); remove it or give another folder with --out",
                                  file_.string(), error.what()));
    }
    if (before.value("format", 0) != format || before.value("origin", Json()) != origin_) return;
    experiments_ = before.at("experiments");
}

std::size_t Store::repetitions(const Experiment& experiment) const {
    const auto found = experiments_.find(experiment.key);
    if (found == experiments_.end() || found->at("fingerprint") != experiment.fingerprint) return 0;
    return found->at("repetitions").size();
}

double Store::spent(const Experiment& experiment) const {
    return repetitions(experiment) == 0 ? 0 : experiments_.at(experiment.key).at("spent_ms").get<double>();
}

void Store::add(const Experiment& experiment, const Json& value, double ms) {
    if (repetitions(experiment) == 0) {
        experiments_[experiment.key] = {
            {"fingerprint", experiment.fingerprint}, {"spent_ms", 0.0}, {"repetitions", Json::array()}};
    }
    Json& kept = experiments_[experiment.key];
    kept["spent_ms"] = kept["spent_ms"].get<double>() + ms;
    kept["repetitions"].push_back(value);
    write();
}

void Store::setReport(const Json& report) {
    report_ = report;
    write();
}

Results Store::results() const {
    Results results;
    for (const auto& [key, kept] : experiments_.items()) results[key] = kept.at("repetitions");
    return results;
}

void Store::write() const {
    Json json = {{"format", format}, {"origin", origin_}};
    if (!report_.is_null()) json["report"] = report_;
    json["experiments"] = experiments_;
    writeWhole(file_, json.dump() + "\n");
}

}  // namespace cairn::thesis
