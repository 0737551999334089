// The balls near a cell lie in up to nine contiguous runs.
#include "render/prepare/rays/ball_set.h"

#include <numeric>

#include "render/prepare/cells/tiles.h"

namespace render {

void BallSet::assignAround(const BallCells& cells, glm::ivec3 cell) {
    const glm::ivec3 low = max(cell - 1, glm::ivec3(0));
    const glm::ivec3 high = min(cell + 1, cells.count - 1);
    thread_local std::vector<std::uint32_t> around;
    around.clear();
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            const std::uint32_t first = cells.begin[cellIndex(cells.count, low.x, y, z)];
            const std::uint32_t end = cells.begin[cellIndex(cells.count, high.x, y, z) + 1];
            around.resize(around.size() + (end - first));
            std::iota(around.end() - (end - first), around.end(), first);
        }
    }
    assign(cells, around.size(), [&](std::size_t k) { return around[k]; });
}

}  // namespace render
