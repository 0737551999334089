// Near the surface, every block is sampled once to see on which side of the surface its nodes are, and the values of
// those with nodes on both sides are kept. Blocks next to them are then sampled again, which costs less than keeping
// the values of all.
#include "render/mesh/sampled_field.h"

#include <algorithm>
#include <cstdint>

#include <tbb/parallel_for.h>

namespace render {
namespace {

enum class Side : std::uint8_t { outside, inside, both };

Side sideOf(const BlockNodes& values) {
    const auto isInside = [](float value) { return value < 0.0F; };
    const auto count = std::count_if(values.begin(), values.end(), isInside);
    if (count == 0) return Side::outside;
    return count == static_cast<std::ptrdiff_t>(values.size()) ? Side::inside : Side::both;
}

void sampleValues(const BallBlocks& balls, float threshold, std::size_t block, BlockNodes& values) {
    balls.sample(block, values);
    for (float& value : values) value = threshold - value;
}

/// Whether a block or one of its 26 neighbors has nodes on another side than the block.
bool isAtSurface(const BallBlocks& balls, const std::vector<Side>& sides, std::size_t block) {
    const Side own = sides[block];
    if (own == Side::both) return true;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                const std::ptrdiff_t other = balls.find(balls.blocks()[block] + glm::ivec3(x, y, z));
                if ((other < 0 ? Side::outside : sides[static_cast<std::size_t>(other)]) != own) return true;
            }
    return false;
}

}  // namespace

SampledField sampleNearSurface(const BallBlocks& balls, float threshold) {
    const std::size_t count = balls.blocks().size();
    std::vector<Side> sides(count);
    std::vector<std::unique_ptr<BlockNodes>> values(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t block) {
        BlockNodes sampled;
        sampleValues(balls, threshold, block, sampled);
        sides[block] = sideOf(sampled);
        if (sides[block] == Side::both) values[block] = std::make_unique<BlockNodes>(sampled);
    });
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t block) {
        if (values[block] || !isAtSurface(balls, sides, block)) return;
        values[block] = std::make_unique<BlockNodes>();
        sampleValues(balls, threshold, block, *values[block]);
    });
    SampledField field;
    field.outside = threshold;
    for (std::size_t block = 0; block < count; ++block) {
        if (values[block]) {
            field.blocks.push_back(balls.blocks()[block]);
            field.values.push_back(std::move(values[block]));
        } else if (sides[block] == Side::inside) {
            field.inside.push_back(balls.blocks()[block]);
        }
    }
    return field;
}

SampledField sampleWhole(const BallBlocks& balls) {
    const std::size_t count = balls.blocks().size();
    std::vector<std::unique_ptr<BlockNodes>> values(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t block) {
        auto sampled = std::make_unique<BlockNodes>();
        balls.sample(block, *sampled);
        // The corner of a ball's box may be out of the ball's reach.
        if (std::ranges::any_of(*sampled, [](float value) { return value > 0.0F; })) values[block] = std::move(sampled);
    });
    SampledField field;
    field.outside = 0.0F;
    for (std::size_t block = 0; block < count; ++block) {
        if (!values[block]) continue;
        field.blocks.push_back(balls.blocks()[block]);
        field.values.push_back(std::move(values[block]));
    }
    return field;
}

}  // namespace render
