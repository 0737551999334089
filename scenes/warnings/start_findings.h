// What the searches for surprises in a scene's start share: the list of messages and the words for what they name.
// start_warnings.h is the door; each of the searches below has a file of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/vec3.h"
#include "engine/obstacles/obstacle_surfaces.h"
#include "scenes/model/scene.h"

namespace scenes {

/// A particle whose center is this deep in an obstacle, in radii, starts inside the obstacle. Chosen: more than the
/// jitter of a body whose lattice begins on the surface.
inline constexpr double kInsideDepth = 0.5;

/// The messages of a scene's start, as they are found.
class StartMessages {
 public:
    explicit StartMessages(const Scene& scene) : scene_(scene) {}

    /// Adds a message about a table of the scene file. Of each kind of finding only the first few are kept.
    void add(const SourcePosition& table, const std::string& message);

    /// Ends a kind of finding: adds how many messages of it were left out.
    void endKind();

    std::vector<std::string> list() && { return std::move(list_); }

 private:
    const Scene& scene_;
    std::vector<std::string> list_;
    std::size_t ofThisKind_ = 0;
};

/// "1 particle", "12 particles", or "about 1.2e+04 particles" for a count in a sample, each of which stands for
/// `weight` of them.
std::string countText(std::size_t count, double weight, const char* one, const char* many);

std::string positionText(const engine::Vec3& position);

/// Index of the body that an initial particle belongs to.
std::uint32_t bodyOf(const Scene& scene, std::uint32_t particle);

/// "body 2 (line 14)" for the index of a body.
std::string bodyText(const Scene& scene, std::size_t body);

/// "obstacle 3, a box".
std::string obstacleText(const Scene& scene, std::size_t obstacle);

/// Calls visit(surface) for the surfaces of an obstacle, given by its index, that are closer to a point than the reach
/// (m) at the start.
template <class Visit>
void forEachSurfaceNear(const engine::Obstacles& obstacles, std::size_t obstacle, const engine::Vec3& point,
                        double reach, const Visit& visit) {
    const auto visitNear = [&](const engine::Surface& surface) {
        if (surface.height < reach) visit(surface);
    };
    if (engine::isPlaced(obstacles, obstacle))
        return engine::forEachPlacedSurface(obstacles, obstacle, point, 0.0, reach, visitNear);
    std::visit(
        [&](const auto& shape) {
            if (engine::mayReach(shape, point, reach)) engine::forEachSurface(shape, point, 1.0, visitNear);
        },
        obstacles.shapes[obstacle]);
}

/// Finds particles and points of emission inside obstacles, particles in gaps without room, and containers that
/// contradict each other.
void findInsideObstacles(const Scene& scene, StartMessages& messages);

/// Finds pairs of particles that start too close to each other.
void findClosePairs(const Scene& scene, StartMessages& messages);

/// Finds out whether the cameras see anything but the ground.
void findEmptyPicture(const Scene& scene, StartMessages& messages);

}  // namespace scenes
