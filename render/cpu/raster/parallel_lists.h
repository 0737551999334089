// Loops over the corners and triangles of meshes on all threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace render {

/// How many corners or triangles one task handles. Chosen: a task takes some hundredths of a millisecond.
inline constexpr std::size_t kMeshGrain = 4096;

/// Calls visit(k) for all k below count, in parallel.
template <typename Visit>
void forAll(std::size_t count, const Visit& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kMeshGrain), [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) visit(k);
    });
}

/// Calls visit(k, list) for all k below count, in parallel. @return what the calls have appended to the lists, in the
/// order of k
template <typename Item, typename Visit>
std::vector<Item> listAll(std::size_t count, const Visit& visit) {
    std::vector<std::vector<Item>> parts((count + kMeshGrain - 1) / kMeshGrain);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
        parts[part].reserve(kMeshGrain);
        const std::size_t end = std::min(count, (part + 1) * kMeshGrain);
        for (std::size_t k = part * kMeshGrain; k < end; ++k) visit(k, parts[part]);
    });
    std::size_t total = 0;
    for (const std::vector<Item>& part : parts) total += part.size();
    std::vector<Item> all;
    all.reserve(total);
    for (const std::vector<Item>& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace render
