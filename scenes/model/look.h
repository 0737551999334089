// How a scene is drawn: cameras, colors, lights, obstacles and overlay. view/frame_view.cpp adds the particles of a
// moment, which makes the renderer's input.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/vec3.h"
#include "render/picture/view.h"

namespace scenes {

struct CameraPlacement {
    render::Projection projection = render::Projection::perspective;
    engine::Vec3 eye = {0.0, 2.0, 10.0};    ///< m
    engine::Vec3 target = {0.0, 0.0, 0.0};  ///< m
    engine::Vec3 up = {0.0, 1.0, 0.0};
    double verticalFov = 0.7;  ///< full vertical angle of view, radians; perspective only
    double halfHeight = 5.0;   ///< half the height of the picture, m; orthographic only
    double aperture = 0.0;     ///< diameter of the lens, m; perspective only
    double focus = 0.0;        ///< distance of the plane in focus, m; 0: that of the target
    double shutter = 0.0;      ///< share of the time between two frames for which the shutter is open
};

/// The quantity that a particle's color shows.
enum class ColorBy { material, speed, age, temperature };

/// A sphere that is drawn of an obstacle. What is drawn of an obstacle is given where its shape is; the pose of the
/// obstacle tells where that is in the scene.
struct DrawnSphere {
    std::size_t obstacle = 0;               ///< index of the obstacle
    engine::Vec3 center = {0.0, 0.0, 0.0};  ///< m
    double radius = 0.5;                    ///< m
    glm::vec3 color{0.5F};                  ///< linear RGB
};

/// An axis-aligned box that is drawn of an obstacle which stays where it is.
struct DrawnBox {
    std::size_t obstacle = 0;                ///< index of the obstacle
    engine::Vec3 minimum = {0.0, 0.0, 0.0};  ///< m
    engine::Vec3 maximum = {0.0, 0.0, 0.0};  ///< m
    glm::vec3 color{0.5F};                   ///< linear RGB
};

/// The surface of an obstacle that is drawn as triangles.
struct DrawnSolid {
    std::size_t obstacle = 0;                       ///< index of the obstacle
    std::shared_ptr<const render::SolidMesh> mesh;  ///< around the origin below
    engine::Vec3 origin = {0.0, 0.0, 0.0};          ///< m
    glm::vec3 color{0.5F};                          ///< linear RGB
    render::Medium medium{};
};

/// Lines that are drawn of an obstacle.
struct DrawnEdges {
    std::size_t obstacle = 0;                                  ///< index of the obstacle
    std::vector<std::pair<engine::Vec3, engine::Vec3>> lines;  ///< m
    glm::vec3 color{1.0F, 0.9F, 0.0F};                         ///< linear RGB
};

/// How a scene is drawn, apart from its cameras: tables [look] and [overlay], and what is drawn of the obstacles.
struct Look {
    /// What the views of all frames have in common: everything but the camera, the time stamp of the overlay, and what
    /// has a position, which depends on the camera.
    render::View common;
    std::vector<DrawnSphere> spheres;
    std::vector<DrawnBox> boxes;
    std::vector<DrawnSolid> solids;
    std::vector<DrawnEdges> edges;
    float edgeWidth = 1.5F;     ///< width of the edges, pixels
    double groundHeight = 0.0;  ///< height of the ground, if there is one, m
    bool hasTimeStamp = false;
    ColorBy colorBy = ColorBy::material;
    std::vector<engine::Vec3> ramp;  ///< linear RGB from low to high; empty for colors by material
    double rampLow = 0.0;            ///< speed (m/s), age (s) or temperature (K) of the first color of the ramp
    double rampHigh = 1.0;           ///< speed (m/s), age (s) or temperature (K) of the last color of the ramp
    bool isRampOfLight = false;  ///< whether the ramp is that of a black body, whose light adds to the material's color
};

}  // namespace scenes
