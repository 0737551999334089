// How a scene is seen, still in double: camera, colors, lights, overlay and what of the obstacles is drawn.
// frame_view.cpp turns it into the renderer's input.
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
    double verticalFov = 0.7;  ///< full angle, radians
    double halfHeight = 5.0;   ///< m, orthographic only
};

enum class ColorBy { material, speed, age };

/// Colors are linear RGB.
struct Look {
    render::Style style = render::Style::spheres;
    ColorBy colorBy = ColorBy::material;
    std::vector<engine::Vec3> ramp;  ///< for speed and age, from low to high
    double rampLow = 0.0;            ///< m/s or s, of the first color
    double rampHigh = 1.0;           ///< of the last color
    engine::Vec3 backgroundTop = {0.0, 0.0, 0.0};
    engine::Vec3 backgroundBottom = {0.0, 0.0, 0.0};
    engine::Vec3 edgeColor = {1.0, 0.9, 0.0};
    double edgeWidth = 1.5;                  ///< pixels
    engine::Vec3 toLight = {0.0, 1.0, 0.0};  ///< unit length
    engine::Vec3 lightColor = {1.0, 1.0, 1.0};
    bool shadows = true;
    engine::Vec3 ambientSky = {0.35, 0.35, 0.35};
    engine::Vec3 ambientGround = {0.2, 0.2, 0.2};
    double specular = 0.0;
    int glossExponent = 6;
    double shadowSoftness = 0.0;  ///< in particle radii
    double occlusion = 0.0;
    double reflection = 0.0;
    engine::Vec3 mirrorTop = {0.9, 0.9, 0.9};
    engine::Vec3 mirrorHorizon = {0.6, 0.6, 0.6};
    engine::Vec3 mirrorBottom = {0.2, 0.2, 0.2};
    double metal = 0.0;
    double roughness = 0.0;
    double translucency = 0.0;
    double absorption = 0.0;
    double glow = 0.0;
    double exposure = 0.0;
    bool ground = false;
    double groundHeight = 0.0;  ///< m
    engine::Vec3 groundColor = {0.6, 0.6, 0.6};
    double groundFade = 30.0;    ///< m
    double metaballReach = 2.5;  ///< particle radii
    render::Skin skin = render::Skin::plain;
};

/// What figures carry besides the picture.
struct Overlay {
    bool time = false;
    double scaleBar = 0.0;  ///< m; 0: none
    bool colorBar = false;
    std::string colorLabel;              ///< what the colors show, without the unit
    engine::Vec3 ink = {1.0, 1.0, 1.0};  ///< linear RGB
    double size = 1.0;                   ///< of text, relative to the usual
};

/// What is drawn of an obstacle.
struct ObstacleLook {
    bool visible = true;
    bool edges = false;                    ///< of a box or container
    engine::Vec3 color = {0.5, 0.5, 0.5};  ///< of a surface; of a container that of its edges
};

}  // namespace scenes
