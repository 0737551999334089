// Loops and sums over particles on all threads, with the same bits for any number of them: each index writes to itself
// alone, and sums are taken over chunks of fixed size whose results are added up in order.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace engine {

/// Calls body(index) for 0 ... count - 1, at least `grain` of them in a row on one thread.
/// Isolated, so that a waiting thread does not take up a whole frame's drawing meanwhile.
template <class Body>
void inParallel(std::size_t count, std::size_t grain, const Body& body) {
    if (count <= grain) {
        for (std::size_t index = 0; index < count; ++index) body(index);
        return;
    }
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
            for (std::size_t index = range.begin(); index < range.end(); ++index) body(index);
        });
    });
}

/// Of a particle's cheap work. Measured: a thread takes as long to wake up as another takes for some thousands.
inline constexpr std::size_t kParticleGrain = 8192;

/// Terms of a partial sum; part of what makes the bits of a sum.
inline constexpr std::size_t kSumChunk = 1024;

/// Sum of term(index) over 0 ... count - 1.
template <class Term>
double sumOver(std::size_t count, const Term& term) {
    const std::size_t chunks = (count + kSumChunk - 1) / kSumChunk;
    std::vector<double> partial(chunks, 0.0);
    inParallel(chunks, kParticleGrain / kSumChunk, [&](std::size_t chunk) {
        const std::size_t end = std::min(count, (chunk + 1) * kSumChunk);
        double sum = 0.0;
        for (std::size_t index = chunk * kSumChunk; index < end; ++index) sum += term(index);
        partial[chunk] = sum;
    });
    double sum = 0.0;
    for (const double part : partial) sum += part;
    return sum;
}

/// The largest term(index), which is no NaN and at least 0, over 0 ... count - 1.
template <class Term>
double largestOver(std::size_t count, const Term& term) {
    const std::size_t chunks = (count + kSumChunk - 1) / kSumChunk;
    std::vector<double> partial(chunks, 0.0);
    inParallel(chunks, kParticleGrain / kSumChunk, [&](std::size_t chunk) {
        const std::size_t end = std::min(count, (chunk + 1) * kSumChunk);
        for (std::size_t index = chunk * kSumChunk; index < end; ++index)
            partial[chunk] = std::max(partial[chunk], term(index));
    });
    return chunks == 0 ? 0.0 : *std::max_element(partial.begin(), partial.end());
}

}  // namespace engine
