#include "world/byte_stream.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cairn {
namespace {

/// Numbers one by one, and as one array.
void putContent(ByteWriter& out, std::size_t numbers, std::size_t in_array) {
    for (std::size_t i = 0; i < numbers; ++i) out.put(static_cast<std::uint8_t>(i * 7));
    if (in_array == 0) return;
    std::vector<double> values(in_array);
    for (std::size_t i = 0; i < in_array; ++i) values[i] = static_cast<double>(i) / 3;
    out.putArray(std::span<const double>(values));
}

TEST(ByteStream, PagesAreTheFrameThatABufferHolds) {
    const std::size_t block = 64U * 1024;
    for (const std::size_t numbers : {std::size_t{0}, std::size_t{1}, block - 1, block, block + 1, 16 * block - 1,
                                      16 * block, 16 * block + 1, 50 * block + 17}) {
        for (const std::size_t in_array : {std::size_t{0}, std::size_t{1}, std::size_t{400'000}}) {
            std::vector<std::byte> whole;
            ByteWriter out(whole, FrameKind::world_part);
            putContent(out, numbers, in_array);
            out.finish();
            std::vector<std::byte> pages;
            std::size_t largest = 0;
            writeFrame(
                FrameKind::world_part,
                [&](std::span<const std::byte> page) {
                    pages.insert(pages.end(), page.begin(), page.end());
                    largest = std::max(largest, page.size());
                },
                [&](ByteWriter& paged) { putContent(paged, numbers, in_array); });
            EXPECT_TRUE(pages == whole) << numbers << " numbers and an array of " << in_array;
            EXPECT_LE(largest, 17 * block + sizeof(double) * in_array);
            EXPECT_NO_THROW(ByteReader(pages, FrameKind::world_part, "pages"));
        }
    }
}

TEST(ByteStream, PagesMustBeTheSameTwice) {
    std::uint8_t count = 0;
    EXPECT_THROW(writeFrame(
                     FrameKind::world_part, [](std::span<const std::byte>) {},
                     [&](ByteWriter& out) {
                         ++count;
                         for (std::uint8_t i = 0; i < count; ++i) out.put(i);
                     }),
                 std::logic_error);
}

}  // namespace
}  // namespace cairn
