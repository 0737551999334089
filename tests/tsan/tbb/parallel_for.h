// oneTBB's loops on plain threads: a range is divided into one piece a thread. See threads.h.
#pragma once

#include <algorithm>
#include <cstddef>

#include "tbb/blocked_range.h"
#include "tbb/threads.h"

namespace tbb {

struct static_partitioner {};

template <class Value, class Body>
void parallel_for(const blocked_range<Value>& range, const Body& body) {
    if (range.end() <= range.begin()) return;
    const std::size_t size = range.size();
    const std::size_t grains = (size + range.grainsize() - 1) / range.grainsize();
    const std::size_t pieces = std::min(grains, static_cast<std::size_t>(on_threads::concurrency));
    const auto boundary = [&](std::size_t piece) { return range.begin() + static_cast<Value>(size * piece / pieces); };
    on_threads::runAll(pieces, [&](std::size_t piece) {
        body(blocked_range<Value>(boundary(piece), boundary(piece + 1), range.grainsize()));
    });
}

template <class Value, class Body>
void parallel_for(const blocked_range<Value>& range, const Body& body, const static_partitioner&) {
    parallel_for(range, body);
}

template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body) {
    parallel_for(blocked_range<Index>(first, last), [&](const blocked_range<Index>& piece) {
        for (Index index = piece.begin(); index < piece.end(); ++index) body(index);
    });
}

}  // namespace tbb
