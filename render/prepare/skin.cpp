// Balls of a smooth skin: each is pulled toward the mean of its neighbors and weighs the less, the more of them there
// are, and the kernel of a large ball ends early where small ones are near. Particles are sorted into cells as wide as
// the longest distance at which two particles influence each other. All that may be in reach of one cell's particles is
// gathered once into blocks of 16, and each particle's sums run over these blocks with 16 accumulators, however wide
// the vectors are. The accumulators are added up in a fixed order, so that every instruction set gives the same bits.
// Groups of particles that are far apart have grids of their own: particles that have left a scene cost no time, and
// change no bit of the others' balls where they are too far away for one grid.
// This file is compiled once per instruction set.
#include "render/prepare/skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <tbb/parallel_for.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/prepare/skin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_rays-inl.h"
#include "render/prepare/strays.h"

#ifndef RENDER_SKIN_CELLS
#define RENDER_SKIN_CELLS
namespace render {

/// Number of particles whose kernels are added up at a time.
constexpr std::size_t kBlock = 16;

/// Particles whose radius is above 0, sorted by the cells of a grid, component by component, so that all particles in
/// reach of one lie in nine contiguous runs.
struct ParticleCells {
    glm::vec3 low{0.0F};
    float side = 1.0F;
    glm::ivec3 count{1};
    std::vector<std::uint32_t> begin;  ///< sorted index of each cell's first particle; at last the number of particles
    std::vector<float> x, y, z, radius;                 ///< position and radius of each particle, by sorted index
    std::vector<std::uint32_t> index;                   ///< index of each particle in the view, by sorted index
    float smallestRadius = 0.0F, largestRadius = 0.0F;  ///< of the particles, m

    /// The cell of a point. @pre at is not below `low`; conversion then rounds down (glm::floor may be a call).
    glm::ivec3 cellOf(glm::vec3 at) const { return min(glm::ivec3((at - low) / side), count - 1); }
};

/// The particles near a cell in whole blocks: x, y, z and radius. The last block is filled up with particles out of
/// reach.
struct Neighborhood {
    std::size_t size = 0;
    std::array<std::vector<float>, 4> values;  // x, y, z and radius of the particles
};

/// What a particle's neighbors, itself included, make of its ball, in the terms of view.h's smooth skin.
struct NeighborInfluence {
    float density = 0.0F;            ///< sum of k
    glm::vec3 weightedOffset{0.0F};  ///< sum of k times the vector to the neighbor, m
    float reach = 0.0F;              ///< R, m
};

}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

constexpr std::size_t kVectorsPerBlock = kBlock / hn::MaxLanes(D());
using BlockSum = std::array<V, kVectorsPerBlock>;

/// Copies all particles that may be in reach of a cell's particles, and the cell's particles themselves.
void gather(const ParticleCells& cells, glm::ivec3 cell, Neighborhood& neighborhood) {
    const glm::ivec3 first = max(cell - 1, glm::ivec3(0));
    const glm::ivec3 last = min(cell + 1, cells.count - 1);
    const std::array<const float*, 4> from = {cells.x.data(), cells.y.data(), cells.z.data(), cells.radius.data()};
    neighborhood.size = 0;
    for (int z = first.z; z <= last.z; ++z) {
        for (int y = first.y; y <= last.y; ++y) {
            const std::size_t begin = cells.begin[cellIndex(cells.count, first.x, y, z)];
            const std::size_t count = cells.begin[cellIndex(cells.count, last.x, y, z) + 1] - begin;
            for (std::size_t value = 0; value < 4; ++value) {
                std::vector<float>& to = neighborhood.values[value];
                if (to.size() < neighborhood.size + count + kBlock) to.resize(2 * (neighborhood.size + count + kBlock));
                std::copy_n(from[value] + begin, count, to.begin() + static_cast<std::ptrdiff_t>(neighborhood.size));
            }
            neighborhood.size += count;
        }
    }
    // Far beyond any reach, and near enough for the squared distance to be finite.
    constexpr std::array<float, 4> kOutOfReach = {1e18F, 1e18F, 1e18F, 0.0F};
    for (std::size_t value = 0; value < 4; ++value)
        std::fill_n(&neighborhood.values[value][neighborhood.size], kBlock, kOutOfReach[value]);
    neighborhood.size = (neighborhood.size + kBlock - 1) / kBlock * kBlock;
}

/// The sum of all accumulators: the second half is added to the first until one is left.
HWY_INLINE float total(const BlockSum& sum) {
    const hn::CappedTag<float, 4> d;
    alignas(64) std::array<float, kBlock> sums;
    for (std::size_t v = 0; v < kVectorsPerBlock; ++v) hn::Store(sum[v], D(), &sums[v * hn::Lanes(D())]);
    for (const std::size_t half : {std::size_t{8}, std::size_t{4}})
        for (std::size_t k = 0; k < half; k += hn::Lanes(d))
            hn::Store(hn::Load(d, &sums[k]) + hn::Load(d, &sums[k + half]), d, &sums[k]);
    return (sums[0] + sums[2]) + (sums[1] + sums[3]);
}

/// Vectors from a point to the particles of a neighborhood from index k on.
HWY_INLINE Vec3 offsetsFrom(const Vec3& point, const Neighborhood& neighborhood, std::size_t k) {
    const D d;
    const auto& [x, y, z, radius] = neighborhood.values;
    return Vec3{hn::LoadU(d, &x[k]), hn::LoadU(d, &y[k]), hn::LoadU(d, &z[k])} - point;
}

/// The radius of a ball's kernel among the particles of a neighborhood, m.
float kernelReach(const Neighborhood& neighborhood, glm::vec4 particle, float reach) {
    const D d;
    const Vec3 here = splat(glm::vec3(particle));
    const V own = splat(particle.w);
    const V least = splat(kSkinLeastSize * particle.w);
    V end = splat(reach * particle.w);
    for (std::size_t k = 0; k < neighborhood.size; k += hn::Lanes(d)) {
        const Vec3 off = offsetsFrom(here, neighborhood, k);
        const V radius = hn::LoadU(d, &neighborhood.values[3][k]);
        const V size = hn::Max(radius, least);
        const V beyond = splat(reach - 1.0F) * (splat(1.0F) + (size + size) / own) * size;
        const V limit = hn::Max(own + beyond, hn::Sqrt(dot(off, off)) - size);
        end = hn::Min(end, hn::IfThenElse(radius < splat(0.5F) * own, limit, end));
    }
    return hn::GetLane(minOfLanes(end, hn::FirstN(d, hn::Lanes(d))));
}

/// @tparam kIsMixed  whether particles may have different radii
template <bool kIsMixed>
NeighborInfluence influenceOn(glm::vec4 particle, const Neighborhood& neighborhood, float reach) {
    const D d;
    const Vec3 here = splat(glm::vec3(particle));
    const V zero = splat(0.0F);
    const V one = splat(1.0F);
    BlockSum density, offsetX, offsetY, offsetZ;
    for (BlockSum* sum : {&density, &offsetX, &offsetY, &offsetZ}) sum->fill(zero);
    for (std::size_t block = 0; block < neighborhood.size; block += kBlock) {
        for (std::size_t v = 0; v < kVectorsPerBlock; ++v) {
            const std::size_t k = block + v * hn::Lanes(d);
            const Vec3 off = offsetsFrom(here, neighborhood, k);
            const V radius = hn::LoadU(d, &neighborhood.values[3][k]);
            const V support = splat(0.5F * reach) * (splat(particle.w) + radius);
            const V root = hn::Max(zero, one - dot(off, off) / (support * support));
            V weight = root * root;
            if constexpr (kIsMixed) {
                const V contrast = splat(3.0F) * (splat(particle.w) - radius) / (splat(particle.w) + radius);
                weight = weight * hn::Max(zero, one - contrast * contrast);
            }
            density[v] = density[v] + weight;
            offsetX[v] = offsetX[v] + weight * off.x;
            offsetY[v] = offsetY[v] + weight * off.y;
            offsetZ[v] = offsetZ[v] + weight * off.z;
        }
    }
    return {total(density), {total(offsetX), total(offsetY), total(offsetZ)}, reach * particle.w};
}

/// Computes the influences on the particles with the sorted indices first, first + 1, ...
void neighborInfluences(const ParticleCells& cells, float reach, std::size_t first,
                        std::span<NeighborInfluence> influences) {
    thread_local Neighborhood neighborhood;
    std::size_t end = 0;  // sorted index at which the cell ends whose neighborhood has been gathered
    for (std::size_t k = 0; k < influences.size(); ++k) {
        const std::size_t sortedIndex = first + k;
        const glm::vec4 particle(cells.x[sortedIndex], cells.y[sortedIndex], cells.z[sortedIndex],
                                 cells.radius[sortedIndex]);
        if (sortedIndex >= end) {
            const glm::ivec3 cell = cells.cellOf(particle);
            gather(cells, cell, neighborhood);
            end = cells.begin[cellIndex(cells.count, cell.x, cell.y, cell.z) + 1];
        }
        const bool isMixed = cells.smallestRadius < cells.largestRadius;
        influences[k] = isMixed ? influenceOn<true>(particle, neighborhood, reach)
                                : influenceOn<false>(particle, neighborhood, reach);
        if (cells.smallestRadius < 0.5F * particle.w) influences[k].reach = kernelReach(neighborhood, particle, reach);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(neighborInfluences);

namespace {

constexpr double kMostCells = 4e6;  // largest number of cells; chosen: they take 16 MB

/// Sets the radii, and makes cells as wide as particles influence each other.
void fitToRadii(std::span<const Sphere> particles, float reach, ParticleCells& cells) {
    cells.smallestRadius = std::numeric_limits<float>::max();
    cells.largestRadius = std::numeric_limits<float>::min();
    for (const Sphere& particle : particles) {
        if (particle.radius <= 0.0F) continue;
        cells.smallestRadius = std::min(cells.smallestRadius, particle.radius);
        cells.largestRadius = std::max(cells.largestRadius, particle.radius);
    }
    cells.side = reach * cells.largestRadius;
    // A kernel may end at a particle's distance less its radius, which is less than half of the ball's.
    if (cells.smallestRadius < 0.5F * cells.largestRadius) cells.side += 0.5F * cells.largestRadius;
}

/// Places cells around the particles, and makes them wider if there were too many.
void fitToPositions(std::span<const Sphere> particles, ParticleCells& cells) {
    Bounds<glm::vec3> bounds;
    for (const Sphere& particle : particles) bounds.add(particle.center);
    cells.low = bounds.low;
    const auto countAlong = [&](int axis) {
        return std::floor(double(bounds.high[axis] - bounds.low[axis]) / cells.side) + 1.0;
    };
    while (countAlong(0) * countAlong(1) * countAlong(2) > kMostCells) cells.side *= 2.0F;
    for (int axis = 0; axis < 3; ++axis) cells.count[axis] = static_cast<int>(countAlong(axis));
}

/// Sorts the particles whose radius is above 0 into cells by a counting sort. @param reach  reach of the field, in
/// radii
ParticleCells sortIntoCells(std::span<const Sphere> particles, float reach) {
    ParticleCells cells;
    fitToRadii(particles, reach, cells);
    fitToPositions(particles, cells);
    std::vector<std::uint32_t> cellOf(particles.size());
    cells.begin.assign(cellIndex(cells.count, 0, 0, cells.count.z) + 1, 0);
    for (std::size_t k = 0; k < particles.size(); ++k) {
        if (particles[k].radius <= 0.0F) continue;
        const glm::ivec3 cell = cells.cellOf(particles[k].center);
        cellOf[k] = static_cast<std::uint32_t>(cellIndex(cells.count, cell.x, cell.y, cell.z));
        ++cells.begin[cellOf[k] + 1];
    }
    for (std::size_t k = 1; k < cells.begin.size(); ++k) cells.begin[k] += cells.begin[k - 1];
    std::vector<std::uint32_t> next(cells.begin.begin(), cells.begin.end() - 1);
    for (std::vector<float>* values : {&cells.x, &cells.y, &cells.z, &cells.radius}) values->resize(cells.begin.back());
    cells.index.resize(cells.begin.back());
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const Sphere& particle = particles[k];
        if (particle.radius <= 0.0F) continue;
        const std::uint32_t sortedIndex = next[cellOf[k]]++;
        cells.x[sortedIndex] = particle.center.x;
        cells.y[sortedIndex] = particle.center.y;
        cells.z[sortedIndex] = particle.center.z;
        cells.radius[sortedIndex] = particle.radius;
        cells.index[sortedIndex] = static_cast<std::uint32_t>(k);
    }
    return cells;
}

/// The ball of a smooth skin for a particle.
SkinBall smoothed(const NeighborInfluence& influence, const Sphere& particle, float reach) {
    // The exponent -3/4 lies between 0, where the field is a sum, which swells where many balls overlap, and -1, where
    // it is a mean, which sinks in at the border.
    const float root = std::sqrt(influence.density);
    SkinBall ball{particle.center + kSkinPull * influence.weightedOffset / influence.density,
                  1.0F / (root * std::sqrt(root)), influence.reach};
    if (ball.reach >= reach * particle.radius) return ball;
    const float share = particle.radius / ball.reach;
    const float steeper = (1.0F - 1.0F / (reach * reach)) / (1.0F - share * share);
    ball.weight *= steeper * steeper;
    return ball;
}

/// Makes the balls of a smooth skin for particles that only each other influence.
void smooth(std::span<const Sphere> particles, float reach, std::span<SkinBall> balls) {
    const ParticleCells cells = sortIntoCells(particles, reach);
    constexpr std::size_t kChunk = 128;
    const std::size_t count = cells.index.size();
    tbb::parallel_for(std::size_t{0}, (count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t first = chunk * kChunk;
        std::array<NeighborInfluence, kChunk> buffer;
        const auto influences = std::span(buffer).first(std::min(kChunk, count - first));
        HWY_DYNAMIC_DISPATCH(neighborInfluences)(cells, reach, first, influences);
        for (std::size_t k = 0; k < influences.size(); ++k) {
            const std::uint32_t index = cells.index[first + k];
            balls[index] = smoothed(influences[k], particles[index], reach);
        }
    });
}

/// smooth() for some of the particles.
void smoothGroup(std::span<const Sphere> particles, std::span<const std::uint32_t> group, float reach,
                 std::span<SkinBall> balls) {
    std::vector<Sphere> members;
    members.reserve(group.size());
    for (const std::uint32_t index : group) members.push_back(particles[index]);
    std::vector<SkinBall> theirs(group.size());
    smooth(members, reach, theirs);
    for (std::size_t k = 0; k < group.size(); ++k) balls[group[k]] = theirs[k];
}

}  // namespace

BallKernel kernelOf(const SkinBall& ball) {
    const float peak = std::sqrt(ball.weight);
    return {peak, std::sqrt(peak) / ball.reach};
}

float surfaceThreshold(const MetaballField& field) {
    const float root = 1.0F - 1.0F / (field.reach * field.reach);
    return root * root;
}

std::vector<SkinBall> skinOf(const View& view) {
    std::vector<SkinBall> balls(view.particles.size());
    if (view.field.skin == Skin::plain) {
        for (std::size_t k = 0; k < balls.size(); ++k)
            balls[k] = {view.particles[k].center, 1.0F, view.field.reach * view.particles[k].radius};
        return balls;
    }
    if (balls.empty()) return balls;
    ParticleCells widest;
    fitToRadii(view.particles, view.field.reach, widest);
    // A little wider than particles influence each other, because distances are rounded.
    const auto groups = separateGroups(view.particles, 1.001F * widest.side, kMostCells);
    if (groups.empty()) smooth(view.particles, view.field.reach, balls);
    for (const std::vector<std::uint32_t>& group : groups) smoothGroup(view.particles, group, view.field.reach, balls);
    return balls;
}

}  // namespace render

#endif
