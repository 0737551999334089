// The moments of the neighbors are summed in single precision about the particle; what is made of them is computed in
// double precision and without functions of libm, so that it is the same on every machine. No eigenvalues are needed,
// because the ellipsoid's matrix is the square of the covariance but for a factor.
// This file is compiled once per instruction set.
#include "render/prepare/skin/skin_shapes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <tbb/parallel_for.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/prepare/skin/skin_shapes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"
#include "render/prepare/skin/neighborhood-inl.h"

#ifndef RENDER_SKIN_MOMENTS
#define RENDER_SKIN_MOMENTS
namespace render {

/// Sums over the particles around one, itself included: of K, of K times the vector d to each, and of K d d^T.
struct NeighborMoments {
    float weight = 0.0F;
    glm::vec3 first{0.0F};            ///< m
    SymmetricMatrix<float> second{};  ///< m^2
};

}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

template <bool kIsMixed>
NeighborMoments momentsAround(glm::vec4 particle, const Neighborhood& neighborhood, float reach) {
    const D d;
    const Vec3 here = splat(glm::vec3(particle));
    std::array<BlockSum, 10> sums;
    for (BlockSum& sum : sums) sum.fill(splat(0.0F));
    for (std::size_t block = 0; block < neighborhood.size; block += kBlock) {
        for (std::size_t v = 0; v < kVectorsPerBlock; ++v) {
            const std::size_t k = block + v * hn::Lanes(d);
            const Vec3 off = offsetsFrom(here, neighborhood, k);
            const V weight = neighborWeight<kIsMixed>(particle, off, hn::LoadU(d, &neighborhood.values[3][k]), reach);
            const Vec3 first = off * weight;
            const std::array<V, 10> terms = {weight,          first.x,         first.y,         first.z,
                                             first.x * off.x, first.y * off.y, first.z * off.z, first.x * off.y,
                                             first.x * off.z, first.y * off.z};
            for (std::size_t sum = 0; sum < terms.size(); ++sum) sums[sum][v] = sums[sum][v] + terms[sum];
        }
    }
    return {total(sums[0]),
            {total(sums[1]), total(sums[2]), total(sums[3])},
            {total(sums[4]), total(sums[5]), total(sums[6]), total(sums[7]), total(sums[8]), total(sums[9])}};
}

/// Computes the moments around the particles with the sorted indices first, first + 1, ...
void neighborMoments(const ParticleCells& cells, float reach, std::size_t first, std::span<NeighborMoments> moments) {
    thread_local Neighborhood neighborhood;
    const bool isMixed = cells.smallestRadius < cells.largestRadius;
    std::size_t end = 0;  // sorted index at which the cell ends whose neighborhood has been gathered
    for (std::size_t k = 0; k < moments.size(); ++k) {
        const glm::vec4 particle = cells.particle(first + k);
        if (first + k >= end) {
            const glm::ivec3 cell = cells.cellOf(particle);
            gather<4>(cells, cell, 2, neighborhood);
            end = cells.begin[cellIndex(cells.count, cell.x, cell.y, cell.z) + 1];
        }
        moments[k] = isMixed ? momentsAround<true>(particle, neighborhood, reach)
                             : momentsAround<false>(particle, neighborhood, reach);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(neighborMoments);

namespace {

using Matrix = SymmetricMatrix<double>;

/// The matrix a I + b m.
Matrix blended(double a, double b, const Matrix& m) {
    return {a + b * m.xx, a + b * m.yy, a + b * m.zz, b * m.xy, b * m.xz, b * m.yz};
}

/// @param radius  of the particle, m
NeighborShape shapeOf(const NeighborMoments& moments, float radius, float reach) {
    const glm::dvec3 m = glm::dvec3(moments.first) / double(moments.weight);
    const glm::dvec3 first(moments.first);
    const SymmetricMatrix<float>& second = moments.second;
    const double support = 2.0 * double(reach) * double(radius);
    const double round = double(kSkinRoundness) * support * support / 9.0;
    // The sum of K e e^T with e = d - m is that of K d d^T less m times the sum of K d^T.
    const Matrix sum{double(second.xx) - m.x * first.x + round, double(second.yy) - m.y * first.y + round,
                     double(second.zz) - m.z * first.z + round, double(second.xy) - m.x * first.y,
                     double(second.xz) - m.x * first.z,         double(second.yz) - m.y * first.z};
    return {glm::vec3(m), sum * (3.0 / sum.trace())};
}

/// The cube root of a number from 0.027 to 1, by Newton's method from above. Of the smallest, (1 - s)^2 (1 + 2 s) with
/// s = kSkinStretch, the tenth step changes no bit.
double cubeRoot(double x) {
    double root = 1.0;
    for (int k = 0; k < 10; ++k) root = (2.0 * root + x / (root * root)) / 3.0;
    return root;
}

}  // namespace

std::vector<NeighborShape> neighborShapes(const ParticleCells& cells, float reach) {
    constexpr std::size_t kChunk = 128;
    const std::size_t count = cells.index.size();
    std::vector<NeighborShape> shapes(count);
    tbb::parallel_for(std::size_t{0}, (count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t first = chunk * kChunk;
        std::array<NeighborMoments, kChunk> buffer;
        const auto moments = std::span(buffer).first(std::min(kChunk, count - first));
        HWY_DYNAMIC_DISPATCH(neighborMoments)(cells, reach, first, moments);
        for (std::size_t k = 0; k < moments.size(); ++k)
            shapes[first + k] = shapeOf(moments[k], cells.radius[first + k], reach);
    });
    return shapes;
}

SymmetricMatrix<float> spreadOf(const SymmetricMatrix<double>& covariance, float stretch, float reach) {
    const Matrix shape = blended(1.0 - double(stretch), double(stretch), covariance);
    const double root = cubeRoot(shape.determinant());
    const Matrix spread = squared(shape) * (double(reach) * double(reach) / (root * root));
    return {float(spread.xx), float(spread.yy), float(spread.zz), float(spread.xy), float(spread.xz), float(spread.yz)};
}

}  // namespace render

#endif
