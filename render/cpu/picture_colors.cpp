// Most pixels show one thing, and are shaded once; each thing on an outline's pixel is shaded at the middle of the
// samples that show it.
#include "render/cpu/picture_colors.h"

#include <algorithm>
#include <array>
#include <bit>

#include <tbb/parallel_for.h>

#include "render/cpu/metaballs/ray_layout.h"
#include "render/cpu/raster/line_coverage.h"

namespace render {

namespace {

/// Columns and rows along the Z curve: between the light and a compact group of pixels there are fewer spheres than
/// between it and a row of them.
struct ZPlaces {
    std::array<float, kTilePixels> column{}, row{};
    std::array<std::uint8_t, kTilePixels> rank{};  ///< on the curve, of each place

    constexpr ZPlaces() {
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            column[k] = static_cast<float>(kZCurve[k] % kTileSize);
            row[k] = static_cast<float>(kZCurve[k] / kTileSize);
            rank[kZCurve[k]] = static_cast<std::uint8_t>(k);
        }
    }
};

constexpr ZPlaces kZPlaces;

/// The middles of the samples whose bits are set, from the pixel's middle.
std::array<glm::vec2, 16> middles() {
    std::array<glm::vec2, 16> found{};
    for (unsigned samples = 1; samples < found.size(); ++samples) {
        glm::vec2 sum(0.0F);
        for (std::size_t s = 0; s < kFourSamples.size(); ++s)
            if ((samples >> s & 1U) != 0) sum += kFourSamples[s];
        found[samples] = sum / static_cast<float>(std::popcount(samples));
    }
    return found;
}

/// Where a pixel is shaded that shows one thing, from its corner.
glm::vec2 placeOfOne(const PictureJob& job) {
    return 0.5F + (job.offsets.size() == 1 ? job.offsets[0] : glm::vec2(0.0F));
}

/// Things on the pixels of one tile along the Z curve.
void placeTile(const PictureJob& job, std::size_t tile, std::span<const std::int32_t, kTilePixels> seen,
               SurfacePoints& points) {
    const glm::vec2 first = tileCorner(*job.contents.solids.tiles, tile) + placeOfOne(job);
    points.count = kTilePixels;
    for (std::size_t k = 0; k < kTilePixels; ++k) points.seen[k] = seen[kZCurve[k]];
    for (std::size_t k = 0; k < kTilePixels; ++k) points.x[k] = first.x + kZPlaces.column[k];
    for (std::size_t k = 0; k < kTilePixels; ++k) points.y[k] = first.y + kZPlaces.row[k];
    placePoints(job.surfaces, points);
}

void shadePoints(const PictureJob& job, const SurfacePoints& points, PointColors& colors) {
    LightReach found;
    if (job.obstruction != nullptr) reach(*job.obstruction, job.surfaces, points, found);
    shade(job.shading, job.surfaces, points, job.obstruction != nullptr ? &found : nullptr, colors);
}

/// One tile on its way; colors stand along the Z curve.
class TileColors {
 public:
    TileColors(const PictureJob& job, std::size_t tile) : job_(job), tile_(tile) {}

    void addPixels(std::span<const std::int32_t, kTilePixels> seen) {
        SurfacePoints points;
        placeTile(job_, tile_, seen, points);
        shadePoints(job_, points, colors_);
    }

    void addEdges(const TileEdges& edges) {
        std::span<const EdgePixel> pixels = edges.pixels;
        std::span<const EdgeThing> things = edges.things;
        while (!pixels.empty()) {
            // Each has four things at most.
            const std::size_t count = std::min(pixels.size(), kTilePixels / kFourSamples.size());
            things = things.subspan(mixEdges(pixels.first(count), things));
            pixels = pixels.subspan(count);
        }
    }

    void addLines(std::span<const TileRays> rays) {
        const TileContents& contents = job_.contents;
        const LineCover over = lineCover(contents.solids, contents.lines, tile_, rays, placeOfOne(job_));
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            const glm::vec4& line = over[kZCurve[k]];
            for (int channel = 0; channel < 3; ++channel) {
                float& value = colors_.rgb[static_cast<std::size_t>(channel)][k];
                value = std::min(value * (1.0F - line.w) + line[channel], 1.0F);
            }
        }
    }

    const PointColors& colors() const { return colors_; }

 private:
    /// Colors edge pixels, whose things are the first of these; returns how many.
    std::size_t mixEdges(std::span<const EdgePixel> pixels, std::span<const EdgeThing> things) {
        static const std::array<glm::vec2, 16> kMiddles = middles();
        const glm::vec2 corner = tileCorner(*job_.contents.solids.tiles, tile_);
        SurfacePoints points;
        points.count = 0;
        for (const EdgePixel& pixel : pixels) {
            for (const std::size_t last = points.count + pixel.count; points.count < last; ++points.count) {
                const EdgeThing& thing = things[points.count];
                const glm::vec2 at = pixelMiddle(corner, pixel.place) + kMiddles[thing.samples];
                points.seen[points.count] = thing.seen;
                points.x[points.count] = at.x;
                points.y[points.count] = at.y;
            }
        }
        placePoints(job_.surfaces, points);
        PointColors colors;
        shadePoints(job_, points, colors);
        std::size_t k = 0;
        for (const EdgePixel& pixel : pixels) {
            glm::vec3 sum(0.0F);
            for (const std::size_t last = k + pixel.count; k < last; ++k) {
                const float count = static_cast<float>(std::popcount(things[k].samples));
                sum += count * glm::vec3(colors.rgb[0][k], colors.rgb[1][k], colors.rgb[2][k]);
            }
            const std::size_t at = kZPlaces.rank[pixel.place];
            for (std::size_t channel = 0; channel < 3; ++channel)
                colors_.rgb[channel][at] = 0.25F * sum[static_cast<int>(channel)];
        }
        return k;
    }

    const PictureJob& job_;
    std::size_t tile_;
    PointColors colors_;
};

std::array<std::int32_t, kTilePixels> allSeeing(std::int32_t what) {
    std::array<std::int32_t, kTilePixels> seen;
    seen.fill(what);
    return seen;
}

/// Colors a tile, and calls put(colors) where it is drawn pixel by pixel.
template <typename Put>
TileClass colorTile(const PictureJob& job, std::size_t tile, const Put& put) {
    const TileContents& contents = job.contents;
    TileColors colors(job, tile);
    if (!contents.hasLines(tile)) {
        if (contents.isBackground(tile)) return TileClass::background;
        if (contents.isGround(tile)) {
            if (contents.ground[tile].kind == GroundKind::plain) return TileClass::ground;
            colors.addPixels(allSeeing(kSeesGround));
            put(colors.colors());
            return TileClass::picture;
        }
    }
    const TileSamples samples(contents, job.offsets, tile);
    colors.addPixels(samples.seen());
    thread_local TileEdges edges;
    samples.findEdges(edges);
    if (!edges.pixels.empty()) colors.addEdges(edges);
    if (contents.hasLines(tile)) colors.addLines(samples.rays());
    put(colors.colors());
    return TileClass::picture;
}

void putTile(const PointColors& colors, std::size_t tile, const CellLists& tiles, std::span<PixelColor> pixels) {
    alignas(64) std::array<PixelColor, kTilePixels> packed;
    packColors(colors, packed.data());
    const auto columns = static_cast<std::size_t>(tiles.columns);
    const std::size_t rowLength = columns * kTileSize;
    PixelColor* own = &pixels[tile / columns * kTileSize * rowLength + tile % columns * kTileSize];
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        const std::size_t place = kZCurve[k];
        own[place / kTileSize * rowLength + place % kTileSize] = packed[k];
    }
}

}  // namespace

void colorPixels(const PictureJob& job, std::span<PixelColor> pixels, std::span<TileClass> classes) {
    const CellLists& tiles = *job.contents.solids.tiles;
    tbb::parallel_for(std::size_t{0}, classes.size(), [&](std::size_t tile) {
        classes[tile] = colorTile(job, tile, [&](const PointColors& colors) { putTile(colors, tile, tiles, pixels); });
    });
}

void addColors(const PictureJob& job, std::span<PointColors> sums, std::span<TileClass> classes) {
    tbb::parallel_for(std::size_t{0}, classes.size(), [&](std::size_t tile) {
        classes[tile] = colorTile(job, tile, [&](const PointColors& colors) {
            for (std::size_t channel = 0; channel < 3; ++channel)
                for (std::size_t k = 0; k < kTilePixels; ++k) sums[tile].rgb[channel][k] += colors.rgb[channel][k];
        });
    });
}

void meanColors(int jobs, std::span<PointColors> sums, std::span<const TileClass> classes, const CellLists& tiles,
                std::span<PixelColor> pixels) {
    tbb::parallel_for(std::size_t{0}, classes.size(), [&](std::size_t tile) {
        if (classes[tile] != TileClass::picture) return;
        for (std::array<float, kTilePixels>& channel : sums[tile].rgb)
            for (float& value : channel) value /= static_cast<float>(jobs);
        putTile(sums[tile], tile, tiles, pixels);
    });
}

std::vector<VisiblePoint> visiblePoints(const PictureJob& job) {
    const CellLists& tiles = *job.contents.solids.tiles;
    const CameraFrame& frame = job.surfaces.frame;
    std::vector<VisiblePoint> found(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
    tbb::parallel_for(std::size_t{0}, tiles.begin.size() - 1, [&](std::size_t tile) {
        SurfacePoints points;
        placeTile(job, tile, TileSamples(job.contents, job.offsets, tile).seen(), points);
        const glm::ivec2 corner(tileCorner(tiles, tile));
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            const glm::ivec2 at = corner + glm::ivec2(kZCurve[k] % kTileSize, kZCurve[k] / kTileSize);
            if (at.x >= frame.width || at.y >= frame.height) continue;
            VisiblePoint& point = found[static_cast<std::size_t>(at.y * frame.width + at.x)];
            point.normal = {points.normal[0][k], points.normal[1][k], points.normal[2][k]};
            point.depth = points.seen[k] == kSeesBackground ? -1.0F : points.depth[k];
        }
    });
    return found;
}

}  // namespace render
