#include "resolution/contact_colours.h"

#include <bit>

namespace cairn {

namespace {

/// Colours that fit into a word; pairs of bodies with more neighbours share one more, which is solved by one thread.
constexpr std::size_t most_colours = 64;

}  // namespace

void ContactColours::colour(std::span<const ContactEnds> ends, std::size_t moving) {
    used_.assign(moving, 0);
    colour_of_.clear();
    first_.clear();
    std::uint32_t count[most_colours + 1] = {};
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (i > 0 && ends[i] == ends[i - 1]) continue;
        const ContactEnds& pair = ends[i];
        std::uint64_t taken = 0;
        if (pair.a < moving) taken |= used_[pair.a];
        if (pair.b < moving) taken |= used_[pair.b];
        const auto colour = static_cast<std::size_t>(std::countr_one(taken));
        if (colour < most_colours) {
            if (pair.a < moving) used_[pair.a] |= std::uint64_t{1} << colour;
            if (pair.b < moving) used_[pair.b] |= std::uint64_t{1} << colour;
        }
        ++count[colour];
        colour_of_.push_back(static_cast<std::uint8_t>(colour));
        first_.push_back(static_cast<std::uint32_t>(i));
    }
    const std::size_t pairs = first_.size();
    first_.push_back(static_cast<std::uint32_t>(ends.size()));

    colour_begin_.assign(1, 0);
    std::uint32_t cursor[most_colours + 1];
    shared_ = 0;
    for (std::size_t c = 0; c <= most_colours; ++c) {
        cursor[c] = colour_begin_.back();
        if (count[c] == 0) continue;
        if (c < most_colours) ++shared_;
        colour_begin_.push_back(colour_begin_.back() + count[c]);
    }
    pair_order_.resize(pairs);
    for (std::size_t p = 0; p < pairs; ++p) pair_order_[cursor[colour_of_[p]]++] = static_cast<std::uint32_t>(p);

    order_.clear();
    pair_begin_.clear();
    for (const std::uint32_t p : pair_order_) {
        pair_begin_.push_back(static_cast<std::uint32_t>(order_.size()));
        for (std::uint32_t i = first_[p]; i < first_[p + 1]; ++i) order_.push_back(i);
    }
    pair_begin_.push_back(static_cast<std::uint32_t>(order_.size()));
}

}  // namespace cairn
