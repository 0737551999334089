// Makes balls of particles and lists them for the tiles that they reach.
#include "render/prepare/metaball_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace render {

namespace {

std::vector<std::size_t> particlesWithRadius(const View& view) {
    std::vector<std::size_t> found;
    found.reserve(view.particles.size());
    for (std::size_t k = 0; k < view.particles.size(); ++k)
        if (view.particles[k].radius > 0.0F) found.push_back(k);
    return found;
}

/// A matrix in the axes of a camera, in double precision because it is inverted.
SymmetricMatrix<double> inView(const CameraFrame& frame, const SymmetricMatrix<float>& m) {
    const SymmetricMatrix<double> world{double(m.xx), double(m.yy), double(m.zz),
                                        double(m.xy), double(m.xz), double(m.yz)};
    return inAxes(world, glm::dvec3(frame.right), glm::dvec3(frame.up), glm::dvec3(frame.forward));
}

/// Gives the balls of an anisotropic skin their shapes.
/// @param pixels  set to the bounds of the pixels that each ball may touch
void shapeBalls(std::span<const SkinBall> skin, MetaballScene& scene, std::vector<Rect>& pixels) {
    scene.ellipsoids.resize(scene.balls.size());
    pixels.resize(scene.balls.size());
    tbb::parallel_for(std::size_t{0}, scene.balls.size(), [&](std::size_t k) {
        Metaball& ball = scene.balls[k];
        const SymmetricMatrix<double> spread = inView(scene.frame, skin[scene.particles[k]].spread);
        scene.ellipsoids[k] = ellipsoidOf(spread, ball.peak);
        // A little longer, for the rounding of what is cast.
        ball.reach = 1.00001F * static_cast<float>(std::sqrt(spread.zz));
        pixels[k] = pixelsTouchedByEllipsoid(scene.frame, ball.center, inFloat(spread)).value_or(Rect{});
    });
}

}  // namespace

MetaballScene metaballScene(const CameraFrame& frame, const View& view, std::span<const SkinBall> balls) {
    MetaballScene scene;
    scene.frame = frame;
    scene.particles = particlesWithRadius(view);
    scene.balls.resize(scene.particles.size());
    tbb::parallel_for(std::size_t{0}, scene.balls.size(), [&](std::size_t k) {
        const SkinBall& ball = balls[scene.particles[k]];
        const BallKernel kernel = kernelOf(ball);
        scene.balls[k] = {frame.toView(ball.center), ball.reach, kernel.peak, kernel.slope};
    });
    std::vector<Rect> pixels;
    if (view.field.skin == Skin::anisotropic) shapeBalls(balls, scene, pixels);
    std::vector<ViewSphere> kernels(scene.balls.size());
    float smallest = std::numeric_limits<float>::max();
    double sum = 0.0;
    for (std::size_t k = 0; k < scene.balls.size(); ++k) {
        kernels[k] = {scene.balls[k].center, scene.balls[k].reach};
        const float reach = view.field.reach * view.particles[scene.particles[k]].radius;
        smallest = std::min(smallest, reach);
        sum += reach;
    }
    // Rays may miss a ball with less than a tenth of the mean reach (chosen), because one very small ball must not
    // shorten the steps on all rays.
    const double mean = sum / static_cast<double>(std::max<std::size_t>(scene.balls.size(), 1));
    scene.smallestRadius = std::max(smallest, static_cast<float>(0.1 * mean)) / view.field.reach;
    scene.step = 0.5F * scene.smallestRadius;
    scene.threshold = surfaceThreshold(view.field);
    if (scene.ellipsoids.empty()) pixels = pixelBounds(frame, kernels);
    scene.tiles = binToTiles(frame, kernels, pixels);
    return scene;
}

void setAttributes(const View& view, std::span<const SkyVisibility> particleSky, MetaballScene& scene) {
    scene.hasSky = !particleSky.empty();
    scene.attributes.resize(scene.particles.size());
    tbb::parallel_for(std::size_t{0}, scene.attributes.size(), [&](std::size_t k) {
        const std::size_t particle = scene.particles[k];
        scene.attributes[k] = {view.particles[particle].color,
                               particleSky.empty() ? kUnoccluded : particleSky[particle]};
    });
}

SmoothnessLimits smoothnessLimits(const MetaballScene& scene) {
    // Within a pixel the field rises by less than kSteepest times the width of the pixel over the smallest radius. (The
    // field of a single ball rises by half as much, and the nearest cast ray may be a diagonal of the pixel away.)
    constexpr float kSteepest = 2.0F;
    float farthest = 0.0F;
    for (const Metaball& ball : scene.balls) farthest = std::max(farthest, ball.center.z + ball.reach);
    const float pixel = scene.frame.pixelWidth() * (scene.frame.perspective ? farthest : 1.0F);
    // The greatest sample on a ray is at most a quarter of a radius away from the maximum of the field, where the field
    // of a single ball at the threshold has the second derivative -4 sqrt(threshold) / reach^2 per square radius.
    const float root = std::sqrt(scene.threshold);  // equals 1 - 1 / reach^2, hence 1 - root = 1 / reach^2
    const float missed = 0.125F * root * (1.0F - root);
    // Across a flat ellipsoid the field rises and bends the more steeply. Chosen: few axes are shorter than half.
    const float flat = scene.ellipsoids.empty() ? 1.0F : 2.0F;
    return {0.02F * scene.smallestRadius,
            scene.threshold - flat * flat * missed - flat * kSteepest * pixel / scene.smallestRadius};
}

}  // namespace render
