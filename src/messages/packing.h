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

namespace cairn {

/// What may be sent byte by byte: numbers, structures of numbers, and Eigen's fixed vectors, which hold nothing else.
template <class T>
concept Sendable =
    std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3> || std::is_same_v<T, Mat3> || std::is_same_v<T, Quat>;

/// Appends a value to a message.
template <Sendable T>
void pack(std::vector<std::byte>& message, const T& value) {
    const std::size_t end = message.size();
    message.resize(end + sizeof(T));
    std::memcpy(message.data() + end, static_cast<const void*>(&value), sizeof(T));
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
