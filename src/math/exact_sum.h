/// @file Sums of numbers without rounding, so that neither the order nor who adds what makes a difference.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "cairn/types.h"

namespace cairn {

/// A sum as few numbers, to be sent.
struct ExactDigits {
    std::uint8_t first = 0;  ///< place of the first digit, which is the lowest
    std::uint8_t count = 0;
    bool negative = false;
    double not_finite = 0;  ///< sum of terms that are infinite or no numbers; 0 = there were none
    std::array<std::uint32_t, 68> digits{};
};

/// A sum of doubles that is rounded once, when it is asked for: the same terms give the same bits in any order, also
/// when parts of them were summed elsewhere. It is one long number, of digits with 32 bits that may carry.
/// @source R. Neal, Fast exact summation using small and large superaccumulators, 2015, arXiv:1505.05571
class ExactSum {
  public:
    void add(double term) {
        const auto bits = std::bit_cast<std::uint64_t>(term);
        const std::uint64_t exponent = bits >> mantissa_bits & 0x7ffU;
        if (exponent == 0x7ffU) {
            not_finite_ += term;
            return;
        }
        const std::uint64_t fraction = bits & ((std::uint64_t{1} << mantissa_bits) - 1);
        const std::uint64_t mantissa = exponent == 0 ? fraction : fraction | std::uint64_t{1} << mantissa_bits;
        // In units of the smallest double there is.
        const std::uint64_t place = exponent == 0 ? 0 : exponent - 1;
        const std::uint64_t low = (mantissa & digit_mask) << place % digit_bits;
        const std::uint64_t high = (mantissa >> digit_bits) << place % digit_bits;
        const bool negative = bits >> 63U != 0;
        const auto put = [&](std::size_t digit, std::uint64_t amount) {
            const auto value = static_cast<std::int64_t>(amount);
            digits_[digit] += negative ? -value : value;
        };
        const std::size_t first = place / digit_bits;
        put(first, low & digit_mask);
        put(first + 1, (low >> digit_bits) + (high & digit_mask));
        put(first + 2, high >> digit_bits);
        if (++uncarried_ == most_uncarried) carry();
    }

    void add(const ExactSum& other) {
        ExactSum carried = other;
        carried.carry();
        carry();
        for (std::size_t i = 0; i < digit_count; ++i) digits_[i] += carried.digits_[i];
        uncarried_ = 1;
        not_finite_ += other.not_finite_;
    }

    void add(const ExactDigits& sent) {
        carry();
        for (std::size_t i = 0; i < sent.count; ++i) {
            const std::int64_t digit = sent.digits[i];
            digits_[sent.first + i] += sent.negative ? -digit : digit;
        }
        uncarried_ = 1;
        not_finite_ += sent.not_finite;
    }

    ExactDigits digits() const {
        ExactDigits sent;
        sent.not_finite = not_finite_;
        const ExactSum size = positive(sent.negative);
        std::size_t first = 0, end = digit_count;
        while (end > 0 && size.digits_[end - 1] == 0) --end;
        while (first < end && size.digits_[first] == 0) ++first;
        sent.first = static_cast<std::uint8_t>(first);
        sent.count = static_cast<std::uint8_t>(end - first);
        for (std::size_t i = first; i < end; ++i) sent.digits[i - first] = static_cast<std::uint32_t>(size.digits_[i]);
        return sent;
    }

    /// The double next to the sum; of two as near the even one.
    double rounded() const {
        if (not_finite_ != 0) return not_finite_;
        bool negative = false;
        const ExactSum sum = positive(negative);
        std::size_t top = digit_count;
        while (top > 0 && sum.digits_[top - 1] == 0) --top;
        if (top == 0) return 0;
        const auto digit = [&](std::size_t below_top) -> std::uint64_t {
            return below_top > top ? 0 : static_cast<std::uint64_t>(sum.digits_[top - below_top]);
        };
        std::uint64_t leading = digit(1) << digit_bits | digit(2);
        const int shift = std::countl_zero(leading);
        bool rest = false;
        if (shift > 0) {
            leading = leading << shift | digit(3) >> (digit_bits - static_cast<unsigned>(shift));
            rest = (digit(3) << shift & digit_mask) != 0;
        } else {
            rest = digit(3) != 0;
        }
        for (std::size_t below = 4; below <= top && !rest; ++below) rest = digit(below) != 0;
        // Of 64 bits the last stands for all behind it: 53 are kept.
        if (rest) leading |= 1U;
        const int exponent = static_cast<int>(digit_bits) * (static_cast<int>(top) - 2) - shift - smallest_exponent;
        const double size = std::ldexp(static_cast<double>(leading), exponent);
        return negative ? -size : size;
    }

  private:
    static constexpr unsigned mantissa_bits = 52;
    static constexpr unsigned digit_bits = 32;
    static constexpr std::uint64_t digit_mask = (std::uint64_t{1} << digit_bits) - 1;
    static constexpr int smallest_exponent = 1074;
    /// The largest double ends in the 66th digit; two more are for sums of many.
    static constexpr std::size_t digit_count = std::tuple_size_v<decltype(ExactDigits::digits)>;
    /// A term adds less than 2³³ to a digit of 63 bits.
    static constexpr std::uint32_t most_uncarried = 1U << 28U;

    /// Lets all digits but the last be from 0 to 2³² − 1.
    void carry() {
        for (std::size_t i = 0; i + 1 < digit_count; ++i) {
            digits_[i + 1] += digits_[i] >> digit_bits;
            digits_[i] &= static_cast<std::int64_t>(digit_mask);
        }
        uncarried_ = 0;
    }

    /// Its size, with digits from 0 to 2³² − 1.
    ExactSum positive(bool& negative) const {
        ExactSum size = *this;
        size.carry();
        negative = size.digits_.back() < 0;
        if (!negative) return size;
        for (std::int64_t& digit : size.digits_) digit = -digit;
        size.carry();
        return size;
    }

    std::array<std::int64_t, digit_count> digits_{};
    std::uint32_t uncarried_ = 0;  ///< terms since the last carry
    double not_finite_ = 0;        ///< sum of the terms that are infinite or no numbers
};

/// The same of vectors.
class ExactVectorSum {
  public:
    void add(const Vec3& term) {
        for (int axis = 0; axis < 3; ++axis) axes_[static_cast<std::size_t>(axis)].add(term[axis]);
    }
    void add(const ExactVectorSum& other) {
        for (std::size_t axis = 0; axis < 3; ++axis) axes_[axis].add(other.axes_[axis]);
    }
    /// Calls visit with the sum of each axis.
    template <class Visit>
    void forAxes(const Visit& visit) {
        for (ExactSum& axis : axes_) visit(axis);
    }
    Vec3 rounded() const { return {axes_[0].rounded(), axes_[1].rounded(), axes_[2].rounded()}; }

  private:
    std::array<ExactSum, 3> axes_;
};

}  // namespace cairn
