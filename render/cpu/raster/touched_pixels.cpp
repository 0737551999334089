// Bounds of projected spheres for the binning, as many at a time as the machine has lanes; this file is compiled once
// per instruction set.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/prepare/tiles.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/raster/touched_pixels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// On the plane at depth 1; in parallel projection on any.
struct Interval {
    V low, high;
};

/// Tangents from the eye to the circle (a, z, r): a/z runs over (a z -+ r sqrt(a^2 + z^2 - r^2)) / (z^2 - r^2), for z >
/// r. front: z^2 - r^2. Where the numerator's terms cancel it is rationalised: it is (a^2 - r^2) front over their sum.
Interval tangents(V a, V z, V r, V front) {
    const V root = hn::Mul(r, hn::Sqrt(hn::Max(hn::Add(hn::Mul(a, a), front), splat(0.0F))));
    const V middle = hn::Mul(a, z);
    const V product = hn::Mul(hn::Sub(a, r), hn::Add(a, r));
    const V least = hn::Sub(middle, root);
    const V most = hn::Add(middle, root);
    const M isRight = hn::Ge(middle, splat(0.0F));
    return {hn::IfThenElse(isRight, hn::Div(product, most), hn::Div(least, front)),
            hn::IfThenElse(isRight, hn::Div(most, front), hn::Div(product, least))};
}

/// Rounded down; from -1 to count.
VI clampedPixel(V at, int count) {
    const V within = clamp(at, -1.0F, static_cast<float>(count));
    // Conversion rounds down from zero on.
    return hn::Sub(hn::ConvertTo(DI(), hn::Add(within, splat(1.0F))), splatInt(1));
}

/// spheres, pixels: a vector of them.
void touchedByVector(const CameraFrame& frame, const ViewSphere* spheres, Rect* pixels) {
    static_assert(sizeof(ViewSphere) == 4 * sizeof(float) && sizeof(Rect) == 4 * sizeof(std::int32_t));
    const D d;
    V x, y, z, r;
    hn::LoadInterleaved4(d, &spheres->center.x, x, y, z, r);
    Interval across{hn::Sub(x, r), hn::Add(x, r)};
    Interval up{hn::Sub(y, r), hn::Add(y, r)};
    M isWhole = hn::FirstN(d, 0);
    if (frame.perspective) {
        const V front = hn::Mul(hn::Sub(z, r), hn::Add(z, r));
        across = tangents(x, z, r, front);
        up = tangents(y, z, r, front);
        // Where a sphere all but touches the eye's plane, tangents are useless.
        isWhole = hn::Le(z, hn::Mul(r, splat(1.0001F)));
    }
    const auto width = static_cast<float>(frame.width);
    const auto height = static_cast<float>(frame.height);
    const V perX = splat(0.5F * width / frame.halfWidth);
    const V perY = splat(0.5F * height / frame.halfHeight);
    const V middleX = splat(0.5F * width);
    const V middleY = splat(0.5F * height);
    const V margin = splat(1.0F);
    const VI left = clampedPixel(hn::Sub(hn::Add(middleX, hn::Mul(across.low, perX)), margin), frame.width);
    const VI right = clampedPixel(hn::Add(hn::Add(middleX, hn::Mul(across.high, perX)), margin), frame.width);
    const VI top = clampedPixel(hn::Sub(hn::Sub(middleY, hn::Mul(up.high, perY)), margin), frame.height);
    const VI bottom = clampedPixel(hn::Add(hn::Sub(middleY, hn::Mul(up.low, perY)), margin), frame.height);
    const VI lastColumn = splatInt(frame.width - 1);
    const VI lastRow = splatInt(frame.height - 1);
    const VI zero = splatInt(0);
    const M isOutside = floatMask(hn::Or(hn::Or(hn::Gt(left, lastColumn), hn::Gt(top, lastRow)),
                                         hn::Or(hn::Lt(right, zero), hn::Lt(bottom, zero))));
    const M isBehind = hn::Le(hn::Add(z, r), splat(0.0F));
    const auto none = hn::RebindMask(DI(), hn::Or(isBehind, hn::AndNot(isWhole, isOutside)));
    const auto whole = hn::RebindMask(DI(), isWhole);
    const auto pick = [&](VI within, VI everything, VI nothing) {
        return hn::IfThenElse(none, nothing, hn::IfThenElse(whole, everything, within));
    };
    const VI before = splatInt(-1);
    hn::StoreInterleaved4(pick(hn::Max(left, zero), zero, zero), pick(hn::Max(top, zero), zero, zero),
                          pick(hn::Min(right, lastColumn), lastColumn, before),
                          pick(hn::Min(bottom, lastRow), lastRow, before), DI(), &pixels->x0);
}

void touched(const CameraFrame& frame, std::span<const ViewSphere> spheres, std::span<Rect> pixels) {
    const std::size_t lanes = hn::Lanes(D());
    const std::size_t end = spheres.size() / lanes * lanes;
    for (std::size_t k = 0; k < end; k += lanes) touchedByVector(frame, &spheres[k], &pixels[k]);
    if (end == spheres.size()) return;
    std::array<ViewSphere, kTileSize> rest;
    std::array<Rect, kTileSize> touchedByRest;
    std::ranges::copy(spheres.subspan(end), rest.begin());
    touchedByVector(frame, rest.data(), touchedByRest.data());
    std::copy_n(touchedByRest.begin(), spheres.size() - end, pixels.subspan(end).begin());
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(touched);

std::vector<Rect> pixelBounds(const CameraFrame& frame, std::span<const ViewSphere> spheres) {
    std::vector<Rect> pixels(spheres.size());
    constexpr std::size_t kChunk = 1024;
    tbb::parallel_for(std::size_t{0}, (spheres.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t first = chunk * kChunk;
        const std::size_t count = std::min(kChunk, spheres.size() - first);
        HWY_DYNAMIC_DISPATCH(touched)(frame, spheres.subspan(first, count), std::span(pixels).subspan(first, count));
    });
    return pixels;
}

}  // namespace render

#endif
