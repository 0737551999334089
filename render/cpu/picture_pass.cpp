// What the stages of a picture find, and what is handed from each to the next. Positions are relative to the eye.
#include "render/cpu/picture_pass.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "render/cpu/lighting/occluder_bounds.h"

namespace render {

namespace {

// Whether any term of the shading model looks at openness.
bool needsSkyVisibility(const View& view) {
    const Surface& surface = view.surface;
    return !view.particles.empty() && (view.ambient.occlusion > 0.0F || surface.reflection > 0.0F ||
                                       surface.translucency > 0.0F || surface.absorption > 0.0F);
}

float meanRadiusOf(const View& view) {
    double sum = 0.0;
    for (const Sphere& particle : view.particles) sum += double(particle.radius);
    return view.particles.empty() ? 0.0F : static_cast<float>(sum / static_cast<double>(view.particles.size()));
}

}  // namespace

void PicturePass::prepare(const CameraFrame& frame, const View& view, int depthMapTexels, DrawTimes& times) {
    frame_ = frame;
    light_ = lightBasis(view.light.toLight);
    shading_ = shadingOf(view);
    castsField_ = view.style == Style::metaballs && !view.particles.empty();
    meanRadius_ = meanRadiusOf(view);
    depthMapTexels_ = depthMapTexels;
    // None needs what those beside it find, and each has parts that keep one thread alone busy.
    const auto placeBalls = [&] {
        timed(times.bin, [&] {
            drawn_ = drawnSpheres(view);
            skin_ = castsField_ ? skinOf(view) : std::vector<SkinBall>{};
        });
        tbb::parallel_invoke([&] { timed(times.bin, [&] { bin(view); }); },
                             [&] { timed(times.shadow, [&] { findShadows(view); }); });
    };
    tbb::parallel_invoke([&] { timed(times.occlusion, [&] { findSkyVisibility(view); }); }, placeBalls);
    timed(times.bin, [&] {
        sphereAttributes_ = sphereAttributes(view, drawn_, particleSky_);
        findBoxes(view);
        findGround(view);
    });
}

void PicturePass::findGround(const View& view) {
    groundTiles_.assign(sphereTiles_.begin.size() - 1, {});
    if (view.ground) {
        const Occluders occluders{light_, lightGrid_, depthMap_, needsSkyVisibility_ ? &skyMap_ : nullptr, meanRadius_};
        groundTiles_ = groundTiles(frame_, view.ground->height - frame_.eye.y, occluderBoundsOf(view, occluders));
    }
}

void PicturePass::findSkyVisibility(const View& view) {
    needsSkyVisibility_ = needsSkyVisibility(view);
    skyGrid_ = needsSkyVisibility_ ? skyVisibilityGrid(view.particles, std::move(skyGrid_)) : SkyVisibilityGrid{};
    skyMap_ = SkyVisibilityMap{};
    particleSky_ = needsSkyVisibility_ ? particleSkyVisibility(view.particles, skyGrid_) : std::vector<SkyVisibility>{};
    if (!needsSkyVisibility_) return;
    if (view.ground) skyMap_ = skyVisibilityAtHeight(skyGrid_, view.ground->height);
}

void PicturePass::bin(const View& view) {
    viewSpheres_.resize(drawn_.spheres.size());
    for (std::size_t k = 0; k < viewSpheres_.size(); ++k)
        viewSpheres_[k] = {frame_.toView(drawn_.spheres[k].center + frame_.eye), drawn_.spheres[k].radius};
    spherePixels_ = pixelBounds(frame_, viewSpheres_);
    sphereTiles_ = binToTiles(frame_, viewSpheres_, spherePixels_);
    lineList_ = projectEdges(frame_, view.edges);
    if (castsField_) binnedField_ = binField(frame_, {view, skin_, {}});
}

void PicturePass::findShadows(const View& view) {
    lightGrid_ = view.light.shadows ? lightGrid(light_, drawn_.spheres, view.light.softness) : LightGrid{};
    castDepths(view, glm::vec2(0.0F));
}

void PicturePass::castDepths(const View& view, glm::vec2 shift) {
    depthMapShift_ = shift;
    depthMap_ = castsField_ && view.light.shadows ? castDepthMap(light_, {view, skin_, {}}, {depthMapTexels_, shift})
                                                  : DepthMap{};
}

// Rays moved by a third of a pixel look at texels moved by a third of a texel, so that the mean of the pictures has the
// mean of the maps.
void PicturePass::castShadow(const View& view, const Sampling& sampling) {
    if (castsField_ && view.light.shadows && sampling.offset != depthMapShift_) castDepths(view, sampling.offset);
}

void PicturePass::findBoxes(const View& view) {
    boxTiles_.assign(sphereTiles_.begin.size() - 1, 0);
    for (const BoxObstacle& box : view.boxObstacles) {
        const auto pixels = pixelsTouchedByBox(frame_, box.minimum, box.maximum);
        if (!pixels) continue;
        for (int row = pixels->y0 / kTileSize; row <= pixels->y1 / kTileSize; ++row) {
            for (int column = pixels->x0 / kTileSize; column <= pixels->x1 / kTileSize; ++column) {
                boxTiles_[sphereTiles_.cellIndex(column, row)] = 1;
            }
        }
    }
}

void PicturePass::castField(const View& view, const Sampling& sampling) {
    if (!castsField_) return;
    castPicture(frame_, {view, skin_, particleSky_}, binnedField_,
                {sampling.offset, sampling.samples > 1, sampling.sparse}, field_);
}

// Whether anything stands in the light's way.
bool PicturePass::castsShadows(const View& view) const {
    return view.light.shadows && (!lightGrid_.empty() || !depthMap_.empty() || !view.boxObstacles.empty());
}

Obstruction PicturePass::obstructionOf(const View& view) const {
    Obstruction obstruction;
    obstruction.light = light_;
    obstruction.eye = frame_.eye;
    if (!lightGrid_.empty()) obstruction.spheres = &lightGrid_;
    if (!depthMap_.empty()) obstruction.field = &depthMap_;
    if (view.light.shadows) obstruction.boxes = view.boxObstacles;
    obstruction.softness = view.light.softness;
    obstruction.meanRadius = meanRadius_;
    if (needsSkyVisibility_ && view.ambient.occlusion > 0.0F) {
        obstruction.open = &skyGrid_;
        obstruction.ground = &skyMap_;
    }
    return obstruction;
}

/// Calls visit(job) with all that the pixels of these rays are colored from.
template <typename Visit>
auto PicturePass::withJob(const View& view, const Sampling& sampling, const Visit& visit) const {
    Solids solids{frame_, viewSpheres_, spherePixels_, &sphereTiles_, view.boxObstacles, std::nullopt};
    if (view.ground) solids.ground = view.ground->height - frame_.eye.y;
    const Surfaces surfaces{frame_,
                            drawn_.spheres,
                            sphereAttributes_,
                            drawn_.firstObstacle,
                            view.boxObstacles,
                            solids.ground,
                            view.ground.value_or(Ground{}).color,
                            field_.samples,
                            light_.toLight,
                            needsSkyVisibility_};
    const Obstruction obstruction = obstructionOf(view);
    const bool dims = castsShadows(view) || obstruction.open != nullptr;
    const TileContents contents{solids, castsField_ ? &field_ : nullptr, lineList_, boxTiles_, groundTiles_};
    return visit(PictureJob{contents, sampling.samples == 1 ? SampleOffsets(&sampling.offset, 1) : kFourSamples,
                            surfaces, dims ? &obstruction : nullptr, shading_});
}

void PicturePass::color(const View& view, const Sampling& sampling, std::span<PixelColor> pixels) {
    classes_.resize(groundTiles_.size());
    withJob(view, sampling, [&](const PictureJob& job) { colorPixels(job, pixels, classes_); });
    colorPlain(view, pixels);
}

void PicturePass::clearSum() {
    classes_.resize(groundTiles_.size());
    sums_.assign(classes_.size(), {});
}

void PicturePass::addColors(const View& view, const Sampling& sampling) {
    withJob(view, sampling, [&](const PictureJob& job) { render::addColors(job, sums_, classes_); });
}

void PicturePass::takeMean(const View& view, int samplings, std::span<PixelColor> pixels) {
    meanColors(samplings, sums_, classes_, sphereTiles_, pixels);
    colorPlain(view, pixels);
}

void PicturePass::colorPlain(const View& view, std::span<PixelColor> pixels) {
    Backdrop backdrop;
    backdrop.frame = frame_;
    backdrop.frame.eye = glm::vec3(0.0F);
    backdrop.background = view.background;
    if (view.ground) {
        backdrop.ground = unoccludedGround(shading_, view.ground->color);
        backdrop.groundHeight = view.ground->height - frame_.eye.y;
        backdrop.groundCenter = shading_.groundCenter;
        backdrop.fadeDistance = shading_.fadeDistance;
    }
    plain_.color(backdrop, classes_, sphereTiles_.columns, pixels);
}

std::vector<VisiblePoint> PicturePass::visiblePoints(const View& view, const Sampling& sampling) {
    return withJob(view, sampling, [](const PictureJob& job) { return render::visiblePoints(job); });
}

}  // namespace render
