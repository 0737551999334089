// Sums over the particles of all ranks that have the same bits for any number of threads and ranks.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/core/exact_sum.h"
#include "engine/core/parallel.h"
#include "engine/ranks/ranks.h"

namespace engine {

/// The sums over all ranks of several exact sums, rounded.
template <std::size_t n>
std::array<double, n> roundedOverRanks(const Ranks& ranks, std::array<ExactSum, n>& sums) {
    if (ranks.areMany()) {
        std::vector<std::int64_t> words;
        words.reserve(n * ExactSum::kWords);
        for (ExactSum& sum : sums) words.insert(words.end(), sum.carriedWords().begin(), sum.carriedWords().end());
        ranks.sum(words);
        for (std::size_t k = 0; k < n; ++k)
            std::copy_n(words.data() + k * ExactSum::kWords, ExactSum::kWords, sums[k].carriedWords().begin());
    }
    std::array<double, n> rounded;
    for (std::size_t k = 0; k < n; ++k) rounded[k] = sums[k].value();
    return rounded;
}

/// Sums of several terms, exact until they are rounded, over the indices 0 to count - 1 and over all ranks.
/// @param terms  terms(index) returns the terms of an index as an array of n numbers; called once for each index
template <std::size_t n, class Terms>
std::array<double, n> exactSums(const Ranks& ranks, std::size_t count, const Terms& terms) {
    using Sums = std::array<ExactSum, n>;
    std::array<ExactSum, n> sums;
    for (const Sums& part : resultsOfChunks<Sums>(count, [&](std::size_t begin, std::size_t end) {
             Sums ofChunk;
             std::array<ExactSum::Adder, n> adders;
             for (std::size_t index = begin; index < end; ++index) {
                 const std::array<double, n> of = terms(index);
                 for (std::size_t k = 0; k < n; ++k) adders[k].add(of[k], ofChunk[k]);
             }
             for (std::size_t k = 0; k < n; ++k) adders[k].flush(ofChunk[k]);
             return ofChunk;
         }))
        for (std::size_t k = 0; k < n; ++k) sums[k] += part[k];
    return roundedOverRanks(ranks, sums);
}

/// The exact sum of one term of each index.
template <class Term>
double exactSum(const Ranks& ranks, std::size_t count, const Term& term) {
    return exactSums<1>(ranks, count,
                        [&](std::size_t index) { return std::array{static_cast<double>(term(index))}; })[0];
}

}  // namespace engine
