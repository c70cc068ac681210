#include "world/byte_stream.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace cairn {

namespace {

constexpr std::array<char, 8> magic = {'C', 'A', 'I', 'R', 'N', 'S', 'A', 'V'};
/// Bytes that share one checksum: small enough that an offset helps, large enough that checksums do not count.
constexpr std::size_t block_size = std::size_t{64} * 1024;

/// Bytes that are handed over at once.
constexpr std::size_t page_size = 16 * block_size;

/// The first bytes of a frame; behind the content stands one checksum per block of it.
struct Head {
    std::array<char, 8> magic;
    std::uint32_t kind;
    std::uint32_t version;
    std::uint64_t content;  ///< bytes of the content
    std::uint64_t check;    ///< of the four above
};
static_assert(sizeof(Head) == 32);

std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 32U)) * 0xd6e8feb86659fd93U;
    return x ^ (x >> 32U);
}

/// Four sums side by side, so that the processor need not wait for one multiplication before the next.
std::uint64_t checksum(std::span<const std::byte> bytes) {
    constexpr std::size_t lanes = 4;
    constexpr std::size_t stride = lanes * sizeof(std::uint64_t);
    std::array<std::uint64_t, lanes> sums = {1, 2, 3, 4};
    std::size_t at = 0;
    for (; at + stride <= bytes.size(); at += stride) {
        std::array<std::uint64_t, lanes> words{};
        std::memcpy(words.data(), bytes.data() + at, stride);
        for (std::size_t i = 0; i < lanes; ++i) {
            sums[i] = std::rotl((sums[i] ^ words[i]) * 0x9e3779b97f4a7c15U, 29);
        }
    }
    std::uint64_t sum = bytes.size();
    for (; at < bytes.size(); ++at) sum = mixed(sum ^ std::to_integer<std::uint64_t>(bytes[at]));
    for (const std::uint64_t lane : sums) sum = mixed(sum ^ lane);
    return sum;
}

std::uint64_t headCheck(const Head& head) {
    return checksum(std::as_bytes(std::span(&head, 1)).first(offsetof(Head, check)));
}

std::string_view nameOf(FrameKind kind) {
    switch (kind) {
        case FrameKind::world:
            return "a world";
        case FrameKind::scene_run:
            return "a run";
        case FrameKind::world_part:
            return "a part of a world";
        case FrameKind::world_common:
            return "what the parts of a world have in common";
        case FrameKind::checkpoint:
            return "a checkpoint of several parts";
        case FrameKind::run_common:
            return "what the parts of a run have in common";
    }
    return "something unknown";
}

Head headOf(FrameKind kind, std::uint32_t version, std::uint64_t content) {
    Head head{magic, static_cast<std::uint32_t>(kind), version, content, 0};
    head.check = headCheck(head);
    return head;
}

std::size_t blocksOf(std::uint64_t content) {
    return static_cast<std::size_t>((content + block_size - 1) / block_size);
}

}  // namespace

std::size_t frameHeadSize() {
    return sizeof(Head);
}

void sealFrame(std::span<std::byte> frame, FrameKind kind, std::uint32_t version) {
    // Content c has ceil(c / block) checksums behind it; solved for c from the whole length.
    const std::size_t behind = frame.size() - sizeof(Head);
    const std::size_t blocks = (behind + block_size + sizeof(std::uint64_t) - 1) / (block_size + sizeof(std::uint64_t));
    const std::size_t content = behind - blocks * sizeof(std::uint64_t);
    const Head head = headOf(kind, version, content);
    std::memcpy(frame.data(), &head, sizeof head);
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::size_t begin = i * block_size;
        const std::uint64_t sum = checksum(frame.subspan(sizeof(Head) + begin, std::min(block_size, content - begin)));
        std::memcpy(frame.data() + sizeof(Head) + content + i * sizeof sum, &sum, sizeof sum);
    }
}

std::optional<FrameKind> frameKind(std::span<const std::byte> frame) {
    if (frame.size() < sizeof(Head)) return std::nullopt;
    Head head{};
    std::memcpy(&head, frame.data(), sizeof head);
    return static_cast<FrameKind>(head.kind);
}

ByteWriter::ByteWriter(std::vector<std::byte>& buffer, FrameKind kind)
    : buffer_(buffer), kind_(kind), end_(sizeof(Head)) {}

/// What of a frame is not in the buffer any more.
struct ByteWriter::Pages {
    const TakePage* append;     ///< null = it is only counted
    std::uint64_t content = 0;  ///< bytes that were handed over
    std::vector<std::uint64_t> sums{};
};

ByteWriter::ByteWriter(std::vector<std::byte>& page, FrameKind kind, Pages& pages)
    : buffer_(page), kind_(kind), end_(0), pages_(&pages) {}

/// Makes room for bytes at the end.
void ByteWriter::enlarge(std::size_t bytes) {
    if (pages_ == nullptr) {
        buffer_.resize(std::max(end_, 2 * buffer_.size()));
        return;
    }
    end_ -= bytes;
    handOver(end_ / block_size * block_size);
    end_ += bytes;
    if (end_ > buffer_.size()) buffer_.resize(end_);
}

/// Takes so many bytes out of the buffer.
void ByteWriter::handOver(std::size_t count) {
    const auto bytes = std::span<const std::byte>(buffer_).first(count);
    if (pages_->append != nullptr && count > 0) {
        for (std::size_t at = 0; at < count; at += block_size) {
            pages_->sums.push_back(checksum(bytes.subspan(at, std::min(block_size, count - at))));
        }
        (*pages_->append)(bytes);
    }
    pages_->content += count;
    std::memmove(buffer_.data(), buffer_.data() + count, end_ - count);
    end_ -= count;
}

void writeFrame(FrameKind kind, const TakePage& append, const std::function<void(ByteWriter&)>& save) {
    std::vector<std::byte> page(page_size);
    const auto putAll = [&](ByteWriter::Pages& pages) {
        ByteWriter out(page, kind, pages);
        save(out);
        out.handOver(out.end_);
    };
    ByteWriter::Pages counted{nullptr};
    putAll(counted);
    const Head head = headOf(kind, snapshot_version, counted.content);
    append(std::as_bytes(std::span(&head, 1)));
    ByteWriter::Pages pages{&append};
    putAll(pages);
    if (pages.content != counted.content) throw std::logic_error("snapshots: one changed while it was written");
    append(std::as_bytes(std::span(pages.sums)));
}

void ByteWriter::finish() {
    const std::size_t content = end_ - sizeof(Head);
    grow(blocksOf(content) * sizeof(std::uint64_t));
    buffer_.resize(end_);
    sealFrame(buffer_, kind_, snapshot_version);
}

ByteReader::ByteReader(std::span<const std::byte> bytes, FrameKind kind, std::string source)
    : source_(std::move(source)) {
    Head head{};
    if (bytes.size() < sizeof head) {
        throw InputError(
            fmt::format("{} is truncated at byte {}: its head alone has {} bytes", source_, bytes.size(), sizeof head));
    }
    std::memcpy(&head, bytes.data(), sizeof head);
    if (head.magic != magic) {
        throw InputError(
            fmt::format("{} is not a snapshot: byte 0 does not begin one; if an earlier Cairn wrote it, "
                        "use that one or run the scene again",
                        source_));
    }
    if (head.version != snapshot_version) {
        throw InputError(
            fmt::format("{} has version {} (byte 12); this program reads version {}: use the Cairn that "
                        "wrote it or run the scene again",
                        source_, head.version, snapshot_version));
    }
    if (head.check != headCheck(head)) throw InputError(fmt::format("{} is damaged within bytes 8 and 32", source_));
    if (head.kind != static_cast<std::uint32_t>(kind)) {
        throw InputError(fmt::format("{} holds {} (byte 8), not {}", source_, nameOf(static_cast<FrameKind>(head.kind)),
                                     nameOf(kind)));
    }
    const std::size_t behind = bytes.size() - sizeof head;
    const std::size_t blocks = head.content <= behind ? blocksOf(head.content) : 0;
    if (head.content > behind || blocks * sizeof(std::uint64_t) > behind - head.content) {
        throw InputError(
            fmt::format("{} is truncated at byte {}: it has {} bytes of content", source_, bytes.size(), head.content));
    }
    if (const std::size_t end = sizeof head + head.content + blocks * sizeof(std::uint64_t); end != bytes.size()) {
        throw InputError(fmt::format("{} has {} bytes, but ends at byte {}", source_, bytes.size(), end));
    }
    bytes_ = bytes.first(sizeof head + head.content);
    at_ = sizeof head;
    for (std::size_t i = 0; i < blocks; ++i) {
        const auto block = bytes_.subspan(sizeof head + i * block_size)
                               .first(std::min<std::size_t>(block_size, head.content - i * block_size));
        std::uint64_t sum = 0;
        std::memcpy(&sum, bytes.data() + bytes_.size() + i * sizeof sum, sizeof sum);
        if (sum == checksum(block)) continue;
        const std::size_t begin = sizeof head + i * block_size;
        throw InputError(fmt::format("{} is damaged within bytes {} and {}", source_, begin, begin + block.size()));
    }
}

std::string ByteReader::getText() {
    const std::uint64_t count = get<std::uint64_t>();
    if (count > left()) refuse("a text longer than the snapshot");
    std::string text(count, '\0');
    if (count > 0) std::memcpy(text.data(), take(count), count);
    return text;
}

const std::byte* ByteReader::take(std::size_t count) {
    if (count > left()) refuse("less than what should follow");
    at_ += count;
    return bytes_.data() + (at_ - count);
}

void ByteReader::refuse(std::string_view what) const {
    throw InputError(fmt::format("{} cannot be read: at byte {} there is {}", source_, at_, what));
}

void ByteReader::finish() const {
    if (left() > 0) refuse("more than it should hold");
}

}  // namespace cairn
