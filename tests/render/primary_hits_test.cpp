// findSphereHitsOverGround(), which leaves out the depth of the ground, against findFlatHits() and findSphereHits().
#include "tests/catch.h"

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "render/cpu/raster/primary_hits.h"

namespace {

using render::kTilePixels;

/// Spheres around the plane y = height, relative to the eye, in the camera's view coordinates.
std::vector<render::ViewSphere> spheresNear(const render::CameraFrame& frame, float height, float lowest) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> side(-1.5F, 1.5F);
    std::uniform_real_distribution<float> up(lowest, lowest + 1.0F);
    std::vector<render::ViewSphere> spheres;
    for (int k = 0; k < 60; ++k)
        spheres.push_back(
            {frame.toView(frame.eye + glm::vec3(side(random), height + up(random), side(random) - 5.0F)), 0.15F});
    return spheres;
}

using Samples = std::array<render::TileRays, 4>;

void placeRays(const render::CellLists& tiles, std::size_t tile, Samples& samples) {
    for (std::size_t s = 0; s < samples.size(); ++s) {
        const glm::vec2 first = render::tileCorner(tiles, tile) + 0.5F + render::kFourSamples[s];
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            samples[s].x[k] = first.x + static_cast<float>(k % render::kTileSize);
            samples[s].y[k] = first.y + static_cast<float>(k / render::kTileSize);
        }
    }
}

struct Counts {
    int differing = 0, onSpheres = 0, onGround = 0;
};

/// Compares what both find on the tiles that the ground fills.
Counts compareHits(const render::SolidGeometry& geometry) {
    Counts counts;
    Samples whole;
    for (std::size_t tile = 0; tile + 1 < geometry.tiles->begin.size(); ++tile) {
        placeRays(*geometry.tiles, tile, whole);
        Samples shortcut = whole;
        std::ptrdiff_t filled = 0;
        for (render::TileRays& rays : whole) {
            render::findFlatHits(geometry, {.hasGround = true, .hasBoxes = false}, rays);
            filled += std::ranges::count(rays.hitId, render::kHitGround);
        }
        if (filled < std::ptrdiff_t{4 * kTilePixels}) continue;
        render::findSphereHits(geometry, tile, whole);
        render::findSphereHitsOverGround(geometry, tile, shortcut);
        for (std::size_t s = 0; s < whole.size(); ++s) {
            for (std::size_t k = 0; k < kTilePixels; ++k) {
                counts.differing += whole[s].hitId[k] == shortcut[s].hitId[k] ? 0 : 1;
                (whole[s].hitId[k] == render::kHitGround ? counts.onGround : counts.onSpheres) += 1;
            }
        }
    }
    return counts;
}

}  // namespace

TEST_CASE("Spheres on the ground, in it and under it hide it where its depth says so") {
    struct Case {
        float eye, target;  // heights over the ground
    };
    for (const render::Projection projection : {render::Projection::perspective, render::Projection::orthographic}) {
        // From above, from below, and upwards from above: in parallel projection, rays that begin under the ground.
        for (const Case& seen : {Case{2.0F, 0.0F}, Case{-2.0F, 0.0F}, Case{0.5F, 2.5F}}) {
            render::Camera camera;
            camera.eye = {0.0F, seen.eye, 5.0F};
            camera.target = {0.0F, seen.target, 0.0F};
            camera.projection = projection;
            camera.halfHeight = 2.0F;
            const render::CameraFrame frame = render::cameraFrame(camera, {96, 96});
            for (const float lowest : {-0.5F, 0.0F, 0.2F}) {
                const std::vector<render::ViewSphere> spheres = spheresNear(frame, -seen.eye, lowest);
                const std::vector<render::Rect> pixels = render::pixelBounds(frame, spheres);
                const render::CellLists tiles = render::binToTiles(frame, spheres, pixels);
                const Counts counts = compareHits({frame, spheres, pixels, &tiles, {}, -seen.eye});
                CAPTURE(seen.eye, lowest, static_cast<int>(projection));
                CHECK(counts.differing == 0);
                const bool isUpwards = seen.target > seen.eye;
                if (isUpwards && projection == render::Projection::perspective) continue;
                CHECK(counts.onGround > 4000);
                if (seen.eye > 0.0F && !isUpwards) CHECK(counts.onSpheres > 2000);
                // Seen from below, what stands clear of the ground is hidden by it.
                if ((seen.eye < 0.0F || isUpwards) && lowest > 0.15F) CHECK(counts.onSpheres == 0);
            }
        }
    }
}
