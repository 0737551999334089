// Rounds exact sums.
#include "engine/core/exact_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace engine {

double ExactSum::value() const {
    if (words_.back() != 0) return std::numeric_limits<double>::quiet_NaN();
    ExactSum magnitude = *this;
    auto& words = magnitude.carriedWords();
    constexpr std::size_t kTop = kWords - 2;  // the word with the sign: all below it are at least 0 after carrying
    const bool isNegative = words[kTop] < 0;
    if (isNegative) {
        for (std::int64_t& word : words) word = -word;
        magnitude.carry();
    }
    std::size_t first = kTop;
    while (first > 0 && words[first] == 0) --first;
    const auto wordAt = [&](std::size_t below) {
        return first >= below ? static_cast<std::uint64_t>(words[first - below]) : 0;
    };
    // The first 64 bits below the highest one, of which the last is set if any bit further below is: the conversion to
    // double then rounds as if it saw all bits.
    std::uint64_t bits = wordAt(0) << 32 | wordAt(1);
    if (bits == 0) return 0.0;
    const int shift = std::countl_zero(bits);
    bits = bits << shift | (shift == 0 ? 0 : wordAt(2) >> (32 - shift));
    bool isMore = shift < 32 && static_cast<std::uint32_t>(wordAt(2) << shift) != 0;
    for (std::size_t below = 3; below <= first; ++below) isMore |= wordAt(below) != 0;
    const double value =
        std::ldexp(static_cast<double>(bits | (isMore ? 1 : 0)), 32 * (static_cast<int>(first) - 1) - 1074 - shift);
    return isNegative ? -value : value;
}

}  // namespace engine
