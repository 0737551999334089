// Loops and sums over particles on all threads. Results have the same bits for any number of threads: the loop body for
// an index writes only to that index, and sums are taken over chunks of fixed size, whose results are added in order.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

namespace engine {

/// The number of threads that loops are divided among, at most.
inline std::size_t threadCount() {
    return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
}

/// Divides the indices 0 ... count - 1 into ranges among the threads. A few ranges are assigned to threads in the same
/// way every time, so that data that a thread has written are still in its cache; many ranges are balanced by work
/// stealing. Isolated, so that a waiting thread does not begin another task, such as drawing a whole frame.
template <class Ranges>
void splitUp(std::size_t count, std::size_t grain, const Ranges& body) {
    constexpr std::size_t kFew = 256;  // most grains that count as few; chosen: 262,144 particles in most loops
    const tbb::blocked_range<std::size_t> all(0, count, grain);
    const auto each = [&](const auto& range) { body(range.begin(), range.end()); };
    tbb::this_task_arena::isolate([&] {
        if (count <= kFew * grain)
            tbb::parallel_for(all, each, tbb::static_partitioner());
        else
            tbb::parallel_for(all, each);
    });
}

/// Calls body(begin, end), on several threads, for ranges that together cover the indices 0 ... count - 1. Up to
/// `grain` indices are processed by one thread.
template <class Body>
void inRanges(std::size_t count, std::size_t grain, const Body& body) {
    if (count <= grain)
        body(0, count);
    else
        splitUp(count, grain, body);
}

/// Whether holds(begin, end) is true for all of the ranges into which inRanges() divides the indices 0 ... count - 1.
template <class Holds>
bool holdsInRanges(std::size_t count, std::size_t grain, const Holds& holds) {
    std::atomic<bool> all = true;
    inRanges(count, grain, [&](std::size_t begin, std::size_t end) {
        if (!holds(begin, end)) all = false;
    });
    return all;
}

/// Calls body(index) for all indices 0 ... count - 1, divided among the threads like inRanges().
template <class Body>
void inParallel(std::size_t count, std::size_t grain, const Body& body) {
    inRanges(count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t index = begin; index < end; ++index) body(index);
    });
}

/// Number of particles that a thread processes at a time in loops with little work for each particle. One thread would
/// be as fast for some thousand particles, but the other threads would then have to fetch the results from its cache.
/// Measured with `globular bench` on two Zen 5 cores: with 8192, steps and scenes of 2000 to 6000 particles take a
/// tenth longer; with 512, steps of 1000.
inline constexpr std::size_t kParticleGrain = 1024;

/// Copies a vector into another vector on several threads, and uses the memory of the other vector again.
template <class T>
void copy(const std::vector<T>& from, std::vector<T>& to) {
    to.resize(from.size());
    inRanges(from.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
        std::copy_n(from.data() + begin, end - begin, to.data() + begin);
    });
}

/// Number of terms in each partial sum of a parallel sum. The last bits of every sum depend on this number.
inline constexpr std::size_t kSumChunk = 1024;

/// Returns the results of ofChunk(begin, end) for consecutive chunks of kSumChunk indices, which together cover 0 ...
/// count - 1. No chunk is empty.
template <class Result, class OfChunk>
std::vector<Result> resultsOfChunks(std::size_t count, const OfChunk& ofChunk) {
    std::vector<Result> results((count + kSumChunk - 1) / kSumChunk);
    inParallel(results.size(), 1, [&](std::size_t chunk) {
        results[chunk] = ofChunk(chunk * kSumChunk, std::min(count, (chunk + 1) * kSumChunk));
    });
    return results;
}

/// Sum of term(0) to term(count - 1), computed on several threads in an order that does not depend on their number.
template <class Sum = double, class Term>
Sum sumOver(std::size_t count, const Term& term) {
    const auto sumOf = [&](std::size_t begin, std::size_t end) {
        Sum sum{};
        for (std::size_t index = begin; index < end; ++index) sum += term(index);
        return sum;
    };
    Sum sum{};
    for (const Sum& part : resultsOfChunks<Sum>(count, sumOf)) sum += part;
    return sum;
}

/// The largest of 0 and term(0) to term(count - 1), computed on several threads. No term may be NaN.
template <class Term>
double largestOver(std::size_t count, const Term& term) {
    const auto largestOf = [&](std::size_t begin, std::size_t end) {
        double largest = 0.0;
        for (std::size_t index = begin; index < end; ++index) largest = std::max(largest, term(index));
        return largest;
    };
    double largest = 0.0;
    for (const double part : resultsOfChunks<double>(count, largestOf)) largest = std::max(largest, part);
    return largest;
}

}  // namespace engine
