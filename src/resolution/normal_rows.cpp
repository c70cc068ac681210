#include "resolution/normal_rows.h"

namespace cairn {

void NormalRows::build(const LocalBatch& batch) {
    // Counting sort. begin_[i + 1] is first the number of contacts of body i, then the place of its next one, and in
    // the end that of its last one plus 1.
    begin_.assign(batch.bodies.size() + 2, 0);
    const auto count = [&](std::uint32_t body) {
        if (!batch.isFixed(body)) ++begin_[body + 2];
    };
    for (const ContactFrame& c : batch.contacts) {
        count(c.a);
        count(c.b);
    }
    for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    contact_.resize(begin_.back());
    row_.resize(begin_.back());
    const auto place = [&](std::uint32_t body, std::size_t contact, const Vec3& direction, const Vec3& r) {
        if (batch.isFixed(body)) return;
        const std::uint32_t at = begin_[body + 1]++;
        contact_[at] = static_cast<std::uint32_t>(contact);
        row_[at] = {direction, r.cross(direction)};
    };
    for (std::size_t i = 0; i < batch.contacts.size(); ++i) {
        const ContactFrame& c = batch.contacts[i];
        place(c.a, i, c.basis.col(0), c.r_a);
        place(c.b, i, -c.basis.col(0), c.r_b);
    }
}

}  // namespace cairn
