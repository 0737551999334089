// Lists go up as they are prepared; what the CPU keeps component by component is interleaved to four numbers a texel.
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
    : spheres_(gl, GL_RGBA32F),
      sphereAttributes_(gl, GL_RGBA32UI),
      sphereBegins_(gl, GL_R32I),
      sphereItems_(gl, GL_R32I),
      tileSpheres_(gl, GL_RGBA32F),
      boxes_(gl, GL_RGBA32F),
      boxBegins_(gl, GL_R32I),
      tileBoxes_(gl, GL_RGBA32F),
      lines_(gl, GL_RGBA32F),
      lineBegins_(gl, GL_R32I),
      lineItems_(gl, GL_R32I),
      casters_(gl, GL_RGBA32F),
      casterBegins_(gl, GL_R32I),
      boxCasters_(gl, GL_RGBA32F),
      boxCasterBegins_(gl, GL_R32I),
      groundSky_(gl, GL_R32F),
      skyGrid_(gl, GL_R32F),
      glowGrid_(gl, GL_RGBA32F),
      tiles_{TextureBuffer(gl, GL_R32I), TextureBuffer(gl, GL_R32I), TextureBuffer(gl, GL_R32I),
             TextureBuffer(gl, GL_R32I), TextureBuffer(gl, GL_R32I)} {}

void ViewBuffers::upload(const PreparedView& view, std::span<const char> meshTiles) {
    uploadList(spheres_, view.viewSpheres, "the spheres");
    uploadList(sphereAttributes_, view.sphereAttributes, "the spheres' colors");
    uploadList(sphereBegins_, view.sphereTiles.begin, "the tiles");
    uploadList(sphereItems_, view.sphereTiles.items, "the tiles' lists of spheres");
    // Shaders read a sphere of a list at once, without its index.
    std::vector<ViewSphere> spheres(view.sphereTiles.items.size());
    tbb::parallel_for(std::size_t{0}, spheres.size(),
                      [&](std::size_t k) { spheres[k] = view.viewSpheres[view.sphereTiles.items[k]]; });
    uploadList(tileSpheres_, spheres, "the tiles' lists of spheres");
    uploadTiles(view, meshTiles);
    uploadCasters(view);
    uploadBoxes(view);
    uploadLines(view);
    uploadSky(view);
}

void ViewBuffers::uploadTiles(const PreparedView& view, std::span<const char> meshTiles) {
    for (std::vector<std::int32_t>& tiles : tileIndices_) tiles.clear();
    for (std::size_t tile = 0; tile < view.sphereTiles.cellCount(); ++tile)
        tileIndices_[static_cast<std::size_t>(classOf(view, meshTiles, tile))].push_back(
            static_cast<std::int32_t>(tile));
    for (std::size_t kind = 0; kind < kTileClassCount; ++kind)
        uploadList(tiles_[kind], tileIndices_[kind], "the tiles");
}

void ViewBuffers::uploadCasters(const PreparedView& view) {
    uploadList(casterBegins_, view.lightGrid.begin, "the cells of the light's grid");
    const LightSpheres& from = view.lightGrid.spheres;
    std::vector<glm::vec4> casters(from.u.size());
    tbb::parallel_for(std::size_t{0}, casters.size(), [&](std::size_t k) {
        casters[k] = {from.u[k], from.v[k], from.height[k], from.radius[k]};
    });
    uploadList(casters_, casters, "the lists of spheres that cast shadows");
}

void ViewBuffers::uploadBoxes(const PreparedView& view) {
    const std::vector<BoxObstacle>& obstacles = view.view->boxObstacles;
    const glm::vec3 eye = view.frame.eye;
    std::vector<glm::vec4> boxes;
    for (const BoxObstacle& box : obstacles) {
        boxes.emplace_back(box.minimum - eye, 0.0F);
        boxes.emplace_back(box.maximum - eye, 0.0F);
        boxes.emplace_back(box.color, 0.0F);
    }
    uploadList(boxes_, boxes, "the boxes");
    // Shaders read a box of a list at once, and its index with it: floats have all integers up to 2^24.
    std::vector<glm::vec4> listed;
    listed.reserve(2 * view.boxTiles.items.size());
    for (const std::uint32_t index : view.boxTiles.items) {
        listed.emplace_back(obstacles[index].minimum - eye, static_cast<float>(index));
        listed.emplace_back(obstacles[index].maximum - eye, view.boxFronts[index]);
    }
    uploadList(boxBegins_, view.boxTiles.begin, "the tiles");
    uploadList(tileBoxes_, listed, "the tiles' lists of boxes");
    listed.clear();
    for (std::size_t k = 0; k < view.lightBoxes.boxes.index.size(); ++k) {
        const std::uint32_t index = view.lightBoxes.boxes.index[k];
        const BoxObstacle& box = view.shadowBoxes.boxes[index];
        listed.emplace_back(box.minimum - eye, view.lightBoxes.boxes.top[k]);
        listed.emplace_back(box.maximum - eye, index < view.shadowBoxes.subtractedCount ? -1.0F : 1.0F);
    }
    uploadList(boxCasterBegins_, view.lightBoxes.begin, "the cells of the light's grid of boxes");
    uploadList(boxCasters_, listed, "the lists of boxes that cast shadows");
}

void ViewBuffers::uploadLines(const PreparedView& view) {
    std::vector<glm::vec4> lines;
    for (const ScreenLine& line : view.lines.lines) {
        lines.emplace_back(line.from, line.to);
        lines.emplace_back(line.fromDepth, line.toDepth, line.width, 0.0F);
        lines.emplace_back(line.color, 0.0F);
    }
    uploadList(lines_, lines, "the lines");
    uploadList(lineBegins_, view.lines.tiles.begin, "the tiles");
    uploadList(lineItems_, view.lines.tiles.items, "the tiles' lists of lines");
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
    return {of("spheres", spheres_),
            of("sphereAttributes", sphereAttributes_),
            of("sphereBegins", sphereBegins_),
            of("sphereItems", sphereItems_),
            of("tileSpheres", tileSpheres_),
            of("boxes", boxes_),
            of("boxBegins", boxBegins_),
            of("tileBoxes", tileBoxes_),
            of("lines", lines_),
            of("lineBegins", lineBegins_),
            of("lineItems", lineItems_),
            of("casters", casters_),
            of("casterBegins", casterBegins_),
            of("boxCasters", boxCasters_),
            of("boxCasterBegins", boxCasterBegins_),
            of("groundSky", groundSky_),
            of("skyGrid", skyGrid_),
            of("glowGrid", glowGrid_)};
}

}  // namespace render
