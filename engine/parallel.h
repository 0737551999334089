// Loops and sums over particles on all threads, with the same bits for any number of them: each index writes to itself
// alone, and sums are taken over chunks of fixed size whose results are added up in order.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

#ifdef GLOBULAR_SANITIZES_THREADS
#include <thread>
#endif

namespace engine {

/// How many threads loops are shared out over, at most.
inline std::size_t threadCount() {
    return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
}

#ifdef GLOBULAR_SANITIZES_THREADS
/// ThreadSanitizer does not see how oneTBB, which is not compiled with it, hands work from thread to thread.
template <class Ranges>
void splitUp(std::size_t count, std::size_t grain, const Ranges& body) {
    const std::size_t parts = std::min(threadCount(), (count + grain - 1) / grain);
    std::vector<std::thread> threads;
    for (std::size_t part = 1; part < parts; ++part)
        threads.emplace_back([=, &body] { body(count * part / parts, count * (part + 1) / parts); });
    body(0, count / parts);
    for (std::thread& thread : threads) thread.join();
}
#else
/// Isolated, so that a waiting thread does not take up a whole frame's drawing meanwhile.
template <class Ranges>
void splitUp(std::size_t count, std::size_t grain, const Ranges& body) {
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                          [&](const auto& range) { body(range.begin(), range.end()); });
    });
}
#endif

/// Calls body(begin, end) for ranges of 0 ... count - 1, which are worth a thread from `grain` on.
template <class Body>
void inRanges(std::size_t count, std::size_t grain, const Body& body) {
    if (count <= grain)
        body(0, count);
    else
        splitUp(count, grain, body);
}

/// Whether holds(begin, end) of all ranges that inRanges makes.
template <class Holds>
bool holdsInRanges(std::size_t count, std::size_t grain, const Holds& holds) {
    std::atomic<bool> all = true;
    inRanges(count, grain, [&](std::size_t begin, std::size_t end) {
        if (!holds(begin, end)) all = false;
    });
    return all;
}

/// Calls body(index) for 0 ... count - 1, at least `grain` of them in a row on one thread.
template <class Body>
void inParallel(std::size_t count, std::size_t grain, const Body& body) {
    inRanges(count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t index = begin; index < end; ++index) body(index);
    });
}

/// Of a particle's cheap work. Measured: a thread takes as long to wake up as another takes for some thousands.
inline constexpr std::size_t kParticleGrain = 8192;

/// to = from.
template <class T>
void copy(const std::vector<T>& from, std::vector<T>& to) {
    to.resize(from.size());
    inRanges(from.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
        std::copy_n(from.data() + begin, end - begin, to.data() + begin);
    });
}

/// Terms of a partial sum; part of what makes the bits of a sum.
inline constexpr std::size_t kSumChunk = 1024;

/// Sum of term(index) over 0 ... count - 1, at least `grain` of them, in whole chunks, in a row on one thread.
template <class Sum = double, class Term>
Sum sumOver(std::size_t count, const Term& term, std::size_t grain = kParticleGrain) {
    const std::size_t chunks = (count + kSumChunk - 1) / kSumChunk;
    std::vector<Sum> partial(chunks, Sum{});
    inParallel(chunks, std::max<std::size_t>(1, grain / kSumChunk), [&](std::size_t chunk) {
        const std::size_t end = std::min(count, (chunk + 1) * kSumChunk);
        Sum sum{};
        for (std::size_t index = chunk * kSumChunk; index < end; ++index) sum += term(index);
        partial[chunk] = sum;
    });
    Sum sum{};
    for (const Sum& part : partial) sum += part;
    return sum;
}

/// The largest term(index), which is no NaN and at least 0, over 0 ... count - 1.
template <class Term>
double largestOver(std::size_t count, const Term& term) {
    const std::size_t chunks = (count + kSumChunk - 1) / kSumChunk;
    std::vector<double> partial(chunks, 0.0);
    inParallel(chunks, kParticleGrain / kSumChunk, [&](std::size_t chunk) {
        const std::size_t end = std::min(count, (chunk + 1) * kSumChunk);
        double largest = 0.0;
        for (std::size_t index = chunk * kSumChunk; index < end; ++index) largest = std::max(largest, term(index));
        partial[chunk] = largest;
    });
    return chunks == 0 ? 0.0 : *std::max_element(partial.begin(), partial.end());
}

}  // namespace engine
