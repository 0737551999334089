// Balls whose kernels lie before or behind all points of the tile are passed over: most balls of a liquid lie behind.
#include "render/cpu/metaballs/strongest_ball.h"

#include <algorithm>

namespace render {

void HitPoints::add(const CameraFrame& frame, std::size_t pixelIndex, glm::vec2 onPicture, float depth) {
    const float scale = frame.perspective ? depth : 1.0F;
    pixel[count] = static_cast<std::uint8_t>(pixelIndex);
    const glm::vec2 middle = scale * frame.middle;
    x[count] = (2.0F * onPicture.x / static_cast<float>(frame.width) - 1.0F) * frame.halfWidth * scale + middle.x;
    y[count] = (1.0F - 2.0F * onPicture.y / static_cast<float>(frame.height)) * frame.halfHeight * scale + middle.y;
    z[count] = depth;
    ++count;
}

namespace {

/// @param squareOf(index, off)  what is taken from a ball's peak at an offset from its center
template <typename Square>
void findStrongest(const MetaballScene& scene, std::size_t tile, HitPoints& points, const Square& squareOf) {
    const auto [nearest, farthest] = std::minmax_element(points.z.begin(), points.z.begin() + points.count);
    std::array<float, kTilePixels> most{};
    std::fill_n(points.ball.begin(), points.count, HitPoints::kNoBall);
    for (const std::uint32_t index : scene.tiles.itemsOf(tile)) {
        const Metaball& ball = scene.balls[index];
        if (ball.center.z - ball.reach > *farthest) break;  // as all later ones: they are listed front to back
        if (ball.center.z + ball.reach < *nearest) continue;
        for (std::size_t k = 0; k < points.count; ++k) {  // without branches: compilers vectorize this loop
            const float offX = points.x[k] - ball.center.x;
            const float offY = points.y[k] - ball.center.y;
            const float offZ = points.z[k] - ball.center.z;
            const float root = std::max(ball.peak - squareOf(index, glm::vec3(offX, offY, offZ)), 0.0F);
            const float kernel = root * root;
            const bool isStronger = kernel > most[k];
            most[k] = isStronger ? kernel : most[k];
            points.ball[k] = isStronger ? index : points.ball[k];
        }
    }
}

}  // namespace

void findStrongestBalls(const MetaballScene& scene, std::size_t tile, HitPoints& points) {
    if (scene.ellipsoids.empty())
        findStrongest(scene, tile, points, [&](std::uint32_t index, glm::vec3 off) {
            const float slope = scene.balls[index].slope;
            return (off.x * off.x + off.y * off.y + off.z * off.z) * (slope * slope);
        });
    else
        findStrongest(scene, tile, points, [&](std::uint32_t index, glm::vec3 off) {
            return dot(off, scene.ellipsoids[index].form.times(off));
        });
}

}  // namespace render
