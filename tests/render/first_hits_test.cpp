// The way that leaves the ground's depth out against the one that does not.
#include "tests/catch.h"

#include <algorithm>
#include <random>
#include <vector>

#include "render/first_hits.h"

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

void placeRays(const render::CellLists& tiles, std::size_t tile, render::TileRays& rays) {
    const glm::vec2 corner = render::cornerOf(tiles, tile);
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        rays.x[k] = corner.x + static_cast<float>(k % render::kTileSize) + 0.5F;
        rays.y[k] = corner.y + static_cast<float>(k / render::kTileSize) + 0.5F;
    }
}

}  // namespace

TEST_CASE("Spheres on the ground, in it and under it hide it where its depth says so") {
    for (const render::Projection projection : {render::Projection::perspective, render::Projection::orthographic}) {
        // Above it, and below.
        for (const float eye : {2.0F, -2.0F}) {
            render::Camera camera;
            camera.eye = {0.0F, eye, 5.0F};
            camera.target = {0.0F, 0.0F, 0.0F};
            camera.projection = projection;
            camera.halfHeight = 1.0F;
            const render::CameraFrame frame = render::cameraFrame(camera, {96, 96});
            for (const float lowest : {-0.5F, 0.0F, 0.2F}) {
                const std::vector<render::ViewSphere> spheres = spheresNear(frame, -eye, lowest);
                const std::vector<render::Rect> pixels = render::touchedPixels(frame, spheres);
                const render::CellLists tiles = render::binToTiles(frame, spheres, pixels);
                const render::Solids solids{frame, spheres, pixels, &tiles, {}, -eye};
                int differing = 0;
                int onSpheres = 0;
                int onGround = 0;
                for (std::size_t tile = 0; tile + 1 < tiles.begin.size(); ++tile) {
                    render::TileRays whole;
                    placeRays(tiles, tile, whole);
                    render::TileRays quick = whole;
                    render::lookAtFlats(solids, {.ground = true, .boxes = false}, whole);
                    // Only where the ground fills the tile.
                    if (std::ranges::count(whole.seen, render::kSeesGround) < int{kTilePixels}) continue;
                    render::lookAtSpheres(solids, tile, {&whole, 1});
                    render::lookAtSpheresOnGround(solids, tile, {&quick, 1});
                    for (std::size_t k = 0; k < kTilePixels; ++k) {
                        differing += whole.seen[k] == quick.seen[k] ? 0 : 1;
                        (whole.seen[k] == render::kSeesGround ? onGround : onSpheres) += 1;
                    }
                }
                CAPTURE(eye, lowest, static_cast<int>(projection));
                CHECK(differing == 0);
                CHECK(onGround > 1000);
                // Seen from below, what stands clear of the ground is hidden by it.
                if (eye > 0.0F) CHECK(onSpheres > 500);
                if (eye < 0.0F && lowest > 0.15F) CHECK(onSpheres == 0);
            }
        }
    }
}
