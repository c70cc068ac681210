/// @file Numbers as the bytes of messages between ranks, which are the same program on the same kind of machine.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "cairn/ranks.h"
#include "cairn/types.h"
#include "math/exact_sum.h"

namespace cairn {

/// What may be sent byte by byte: numbers, structures of numbers, and Eigen's fixed vectors, which hold nothing else.
/// Exact sums are shorter when only their digits are sent.
template <class T>
concept Sendable = (std::is_trivially_copyable_v<T> && !std::is_same_v<T, ExactSum>) || std::is_same_v<T, Vec3> ||
                   std::is_same_v<T, Mat3> || std::is_same_v<T, Quat>;

/// Appends a value to a message.
template <Sendable T>
void pack(std::vector<std::byte>& message, const T& value) {
    const std::size_t end = message.size();
    message.resize(end + sizeof(T));
    std::memcpy(message.data() + end, static_cast<const void*>(&value), sizeof(T));
}

inline void pack(std::vector<std::byte>& message, const ExactSum& sum) {
    const ExactDigits sent = sum.digits();
    pack(message, sent.first);
    pack(message, sent.count);
    pack(message, sent.negative);
    pack(message, sent.not_finite);
    for (std::size_t i = 0; i < sent.count; ++i) pack(message, sent.digits[i]);
}

/// Reads a message from its beginning.
class Unpacker {
  public:
    explicit Unpacker(std::span<const std::byte> message) : left_(message) {}

    bool isAtEnd() const { return left_.empty(); }
    /// The next value. @throws std::logic_error if there is none: ranks that disagree are a mistake of Cairn
    template <Sendable T>
    T get() {
        if (left_.size() < sizeof(T)) throw std::logic_error("messages: one ended early");
        T value;
        std::memcpy(static_cast<void*>(&value), left_.data(), sizeof(T));
        left_ = left_.subspan(sizeof(T));
        return value;
    }

    ExactDigits getSum() {
        ExactDigits sent;
        sent.first = get<std::uint8_t>();
        sent.count = get<std::uint8_t>();
        sent.negative = get<bool>();
        sent.not_finite = get<double>();
        if (sent.first + std::size_t{sent.count} > sent.digits.size()) throw std::logic_error("messages: no sum");
        for (std::size_t i = 0; i < sent.count; ++i) sent.digits[i] = get<std::uint32_t>();
        return sent;
    }

  private:
    std::span<const std::byte> left_;
};

/// Tells the same to all ranks. @return what each told, this one as well [ranks]
inline Ranks::Messages tellAll(Ranks& ranks, const std::vector<std::byte>& message) {
    return ranks.exchange(Ranks::Messages(static_cast<std::size_t>(ranks.size()), message));
}

/// One value of every rank, by rank.
template <Sendable T>
std::vector<T> gatherAll(Ranks& ranks, const T& value) {
    std::vector<std::byte> message;
    pack(message, value);
    std::vector<T> all;
    for (const std::vector<std::byte>& told : tellAll(ranks, message)) all.push_back(Unpacker(told).get<T>());
    return all;
}

}  // namespace cairn
