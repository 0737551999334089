// How a scene is drawn: camera positions, colors, lights, overlay, and what is visible of the obstacles.
// view/frame_view.cpp combines it with the particles of a moment into the renderer's input.
#pragma once

#include <string>
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
};

/// The quantity that a particle's color shows.
enum class ColorBy { material, speed, age };

/// The [look] table of a scene.
struct Look {
    /// What the views of all frames have in common: style, lights, surface, ground (but for its center), background.
    /// The rest (particles, obstacles, camera, overlay) is empty.
    render::View common;
    ColorBy colorBy = ColorBy::material;
    std::vector<engine::Vec3> ramp;  ///< linear RGB from low to high speed or age; empty for colors by material
    double rampLow = 0.0;            ///< speed (m/s) or age (s) of the first color
    double rampHigh = 1.0;           ///< speed (m/s) or age (s) of the last color
    glm::vec3 edgeColor{0.0F};       ///< linear RGB, of the edges of boxes
    float edgeWidth = 1.5F;          ///< pixels
};

/// The [overlay] table of a scene.
struct Overlay {
    bool time = false;
    double scaleBar = 0.0;  ///< length in m; 0: none
    bool colorBar = false;
    std::string colorLabel;              ///< name of the quantity that the colors show, without its unit
    engine::Vec3 ink = {1.0, 1.0, 1.0};  ///< linear RGB of text and lines
    double size = 1.0;                   ///< of the text, relative to the default size
};

/// How an obstacle is drawn.
struct ObstacleLook {
    bool isVisible = true;
    bool hasEdges = false;                 ///< the edges of a box or container are drawn as lines
    engine::Vec3 color = {0.5, 0.5, 0.5};  ///< linear RGB: of the surface; of a container's edges
};

}  // namespace scenes
