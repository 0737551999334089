// Tiles of rays for the picture and for the light's depth map, and the packing of what they hit.
#include "render/metaball_frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

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

// The rotated grid of shaders/picture.frag.
constexpr std::array<std::array<float, 2>, 4> kOffsets = {
    {{-0.125F, -0.375F}, {0.375F, -0.125F}, {-0.375F, 0.125F}, {0.125F, 0.375F}}};

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
    field.tiles = binToTiles(frame, reaches);
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

void placeRays(RayBlock& block, const CellLists& tiles, std::size_t tile, glm::vec2 offset) {
    const auto columns = static_cast<std::size_t>(tiles.columns);
    const auto left = static_cast<float>(tile % columns * kTileSize);
    const auto top = static_cast<float>(tile / columns * kTileSize);
    block.count = kBlockRays;
    for (std::size_t k = 0; k < kBlockRays; ++k) {
        block.x[k] = left + static_cast<float>(kZCurve[k] % kTileSize) + 0.5F + offset.x;
        block.y[k] = top + static_cast<float>(kZCurve[k] / kTileSize) + 0.5F + offset.y;
    }
}

// The samples at pixels, for looking at neighbours across tiles.
class Neighbours {
 public:
    Neighbours(const FieldPicture& picture, const CellLists& tiles) : picture_(picture), tiles_(tiles) {}

    float depthAt(int x, int y) const {
        if (x < 0 || y < 0 || x >= tiles_.columns * kTileSize || y >= tiles_.rows * kTileSize) return 0.0F;
        const std::int32_t slot = picture_.slots[tiles_.cellIndex(x / kTileSize, y / kTileSize)];
        if (slot < 0) return 0.0F;
        const auto place = static_cast<std::size_t>(slot) * kBlockRays +
                           static_cast<std::size_t>(y % kTileSize * kTileSize + x % kTileSize);
        return std::bit_cast<float>(picture_.samples[place].depthBits);
    }

    // Hit beside miss, or a jump in depth that a pixel's slope does not explain.
    bool outlineAt(int x, int y, float jump) const {
        const float depth = depthAt(x, y);
        for (const auto& [dx, dy] : {std::array{1, 0}, std::array{-1, 0}, std::array{0, 1}, std::array{0, -1}}) {
            const float other = depthAt(x + dx, y + dy);
            if ((other > 0.0F) != (depth > 0.0F) || std::abs(other - depth) > jump) return true;
        }
        return false;
    }

 private:
    const FieldPicture& picture_;
    const CellLists& tiles_;
};

// The extra samples of one tile, in the order of its pixels.
struct TileExtras {
    std::vector<std::uint8_t> pixels;
    std::vector<FieldSample> samples;  ///< four a pixel
    std::vector<std::uint32_t> open;
};

TileExtras castExtras(const FieldCast& cast, std::size_t tile, std::vector<std::uint8_t> pixels) {
    TileExtras extras;
    const auto columns = static_cast<std::size_t>(cast.tiles->columns);
    const auto left = static_cast<float>(tile % columns * kTileSize);
    const auto top = static_cast<float>(tile / columns * kTileSize);
    RayBlock block;
    const auto flush = [&] {
        castBlock(cast, tile, block);
        for (std::size_t k = 0; k < block.count; ++k) {
            extras.samples.push_back(packedSample(cast.frame, block, k));
            if (cast.openness) extras.open.push_back(packedOpenness(block, k));
        }
        block.count = 0;
    };
    for (const std::uint8_t pixel : pixels) {
        for (const auto& offset : kOffsets) {
            block.x[block.count] = left + static_cast<float>(pixel % kTileSize) + 0.5F + offset[0];
            block.y[block.count] = top + static_cast<float>(pixel / kTileSize) + 0.5F + offset[1];
            ++block.count;
        }
        if (block.count == kBlockRays) flush();
    }
    if (block.count > 0) flush();
    extras.pixels = std::move(pixels);
    return extras;
}

void addExtras(const FieldCast& cast, float jump, FieldPicture& picture) {
    const Neighbours neighbours(picture, *cast.tiles);
    std::vector<TileExtras> extras(picture.slots.size());
    tbb::parallel_for(std::size_t{0}, picture.slots.size(), [&](std::size_t tile) {
        if (picture.slots[tile] < 0) return;
        const int left = static_cast<int>(tile) % cast.tiles->columns * kTileSize;
        const int top = static_cast<int>(tile) / cast.tiles->columns * kTileSize;
        std::vector<std::uint8_t> pixels;
        for (const std::uint8_t place : kZCurve) {
            if (neighbours.outlineAt(left + place % kTileSize, top + place / kTileSize, jump)) pixels.push_back(place);
        }
        if (!pixels.empty()) extras[tile] = castExtras(cast, tile, std::move(pixels));
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

// What the picture shows of the surface, tile by tile.
void sumUpTiles(FieldPicture& picture) {
    constexpr float kNever = std::numeric_limits<float>::infinity();
    picture.farthest.assign(picture.slots.size(), kNever);
    tbb::parallel_for(std::size_t{0}, picture.slots.size(), [&](std::size_t tile) {
        if (picture.slots[tile] < 0) return;
        const FieldSample* samples = &picture.samples[static_cast<std::size_t>(picture.slots[tile]) * kBlockRays];
        bool isSeen = false;
        float farthest = 0.0F;
        for (std::size_t k = 0; k < kBlockRays; ++k) {
            const bool isWhole = samples[k].depthBits != 0 && samples[k].extra == 0;
            isSeen = isSeen || samples[k].depthBits != 0 || samples[k].extra != 0;
            farthest = std::max(farthest, isWhole ? std::bit_cast<float>(samples[k].depthBits) : kNever);
        }
        picture.farthest[tile] = farthest;
        if (!isSeen) picture.slots[tile] = -1;
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

FieldPicture castPicture(const CameraFrame& frame, const Skinned& skin, const FieldSampling& sampling) {
    const BinnedField field = binField(frame, skin);
    FieldCast cast = castOf(frame, skin.view, field);
    cast.openness = !skin.open.empty();
    FieldPicture picture;
    const std::size_t tileCount = field.tiles.begin.size() - 1;
    picture.slots.assign(tileCount, -1);
    std::int32_t slotCount = 0;
    for (std::size_t tile = 0; tile < tileCount; ++tile) {
        if (field.tiles.begin[tile + 1] > field.tiles.begin[tile]) picture.slots[tile] = slotCount++;
    }
    picture.samples.resize(static_cast<std::size_t>(slotCount) * kBlockRays);
    if (cast.openness) picture.open.resize(picture.samples.size());
    tbb::parallel_for(std::size_t{0}, tileCount, [&](std::size_t tile) {
        if (picture.slots[tile] < 0) return;
        RayBlock block;
        placeRays(block, field.tiles, tile, sampling.offset);
        castBlock(cast, tile, block);
        const std::size_t out = static_cast<std::size_t>(picture.slots[tile]) * kBlockRays;
        for (std::size_t k = 0; k < kBlockRays; ++k) {
            picture.samples[out + kZCurve[k]] = packedSample(frame, block, k);
            if (cast.openness) picture.open[out + kZCurve[k]] = packedOpenness(block, k);
        }
    });
    if (sampling.extraAtOutlines) addExtras(cast, 0.5F * field.smallestRadius, picture);
    sumUpTiles(picture);
    return picture;
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
        placeRays(block, field.tiles, tile, glm::vec2(0.0F));
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
