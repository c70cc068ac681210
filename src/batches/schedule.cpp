#include "batches/schedule.h"

#include <algorithm>

namespace cairn {

namespace {

/// Contacts of the smallest batch that is handed out by itself.
constexpr std::size_t large_contacts = 32;

}  // namespace

void BatchSchedule::arrange(std::span<const BatchView> batches) {
    const auto contactsOf = [&](std::uint32_t i) { return batches[i].contacts.size(); };
    const auto count = static_cast<std::uint32_t>(batches.size());
    order_.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        if (contactsOf(i) >= large_contacts) order_.push_back(i);
    }
    large_ = order_.size();
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t i, std::uint32_t j) {
        return contactsOf(i) != contactsOf(j) ? contactsOf(i) > contactsOf(j) : i < j;
    });
    for (std::uint32_t i = 0; i < count; ++i) {
        if (contactsOf(i) < large_contacts) order_.push_back(i);
    }
}

}  // namespace cairn
