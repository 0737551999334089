// Sky visibility, tiles and shadow casters are found side by side: none needs the others' results, and each has parts
// that keep only one thread busy.
#include "render/prepare/prepared_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_invoke.h>

#include "render/picture/parallel_loops.h"
#include "render/prepare/cells/mean_radius.h"
#include "render/prepare/cells/strays.h"
#include "render/prepare/ground_tiles.h"

namespace render {

namespace {

bool needsSkyVisibility(const View& view) {
    const Surface& surface = view.surface;
    return !view.particles.empty() && (view.ambient.occlusion > 0.0F || surface.reflection > 0.0F ||
                                       surface.translucency > 0.0F || surface.absorption > 0.0F);
}

void findSkyVisibility(PreparedView& to) {
    const View& view = *to.view;
    to.needsSkyVisibility = to.settings.isShaded && needsSkyVisibility(view);
    const bool isGlowing = to.settings.isShaded && view.surface.glow > 0.0F;
    const bool needsGrid = to.needsSkyVisibility || isGlowing;
    to.skyGrid = needsGrid ? skyVisibilityGrid(view.particles, std::move(to.skyGrid)) : SkyVisibilityGrid{};
    to.particleSky = needsGrid ? particleSkyVisibility(view.particles, to.skyGrid) : std::vector<SkyVisibility>{};
    to.glowGrid = isGlowing ? glowGrid(view.particles, view.surface.glow, to.particleSky, to.skyGrid.side) : GlowGrid{};
    to.groundSky = to.needsSkyVisibility && view.ground ? skyVisibilityAtHeight(to.skyGrid, view.ground->height)
                                                        : SkyVisibilityMap{};
}

bool hasTransparency(const PreparedView& prepared) {
    const View& view = *prepared.view;
    const auto isTransparent = [](const MeshObstacle& mesh) { return mesh.medium.isTransparent(); };
    return prepared.settings.isShaded && ((prepared.hasMetaballs && view.surface.medium.isTransparent()) ||
                                          std::ranges::any_of(view.meshObstacles, isTransparent));
}

/// Sorts everything for rays that go in any direction.
void prepareTransparency(PreparedView& to) {
    const View& view = *to.view;
    to.hasTransparency = hasTransparency(to);
    to.ballCells = to.hasTransparency && to.hasMetaballs ? ballCells(view, to.skin, to.frame.eye) : BallCells{};
    to.fieldCells = fieldCells(to.ballCells, surfaceThreshold(view.field));
    to.solids =
        to.hasTransparency ? solidTree(to.drawn.spheres, view.boxObstacles, to.meshes, to.frame.eye) : SolidTree{};
}

void binForCamera(PreparedView& to) {
    const View& view = *to.view;
    to.viewSpheres.resize(to.drawn.spheres.size());
    forAll(to.viewSpheres.size(), [&](std::size_t k) {
        to.viewSpheres[k] = {to.frame.toView(to.drawn.spheres[k].center + to.frame.eye), to.drawn.spheres[k].radius};
    });
    to.spherePixels = pixelBounds(to.frame, to.viewSpheres);
    to.sphereTiles = binToTiles(to.frame, to.viewSpheres, to.spherePixels);
    to.lines = projectEdges(to.frame, view.edges);
    if (to.hasMetaballs) to.metaballs = metaballScene(to.frame, view, to.skin);
}

void binForLight(PreparedView& to) {
    const View& view = *to.view;
    const bool castsShadows = to.settings.isShaded && view.light.shadows;
    to.lightGrid = castsShadows ? lightGrid(to.light, to.drawn.spheres, view.light.softness) : LightGrid{};
    to.shadowBoxes = castsShadows ? shadowBoxes(view.boxObstacles) : ShadowBoxes{};
    to.lightBoxes = lightBoxGrid(to.light, to.frame, to.shadowBoxes.boxes, view.light.softness * to.meanRadius);
    to.depthMap = castsShadows && to.hasMetaballs ? depthMapGrid(to.light, view, to.skin, to.settings.depthMapTexels)
                                                  : DepthMapGrid{};
    to.meshDepthMap = castsShadows && !to.meshes.empty()
                          ? meshDepthMapGrid(to.light, view, to.meshes, to.settings.depthMapTexels)
                          : DepthMapGrid{};
    to.opticalDepth = !to.depthMap.empty() && view.surface.medium.isTransparent()
                          ? opticalDepthMap(to.light, view, to.frame.eye)
                          : OpticalDepthMap{};
    if (to.depthMap.empty()) return;
    to.lightMetaballs = metaballScene(
        lightFrame(to.light, to.depthMap, view.camera.eye, to.settings.depthMapRaysPerTexel), view, to.skin);
}

/// A view depth that no point of a box is before, however it is rounded, m.
float frontOf(const CameraFrame& frame, const BoxObstacle& box) {
    const glm::vec3 half = 0.5F * (box.maximum - box.minimum);
    const float middle = frame.toView(box.minimum + half).z;
    const float slack = 1.0e-5F * (length(box.minimum - frame.eye) + length(box.maximum - frame.eye));
    return middle - dot(abs(frame.forward), half) - slack;
}

void findBoxTiles(PreparedView& to) {
    const std::vector<BoxObstacle>& boxes = to.view->boxObstacles;
    to.boxFronts.clear();
    for (const BoxObstacle& box : boxes) to.boxFronts.push_back(frontOf(to.frame, box));
    // Two pixels are in the bounds of a box already, of which one is left for the rounding.
    const int margin = std::max(to.lineMargin() - 1, 0);
    const auto tileOf = [](int pixel, int count) { return std::clamp(pixel, 0, count - 1) / kTileSize; };
    std::vector<CellItem> items;
    for (const std::uint32_t index : indicesByKey(to.boxFronts)) {
        const auto pixels = pixelsTouchedByBox(to.frame, boxes[index].minimum, boxes[index].maximum);
        if (!pixels) continue;
        items.push_back({index,
                         {tileOf(pixels->x0 - margin, to.frame.width), tileOf(pixels->y0 - margin, to.frame.height),
                          tileOf(pixels->x1 + margin, to.frame.width), tileOf(pixels->y1 + margin, to.frame.height)}});
    }
    to.boxTiles = binIntoCells(items, to.sphereTiles.columns, to.sphereTiles.rows);
}

void findGroundTiles(PreparedView& to) {
    to.groundTiles.assign(to.sphereTiles.cellCount(), TileKind::background);
    if (to.view->ground) to.groundTiles = groundTiles(to);
}

}  // namespace

int PreparedView::lineMargin() const {
    float widest = 0.0F;
    for (const ScreenLine& line : lines.lines) widest = std::max(widest, line.width);
    return static_cast<int>(std::ceil(0.5F * widest));
}

void prepareView(const View& view, const PrepareSettings& settings, PreparedView& to, DrawTimes& times) {
    to.settings = settings;
    to.frame = cameraFrame(view.camera, settings.size);
    timed(times.bin, [&] { to.withoutStrays = withoutStrays(view, to.frame); });
    to.view = to.withoutStrays ? &*to.withoutStrays : &view;
    const View& drawn = *to.view;
    to.light = lightBasis(drawn.light.toLight);
    to.hasMetaballs = drawn.style == Style::metaballs && !drawn.particles.empty();
    to.meanRadius = static_cast<float>(meanRadius(drawn.particles));
    const auto placeBalls = [&] {
        timed(times.bin, [&] {
            to.drawn = drawnSpheres(drawn);
            to.meshes = drawnMeshes(drawn, to.frame.eye, std::move(to.meshes));
            to.skin = to.hasMetaballs ? skinOf(drawn) : std::vector<SkinBall>{};
        });
        tbb::parallel_invoke([&] { timed(times.rays, [&] { prepareTransparency(to); }); },
                             [&] { timed(times.bin, [&] { binForCamera(to); }); },
                             [&] { timed(times.shadow, [&] { binForLight(to); }); });
    };
    tbb::parallel_invoke([&] { timed(times.occlusion, [&] { findSkyVisibility(to); }); }, placeBalls);
    timed(times.bin, [&] {
        to.sphereAttributes = sphereAttributes(drawn, to.drawn, to.particleSky);
        if (to.hasMetaballs) setAttributes(drawn, to.particleSky, to.metaballs);
        findBoxTiles(to);
        findGroundTiles(to);
    });
}

}  // namespace render
