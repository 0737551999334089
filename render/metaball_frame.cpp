// Tiles of rays for the picture and for the light's depth map, and the packing of what they hit.
#include "render/metaball_frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "render/field_between.h"

namespace render {

namespace {

// Places of a tile's 256 pixels along a Z curve, so that any group of 4, 8 or 16 in a row is compact and its rays meet
// few balls.
constexpr std::array<std::uint8_t, kBlockRays> zCurve() {
    std::array<std::uint8_t, kBlockRays> places{};
    for (unsigned k = 0; k < kBlockRays; ++k) {
        unsigned x = 0;
        unsigned y = 0;
        for (unsigned bit = 0; bit < 4; ++bit) {
            x |= ((k >> (2 * bit)) & 1U) << bit;
            y |= ((k >> (2 * bit + 1)) & 1U) << bit;
        }
        places[k] = static_cast<std::uint8_t>(y * kTileSize + x);
    }
    return places;
}

constexpr std::array<std::uint8_t, kBlockRays> kZCurve = zCurve();

// Every second pixel of every second row, in the same order.
constexpr auto coarsePlaces() {
    std::array<std::uint8_t, kCoarseSide * kCoarseSide> places{};
    std::size_t count = 0;
    for (const std::uint8_t place : kZCurve)
        if (place % 2 == 0 && place / kTileSize % 2 == 0) places[count++] = place;
    return places;
}

constexpr auto kCoarsePlaces = coarsePlaces();

struct BinnedField {
    std::vector<FieldBall> balls;
    CellLists tiles;
    float smallestRadius = 1.0F;
};

BinnedField binField(const CameraFrame& frame, const Skinned& skin) {
    BinnedField field;
    field.balls = fieldBalls(frame, skin);
    std::vector<ViewSphere> reaches(field.balls.size());
    float smallest = std::numeric_limits<float>::max();
    double sum = 0.0;
    for (std::size_t k = 0; k < field.balls.size(); ++k) {
        reaches[k] = {field.balls[k].center, field.balls[k].reach};
        smallest = std::min(smallest, field.balls[k].reach);
        sum += field.balls[k].reach;
    }
    // A dwarf among giants may not make every ray crawl: a tenth of the mean radius is as small as it gets.
    const double mean = sum / static_cast<double>(std::max<std::size_t>(field.balls.size(), 1));
    field.smallestRadius = std::max(smallest, static_cast<float>(0.1 * mean)) / skin.view.field.reach;
    field.tiles = binToTiles(frame, reaches, touchedPixels(frame, reaches));
    return field;
}

FieldCast castOf(const CameraFrame& frame, const View& view, const BinnedField& field) {
    FieldCast cast;
    cast.frame = frame;
    cast.balls = field.balls;
    cast.tiles = &field.tiles;
    const float root = 1.0F - 1.0F / (view.field.reach * view.field.reach);
    cast.threshold = root * root;
    cast.step = 0.5F * field.smallestRadius;
    return cast;
}

constexpr float kEndless = std::numeric_limits<float>::infinity();

/// Rays through these pixels of a tile, in this order.
template <typename Places>
void placeRays(RayBlock& block, glm::vec2 corner, const Places& places, glm::vec2 offset) {
    block.count = places.size();
    for (std::size_t k = 0; k < places.size(); ++k) {
        block.x[k] = corner.x + static_cast<float>(places[k] % kTileSize) + 0.5F + offset.x;
        block.y[k] = corner.y + static_cast<float>(places[k] / kTileSize) + 0.5F + offset.y;
        block.from[k] = 0.0F;
        block.to[k] = kEndless;
    }
}

/// Packs a block's hits to their pixels of the tile.
template <typename Places>
void putSamples(const FieldCast& cast, const RayBlock& block, const Places& places, std::size_t tile,
                FieldPicture& picture) {
    const std::size_t out = static_cast<std::size_t>(picture.slots[tile]) * kBlockRays;
    PackedBlock packed;
    packBlock(cast.frame, block, cast.openness, packed);
    for (std::size_t k = 0; k < block.count; ++k) picture.samples[out + places[k]] = packed.samples[k];
    if (!cast.openness) return;
    for (std::size_t k = 0; k < block.count; ++k) picture.open[out + places[k]] = packed.open[k];
}

/// A tile's coarse hits with those of its neighbours to the right and below; none where they have no slot.
CoarseHits coarseHits(const std::vector<CoarseHits>& own, const FieldPicture& picture, const CellLists& tiles,
                      std::size_t tile) {
    CoarseHits hits = own[static_cast<std::size_t>(picture.slots[tile])];
    const auto columns = static_cast<std::size_t>(tiles.columns);
    const auto neighbour = [&](std::size_t right, std::size_t down) -> const CoarseHits* {
        const std::size_t at = tile + right + down * columns;
        if (tile % columns + right >= columns || at >= picture.slots.size() || picture.slots[at] < 0) return nullptr;
        return &own[static_cast<std::size_t>(picture.slots[at])];
    };
    if (const CoarseHits* right = neighbour(1, 0))
        for (std::size_t row = 0; row < kCoarseSide; ++row) hits.put(kCoarseSide, row, *right, 0, row);
    if (const CoarseHits* below = neighbour(0, 1))
        for (std::size_t column = 0; column < kCoarseSide; ++column) hits.put(column, kCoarseSide, *below, column, 0);
    if (const CoarseHits* diagonal = neighbour(1, 1)) hits.put(kCoarseSide, kCoarseSide, *diagonal, 0, 0);
    return hits;
}

// Within a pixel the field rises by less than this times the pixel's share of the smallest ball's radius (a lone ball's
// by half of it, and a pixel's diagonal away).
constexpr float kSteepest = 2.0F;

Smoothness smoothnessOf(const FieldCast& cast, const BinnedField& field, float reach) {
    float farthest = 0.0F;
    for (const FieldBall& ball : field.balls) farthest = std::max(farthest, ball.center.z + ball.reach);
    const float pixel = cast.frame.pixelWidth() * (cast.frame.perspective ? farthest : 1.0F);
    // A ray's greatest sample lies a quarter of a radius from the field's peak at most, where a lone ball at the
    // threshold bends by 4 sqrt(threshold) / reach^2 a square radius.
    const float missed = 0.125F * std::sqrt(cast.threshold) / (reach * reach);
    return {0.02F * field.smallestRadius, cast.threshold - missed - kSteepest * pixel / field.smallestRadius};
}

void castSparsely(const FieldCast& cast, glm::vec2 offset, Smoothness smoothness, FieldPicture& picture) {
    const CellLists& tiles = *cast.tiles;
    std::vector<CoarseHits> coarse(picture.samples.size() / kBlockRays);
    const auto forTiles = [&](const auto& visit) {
        tbb::parallel_for(std::size_t{0}, picture.slots.size(), [&](std::size_t tile) {
            if (picture.slots[tile] >= 0) visit(tile);
        });
    };
    forTiles([&](std::size_t tile) {
        RayBlock block;
        placeRays(block, cornerOf(tiles, tile), kCoarsePlaces, offset);
        castBlock(cast, tile, block);
        putSamples(cast, block, kCoarsePlaces, tile, picture);
        CoarseHits& hits = coarse[static_cast<std::size_t>(picture.slots[tile])];
        hits.clear();
        for (std::size_t k = 0; k < block.count; ++k)
            hits.put(kCoarsePlaces[k] % kTileSize / 2, kCoarsePlaces[k] / kTileSize / 2, block, k);
    });
    forTiles([&](std::size_t tile) {
        const CoarseHits hits = coarseHits(coarse, picture, tiles, tile);
        const glm::vec2 corner = cornerOf(tiles, tile);
        RayBlock block;
        placeRays(block, corner, kBetweenPlaces, offset);
        const std::array<bool, kBetween> good = fillBetween(cast.frame, hits, smoothness, block);
        putSamples(cast, block, kBetweenPlaces, tile, picture);
        std::array<bool, kBlockRays> isRough{};
        for (std::size_t k = 0; k < kBetween; ++k) isRough[kBetweenPlaces[k]] = !good[k];
        std::vector<std::uint8_t> rough;
        for (const std::uint8_t place : kZCurve)
            if (isRough[place]) rough.push_back(place);
        placeRays(block, corner, rough, offset);
        castBlock(cast, tile, block);
        putSamples(cast, block, rough, tile, picture);
    });
}

/// Where a pixel's extra rays look for the surface.
struct DepthRange {
    float from = 0.0F;
    float to = kEndless;
};

// The depths of a tile's pixels and of those around them; 0 where there is no surface.
class Depths {
 public:
    Depths(const FieldPicture& picture, const CellLists& tiles, std::size_t tile) : picture_(picture), tiles_(tiles) {
        const auto columns = static_cast<std::size_t>(tiles.columns);
        const int left = static_cast<int>(tile % columns);
        const int top = static_cast<int>(tile / columns);
        copy(left, top, {0, 0}, {kTileSize, kTileSize}, {1, 1});
        copy(left - 1, top, {kTileSize - 1, 0}, {1, kTileSize}, {0, 1});
        copy(left + 1, top, {0, 0}, {1, kTileSize}, {kTileSize + 1, 1});
        copy(left, top - 1, {0, kTileSize - 1}, {kTileSize, 1}, {1, 0});
        copy(left, top + 1, {0, 0}, {kTileSize, 1}, {1, kTileSize + 1});
    }

    // Hit beside miss, or a jump in depth that a pixel's slope does not explain.
    std::array<bool, kBlockRays> outlines(float jump) const {
        std::array<bool, kBlockRays> found{};
        for (std::size_t row = 0; row < kTileSize; ++row) {
            const float* at = &depths_[(row + 1) * kSide + 1];
            bool* out = &found[row * kTileSize];
            for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, std::ptrdiff_t{-1}, kSide, -kSide})
                for (std::ptrdiff_t k = 0; k < kTileSize; ++k) out[k] = out[k] | differs(at[k], at[k + step], jump);
        }
        return found;
    }

    // From a radius before the nearest of what the pixel and its neighbours show; where one of them shows nothing, to
    // two radii behind the farthest: what extra rays see is what the rays around them see.
    DepthRange around(std::uint8_t place, float radius) const {
        const std::ptrdiff_t at = (place / kTileSize + 1) * kSide + place % kTileSize + 1;
        DepthRange range{kEndless, 0.0F};
        bool isOpen = false;
        for (const std::ptrdiff_t step : {std::ptrdiff_t{0}, std::ptrdiff_t{1}, std::ptrdiff_t{-1}, kSide, -kSide}) {
            const float depth = depths_[static_cast<std::size_t>(at + step)];
            isOpen = isOpen || depth <= 0.0F;
            range.from = depth > 0.0F ? std::min(range.from, depth - radius) : range.from;
            range.to = std::max(range.to, depth + 2.0F * radius);
        }
        return isOpen ? range : DepthRange{range.from, kEndless};
    }

 private:
    static constexpr std::ptrdiff_t kSide = kTileSize + 2;

    static bool differs(float depth, float other, float jump) {
        return ((other > 0.0F) != (depth > 0.0F)) | (std::abs(other - depth) > jump);
    }

    void copy(int column, int row, glm::ivec2 from, glm::ivec2 size, glm::ivec2 to) {
        if (column < 0 || row < 0 || column >= tiles_.columns || row >= tiles_.rows) return;
        const std::int32_t slot = picture_.slots[tiles_.cellIndex(column, row)];
        if (slot < 0) return;
        const FieldSample* samples = &picture_.samples[static_cast<std::size_t>(slot) * kBlockRays];
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                depths_[static_cast<std::size_t>((to.y + y) * kSide + to.x + x)] =
                    std::bit_cast<float>(samples[(from.y + y) * kTileSize + from.x + x].depthBits);
    }

    const FieldPicture& picture_;
    const CellLists& tiles_;
    std::array<float, kSide * kSide> depths_{};
};

// The extra samples of one tile, in the order of its pixels.
struct TileExtras {
    std::vector<std::uint8_t> pixels;
    std::vector<FieldSample> samples;  ///< four a pixel
    std::vector<std::uint32_t> open;
};

TileExtras castExtras(const FieldCast& cast, const Depths& depths, float radius, std::size_t tile,
                      std::vector<std::uint8_t> pixels) {
    TileExtras extras;
    const glm::vec2 corner = cornerOf(*cast.tiles, tile);
    RayBlock block;
    const auto flush = [&] {
        castBlock(cast, tile, block);
        PackedBlock packed;
        packBlock(cast.frame, block, cast.openness, packed);
        const auto count = static_cast<std::ptrdiff_t>(block.count);
        extras.samples.insert(extras.samples.end(), packed.samples.begin(), packed.samples.begin() + count);
        if (cast.openness) extras.open.insert(extras.open.end(), packed.open.begin(), packed.open.begin() + count);
        block.count = 0;
    };
    for (const std::uint8_t pixel : pixels) {
        const DepthRange range = depths.around(pixel, radius);
        for (const glm::vec2 offset : kFourSamples) {
            block.from[block.count] = range.from;
            block.to[block.count] = range.to;
            block.x[block.count] = corner.x + static_cast<float>(pixel % kTileSize) + 0.5F + offset.x;
            block.y[block.count] = corner.y + static_cast<float>(pixel / kTileSize) + 0.5F + offset.y;
            ++block.count;
        }
        if (block.count == kBlockRays) flush();
    }
    if (block.count > 0) flush();
    extras.pixels = std::move(pixels);
    return extras;
}

void addExtras(const FieldCast& cast, float radius, FieldPicture& picture) {
    const float jump = 0.5F * radius;
    std::vector<TileExtras> extras(picture.slots.size());
    tbb::parallel_for(std::size_t{0}, picture.slots.size(), [&](std::size_t tile) {
        if (picture.slots[tile] < 0) return;
        const Depths depths(picture, *cast.tiles, tile);
        const std::array<bool, kBlockRays> outlines = depths.outlines(jump);
        std::vector<std::uint8_t> pixels;
        for (const std::uint8_t place : kZCurve)
            if (outlines[place]) pixels.push_back(place);
        if (!pixels.empty()) extras[tile] = castExtras(cast, depths, radius, tile, std::move(pixels));
    });
    for (std::size_t tile = 0; tile < extras.size(); ++tile) {
        const std::size_t base = static_cast<std::size_t>(std::max(picture.slots[tile], 0)) * kBlockRays;
        for (std::size_t k = 0; k < extras[tile].pixels.size(); ++k) {
            picture.samples[base + extras[tile].pixels[k]].extra =
                static_cast<std::uint32_t>(picture.samples.size() + 4 * k);
        }
        picture.samples.insert(picture.samples.end(), extras[tile].samples.begin(), extras[tile].samples.end());
        picture.open.insert(picture.open.end(), extras[tile].open.begin(), extras[tile].open.end());
    }
}

// Tiles where nothing of the surface is seen lose their slots.
void forgetEmptyTiles(FieldPicture& picture) {
    tbb::parallel_for(std::size_t{0}, picture.slots.size(), [&](std::size_t tile) {
        if (picture.slots[tile] < 0) return;
        const FieldSample* samples = &picture.samples[static_cast<std::size_t>(picture.slots[tile]) * kBlockRays];
        const auto isSeen = [](const FieldSample& sample) { return sample.depthBits != 0 || sample.extra != 0; };
        if (std::none_of(samples, samples + kBlockRays, isSeen)) picture.slots[tile] = -1;
    });
}

CameraFrame lightFrame(const LightBasis& basis, const DepthMap& map, float top) {
    CameraFrame frame;
    frame.perspective = false;
    frame.right = basis.u;
    frame.up = -basis.v;  // rows of the map run along +v
    frame.forward = -basis.toLight;
    frame.width = map.columns;
    frame.height = map.rows;
    frame.halfWidth = 0.5F * static_cast<float>(map.columns) * map.texelSize;
    frame.halfHeight = 0.5F * static_cast<float>(map.rows) * map.texelSize;
    frame.eye =
        (map.origin.x + frame.halfWidth) * basis.u + (map.origin.y + frame.halfHeight) * basis.v + top * basis.toLight;
    return frame;
}

// Finer than a twelfth of a radius nothing more is to be seen in a shadow (measured by eye).
constexpr float kTexelsPerRadius = 12.0F;

// eye: of the camera in light space. Texels lie at multiples of their size in the world, so that a map that grows by a
// row, or a camera that moves, leaves the rest where it was.
DepthMap emptyMap(const LightBounds& bounds, glm::vec3 eye, float texelSize, int mostTexels) {
    DepthMap map;
    const glm::vec3 extent = bounds.high - bounds.low;
    map.texelSize = std::max(std::max(extent.x, extent.y) / static_cast<float>(mostTexels - 5), texelSize);
    // Two texels of margin for the filter.
    map.columns = static_cast<int>(extent.x / map.texelSize) + 6;
    map.rows = static_cast<int>(extent.y / map.texelSize) + 6;
    const glm::vec2 low = glm::vec2(bounds.low) + glm::vec2(eye);
    map.origin = (glm::floor(low / map.texelSize) - 2.0F) * map.texelSize - glm::vec2(eye);
    map.heights.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows), kNoHeight);
    return map;
}

}  // namespace

std::vector<FieldBall> fieldBalls(const CameraFrame& frame, const Skinned& skin) {
    std::vector<FieldBall> balls;
    balls.reserve(skin.balls.size());
    for (std::size_t k = 0; k < skin.balls.size(); ++k) {
        const Sphere& particle = skin.view.particles[k];
        if (!(particle.radius > 0.0F)) continue;
        const float reach = skin.view.field.reach * particle.radius;
        const float peak = std::sqrt(skin.balls[k].weight);
        balls.push_back({frame.toView(skin.balls[k].center), reach, peak, std::sqrt(peak) / reach, particle.color,
                         skin.open.empty() ? kOpen : skin.open[k]});
    }
    return balls;
}

void castPicture(const CameraFrame& frame, const Skinned& skin, const FieldSampling& sampling, FieldPicture& picture) {
    const BinnedField field = binField(frame, skin);
    FieldCast cast = castOf(frame, skin.view, field);
    cast.openness = !skin.open.empty();
    const std::size_t tileCount = field.tiles.begin.size() - 1;
    picture.slots.assign(tileCount, -1);
    std::int32_t slotCount = 0;
    for (std::size_t tile = 0; tile < tileCount; ++tile) {
        if (field.tiles.begin[tile + 1] > field.tiles.begin[tile]) picture.slots[tile] = slotCount++;
    }
    picture.samples.resize(static_cast<std::size_t>(slotCount) * kBlockRays);
    picture.open.resize(cast.openness ? picture.samples.size() : 0);
    if (sampling.sparse) {
        castSparsely(cast, sampling.offset, smoothnessOf(cast, field, skin.view.field.reach), picture);
    } else {
        tbb::parallel_for(std::size_t{0}, tileCount, [&](std::size_t tile) {
            if (picture.slots[tile] < 0) return;
            RayBlock block;
            placeRays(block, cornerOf(field.tiles, tile), kZCurve, sampling.offset);
            castBlock(cast, tile, block);
            putSamples(cast, block, kZCurve, tile, picture);
        });
    }
    if (sampling.extraAtOutlines) addExtras(cast, field.smallestRadius, picture);
    forgetEmptyTiles(picture);
}

DepthMap castDepthMap(const LightBasis& basis, const Skinned& skin, const DepthMapSampling& sampling) {
    const View& view = skin.view;
    DepthMap map;
    std::vector<ViewSphere> reaches;
    float smallest = std::numeric_limits<float>::max();
    double sum = 0.0;
    for (std::size_t k = 0; k < skin.balls.size(); ++k) {
        const float radius = view.particles[k].radius;
        if (radius <= 0.0F) continue;
        reaches.push_back({skin.balls[k].center - view.camera.eye, view.field.reach * radius});
        smallest = std::min(smallest, radius);
        sum += double(radius);
    }
    map.heights.assign(1, kNoHeight);
    if (reaches.empty()) return map;
    const LightBounds bounds = lightBounds(basis, reaches);
    // A soft edge is three texels of half the softness wide.
    const auto mean = static_cast<float>(sum / static_cast<double>(reaches.size()));
    const float soft = view.light.softness;
    map = emptyMap(bounds, basis.toLightSpace(view.camera.eye),
                   soft > 0.0F ? 0.5F * soft * mean : smallest / kTexelsPerRadius, sampling.mostTexels);
    map.origin += sampling.shift * map.texelSize;
    CameraFrame frame = lightFrame(basis, map, bounds.high.z);
    frame.eye += view.camera.eye;

    const BinnedField field = binField(frame, skin);
    FieldCast cast = castOf(frame, view, field);
    cast.depthOnly = true;
    tbb::parallel_for(std::size_t{0}, field.tiles.begin.size() - 1, [&](std::size_t tile) {
        if (field.tiles.begin[tile + 1] == field.tiles.begin[tile]) return;
        RayBlock block;
        placeRays(block, cornerOf(field.tiles, tile), kZCurve, glm::vec2(0.0F));
        castBlock(cast, tile, block);
        for (std::size_t k = 0; k < kBlockRays; ++k) {
            const int x = static_cast<int>(block.x[k]);
            const int y = static_cast<int>(block.y[k]);
            if (x >= map.columns || y >= map.rows || block.depth[k] < 0.0F) continue;
            const auto place =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(map.columns) + static_cast<std::size_t>(x);
            map.heights[place] = bounds.high.z - block.depth[k];
        }
    });
    return map;
}

}  // namespace render
