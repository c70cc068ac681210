/// @file Numbers and arrays as bytes in little-endian order, with a head that tells damage from content. The format is
/// described in docs/snapshots.md.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "cairn/types.h"

namespace cairn {

// Arrays are copied as they lie in memory, since a rollback saves in every step.
static_assert(std::endian::native == std::endian::little, "snapshots need a little-endian machine");

/// What may be copied byte by byte: numbers, enumerations, corners of triangles, and Eigen's fixed vectors, which hold
/// nothing else.
template <class T>
concept PlainBytes = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Vec3> ||
    std::is_same_v<T, Mat3> || std::is_same_v<T, Quat> || std::is_same_v<T, std::array<std::uint32_t, 3>>;

/// What a frame of bytes holds.
enum class FrameKind : std::uint32_t {
    world = 1,
    scene_run = 2,
    world_part = 3,    ///< of a world that is divided: what one rank has
    world_common = 4,  ///< of a world that is divided: what all ranks have
    checkpoint = 5,    ///< of parts: which files they are
    run_common = 6     ///< as world_common, of a run
};

/// Takes bytes that follow those before.
using TakePage = std::function<void(std::span<const std::byte>)>;

/// Writes into a buffer whose memory is used again.
class ByteWriter {
  public:
    /// Begins a frame at the start of the buffer; what the buffer held is overwritten.
    ByteWriter(std::vector<std::byte>& buffer, FrameKind kind);

    template <PlainBytes T>
    void put(const T& value) {
        std::memcpy(grow(sizeof(T)), static_cast<const void*>(&value), sizeof(T));
    }
    /// The count, then the elements.
    template <PlainBytes T>
    void putArray(std::span<const T> values) {
        put(std::uint64_t{values.size()});
        if (!values.empty())
            std::memcpy(grow(values.size_bytes()), static_cast<const void*>(values.data()), values.size_bytes());
    }
    void putText(std::string_view text) { putArray(std::span<const char>(text)); }
    /// Writes the head: kind, version, length and checksums. Nothing may be put afterwards.
    void finish();

  private:
    struct Pages;
    friend void writeFrame(FrameKind kind, const TakePage& append, const std::function<void(ByteWriter&)>& save);

    ByteWriter(std::vector<std::byte>& page, FrameKind kind, Pages& pages);
    std::byte* grow(std::size_t bytes) {
        end_ += bytes;
        if (end_ > buffer_.size()) enlarge(bytes);
        return buffer_.data() + (end_ - bytes);
    }
    void enlarge(std::size_t bytes);
    void handOver(std::size_t count);

    std::vector<std::byte>& buffer_;
    FrameKind kind_;
    std::size_t end_;
    Pages* pages_ = nullptr;  ///< null = the buffer holds all
};

/// Writes a frame in pages, so that it is never in memory as a whole.
/// @param save is called twice, as the head says how long the content is, and puts the same both times
void writeFrame(FrameKind kind, const TakePage& append, const std::function<void(ByteWriter&)>& save);

/// Reads what a ByteWriter wrote. Every refusal names the offset.
class ByteReader {
  public:
    /// @param source shown in messages, such as "snapshot" or a file name
    /// @throws InputError if the bytes are truncated, damaged, of another kind or of another version
    ByteReader(std::span<const std::byte> bytes, FrameKind kind, std::string source);

    template <PlainBytes T>
    T get() {
        T value;
        std::memcpy(static_cast<void*>(&value), take(sizeof(T)), sizeof(T));
        return value;
    }
    /// A value of an enumeration whose last name is given. @throws InputError beyond it
    template <class Enum>
    Enum getEnum(Enum last) {
        const auto value = get<std::underlying_type_t<Enum>>();
        if (value > static_cast<std::underlying_type_t<Enum>>(last)) refuse("an unknown choice");
        return static_cast<Enum>(value);
    }
    template <class Array>
    void getArray(Array& values) {
        using T = typename Array::value_type;
        static_assert(PlainBytes<T>);
        const std::uint64_t count = get<std::uint64_t>();
        // Compared before anything is reserved: a damaged count must not ask for the memory it names.
        if (count > left() / sizeof(T)) refuse("an array longer than the snapshot");
        values.resize(count);
        if (count > 0) std::memcpy(static_cast<void*>(values.data()), take(count * sizeof(T)), count * sizeof(T));
    }
    /// An array of a known length. @throws InputError if it has another
    template <class Array>
    void getArray(Array& values, std::size_t count) {
        getArray(values);
        if (values.size() != count) refuse("an array of a wrong length");
    }
    std::string getText();
    /// @throws InputError naming the offset
    [[noreturn]] void refuse(std::string_view what) const;
    /// @throws InputError unless everything was read
    void finish() const;

  private:
    std::size_t left() const { return bytes_.size() - at_; }
    const std::byte* take(std::size_t count);

    std::span<const std::byte> bytes_;
    std::string source_;
    std::size_t at_ = 0;
};

/// Writes the head of a frame over its first bytes. For tests that change what is behind it.
void sealFrame(std::span<std::byte> frame, FrameKind kind, std::uint32_t version);

/// What a frame says it is; nothing checks it. @return none if it is too short to say
std::optional<FrameKind> frameKind(std::span<const std::byte> frame);

/// Bytes of the head of a frame with so many bytes behind it.
std::size_t frameHeadSize();

/// The version of the format that is written and read.
inline constexpr std::uint32_t snapshot_version = 4;

}  // namespace cairn
