// Most pixels show one thing and are shaded once. In a pixel that an outline crosses, each thing that its samples hit
// is shaded once, at the mean position of these samples.
#include "render/cpu/picture_colors.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include <tbb/parallel_for.h>

#include "render/cpu/metaballs/ray_layout.h"
#include "render/cpu/raster/box_outlines.h"
#include "render/cpu/transparency/see_through.h"

namespace render {

namespace {

/// Columns and rows of a tile's pixels along the Z-order curve. Points are shaded in this order, because fewer spheres
/// lie between the light and a compact group of pixels than between the light and a row of them.
struct ZCurveTables {
    std::array<float, kTilePixels> column{}, row{};
    std::array<std::uint8_t, kTilePixels> rank{};  ///< position of each pixel on the curve

    constexpr ZCurveTables() {
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            column[k] = static_cast<float>(kZCurve[k] % kTileSize);
            row[k] = static_cast<float>(kZCurve[k] / kTileSize);
            rank[kZCurve[k]] = static_cast<std::uint8_t>(k);
        }
    }
};

constexpr ZCurveTables kZCurveTables;

/// Mean offset from the pixel's middle, in pixels, of each subset of the four samples. A subset is a bit mask.
std::array<glm::vec2, 16> sampleMiddles() {
    std::array<glm::vec2, 16> found{};
    for (unsigned samples = 1; samples < found.size(); ++samples) {
        glm::vec2 sum(0.0F);
        for (std::size_t s = 0; s < kFourSamples.size(); ++s)
            if ((samples >> s & 1U) != 0) sum += kFourSamples[s];
        found[samples] = sum / static_cast<float>(std::popcount(samples));
    }
    return found;
}

/// Position at which a pixel that shows one thing is shaded, in pixels from the pixel's top left corner.
glm::vec2 shadedPosition(const PictureJob& job) {
    return 0.5F + (job.offsets.size() == 1 ? job.offsets[0] : glm::vec2(0.0F));
}

/// The shading points of a tile's pixels along the Z curve.
void pixelPoints(const PictureJob& job, std::size_t tile, std::span<const std::int32_t, kTilePixels> hitIds,
                 ShadingPoints& points) {
    const glm::vec2 first = tileCorner(*job.contents.geometry.tiles, tile) + shadedPosition(job);
    points.count = kTilePixels;
    for (std::size_t k = 0; k < kTilePixels; ++k) points.hitId[k] = hitIds[kZCurve[k]];
    for (std::size_t k = 0; k < kTilePixels; ++k) points.x[k] = first.x + kZCurveTables.column[k];
    for (std::size_t k = 0; k < kTilePixels; ++k) points.y[k] = first.y + kZCurveTables.row[k];
    evaluateShadingPoints(job.geometry, points);
}

/// The share of an opaque shading point that is not background, as in Layers::color.
float opacityOf(const Shading& shading, const ShadingPoints& points, std::size_t k) {
    if (points.hitId[k] == kHitBackground) return 0.0F;
    if (points.hitId[k] != kHitGround) return 1.0F;
    const glm::vec3 at{points.position[0][k], points.position[1][k], points.position[2][k]};
    const glm::vec3 offset = (at - shading.groundCenter) / shading.fadeDistance;
    const float square = dot(offset, offset);
    return 1.0F / (1.0F + square * square);
}

/// What reaches shading points, if anything casts shadows or occludes the sky.
class PointVisibility {
 public:
    PointVisibility(const PictureJob& job, const ShadingPoints& points) : isSet_(job.occluders.has_value()) {
        if (isSet_) computeLightVisibility(*job.occluders, job.geometry, points, visibility_);
        isTinted_ = isSet_ && job.occluders->opticalDepth != nullptr;
    }

    const LightVisibility* get() const { return isSet_ ? &visibility_ : nullptr; }
    const TileVec3* tint() const { return isTinted_ ? &visibility_.tint : nullptr; }

 private:
    bool isSet_;
    bool isTinted_;
    LightVisibility visibility_;
};

/// Colors the points behind transparent ones.
void shadeEnds(const PictureJob& job, SeenThrough& behind, PointColors& colors) {
    const PointVisibility visibility(job, behind.ends);
    behind.endShading.tint = visibility.tint();
    shade(job.shading, job.geometry, behind.ends, visibility.get(), &behind.endShading, colors);
}

/// Colors points some of which may be transparent.
/// @param open  receives the share of background that each point shows
void shadeTransparent(const PictureJob& job, const ShadingPoints& points, PointColors& colors,
                      std::array<float, kTilePixels>& open) {
    thread_local SeenThrough behind;
    const PointVisibility visibility(job, points);
    findSeenThrough(*job.transparent, job.geometry, points, visibility.get(), behind);
    behind.shading.tint = visibility.tint();
    shade(job.shading, job.geometry, points, visibility.get(), &behind.shading, colors);
    for (std::size_t k = 0; k < points.count; ++k) open[k] = 1.0F - opacityOf(job.shading, points, k);
    PointColors seen;
    shadeEnds(job, behind, seen);
    for (std::size_t end = 0; end < behind.ends.count; ++end) {
        const std::size_t k = behind.point[end];
        const glm::vec3 weight = behind.weight[end];
        for (int channel = 0; channel < 3; ++channel) {
            float& value = colors.rgb[static_cast<std::size_t>(channel)][k];
            value = std::min(value + weight[channel] * seen.rgb[static_cast<std::size_t>(channel)][end], 1.0F);
        }
        open[k] = (weight.x + weight.y + weight.z) / 3.0F * (1.0F - opacityOf(job.shading, behind.ends, end));
    }
}

/// Colors shading points.
/// @param open  receives the share of background that each point shows, if it is not null
void shadePoints(const PictureJob& job, const ShadingPoints& points, PointColors& colors,
                 std::array<float, kTilePixels>* open) {
    if (job.transparent != nullptr) {
        std::array<float, kTilePixels> shares;
        return shadeTransparent(job, points, colors, open != nullptr ? *open : shares);
    }
    shade(job.shading, job.geometry, points, PointVisibility(job, points).get(), nullptr, colors);
    if (open == nullptr) return;
    for (std::size_t k = 0; k < points.count; ++k) (*open)[k] = 1.0F - opacityOf(job.shading, points, k);
}

std::array<std::int32_t, kTilePixels> uniformHits(std::int32_t hitId) {
    std::array<std::int32_t, kTilePixels> hitIds;
    hitIds.fill(hitId);
    return hitIds;
}

/// The colors of one tile's pixels, ordered along the Z curve.
class TileColors {
 public:
    enum class Alpha { none, computed };

    TileColors(const PictureJob& job, std::size_t tile, Alpha alpha = Alpha::none)
        : job_(job), tile_(tile), hasAlpha_(alpha == Alpha::computed) {}

    void colorAll() {
        const TileContents& contents = job_.contents;
        if (contents.kindOf(tile_) == TileKind::occludedGround) return colorPixels(uniformHits(kHitGround));
        const TileSamples samples(contents, job_.offsets, tile_);
        colorPixels(samples.hitIds());
        thread_local TileEdges edges;
        samples.findEdges(edges);
        if (!edges.pixels.empty()) colorEdges(edges);
        if (contents.hasLines(tile_)) addLines(samples.rays());
    }

    const PointColors& colors() const { return colors_; }

    /// The color and alpha of a pixel. @pre alpha is computed
    glm::vec4 at(std::size_t k) const { return {colors_.rgb[0][k], colors_.rgb[1][k], colors_.rgb[2][k], alpha_[k]}; }

 private:
    /// Gives each pixel the color of what its first sample hits.
    void colorPixels(std::span<const std::int32_t, kTilePixels> hitIds) {
        ShadingPoints points;
        std::array<float, kTilePixels> open;
        pixelPoints(job_, tile_, hitIds, points);
        shadePoints(job_, points, colors_, hasAlpha_ ? &open : nullptr);
        if (!hasAlpha_) return;
        for (std::size_t k = 0; k < kTilePixels; ++k) alpha_[k] = 1.0F - open[k];
    }

    /// Replaces the colors of the pixels that an outline crosses.
    void colorEdges(const TileEdges& edges) {
        std::span<const EdgePixel> pixels = edges.pixels;
        std::span<const EdgeHit> hits = edges.hits;
        while (!pixels.empty()) {
            // Each pixel has at most four hits, and one set of shading points has room for a tile of them.
            const std::size_t count = std::min(pixels.size(), kTilePixels / kFourSamples.size());
            hits = hits.subspan(colorSomeEdges(pixels.first(count), hits));
            pixels = pixels.subspan(count);
        }
    }

    void addLines(std::span<const TileRays> rays) {
        const TileContents& contents = job_.contents;
        const LineCoverage lines = lineCoverage(contents.geometry, contents.lines, tile_, rays, shadedPosition(job_));
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            const glm::vec4& line = lines[kZCurve[k]];
            for (int channel = 0; channel < 3; ++channel) {
                float& value = colors_.rgb[static_cast<std::size_t>(channel)][k];
                value = std::min(value * (1.0F - line.w) + line[channel], 1.0F);
            }
            if (hasAlpha_) alpha_[k] = std::min(alpha_[k] * (1.0F - line.w) + line.w, 1.0F);
        }
    }

    /// The shares of a pixel that the things its samples hit have: their shares of the samples or, at the outline of a
    /// box, the exact ones.
    std::array<float, 4> sharesOf(std::span<const EdgeHit> hits, glm::vec2 corner, std::uint8_t pixel) const {
        std::array<float, 4> shares{};
        std::array<SampledHit, 2> sampled;
        for (std::size_t k = 0; k < hits.size(); ++k) {
            const int count = std::popcount(hits[k].sampleMask);
            shares[k] = 0.25F * static_cast<float>(count);
            if (k < 2) sampled[k] = {hits[k].hitId, count};
        }
        if (hits.size() != 2) return shares;
        const auto exact = shareOfFirst(job_.geometry.frame, job_.geometry.boxes, sampled, pixelMiddle(corner, pixel));
        if (exact) shares = {*exact, 1.0F - *exact};
        return shares;
    }

    /// Colors some of the pixels that an outline crosses.
    /// @param hits  begins with the hits of these pixels
    /// @return the number of their hits
    std::size_t colorSomeEdges(std::span<const EdgePixel> pixels, std::span<const EdgeHit> hits) {
        static const std::array<glm::vec2, 16> kSampleMiddles = sampleMiddles();
        const glm::vec2 corner = tileCorner(*job_.contents.geometry.tiles, tile_);
        ShadingPoints points;
        points.count = 0;
        for (const EdgePixel& edge : pixels) {
            for (const std::size_t last = points.count + edge.hitCount; points.count < last; ++points.count) {
                const EdgeHit& hit = hits[points.count];
                const glm::vec2 at = pixelMiddle(corner, edge.pixel) + kSampleMiddles[hit.sampleMask];
                points.hitId[points.count] = hit.hitId;
                points.x[points.count] = at.x;
                points.y[points.count] = at.y;
            }
        }
        evaluateShadingPoints(job_.geometry, points);
        PointColors colors;
        std::array<float, kTilePixels> open;
        shadePoints(job_, points, colors, hasAlpha_ ? &open : nullptr);
        std::size_t k = 0;
        for (const EdgePixel& edge : pixels) {
            glm::vec3 sum(0.0F);
            float alpha = 0.0F;
            const std::array<float, 4> shares = sharesOf(hits.subspan(k, edge.hitCount), corner, edge.pixel);
            for (std::size_t hit = 0; hit < edge.hitCount; ++hit, ++k) {
                sum += shares[hit] * glm::vec3(colors.rgb[0][k], colors.rgb[1][k], colors.rgb[2][k]);
                if (hasAlpha_) alpha += shares[hit] * (1.0F - open[k]);
            }
            const std::size_t rank = kZCurveTables.rank[edge.pixel];
            for (std::size_t channel = 0; channel < 3; ++channel)
                colors_.rgb[channel][rank] = sum[static_cast<int>(channel)];
            if (hasAlpha_) alpha_[rank] = alpha;
        }
        return k;
    }

    const PictureJob& job_;
    std::size_t tile_;
    bool hasAlpha_;
    PointColors colors_;
    std::array<float, kTilePixels> alpha_;  // only with hasAlpha_
};

TileTarget targetOf(const CellLists& tiles, std::size_t tile, std::span<PixelColor> pixels) {
    const auto columns = static_cast<std::size_t>(tiles.columns);
    const std::size_t rowLength = columns * kTileSize;
    return {glm::ivec2(tileCorner(tiles, tile)),
            &pixels[tile / columns * kTileSize * rowLength + tile % columns * kTileSize], rowLength};
}

/// Encodes a tile's colors, which are ordered along the Z curve, and writes them to the picture row by row.
void writeTile(const PointColors& colors, const TileTarget& target) {
    alignas(64) std::array<PixelColor, kTilePixels> encoded;
    encodeColors(colors, Rounding::dithered, encoded.data());
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        const std::size_t pixel = kZCurve[k];
        target.first[pixel / kTileSize * target.rowLength + pixel % kTileSize] = encoded[k];
    }
}

void addColors(const PointColors& colors, PointColors& sums) {
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t k = 0; k < kTilePixels; ++k) sums.rgb[channel][k] += colors.rgb[channel][k];
}

void divideColors(float divisor, PointColors& colors) {
    for (std::array<float, kTilePixels>& channel : colors.rgb)
        for (float& value : channel) value /= divisor;
}

/// Whether the colors of a tile follow from the camera, the background and the ground alone.
bool isUnoccluded(TileKind kind) {
    return kind == TileKind::background || kind == TileKind::openGround;
}

void colorTile(const PictureJob& job, std::size_t tile, const PictureMean& mean, const TileTarget& target) {
    TileColors colors(job, tile);
    colors.colorAll();
    if (mean.count == 1) {
        writeTile(colors.colors(), target);
        return;
    }
    PointColors& sum = mean.sums[tile];
    if (mean.index == 0) sum = colors.colors();
    if (mean.index > 0) addColors(colors.colors(), sum);
    if (mean.index + 1 < mean.count) return;
    divideColors(static_cast<float>(mean.count), sum);
    writeTile(sum, target);
}

}  // namespace

void BackgroundCache::begin(const ShadingGeometry& geometry, const Shading& shading, std::size_t tileCount) {
    Key key{geometry.frame,     geometry.ground,      shading.background,
            shading.openGround, shading.groundCenter, shading.fadeDistance};
    key.frame.eye = glm::vec3(0.0F);  // ground and background are given relative to the eye
    if (key != key_ || kinds_.size() != tileCount) kinds_.assign(tileCount, TileKind::mixed);
    key_ = key;
}

bool BackgroundCache::keeps(std::size_t tile, TileKind kind) {
    return std::exchange(kinds_[tile], kind) == kind && isUnoccluded(kind);
}

void BackgroundCache::note(std::size_t tile, TileKind kind, bool isFirst) {
    kinds_[tile] = isFirst || kinds_[tile] == kind ? kind : TileKind::mixed;
}

bool BackgroundCache::isSteady(std::size_t tile) const {
    return isUnoccluded(kinds_[tile]);
}

void colorPixels(const PictureJob& job, const PictureMean& mean, BackgroundCache& cache, std::span<PixelColor> pixels) {
    const CellLists& tiles = *job.contents.geometry.tiles;
    const std::size_t tileCount = tiles.cellCount();
    if (mean.count > 1) mean.sums.resize(tileCount);
    cache.begin(job.geometry, job.shading, tileCount);
    tbb::parallel_for(std::size_t{0}, tileCount, [&](std::size_t tile) {
        const TileKind kind = job.contents.kindOf(tile);
        const TileTarget target = targetOf(tiles, tile, pixels);
        if (!mean.isOfOneView) {
            cache.note(tile, kind, mean.index == 0);
            colorTile(job, tile, mean, target);
            if (mean.index + 1 == mean.count && cache.isSteady(tile))
                colorBackgroundTile(job.geometry, job.shading, kind == TileKind::openGround, target);
            return;
        }
        if (cache.keeps(tile, kind)) return;
        if (isUnoccluded(kind))
            colorBackgroundTile(job.geometry, job.shading, kind == TileKind::openGround, target);
        else
            colorTile(job, tile, mean, target);
    });
}

void colorLayer(const PictureJob& job, std::size_t index, std::size_t count, std::vector<glm::vec4>& layer) {
    const CellLists& tiles = *job.contents.geometry.tiles;
    const CameraFrame& frame = job.geometry.frame;
    layer.resize(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
    tbb::parallel_for(std::size_t{0}, tiles.cellCount(), [&](std::size_t tile) {
        const bool isEmpty = job.contents.kindOf(tile) == TileKind::background;
        TileColors colors(job, tile, TileColors::Alpha::computed);
        if (!isEmpty) colors.colorAll();
        const glm::ivec2 corner(tileCorner(tiles, tile));
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            const glm::ivec2 at = corner + glm::ivec2(kZCurve[k] % kTileSize, kZCurve[k] / kTileSize);
            if (at.x >= frame.width || at.y >= frame.height) continue;
            glm::vec4& pixel = layer[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(frame.width) +
                                     static_cast<std::size_t>(at.x)];
            const glm::vec4 color = isEmpty ? glm::vec4(0.0F) : colors.at(k);
            pixel = index == 0 ? color : pixel + color;
            if (index + 1 == count) pixel /= static_cast<float>(count);
        }
    });
}

}  // namespace render
