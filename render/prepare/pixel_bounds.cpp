// Bounds of projected spheres for the binning of tiles.h, as many spheres at a time as a SIMD vector holds; this file
// is compiled once per instruction set.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/prepare/tiles.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/prepare/pixel_bounds.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// Bounds along one axis of the picture, on the plane at depth 1; in parallel projection on any plane.
struct Interval {
    V low, high;
};

/// Tangents from the eye to the circle (a, z, r): a/z runs over (a z -+ r sqrt(a^2 + z^2 - r^2)) / (z^2 - r^2), for z >
/// r. Where the numerator's terms cancel it is rationalized: it is (a^2 - r^2) front over their sum.
/// @param front  z^2 - r^2
Interval tangents(V a, V z, V r, V front) {
    const V root = r * hn::Sqrt(hn::Max(a * a + front, splat(0.0F)));
    const V middle = a * z;
    const V product = (a - r) * (a + r);
    const V least = middle - root;
    const V most = middle + root;
    const M isRight = middle >= splat(0.0F);
    return {hn::IfThenElse(isRight, product / most, least / front),
            hn::IfThenElse(isRight, most / front, product / least)};
}

/// A position rounded down to a pixel and clamped to [-1, count].
VI clampToPixel(V position, int count) {
    // Conversion rounds down from zero on.
    return hn::ConvertTo(DI(), clamp(position, -1.0F, static_cast<float>(count)) + splat(1.0F)) - splatInt(1);
}

/// @param spheres, pixels  arrays of as many as a vector has lanes
void boundVector(const CameraFrame& frame, const ViewSphere* spheres, Rect* pixels) {
    static_assert(sizeof(ViewSphere) == 4 * sizeof(float) && sizeof(Rect) == 4 * sizeof(std::int32_t));
    V x, y, z, r;
    hn::LoadInterleaved4(D(), &spheres->center.x, x, y, z, r);
    Interval across{x - r, x + r};
    Interval up{y - r, y + r};
    M isEverywhere = hn::FirstN(D(), 0);
    if (frame.perspective) {
        const V front = (z - r) * (z + r);
        across = tangents(x, z, r, front);
        up = tangents(y, z, r, front);
        // Where a sphere all but touches the eye's plane, tangents are useless.
        isEverywhere = z <= r * splat(1.0001F);
    }
    const auto width = static_cast<float>(frame.width);
    const auto height = static_cast<float>(frame.height);
    const V perX = splat(0.5F * width / frame.halfWidth);
    const V perY = splat(0.5F * height / frame.halfHeight);
    const V middleX = splat(0.5F * width);
    const V middleY = splat(0.5F * height);
    const V margin = splat(1.0F);
    const VI left = clampToPixel(middleX + across.low * perX - margin, frame.width);
    const VI right = clampToPixel(middleX + across.high * perX + margin, frame.width);
    const VI top = clampToPixel(middleY - up.high * perY - margin, frame.height);
    const VI bottom = clampToPixel(middleY - up.low * perY + margin, frame.height);
    const VI lastColumn = splatInt(frame.width - 1);
    const VI lastRow = splatInt(frame.height - 1);
    const VI zero = splatInt(0);
    const M isOutside =
        floatMask(hn::Or(hn::Or(left > lastColumn, top > lastRow), hn::Or(right < zero, bottom < zero)));
    const M isBehind = z + r <= splat(0.0F);
    const auto isNowhere = hn::RebindMask(DI(), hn::Or(isBehind, hn::AndNot(isEverywhere, isOutside)));
    const auto isWhole = hn::RebindMask(DI(), isEverywhere);
    const auto choose = [&](VI bound, VI everywhere, VI nowhere) {
        return hn::IfThenElse(isNowhere, nowhere, hn::IfThenElse(isWhole, everywhere, bound));
    };
    const VI before = splatInt(-1);
    hn::StoreInterleaved4(choose(hn::Max(left, zero), zero, zero), choose(hn::Max(top, zero), zero, zero),
                          choose(hn::Min(right, lastColumn), lastColumn, before),
                          choose(hn::Min(bottom, lastRow), lastRow, before), DI(), &pixels->x0);
}

void boundSpheres(const CameraFrame& frame, std::span<const ViewSphere> spheres, std::span<Rect> pixels) {
    const std::size_t lanes = hn::Lanes(D());
    const std::size_t end = spheres.size() / lanes * lanes;
    for (std::size_t k = 0; k < end; k += lanes) boundVector(frame, &spheres[k], &pixels[k]);
    if (end == spheres.size()) return;
    std::array<ViewSphere, kTileSize> rest;
    std::array<Rect, kTileSize> restPixels;
    std::ranges::copy(spheres.subspan(end), rest.begin());
    boundVector(frame, rest.data(), restPixels.data());
    std::copy_n(restPixels.begin(), spheres.size() - end, pixels.subspan(end).begin());
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(boundSpheres);

std::vector<Rect> pixelBounds(const CameraFrame& frame, std::span<const ViewSphere> spheres) {
    std::vector<Rect> pixels(spheres.size());
    constexpr std::size_t kChunk = 1024;
    tbb::parallel_for(std::size_t{0}, (spheres.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t first = chunk * kChunk;
        const std::size_t count = std::min(kChunk, spheres.size() - first);
        HWY_DYNAMIC_DISPATCH(boundSpheres)
        (frame, spheres.subspan(first, count), std::span(pixels).subspan(first, count));
    });
    return pixels;
}

}  // namespace render

#endif
