// Lists go up as they are prepared, in few buffers, because a shader has few samplers; what the CPU keeps component by
// component is interleaved to four numbers a texel.
#include "render/opengl/view_buffers.h"

#include <algorithm>

#include <tbb/parallel_for.h>
#include <glm/glm.hpp>

namespace render {

namespace {

TileClass classOf(const PreparedView& view, std::span<const char> meshTiles, std::size_t tile) {
    if (!meshTiles.empty() && meshTiles[tile] != 0) return TileClass::flats;
    if (!view.boxTiles.itemsOf(tile).empty() || !view.lines.tiles.itemsOf(tile).empty()) return TileClass::flats;
    const bool hasBalls =
        !view.sphereTiles.itemsOf(tile).empty() || (view.hasMetaballs && !view.metaballs.tiles.itemsOf(tile).empty());
    if (hasBalls) return TileClass::objects;
    switch (view.groundTiles[tile]) {
        case TileKind::background:
            return TileClass::background;
        case TileKind::openGround:
            return TileClass::openGround;
        case TileKind::occludedGround:
            return TileClass::occludedGround;
        case TileKind::mixed:
            return TileClass::objects;
    }
    return TileClass::objects;
}

}  // namespace

bool occludesObstacles(const PreparedView& view) {
    return view.hasOcclusion() &&
           (!view.view->boxObstacles.empty() || !view.view->sphereObstacles.empty() || !view.meshes.empty());
}

ViewBuffers::ViewBuffers(const Gl& gl)
    : lists_(gl, GL_R32I),
      listedTexels_(gl, GL_RGBA32F),
      sphereAttributes_(gl, GL_RGBA32UI),
      groundSky_(gl, GL_R32F),
      skyGrid_(gl, GL_R32F),
      glowGrid_(gl, GL_RGBA32F),
      tiles_{TextureBuffer(gl, GL_R32I), TextureBuffer(gl, GL_R32I), TextureBuffer(gl, GL_R32I),
             TextureBuffer(gl, GL_R32I), TextureBuffer(gl, GL_R32I)} {}

void ViewBuffers::upload(const PreparedView& view, std::span<const char> meshTiles) {
    numbers_.assign(kViewListCount, 0);
    texels_.clear();
    addSpheres(view);
    addCasters(view);
    addBoxes(view);
    addLines(view);
    uploadList(lists_, numbers_, "the lists of what tiles show");
    uploadList(listedTexels_, texels_, "the lists of what tiles show");
    uploadList(sphereAttributes_, view.sphereAttributes, "the spheres' colors");
    uploadTiles(view, meshTiles);
    uploadSky(view);
}

void ViewBuffers::add(ViewList list, std::span<const std::uint32_t> numbers) {
    numbers_[static_cast<std::size_t>(list)] = static_cast<std::int32_t>(numbers_.size());
    numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
}

std::span<glm::vec4> ViewBuffers::addTexels(ViewList list, std::size_t count) {
    const std::size_t place = texels_.size();
    numbers_[static_cast<std::size_t>(list)] = static_cast<std::int32_t>(place);
    texels_.resize(place + count);
    return std::span(texels_).subspan(place);
}

void ViewBuffers::addSpheres(const PreparedView& view) {
    const std::vector<ViewSphere>& spheres = view.viewSpheres;
    const std::vector<std::uint32_t>& items = view.sphereTiles.items;
    add(ViewList::sphereBegins, view.sphereTiles.begin);
    add(ViewList::sphereItems, items);
    const auto texelOf = [&](std::size_t k) { return glm::vec4(spheres[k].center, spheres[k].radius); };
    const std::span<glm::vec4> each = addTexels(ViewList::spheres, spheres.size());
    tbb::parallel_for(std::size_t{0}, each.size(), [&](std::size_t k) { each[k] = texelOf(k); });
    // Shaders read a sphere of a list at once, without its index.
    const std::span<glm::vec4> listed = addTexels(ViewList::tileSpheres, items.size());
    tbb::parallel_for(std::size_t{0}, listed.size(), [&](std::size_t k) { listed[k] = texelOf(items[k]); });
}

void ViewBuffers::uploadTiles(const PreparedView& view, std::span<const char> meshTiles) {
    for (std::vector<std::int32_t>& tiles : tileIndices_) tiles.clear();
    for (std::size_t tile = 0; tile < view.sphereTiles.cellCount(); ++tile)
        tileIndices_[static_cast<std::size_t>(classOf(view, meshTiles, tile))].push_back(
            static_cast<std::int32_t>(tile));
    for (std::size_t kind = 0; kind < kTileClassCount; ++kind)
        uploadList(tiles_[kind], tileIndices_[kind], "the tiles");
}

void ViewBuffers::addCasters(const PreparedView& view) {
    add(ViewList::casterBegins, view.lightGrid.begin);
    const LightSpheres& from = view.lightGrid.spheres;
    const std::span<glm::vec4> casters = addTexels(ViewList::casters, from.u.size());
    tbb::parallel_for(std::size_t{0}, casters.size(), [&](std::size_t k) {
        casters[k] = {from.u[k], from.v[k], from.height[k], from.radius[k]};
    });
}

void ViewBuffers::addBoxes(const PreparedView& view) {
    const std::vector<BoxObstacle>& obstacles = view.view->boxObstacles;
    const glm::vec3 eye = view.frame.eye;
    const std::span<glm::vec4> boxes = addTexels(ViewList::boxes, 3 * obstacles.size());
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
        boxes[3 * k] = glm::vec4(obstacles[k].minimum - eye, 0.0F);
        boxes[3 * k + 1] = glm::vec4(obstacles[k].maximum - eye, 0.0F);
        boxes[3 * k + 2] = glm::vec4(obstacles[k].color, 0.0F);
    }
    // Shaders read a box of a list at once, and its index with it: floats have all integers up to 2^24.
    const std::vector<std::uint32_t>& items = view.boxTiles.items;
    add(ViewList::boxBegins, view.boxTiles.begin);
    const std::span<glm::vec4> listed = addTexels(ViewList::tileBoxes, 2 * items.size());
    for (std::size_t k = 0; k < items.size(); ++k) {
        const BoxObstacle& box = obstacles[items[k]];
        listed[2 * k] = glm::vec4(box.minimum - eye, static_cast<float>(items[k]));
        listed[2 * k + 1] = glm::vec4(box.maximum - eye, view.boxFronts[items[k]]);
    }
    const std::vector<std::uint32_t>& lit = view.lightBoxes.boxes.index;
    add(ViewList::boxCasterBegins, view.lightBoxes.begin);
    const std::span<glm::vec4> casters = addTexels(ViewList::boxCasters, 2 * lit.size());
    for (std::size_t k = 0; k < lit.size(); ++k) {
        const BoxObstacle& box = view.shadowBoxes.boxes[lit[k]];
        casters[2 * k] = glm::vec4(box.minimum - eye, view.lightBoxes.boxes.top[k]);
        casters[2 * k + 1] = glm::vec4(box.maximum - eye, lit[k] < view.shadowBoxes.subtractedCount ? -1.0F : 1.0F);
    }
}

void ViewBuffers::addLines(const PreparedView& view) {
    add(ViewList::lineBegins, view.lines.tiles.begin);
    add(ViewList::lineItems, view.lines.tiles.items);
    const std::vector<ScreenLine>& lines = view.lines.lines;
    const std::span<glm::vec4> texels = addTexels(ViewList::lines, 3 * lines.size());
    for (std::size_t k = 0; k < lines.size(); ++k) {
        texels[3 * k] = glm::vec4(lines[k].from, lines[k].to);
        texels[3 * k + 1] = {lines[k].fromDepth, lines[k].toDepth, lines[k].width, 0.0F};
        texels[3 * k + 2] = glm::vec4(lines[k].color, 0.0F);
    }
}

void ViewBuffers::uploadSky(const PreparedView& view) {
    uploadList(groundSky_, view.hasOcclusion() ? view.groundSky.values : std::vector<float>{}, "the ground's sky");
    std::vector<float> values;
    if (occludesObstacles(view))
        for (const std::vector<float>& side : view.skyGrid.values)
            values.insert(values.end(), side.begin(), side.end());
    uploadList(skyGrid_, values, "the grid of the sky visibility");
    uploadList(glowGrid_, view.glowGrid.values, "the grid of the particles' light");
}

std::vector<TextureBinding> ViewBuffers::bindings() const {
    const auto of = [](const char* name, const TextureBuffer& buffer) {
        return TextureBinding{name, GL_TEXTURE_BUFFER, buffer.texture()};
    };
    return {of("lists", lists_),         of("listedTexels", listedTexels_), of("sphereAttributes", sphereAttributes_),
            of("groundSky", groundSky_), of("skyGrid", skyGrid_),           of("glowGrid", glowGrid_)};
}

}  // namespace render
