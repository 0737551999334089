// Each pass draws a point for each tile that balls reach; what no ball reaches keeps what the target was cleared to.
#include "render/opengl/metaball_passes.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace render {

namespace {

constexpr float kNoSurface = 1.0F;  // depth of the map where there is none

// Pixels of a target along a side of a tile: a fragment stands for 4 x 4 pixels of the picture, of which two by two are
// cast, for 2 x 2 pixels of the picture, or for 2 x 2 pixels of the light's picture.
constexpr int kCoarseTile = kTileSize / 4;
constexpr int kCellTile = kTileSize / 2;
constexpr int kLightTile = kTileSize / 2;

Defines withPointSize(Defines defines, int pixels) {
    defines.push_back(fmt::format("POINT_SIZE {}", pixels));
    return defines;
}

}  // namespace

bool hasOneReach(const MetaballScene& scene) {
    return scene.ellipsoids.empty() &&
           std::ranges::all_of(scene.balls, [&](const Metaball& ball) { return ball.reach == scene.balls[0].reach; });
}

BallBuffers::BallBuffers(const Gl& gl)
    : balls_(gl, GL_RGBA32F),
      attributes_(gl, GL_RGBA32UI),
      begins_(gl, GL_R32I),
      items_(gl, GL_R32I),
      tiles_(gl, GL_R32I) {}

void BallBuffers::upload(const MetaballScene& scene) {
    const bool areEllipsoids = !scene.ellipsoids.empty();
    const std::size_t texels = areEllipsoids ? 3 : hasOneReach(scene) ? 1 : 2;
    std::vector<glm::vec4> balls(texels * scene.balls.size());
    tbb::parallel_for(std::size_t{0}, scene.balls.size(), [&](std::size_t k) {
        const Metaball& ball = scene.balls[k];
        balls[texels * k] = glm::vec4(ball.center, ball.peak);
        if (texels == 2) balls[2 * k + 1] = {ball.reach, ball.slope * ball.slope, 0.0F, 0.0F};
        if (!areEllipsoids) return;
        const SymmetricMatrix<float>& form = scene.ellipsoids[k].form;
        balls[3 * k + 1] = {form.xx, form.yy, form.zz, ball.reach};
        balls[3 * k + 2] = {form.xy, form.xz, form.yz, 0.0F};
    });
    std::vector<SphereAttributes> attributes(scene.attributes.size());
    tbb::parallel_for(std::size_t{0}, attributes.size(), [&](std::size_t k) {
        attributes[k] = particleAttributes(scene.attributes[k].color, scene.attributes[k].sky);
    });
    tileIndices_.clear();
    for (std::size_t tile = 0; tile < scene.tiles.cellCount(); ++tile)
        if (!scene.tiles.itemsOf(tile).empty()) tileIndices_.push_back(static_cast<std::int32_t>(tile));
    uploadList(balls_, balls, "the metaballs");
    uploadList(attributes_, attributes, "the metaballs' colors");
    uploadList(begins_, scene.tiles.begin, "the tiles");
    uploadList(items_, scene.tiles.items, "the tiles' lists of metaballs");
    uploadList(tiles_, tileIndices_, "the tiles");
}

void BallBuffers::addBindings(std::vector<TextureBinding>& to) const {
    to.push_back({"balls", GL_TEXTURE_BUFFER, balls_.texture()});
    to.push_back({"ballAttributes", GL_TEXTURE_BUFFER, attributes_.texture()});
    to.push_back({"ballBegins", GL_TEXTURE_BUFFER, begins_.texture()});
    to.push_back({"ballItems", GL_TEXTURE_BUFFER, items_.texture()});
}

// Shaders read one coarse ray beyond the last column and the last row of the picture.
MetaballPasses::MetaballPasses(const Gl& gl, ShaderPrograms& programs, PictureSize size)
    : gl_(gl),
      programs_(programs),
      camera_(gl),
      light_(gl),
      coarse_(gl, {size.width / 4 + 1, size.height / 4 + 1}, false),
      pixels_(gl, {size.width / 2, size.height / 2}, true),
      markedCells_(gl),
      pixelsOfCells_(gl, GL_R32I) {}

void MetaballPasses::upload(const PreparedView& view) {
    camera_.upload(view.metaballs);
}

void MetaballPasses::cast(const PreparedView& view, const Defines& defines, glm::vec2 offset, bool castsAll) {
    if (!view.depthMap.empty()) castDepthMap(view, defines, offset);
    if (castsAll) {
        castAllPixels(view, defines);
        return;
    }
    castCoarseRays(view, defines);
    findPixelHits(view, defines);
}

void MetaballPasses::castDepthMap(const PreparedView& view, const Defines& defines, glm::vec2 offset) {
    const DepthMapGrid grid = view.depthMap.shifted(offset);
    const CameraFrame frame = lightFrame(view.light, grid, view.frame.eye, view.settings.depthMapRaysPerTexel);
    if (offset == glm::vec2(0.0F))
        light_.upload(view.lightMetaballs);
    else
        light_.upload(metaballScene(frame, *view.view, view.skin));
    const PictureSize tiles{tilesAlong(frame.width), tilesAlong(frame.height)};
    const PictureSize texels{tiles.width * kLightTile, tiles.height * kLightTile};
    if (!depths_ || depths_->size() != texels) depths_.emplace(gl_, texels, std::initializer_list<GLenum>{GL_RGBA32F});
    depths_->bind();
    const std::array<float, 4> nothing{kNoSurface, kNoSurface, kNoSurface, kNoSurface};
    gl_.ClearBufferfv(GL_COLOR, 0, nothing.data());

    Defines parallel = withPointSize(defines, kLightTile);
    std::erase(parallel, "PERSPECTIVE");
    std::vector<TextureBinding> textures{light_.tiles()};
    light_.addBindings(textures);
    const ShaderProgram& program = programs_.get("tile.vert", "depth_map.frag", parallel);
    program.use(textures);
    program.set("tilesInTarget", static_cast<float>(tiles.width), static_cast<float>(tiles.height));
    program.set("lightImage", {2.0F / static_cast<float>(frame.width), 2.0F / static_cast<float>(frame.height),
                               frame.halfWidth, frame.halfHeight});
    gl_.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(light_.tileIndices().size()));
    spreadDepths({2 * grid.columns, 2 * grid.rows});
}

/// Makes the depth texture of the depths. @param size  of the texture
void MetaballPasses::spreadDepths(PictureSize size) {
    if (!map_ || map_->size() != size) {
        map_.emplace(gl_, size, std::initializer_list<GLenum>{GL_DEPTH_COMPONENT32F});
        compareDepths(gl_, map_->texture(0));
    }
    map_->bind();
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_ALWAYS);
    gl_.DepthMask(GL_TRUE);
    const std::array spread{TextureBinding{"depths", GL_TEXTURE_2D, depths_->texture(0)}};
    programs_.get("whole.vert", "depth_texels.frag", {}).use(spread);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.Disable(GL_DEPTH_TEST);
}

/// Draws the tiles that balls reach to the target that is bound.
/// @param shader  name of the fragment shader
void MetaballPasses::drawBallTiles(const PreparedView& view, const char* shader, const Defines& defines) const {
    const CellLists& tiles = view.metaballs.tiles;
    std::vector<TextureBinding> textures{camera_.tiles(),
                                         {"coarseRays", GL_TEXTURE_2D_ARRAY, coarse_.texture()},
                                         {"pixelsOfCells", GL_TEXTURE_BUFFER, pixelsOfCells_.texture()}};
    if (markedHits_) textures.push_back({"markedHits", GL_TEXTURE_2D_ARRAY, markedHits_->texture()});
    camera_.addBindings(textures);
    const ShaderProgram& program = programs_.get("tile.vert", shader, defines);
    program.use(textures);
    program.set("tilesInTarget", static_cast<float>(tiles.columns), static_cast<float>(tiles.rows));
    program.set("markedGrid", markedCells_.grid());
    gl_.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(camera_.tileIndices().size()));
}

void MetaballPasses::castCoarseRays(const PreparedView& view, const Defines& defines) const {
    const CellLists& tiles = view.metaballs.tiles;
    coarse_.bind({tiles.columns * kCoarseTile, tiles.rows * kCoarseTile});
    coarse_.clear();
    drawBallTiles(view, "coarse.frag", withPointSize(defines, kCoarseTile));
}

void MetaballPasses::castAllPixels(const PreparedView& view, const Defines& defines) const {
    const CellLists& tiles = view.metaballs.tiles;
    pixels_.bind({tiles.columns * kCellTile, tiles.rows * kCellTile});
    pixels_.clear();
    Defines cells = withPointSize(defines, kCellTile);
    cells.emplace_back("CASTS_ALL");
    drawBallTiles(view, "cast_cells.frag", cells);
}

void MetaballPasses::findPixelHits(const PreparedView& view, const Defines& defines) {
    const CellLists& tiles = view.metaballs.tiles;
    const PictureSize size{tiles.columns * kCellTile, tiles.rows * kCellTile};
    pixels_.bind(size);
    pixels_.clear();
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_ALWAYS);
    gl_.DepthMask(GL_TRUE);
    drawBallTiles(view, "interpolate.frag", withPointSize(defines, kCellTile));
    gl_.Disable(GL_DEPTH_TEST);
    std::vector<float> marks(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    gl_.ReadPixels(0, 0, size.width, size.height, GL_DEPTH_COMPONENT, GL_FLOAT, marks.data());
    markedCells_.list([&](std::size_t cell) { return marks[cell] > 0.0F; }, size, kCellTile, camera_.tileIndices());
    if (markedCells_.empty()) return;
    castMarkedCells(defines);
    returnMarkedCells(view, defines);
}

/// Casts rays for the marked cells, side by side in a target of their own.
void MetaballPasses::castMarkedCells(const Defines& defines) {
    const PictureSize size = markedCells_.size();
    if (!markedHits_ || markedHits_->size().height < size.height) markedHits_.emplace(gl_, size, false);
    markedHits_->bind(size);
    Defines marked = defines;
    marked.emplace_back("MARKED");
    std::vector<TextureBinding> textures{markedCells_.binding(),
                                         {"coarseRays", GL_TEXTURE_2D_ARRAY, coarse_.texture()}};
    camera_.addBindings(textures);
    const ShaderProgram& program = programs_.get("marked.vert", "cast_cells.frag", marked);
    program.use(textures);
    program.set("markedGrid", markedCells_.grid());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

/// Copies what was found for the marked cells to where they lie.
void MetaballPasses::returnMarkedCells(const PreparedView& view, const Defines& defines) {
    const CellLists& tiles = view.metaballs.tiles;
    const PictureSize size{tiles.columns * kCellTile, tiles.rows * kCellTile};
    std::vector<std::int32_t> pixels(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    const std::span<const std::int32_t> places = markedCells_.placesOfPixels();
    for (std::size_t k = 0; k < places.size(); ++k)
        pixels[static_cast<std::size_t>(places[k])] = static_cast<std::int32_t>(k);
    uploadList(pixelsOfCells_, pixels, "the marked pixels");
    pixels_.bind(size);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    gl_.DepthMask(GL_FALSE);
    drawBallTiles(view, "return_cells.frag", withPointSize(defines, kCellTile));
    gl_.Disable(GL_DEPTH_TEST);
}

void MetaballPasses::addBindings(std::vector<TextureBinding>& to) const {
    camera_.addBindings(to);
    to.push_back({"pixelHits", GL_TEXTURE_2D_ARRAY, pixels_.texture()});
    if (map_) to.push_back({"depthMap", GL_TEXTURE_2D, map_->texture(0)});
}

}  // namespace render
