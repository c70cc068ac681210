/// @file Binary messages: little-endian numbers one after another. Layouts: docs/view-protocol.md.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>

namespace cairn::view {

static_assert(std::endian::native == std::endian::little, "the wire format is written straight from memory");

/// What is sent to a viewer: JSON text or bytes.
struct Message {
    enum class Kind { text, binary };
    Kind kind = Kind::text;
    std::string bytes;
};
using SharedMessage = std::shared_ptr<const Message>;

/// Appends numbers to a string of bytes.
class ByteWriter {
  public:
    template <typename Number>
    void put(Number value) {
        char raw[sizeof(Number)];
        std::memcpy(raw, &value, sizeof(Number));
        bytes_.append(raw, sizeof(Number));
    }
    template <typename Number>
    void putAll(std::span<const Number> values) {
        if (values.empty()) return;
        const std::size_t at = bytes_.size();
        bytes_.resize(at + values.size_bytes());
        std::memcpy(bytes_.data() + at, values.data(), values.size_bytes());
    }
    void putText(std::string_view text) { bytes_.append(text); }
    /// Fills up to a multiple of four bytes.
    void align() { bytes_.append((4 - bytes_.size() % 4) % 4, '\0'); }
    /// @return the bytes; the writer is empty afterwards
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

}  // namespace cairn::view
