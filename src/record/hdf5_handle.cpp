#include "record/hdf5_handle.h"

#include <fmt/format.h>

#include "cairn/types.h"

namespace cairn::hdf5 {

namespace {

constexpr std::string_view system_reason = "error message = '";

/// Keeps the system's reason if an entry has one, else the innermost description.
herr_t pickReason(unsigned, const H5E_error2_t* entry, void* out) {
    auto& reason = *static_cast<std::string*>(out);
    const std::string_view description = entry->desc != nullptr ? entry->desc : "";
    const std::size_t begin = description.find(system_reason);
    if (begin != std::string_view::npos) {
        const std::string_view rest = description.substr(begin + system_reason.size());
        reason = rest.substr(0, rest.find('\''));
        return 1;
    }
    if (reason.empty()) reason = description;
    return 0;
}

}  // namespace

QuietErrors::QuietErrors() {
    H5Eget_auto2(H5E_DEFAULT, &handler_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietErrors::~QuietErrors() {
    H5Eset_auto2(H5E_DEFAULT, handler_, data_);
}

std::string lastError() {
    std::string reason;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, pickReason, &reason);
    return reason.empty() ? "unknown reason" : reason;
}

void fail(const std::filesystem::path& file, std::string_view what) {
    throw IoError(fmt::format("{}: {}: {}", file.string(), what, lastError()));
}

}  // namespace cairn::hdf5
