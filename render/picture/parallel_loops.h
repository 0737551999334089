// Loops over the corners and triangles of meshes on all threads. Their results do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>
#include <glm/glm.hpp>

#include "render/picture/bounds.h"

namespace render {

/// Divides the indices below count into parts of a fixed size, and calls visit(part, first, end) for each in parallel.
template <typename Visit>
void forParts(std::size_t count, std::size_t partSize, const Visit& visit) {
    tbb::parallel_for(std::size_t{0}, (count + partSize - 1) / partSize,
                      [&](std::size_t part) { visit(part, part * partSize, std::min(count, (part + 1) * partSize)); });
}

/// How many corners or triangles one task handles. Chosen: a task takes some hundredths of a millisecond.
inline constexpr std::size_t kMeshPart = 4096;

/// Calls visit(k) for all k below count.
template <typename Visit>
void forAll(std::size_t count, const Visit& visit) {
    forParts(count, kMeshPart, [&](std::size_t, std::size_t first, std::size_t end) {
        for (std::size_t k = first; k < end; ++k) visit(k);
    });
}

/// Calls visit(k, list) for all k below count. @return what the calls have appended to the lists, in the order of k
template <typename Item, typename Visit>
std::vector<Item> listAll(std::size_t count, const Visit& visit) {
    std::vector<std::vector<Item>> parts((count + kMeshPart - 1) / kMeshPart);
    forParts(count, kMeshPart, [&](std::size_t part, std::size_t first, std::size_t end) {
        parts[part].reserve(end - first);
        for (std::size_t k = first; k < end; ++k) visit(k, parts[part]);
    });
    std::size_t total = 0;
    for (const std::vector<Item>& part : parts) total += part.size();
    std::vector<Item> all;
    all.reserve(total);
    for (const std::vector<Item>& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// The bounds of pointOf(k) for all k below count.
template <typename PointOf>
Bounds<glm::vec3> boundsOfAll(std::size_t count, const PointOf& pointOf) {
    std::vector<Bounds<glm::vec3>> parts((count + kMeshPart - 1) / kMeshPart);
    forParts(count, kMeshPart, [&](std::size_t part, std::size_t first, std::size_t end) {
        Bounds<glm::vec3> bounds;
        for (std::size_t k = first; k < end; ++k) bounds.add(pointOf(k));
        parts[part] = bounds;
    });
    Bounds<glm::vec3> all;
    for (const Bounds<glm::vec3>& part : parts) all.add(part.low, part.high);
    return all;
}

}  // namespace render
