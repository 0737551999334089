// The input of the renderer as plain data: what is in the picture, where the camera stands, how it is lit. No GL here,
// so that scenes can fill it in. All lengths in metres, angles in radians, colours linear RGB in [0,1]; right-handed, y
// up.
//
// Shading, the same for every surface (n unit normal, v unit vector to the eye, l unit vector to the light, h =
// normalize(l+v)):
//   ambient  = mix(ambient.ground, ambient.sky, 0.5 + 0.5 n.y)
//   diffuse  = light.color * max(0, n.l) * visibility             visibility: 1 lit, 0 in shadow, between at soft edges
//   fresnel  = specular + (1 - specular) (1 - max(0, v.h))^5
//   glint    = light.color * visibility * fresnel * (gloss + 8)/8 * max(0, n.h)^gloss * [n.l > 0]     gloss =
//   2^glossExponent
//              the whole term is left out when specular = 0
//   colour   = albedo * (ambient + diffuse) + glint, clamped to [0,1], then sRGB encoded and rounded to 8 bits
// The background is mix(bottom, top, t) with t running from 0 at the bottom edge of the picture to 1 at the top edge.
// The ground is shaded with specular = 0 and its colour then mixed into the background by fade/(1 + fade), fade =
// (d/fadeDistance)^4, d the distance of the point from the ground's centre.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "render/overlay.h"

namespace render {

/// A particle: a lit sphere, or one ball of the metaball field.
struct Sphere {
    glm::vec3 center{0.0F};
    float radius = 0.1F;
    glm::vec3 color{0.8F};
};

enum class Style { spheres, metaballs };

/// draft: one sample a pixel. normal: antialiased silhouettes. final: 3 x 3 supersampling, averaged in linear light.
enum class Quality { draft, normal, final };

enum class Projection { perspective, orthographic };

struct Camera {
    Projection projection = Projection::perspective;
    glm::vec3 eye{0.0F, 2.0F, 10.0F};
    glm::vec3 target{0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    float verticalFov = 0.7F;  ///< full angle, perspective only
    float halfHeight = 5.0F;   ///< half the height of the picture, m, orthographic only
};

/// Parallel light.
struct Light {
    glm::vec3 toLight{0.4F, 0.8F, 0.4472136F};  ///< unit length
    glm::vec3 color{1.0F};
    bool shadows = true;  ///< no shadow pass is run without
};

struct Ambient {
    glm::vec3 sky{0.35F};
    glm::vec3 ground{0.2F};
};

/// How the particles' surface answers light; obstacles and ground are matt.
struct Surface {
    float specular = 0.0F;  ///< reflectance at normal incidence; 0 is matt and costs nothing
    int glossExponent = 6;  ///< the highlight's exponent is 2 to the power of this
};

/// A horizontal plane.
struct Ground {
    float height = 0.0F;
    glm::vec3 color{0.6F};
    glm::vec3 center{0.0F};  ///< the fade starts here
    float fadeDistance = 30.0F;
};

struct Background {
    glm::vec3 top{0.0F};
    glm::vec3 bottom{0.0F};
};

struct SphereObstacle {
    glm::vec3 center{0.0F};
    float radius = 0.5F;
    glm::vec3 color{0.5F};
};

struct BoxObstacle {
    glm::vec3 minimum{0.0F};
    glm::vec3 maximum{0.0F};
    glm::vec3 color{0.5F};
};

/// A straight line of constant width on the picture, hidden by what is in front of it.
struct Edge {
    glm::vec3 from{0.0F};
    glm::vec3 to{0.0F};
    glm::vec3 color{1.0F, 0.9F, 0.0F};
    float width = 1.5F;  ///< pixels, at any quality
};

/// The field of metaballs: sum over balls of (1 - d^2/R^2)^2 for d < R, with R = reach * radius. The surface is where
/// the field is (1 - 1/reach^2)^2, so that a lone ball keeps its radius. The normal is the negative gradient; the
/// colour is the average of the balls' colours weighted by their kernels.
struct MetaballField {
    float reach = 2.5F;  ///< at least 1.2, at most 4
};

/// One frame.
struct View {
    std::vector<Sphere> particles;
    Style style = Style::spheres;
    MetaballField field;  ///< used by metaballs only
    Camera camera;
    Light light;
    Ambient ambient;
    Surface surface;
    Background background;
    std::optional<Ground> ground;
    std::vector<SphereObstacle> sphereObstacles;
    std::vector<BoxObstacle> boxObstacles;
    std::vector<Edge> edges;
    Overlay overlay;  ///< drawn last, over the finished picture
};

struct PictureSize {
    int width = 1280;
    int height = 720;
};

}  // namespace render
