// Balls of a smooth skin: each is pulled toward the mean of its neighbors and weighs the less, the more of them there
// are, and the kernel of a large ball ends early where small ones are near. Particles are sorted into cells as wide as
// the longest distance at which two particles influence each other. All that may be in reach of one cell's particles is
// gathered once, and each particle's sums run over it. Those of an anisotropic skin have shapes and shifts, which
// skin_shapes.cpp finds before.
// Groups of particles that are far apart have grids of their own: particles that have left a scene cost no time, and
// change no bit of the others' balls where they are too far away for one grid.
// This file is compiled once per instruction set.
#include "render/prepare/skin/skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <tbb/parallel_for.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/prepare/skin/skin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/cells/cell_order.h"
#include "render/prepare/cells/simd_rays-inl.h"
#include "render/prepare/cells/strays.h"
#include "render/prepare/skin/neighborhood-inl.h"
#include "render/prepare/skin/skin_shapes.h"

#ifndef RENDER_SKIN_INFLUENCE
#define RENDER_SKIN_INFLUENCE
namespace render {

/// What a particle's neighbors, itself included, make of its ball, in the terms of view.h's smooth skin.
struct NeighborInfluence {
    float density = 0.0F;            ///< sum of k
    glm::vec3 weightedOffset{0.0F};  ///< sum of k times the vector to the neighbor, or times the neighbor's m, m
    float reach = 0.0F;              ///< R, m
};

}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

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

/// @tparam kIsMixed    whether particles may have different radii
/// @tparam kIsShifted  whether the neighbors' shifts are summed up, and not the vectors to them
template <bool kIsMixed, bool kIsShifted>
NeighborInfluence influenceOn(glm::vec4 particle, const Neighborhood& neighborhood, float reach) {
    const D d;
    const Vec3 here = splat(glm::vec3(particle));
    const auto& values = neighborhood.values;
    BlockSum density, offsetX, offsetY, offsetZ;
    for (BlockSum* sum : {&density, &offsetX, &offsetY, &offsetZ}) sum->fill(splat(0.0F));
    for (std::size_t block = 0; block < neighborhood.size; block += kBlock) {
        for (std::size_t v = 0; v < kVectorsPerBlock; ++v) {
            const std::size_t k = block + v * hn::Lanes(d);
            Vec3 off = offsetsFrom(here, neighborhood, k);
            const V weight = neighborWeight<kIsMixed>(particle, off, hn::LoadU(d, &values[3][k]), 0.5F * reach);
            if constexpr (kIsShifted)
                off = {hn::LoadU(d, &values[4][k]), hn::LoadU(d, &values[5][k]), hn::LoadU(d, &values[6][k])};
            density[v] = density[v] + weight;
            offsetX[v] = offsetX[v] + weight * off.x;
            offsetY[v] = offsetY[v] + weight * off.y;
            offsetZ[v] = offsetZ[v] + weight * off.z;
        }
    }
    return {total(density), {total(offsetX), total(offsetY), total(offsetZ)}, reach * particle.w};
}

/// Computes the influences on the particles with the sorted indices first, first + 1, ...
template <bool kIsShifted>
void sumInfluences(const ParticleCells& cells, float reach, std::size_t first,
                   std::span<NeighborInfluence> influences) {
    thread_local Neighborhood neighborhood;
    const bool isMixed = cells.smallestRadius < cells.largestRadius;
    std::size_t end = 0;  // sorted index at which the cell ends whose neighborhood has been gathered
    for (std::size_t k = 0; k < influences.size(); ++k) {
        const std::size_t sortedIndex = first + k;
        const glm::vec4 particle = cells.particle(sortedIndex);
        if (sortedIndex >= end) {
            const glm::ivec3 cell = cells.cellOf(particle);
            gather<kIsShifted ? 7 : 4>(cells, cell, 1, neighborhood);
            end = cells.begin[cellIndex(cells.count, cell.x, cell.y, cell.z) + 1];
        }
        influences[k] = isMixed ? influenceOn<true, kIsShifted>(particle, neighborhood, reach)
                                : influenceOn<false, kIsShifted>(particle, neighborhood, reach);
        if (cells.smallestRadius < 0.5F * particle.w) influences[k].reach = kernelReach(neighborhood, particle, reach);
    }
}

/// sumInfluences() of the neighbors' shifts where there are any.
void neighborInfluences(const ParticleCells& cells, float reach, std::size_t first,
                        std::span<NeighborInfluence> influences) {
    if (cells.shift[0].empty())
        sumInfluences<false>(cells, reach, first, influences);
    else
        sumInfluences<true>(cells, reach, first, influences);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(neighborInfluences);

namespace {

/// Weight of a ball of a smooth skin.
float weightOf(const NeighborInfluence& influence, float radius, float reach) {
    // The exponent -3/4 lies between 0, where the field is a sum, which swells where many balls overlap, and -1, where
    // it is a mean, which sinks in at the border.
    const float root = std::sqrt(influence.density);
    const float weight = 1.0F / (root * std::sqrt(root));
    if (influence.reach >= reach * radius) return weight;
    const float share = radius / influence.reach;
    const float steeper = (1.0F - 1.0F / (reach * reach)) / (1.0F - share * share);
    return weight * (steeper * steeper);
}

/// The ball of a smooth or an anisotropic skin for a particle.
/// @param shape  of an anisotropic skin; else null
SkinBall ballOf(const NeighborInfluence& influence, const Sphere& particle, float reach, const NeighborShape* shape) {
    SkinBall ball{particle.center, weightOf(influence, particle.radius, reach), influence.reach, {}};
    if (shape == nullptr) {
        ball.center += kSkinPull * influence.weightedOffset / influence.density;
        return ball;
    }
    ball.center += shape->shift - influence.weightedOffset / influence.density;
    const bool isShort = influence.reach < reach * particle.radius;
    const float room = isShort ? (influence.reach / particle.radius - 1.0F) / (reach - 1.0F) : 1.0F;
    ball.spread = spreadOf(shape->covariance, kSkinStretch * room * room, ball.reach);
    return ball;
}

/// Makes the balls of a smooth or an anisotropic skin for particles that only each other influence.
void smooth(std::span<const Sphere> particles, const MetaballField& field, std::span<SkinBall> balls) {
    ParticleCells cells = sortIntoCells(particles, field.reach);
    std::vector<NeighborShape> shapes;
    if (field.skin == Skin::anisotropic) shapes = neighborShapes(cells, field.reach);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const NeighborShape& shape : shapes) cells.shift[axis].push_back(shape.shift[static_cast<int>(axis)]);
    constexpr std::size_t kChunk = 128;
    const std::size_t count = cells.index.size();
    tbb::parallel_for(std::size_t{0}, (count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t first = chunk * kChunk;
        std::array<NeighborInfluence, kChunk> buffer;
        const auto influences = std::span(buffer).first(std::min(kChunk, count - first));
        HWY_DYNAMIC_DISPATCH(neighborInfluences)(cells, field.reach, first, influences);
        for (std::size_t k = 0; k < influences.size(); ++k) {
            const std::uint32_t index = cells.index[first + k];
            const NeighborShape* shape = shapes.empty() ? nullptr : &shapes[first + k];
            balls[index] = ballOf(influences[k], particles[index], field.reach, shape);
        }
    });
}

/// smooth() for some of the particles.
void smoothGroup(std::span<const Sphere> particles, std::span<const std::uint32_t> group, const MetaballField& field,
                 std::span<SkinBall> balls) {
    std::vector<Sphere> members;
    members.reserve(group.size());
    for (const std::uint32_t index : group) members.push_back(particles[index]);
    std::vector<SkinBall> theirs(group.size());
    smooth(members, field, theirs);
    for (std::size_t k = 0; k < group.size(); ++k) balls[group[k]] = theirs[k];
}

}  // namespace

BallKernel kernelOf(const SkinBall& ball) {
    const float peak = std::sqrt(ball.weight);
    return {peak, std::sqrt(peak) / ball.reach};
}

glm::vec3 extentAlong(const View& view, const SkinBall& ball, glm::vec3 x, glm::vec3 y, glm::vec3 z) {
    if (view.field.skin != Skin::anisotropic) return glm::vec3(ball.reach);
    const SymmetricMatrix<float> spread = inAxes(ball.spread, x, y, z);
    return {std::sqrt(spread.xx), std::sqrt(spread.yy), std::sqrt(spread.zz)};
}

float surfaceThreshold(const MetaballField& field) {
    const float root = 1.0F - 1.0F / (field.reach * field.reach);
    return root * root;
}

std::vector<SkinBall> skinOf(const View& view) {
    std::vector<SkinBall> balls(view.particles.size());
    if (view.field.skin == Skin::plain) {
        for (std::size_t k = 0; k < balls.size(); ++k)
            balls[k] = {view.particles[k].center, 1.0F, view.field.reach * view.particles[k].radius, {}};
        return balls;
    }
    if (balls.empty()) return balls;
    ParticleCells widest;
    fitToRadii(view.particles, view.field.reach, widest);
    // A little wider than particles influence each other, because distances are rounded.
    const float gap = (view.field.skin == Skin::anisotropic ? 2.002F : 1.001F) * widest.side;
    const auto groups = separateGroups(view.particles, gap, kMostCellsToSort);
    if (groups.empty()) smooth(view.particles, view.field, balls);
    for (const std::vector<std::uint32_t>& group : groups) smoothGroup(view.particles, group, view.field, balls);
    return balls;
}

}  // namespace render

#endif
