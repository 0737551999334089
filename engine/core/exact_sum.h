// A sum of doubles that does not depend on the order of its terms: it is exact until it is rounded once at the end.
// Sums that decide about a run are taken in this way, so that they have the same bits however the particles are divided
// among threads and processes.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace engine {

/// The exact sum of any number of doubles, as a fixed-point number that spans the exponents of all doubles. Word k
/// counts units of 2^(32 k - 1074). A term is added to two words; as words have 64 bits, carries can wait for many
/// terms. This is the small superaccumulator of R. M. Neal, "Fast exact summation using small and large
/// superaccumulators", arXiv:1505.05571, 2015.
class ExactSum {
 public:
    static constexpr std::size_t kWords = 68;

    void add(double term) {
        const Parts parts(term);
        if (parts.word == kNotFinite) {
            ++words_.back();
            return;
        }
        words_[parts.word] += parts.low;
        words_[parts.word + 1] += parts.high;
        if (++waiting_ >= kMostWaiting) carry();
    }

    /// Adds terms one after the other to a sum. Neighboring terms mostly belong to the same words, which are then kept
    /// in registers.
    class Adder {
     public:
        void add(double term, ExactSum& to) {
            const Parts parts(term);
            if (parts.word != word_ || waiting_ == kMostWaiting) {
                flush(to);
                word_ = parts.word;
            }
            low_ += parts.low;
            high_ += parts.high;
            ++waiting_;
        }

        /// Passes on what was added since the last time.
        void flush(ExactSum& to) {
            if (word_ == kNotFinite) {
                to.words_.back() += waiting_;
            } else {
                if (to.waiting_ + waiting_ > kMostWaiting) to.carry();
                to.words_[word_] += low_;
                to.words_[word_ + 1] += high_;
                to.waiting_ += waiting_;
            }
            low_ = high_ = 0;
            waiting_ = 0;
        }

     private:
        std::size_t word_ = 0;
        std::int64_t low_ = 0;
        std::int64_t high_ = 0;
        std::uint32_t waiting_ = 0;
    };

    ExactSum& operator+=(ExactSum other) {
        carry();
        other.carry();
        for (std::size_t k = 0; k < kWords; ++k) words_[k] += other.words_[k];
        return *this;
    }

    /// The sum, rounded to the nearest double; NaN if a term was not finite, infinity if it is too large for a double.
    double value() const;

    /// The words after carrying: two thousand millions of them can be added, word by word, to the sum of all.
    std::array<std::int64_t, kWords>& carriedWords() {
        carry();
        return words_;
    }

 private:
    /// Stands for a word where a term is infinite or NaN.
    static constexpr std::size_t kNotFinite = kWords;

    /// What a term adds to a word and to the next one.
    struct Parts {
        explicit Parts(double term) {
            constexpr std::uint64_t kImplicit = std::uint64_t{1} << 52;  // the leading bit, which is not stored
            const auto bits = std::bit_cast<std::uint64_t>(term);
            const std::uint64_t exponent = bits >> 52 & 0x7FF;
            const std::uint64_t isNormal = exponent == 0 ? 0 : 1;
            const std::uint64_t place = exponent - isNormal;
            const std::uint64_t mantissa = (bits & (kImplicit - 1)) | isNormal * kImplicit;
            const std::uint64_t shift = place % 32;
            const auto lower = static_cast<std::int64_t>(mantissa << shift & 0xFFFFFFFF);
            const auto upper = static_cast<std::int64_t>(mantissa >> (32 - shift));
            const std::int64_t sign = static_cast<std::int64_t>(bits) >> 63;  // 0, or -1 for a negative term
            word = exponent == 0x7FF ? kNotFinite : place / 32;
            low = (lower ^ sign) - sign;
            high = (upper ^ sign) - sign;
        }

        std::size_t word;
        std::int64_t low;
        std::int64_t high;
    };

    /// Brings every word but the last below 2^32 in magnitude.
    void carry() {
        for (std::size_t k = 0; k + 2 < kWords; ++k) {
            const std::int64_t over = words_[k] >> 32;
            words_[k] -= over << 32;
            words_[k + 1] += over;
        }
        waiting_ = 0;
    }

    /// A term adds at most 2^52 + 2^32 to a word, and a carried word has less than 2^33.
    static constexpr std::uint32_t kMostWaiting = 2000;

    std::array<std::int64_t, kWords> words_{};  ///< the last counts terms that are not finite
    std::uint32_t waiting_ = 0;                 ///< terms added since the last carry
};

}  // namespace engine
