// A row of pixels at a time, on lanes; this file is compiled once per instruction set.
#include "render/cpu/shading/background_tiles.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/shading/background_tiles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/raster/simd_colors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

Vec3 groundOver(const Backdrop& backdrop, V x, V y, const Vec3& background) {
    const WorldRay ray = worldRay(backdrop.frame, imagePointAt(backdrop.frame, x, y));
    const V depth = hn::Div(hn::Sub(splat(backdrop.groundHeight), ray.origin.y), ray.direction.y);
    const V fade = fadeAt(pointOnRay(ray.origin, depth, ray.direction), backdrop.groundCenter, backdrop.fadeDistance);
    return mixedBy(splat(backdrop.ground), background, fade);
}

/// A tile at this place of the picture; rowLength: pixels.
void colorPlainTile(const Backdrop& backdrop, TileClass shown, glm::ivec2 corner, std::size_t rowLength,
                    PixelColor* to) {
    const Background& background = backdrop.background;
    const auto unit = [](const Vec3& color) {
        return Vec3{clamp(color.x, 0.0F, 1.0F), clamp(color.y, 0.0F, 1.0F), clamp(color.z, 0.0F, 1.0F)};
    };
    for (int row = 0; row < kTileSize; ++row, to += rowLength) {
        const V y = splat(static_cast<float>(corner.y + row) + 0.5F);
        const V down = hn::Mul(y, splat(1.0F / static_cast<float>(backdrop.frame.height)));
        const Vec3 behind = mixedBy(background.top, background.bottom, down);
        for (std::size_t column = 0; column < kTileSize; column += hn::Lanes(D())) {
            const V x = hn::Add(hn::Iota(D(), static_cast<float>(corner.x) + 0.5F), splat(static_cast<float>(column)));
            const bool isGround = shown == TileClass::ground;
            storePacked(unit(isGround ? groundOver(backdrop, x, y, behind) : behind), to + column);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <tbb/parallel_for.h>

namespace render {

HWY_EXPORT(colorPlainTile);

void PlainTiles::color(const Backdrop& backdrop, std::span<const TileClass> classes, int columns,
                       std::span<PixelColor> pixels) {
    // `picture` stands for not known, too: such tiles are never kept.
    if (backdrop != backdrop_ || classes_.size() != classes.size()) classes_.assign(classes.size(), TileClass::picture);
    backdrop_ = backdrop;
    const std::size_t rowLength = static_cast<std::size_t>(columns) * kTileSize;
    tbb::parallel_for(std::size_t{0}, classes.size(), [&](std::size_t tile) {
        const bool kept = classes_[tile] == classes[tile];
        classes_[tile] = classes[tile];
        if (kept || classes[tile] == TileClass::picture) return;
        const glm::ivec2 corner =
            kTileSize * glm::ivec2(tile % static_cast<std::size_t>(columns), tile / static_cast<std::size_t>(columns));
        PixelColor* first =
            &pixels[static_cast<std::size_t>(corner.y) * rowLength + static_cast<std::size_t>(corner.x)];
        HWY_DYNAMIC_DISPATCH(colorPlainTile)(backdrop, classes[tile], corner, rowLength, first);
    });
}

}  // namespace render

#endif
