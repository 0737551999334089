// Tile by tile: rays, what they see, and which pixels show more than one thing.
#include "render/picture_samples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include <tbb/parallel_for.h>

#include "render/line_cover.h"
#include "render/ray_places.h"
#include "render/tile_class.h"

namespace render {

namespace {

constexpr std::size_t kMostFragments = 4;

// Light and sky reach a fragment, which no sample shows yet.
constexpr auto kAllReaches = static_cast<std::int32_t>(0xfffffff0U);

// Without branches, so that compilers turn loops over it into lanes.
int kindOf(std::int32_t seen) {
    const int field = seen >= kSeesField ? kFieldBit : 0;
    const int box = seen >= kSeesBox && field == 0 ? kBoxBit : 0;
    const int sphere = seen >= 0 && seen < kSeesBox ? kSphereBit : 0;
    const int ground = seen == kSeesGround ? kGroundBit : 0;
    const int background = seen == kSeesBackground ? kBackgroundBit : 0;
    return field | box | sphere | ground | background;
}

/// A ray through each pixel of a tile, row by row; first: the place of the first.
void placeRays(glm::vec2 first, std::array<float, kTilePixels>& x, std::array<float, kTilePixels>& y) {
    for (std::size_t row = 0; row < kTileSize; ++row) {
        for (std::size_t column = 0; column < kTileSize; ++column) {
            x[row * kTileSize + column] = first.x + static_cast<float>(static_cast<int>(column));
            y[row * kTileSize + column] = first.y + static_cast<float>(static_cast<int>(row));
        }
    }
}

bool hasItems(const CellLists& lists, std::size_t tile) {
    return lists.begin[tile + 1] > lists.begin[tile];
}

/// The samples of one tile.
class TileSamples {
 public:
    TileSamples(const TileContents& contents, SampleOffsets offsets, std::size_t tile)
        : contents_(contents), tile_(tile), samples_(rays_.data(), offsets.size()) {
        const glm::vec2 corner = cornerOf(*contents.solids.tiles, tile);
        for (std::size_t s = 0; s < offsets.size(); ++s)
            placeRays(corner + 0.5F + offsets[s], samples_[s].x, samples_[s].y);
    }

    void look() {
        if (fieldFills()) {
            samples_ = samples_.first(1);
            samples_[0].depth.fill(kFarDepth);
            lookAtField();
            return;
        }
        if (isSpheresOnGround()) {
            lookAtSpheresOnGround(contents_.solids, tile_, samples_);
            return;
        }
        const Flats flats{contents_.ground[tile_].kind != GroundKind::none, contents_.boxes[tile_] != 0};
        for (TileRays& rays : samples_) lookAtFlats(contents_.solids, flats, rays);
        if (hasField()) lookAtField();
        if (hasItems(*contents_.solids.tiles, tile_)) lookAtSpheres(contents_.solids, tile_, samples_);
    }

    /// Finds the pixels that show several things; returns the class of the others.
    int resolve(TileEdges& edges) const {
        const std::array<std::int32_t, kTilePixels>& first = samples_[0].seen;
        std::array<std::int32_t, kTilePixels> differs{};
        for (std::size_t s = 1; s < samples_.size(); ++s)
            for (std::size_t k = 0; k < kTilePixels; ++k) differs[k] |= samples_[s].seen[k] ^ first[k];
        int bits = 0;
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            const int agreed = differs[k] == 0 ? -1 : 0;
            bits |= kindOf(first[k]) & agreed;
        }
        std::array<bool, kTilePixels> several;
        for (std::size_t k = 0; k < kTilePixels; ++k) several[k] = differs[k] != 0;
        const glm::ivec2 corner(cornerOf(*contents_.solids.tiles, tile_));
        for (const std::uint8_t k : placesWhere(several)) {
            const glm::ivec2 at = corner + glm::ivec2(k % kTileSize, k / kTileSize);
            if (at.x < contents_.solids.frame.width && at.y < contents_.solids.frame.height)
                addEdge(k, at.x + 65536 * at.y, edges);
        }
        return bits;
    }

    /// What pixels that show one thing show.
    std::span<const std::int32_t> seen() const { return samples_[0].seen; }

    std::span<const TileRays> rays() const { return samples_; }

 private:
    bool hasField() const { return contents_.field != nullptr && contents_.field->slots[tile_] >= 0; }
    std::size_t fieldSlot() const { return static_cast<std::size_t>(contents_.field->slots[tile_]); }

    /// One sample a pixel.
    std::span<const FieldSample> fieldSamples() const {
        return std::span(contents_.field->samples).subspan(fieldSlot() * kBlockRays, kTilePixels);
    }

    /// Whether the tile shows nothing but metaballs, without an outline: one sample is as good as four.
    bool fieldFills() const {
        if (!hasField() || contents_.field->outlines[fieldSlot()].pixels.size() > 0) return false;
        if (hasItems(*contents_.solids.tiles, tile_) || contents_.boxes[tile_] != 0) return false;
        float nearest = kFarDepth;
        float farthest = 0.0F;
        for (const FieldSample& sample : fieldSamples()) {
            const float depth = std::bit_cast<float>(sample.depthBits);
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
        }
        return nearest > 0.0F && farthest < contents_.ground[tile_].nearest;
    }

    /// Whether the ground fills the tile behind spheres and nothing else, and no line asks for its depth.
    bool isSpheresOnGround() const {
        const GroundKind ground = contents_.ground[tile_].kind;
        if (ground != GroundKind::plain && ground != GroundKind::dimmed) return false;
        if (contents_.boxes[tile_] != 0 || hasItems(contents_.lines.tiles, tile_)) return false;
        return !hasField();
    }

    void lookAtField() {
        const FieldPicture& field = *contents_.field;
        const Outlines& outlines = field.outlines[fieldSlot()];
        const auto first = kSeesField + static_cast<std::int32_t>(fieldSlot() * kBlockRays);
        std::array<float, kTilePixels> depth;
        const std::span<const FieldSample> own = fieldSamples();
        for (std::size_t k = 0; k < kTilePixels; ++k) depth[k] = std::bit_cast<float>(own[k].depthBits);
        if (samples_.size() > 1)
            for (const std::uint8_t pixel : outlines.pixels) depth[pixel] = 0.0F;
        for (TileRays& rays : samples_)
            for (std::size_t k = 0; k < kTilePixels; ++k)
                seeField(rays, k, depth[k], first + static_cast<std::int32_t>(k));
        if (samples_.size() == 1) return;
        std::size_t place = outlines.first;
        for (const std::uint8_t pixel : outlines.pixels)
            for (TileRays& rays : samples_) {
                const float extra = std::bit_cast<float>(field.samples[place].depthBits);
                seeField(rays, pixel, extra, kSeesField + static_cast<std::int32_t>(place++));
            }
    }

    /// Without branches, so that compilers turn loops over it into lanes. depth: 0 where there is no surface.
    static void seeField(TileRays& rays, std::size_t k, float depth, std::int32_t seen) {
        const bool isNearest = (depth > 0.0F) & (depth < rays.depth[k]);
        rays.depth[k] = isNearest ? depth : rays.depth[k];
        rays.seen[k] = isNearest ? seen : rays.seen[k];
    }

    void addEdge(std::size_t k, std::int32_t place, TileEdges& edges) const {
        std::array<std::int32_t, kMostFragments> seen;
        for (std::size_t s = 0; s < seen.size(); ++s) seen[s] = rays_[s].seen[k];
        EdgePixel pixel;
        pixel.place = place;
        pixel.first = static_cast<std::int32_t>(edges.fragments.size());
        // Which samples show the same cannot be foretold, and is found without branches.
        for (unsigned left = (1U << kMostFragments) - 1U; left != 0; ++pixel.count) {
            const std::int32_t what = seen[static_cast<std::size_t>(std::countr_zero(left))];
            unsigned shows = 0;  // a bit for each sample
            for (std::size_t s = 0; s < seen.size(); ++s) shows |= unsigned{seen[s] == what} << s;
            edges.fragments.push_back({what, kAllReaches | static_cast<std::int32_t>(shows)});
            edges.classBits |= kindOf(what);
            left &= ~shows;
        }
        edges.pixels.push_back(pixel);
    }

    const TileContents& contents_;
    std::size_t tile_;
    std::array<TileRays, 4> rays_;
    std::span<TileRays> samples_;
};

/// What a tile shows that no ray need be cast for: background, or ground; 0 for any other.
int uniformClass(const TileContents& contents, std::size_t tile) {
    if (hasItems(*contents.solids.tiles, tile) || contents.boxes[tile] != 0) return 0;
    if (contents.field != nullptr && contents.field->slots[tile] >= 0) return 0;
    const GroundKind ground = contents.ground[tile].kind;
    if (ground == GroundKind::horizon) return 0;
    return ground == GroundKind::none ? kBackgroundBit : kGroundBit;
}

bool isDimmed(int bits, GroundKind ground) {
    if ((bits & (kSphereBit | kFieldBit | kBoxBit)) != 0) return true;
    return (bits & kGroundBit) != 0 && (ground == GroundKind::dimmed || ground == GroundKind::horizon);
}

/// Writes what a tile's pixels show. where: of the sample within the pixel, from its corner.
void putPixels(const TileContents& contents, std::size_t tile, std::span<const std::int32_t> seen, glm::vec2 where,
               bool isDimmed, std::span<Fragment> pixels) {
    const std::span<Fragment> own = pixels.subspan(tile * kTilePixels, kTilePixels);
    if (!isDimmed || contents.obstruction == nullptr) {
        for (std::size_t k = 0; k < kTilePixels; ++k) own[k] = {seen[k], kAllReaches};
        return;
    }
    SurfacePoints points;
    points.count = kTilePixels;
    // Along the Z curve: between the light and a compact group of pixels there are fewer spheres than between it and a
    // row.
    const glm::vec2 first = cornerOf(*contents.solids.tiles, tile) + where;
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        const std::uint8_t place = kZCurve[k];
        points.seen[k] = seen[place];
        points.x[k] = first.x + static_cast<float>(place % kTileSize);
        points.y[k] = first.y + static_cast<float>(place / kTileSize);
    }
    placePoints(contents.surfaces, points);
    LightReach found;
    reach(*contents.obstruction, contents.surfaces, points, found);
    for (std::size_t k = 0; k < kTilePixels; ++k) own[kZCurve[k]] = {points.seen[k], found.shares[k]};
}

/// Of the samples whose bits are set.
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

/// Adds what light and sky reach the fragments of these pixels.
void reachEdges(const TileContents& contents, std::span<const EdgePixel> pixels, std::span<Fragment> fragments) {
    static const std::array<glm::vec2, 16> kMiddles = middles();
    SurfacePoints points;
    LightReach found;
    std::size_t begun = 0;  // the first fragment of those in `points`
    const auto flush = [&] {
        placePoints(contents.surfaces, points);
        reach(*contents.obstruction, contents.surfaces, points, found);
        for (std::size_t k = 0; k < points.count; ++k) {
            std::int32_t& word = fragments[begun + k].reach;
            word = found.shares[k] | (word & 15);
        }
        begun += points.count;
        points.count = 0;
    };
    for (const EdgePixel& pixel : pixels) {
        const glm::vec2 middle = glm::vec2(pixel.place % 65536, pixel.place / 65536) + 0.5F;
        for (std::int32_t f = pixel.first; f < pixel.first + pixel.count; ++f) {
            const Fragment& fragment = fragments[static_cast<std::size_t>(f)];
            const glm::vec2 at = middle + kMiddles[static_cast<std::size_t>(fragment.reach & 15)];
            points.seen[points.count] = fragment.seen;
            points.x[points.count] = at.x;
            points.y[points.count] = at.y;
            if (++points.count == kTilePixels) flush();
        }
    }
    if (points.count > 0) flush();
}

/// Where edge pixels with one to four fragments are put, and where their fragments are.
struct EdgePlaces {
    std::array<std::int32_t, kMostFragments> pixels{};
    std::array<std::int32_t, kMostFragments> fragments{};
};

EdgePlaces countsOf(const TileEdges& edges) {
    EdgePlaces counts;
    for (const EdgePixel& pixel : edges.pixels) {
        const auto kind = static_cast<std::size_t>(pixel.count - 1);
        ++counts.pixels[kind];
        counts.fragments[kind] += pixel.count;
    }
    return counts;
}

/// Turns the counts of each tile into its places; returns the ends.
EdgePlaces addUp(std::span<EdgePlaces> tiles) {
    EdgePlaces next;
    for (std::size_t kind = 0; kind < kMostFragments; ++kind) {
        if (kind > 0) {
            next.pixels[kind] = next.pixels[kind - 1];
            next.fragments[kind] = next.fragments[kind - 1];
        }
        for (EdgePlaces& tile : tiles) {
            next.pixels[kind] += std::exchange(tile.pixels[kind], next.pixels[kind]);
            next.fragments[kind] += std::exchange(tile.fragments[kind], next.fragments[kind]);
        }
    }
    return next;
}

/// Puts a tile's edge pixels where they belong.
void putEdges(const TileEdges& edges, std::int32_t lineSlot, EdgePlaces at, PictureSamples& samples) {
    for (EdgePixel pixel : edges.pixels) {
        const auto kind = static_cast<std::size_t>(pixel.count - 1);
        const auto to = static_cast<std::size_t>(at.fragments[kind]);
        std::copy_n(edges.fragments.begin() + pixel.first, pixel.count,
                    samples.fragments.begin() + static_cast<std::ptrdiff_t>(to));
        pixel.first = std::exchange(at.fragments[kind], at.fragments[kind] + pixel.count);
        if (lineSlot >= 0)
            pixel.line = lineSlot * static_cast<std::int32_t>(kTilePixels) +
                         pixel.place / 65536 % kTileSize * kTileSize + pixel.place % kTileSize;
        samples.edges[static_cast<std::size_t>(at.pixels[kind]++)] = pixel;
    }
}

/// Puts the tiles' edge pixels side by side, those with few fragments first.
void joinEdges(PictureSamples& samples) {
    const std::vector<TileEdges>& tiles = samples.tileEdges;
    std::vector<EdgePlaces> places(tiles.size());
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t tile) { places[tile] = countsOf(tiles[tile]); });
    const EdgePlaces end = addUp(places);
    samples.edges.resize(static_cast<std::size_t>(end.pixels.back()));
    samples.fragments.resize(static_cast<std::size_t>(end.fragments.back()));
    samples.edgeClass = 0;
    for (const TileEdges& tile : tiles) samples.edgeClass |= static_cast<std::uint8_t>(tile.classBits);
    tbb::parallel_for(std::size_t{0}, tiles.size(),
                      [&](std::size_t tile) { putEdges(tiles[tile], samples.lineSlots[tile], places[tile], samples); });
}

/// Takes the samples of one tile; returns its class.
int takeTile(const TileContents& contents, SampleOffsets offsets, std::size_t tile, std::span<Fragment> pixels,
             PictureSamples& samples) {
    TileEdges& edges = samples.tileEdges[tile];
    edges.pixels.clear();
    edges.fragments.clear();
    edges.classBits = 0;
    const GroundKind ground = contents.ground[tile].kind;
    const std::int32_t lineSlot = samples.lineSlots[tile];
    const glm::vec2 where = 0.5F + (offsets.size() == 1 ? offsets[0] : glm::vec2(0.0F));
    int bits = uniformClass(contents, tile);
    if (bits != 0 && lineSlot < 0) {
        const bool dims = isDimmed(bits, ground);
        if (!dims && !contents.plainToo) return bits;
        std::array<std::int32_t, kTilePixels> seen;
        seen.fill(bits == kGroundBit ? kSeesGround : kSeesBackground);
        putPixels(contents, tile, seen, where, dims, pixels);
        return dims ? bits | kDimBit : bits;
    }
    TileSamples here(contents, offsets, tile);
    here.look();
    bits = here.resolve(edges);
    const bool dims = isDimmed(bits, ground);
    putPixels(contents, tile, here.seen(), where, dims, pixels);
    if (isDimmed(edges.classBits, ground)) {
        edges.classBits |= kDimBit;
        if (contents.obstruction != nullptr) reachEdges(contents, edges.pixels, edges.fragments);
    }
    if (lineSlot >= 0) {
        const LineCover over = lineCover(contents.solids, contents.lines, tile, here.rays(), where);
        std::copy(over.begin(), over.end(), samples.lines.begin() + lineSlot * std::ptrdiff_t{kTilePixels});
        bits |= kLineBit;
        if (edges.classBits != 0) edges.classBits |= kLineBit;
    }
    return dims ? bits | kDimBit : bits;
}

}  // namespace

void takeSamples(const TileContents& contents, SampleOffsets offsets, std::span<Fragment> pixels,
                 PictureSamples& samples) {
    const CellLists& tiles = *contents.solids.tiles;
    const std::size_t tileCount = tiles.begin.size() - 1;
    samples.classes.resize(tileCount);
    samples.lineSlots.assign(tileCount, -1);
    std::int32_t lineSlots = 0;
    for (std::size_t tile = 0; tile < tileCount; ++tile)
        if (hasItems(contents.lines.tiles, tile)) samples.lineSlots[tile] = lineSlots++;
    samples.lines.resize(static_cast<std::size_t>(lineSlots) * kTilePixels);
    samples.tileEdges.resize(tileCount);
    tbb::parallel_for(std::size_t{0}, tileCount, [&](std::size_t tile) {
        samples.classes[tile] = static_cast<std::uint8_t>(takeTile(contents, offsets, tile, pixels, samples));
    });
    joinEdges(samples);
}

}  // namespace render
