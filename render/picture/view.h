// The input of the renderer as plain data: what is in the picture, where the camera stands, how it is lit. No GL here,
// so that scenes can fill it in. All lengths in meters, angles in radians, colors linear RGB in [0,1]; right-handed, y
// up.
//
// Shading, the same for every surface (n unit normal, v unit vector to the eye, l unit vector to the light, h =
// normalize(l+v), r = 2 (n.v) n - v). What a term's strength leaves out at 0 costs nothing. Terms marked * are 0 on
// obstacles and ground, which are matt.
//   sky(d)   = mix(ambient.ground, ambient.sky, 0.5 + 0.5 d.y)
//   ambient  = sky(n) * (1 - occlusion (1 - open(n)))
//   cosine   = max(0, n.l) * (1 + *roughness (2.2 / (max(0, n.l) + max(0, n.v) + 0.2) - 1))
//   diffuse  = light.color * cosine * visibility          visibility: 1 lit, 0 in shadow, between at soft edges
//   through  = *translucency open(-n) (sky(-n) + light.color (0.25 + max(0, -n.l)))
//   body     = mix(albedo, albedo^2, *absorption (1 - open(-n)))
//   f        = mix(specular, albedo, metal);   fresnel(c) = f + (1 - f) (1 - max(0, c))^5
//   glint    = *light.color * visibility * fresnel(v.h) * (gloss + 8)/8 * max(0, n.h)^gloss * [n.l > 0]
//              gloss = 2^glossExponent; the whole term is left out when specular and metal are 0
//   mirror   = *reflection fresnel(n.v) open(r) surroundings(r)
//   color   = (1 - *metal) body (ambient + diffuse + through) + glint + mirror + *glow albedo^2
//   shown    = shoulder(exposure color), or color for exposure = 0
// The picture is clamped to [0,1], sRGB encoded and rounded to 8 bits.
//   surroundings(d): from horizon to top by d.y (2 - d.y) above, from horizon to bottom by min(1, -4 d.y) below
//   shoulder(c): p the largest channel; c for p <= 0.7; otherwise p' = 1 - 0.09 / (p - 0.4) and
//              mix(c p'/p, p', 1 - 1/(1 + 0.06 (p - p'))): smooth, below 1, and white where it is very bright
// The background is mix(bottom, top, t) with t running from 0 at the bottom edge of the picture to 1 at the top edge.
// The ground is shaded with specular = 0 and its color then mixed into the background by fade/(1 + fade), fade =
// (d/fadeDistance)^4, d the distance of the point from the ground's center.
//
// Openness. open(d) = sum over the axes a of d_a^2 O(a, sign of d_a), of six values O between 0 and 1: space is divided
// into cubes of side s, the least power of 2^(1/4) m not below twice the particles' mean radius, with corners at
// multiples of s (s is doubled until a box around all particles, ten cubes wider on each side, has at most a million).
// Every particle spreads its volume, in units of s^3, over the eight cubes whose middles surround its
// center, by trilinear weights; blurred with weights 1/4, 1/2, 1/4 along each of the three axes that is F. Along an
// axis' direction d,
//   O = 1/(1 + tau)^2,   tau = sum over j = 1...6 of (1 - (j - 1/2)/6) F(j cubes further along d),
// and at a place p it is interpolated (trilinearly) between the cubes' middles at p + 0.75 s d. A particle has the
// values at its center, the surface of metaballs the mean of the balls' weighted by their kernels, other surfaces those
// of the point itself.
//
// Soft shadows. With S = softness > 0 and the light's plane across l:
//   - Spheres: visibility = max(0, 1 - sum of covers). A sphere of radius R, its center q off the ray from the point to
//   the
//     light and H further along it, with H + sqrt(max(0, R^2 - q^2)) > R/100, covers edge((R - q)/w), w = S min(R,
//     H/2), edge(x) = t^2 (3 - 2 t), t = clamp(x + 1/2, 0, 1).
//   - Boxes cover edge(x/w): x the distance on that plane inwards from the nearest of the lines through the sides of
//   the
//     box' outline, w = S min(mean radius of the particles, E/2), E where the ray leaves the box, if it does after its
//     start.
//   - Metaballs: the mean of what rays to the light meet from p + 1.5 t n + 0.5 t l + the plane's points off it,
//   weighted
//     by a quadratic B-spline along both of its axes (3 t wide), t = S/2 mean radii; the axes are those of
//     light_space.h.
// Without (S = 0) edges are sharp, up to a pixel's width.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/overlay.h"

namespace render {

/// A particle: a lit sphere, or one ball of the metaball field.
struct Sphere {
    glm::vec3 center{0.0F};
    float radius = 0.1F;
    glm::vec3 color{0.8F};
};

enum class Style { spheres, metaballs };

/// draft: one sample a pixel. normal: antialiased silhouettes. final: 3 x 3 supersampling, averaged in linear light.
/// The surface of metaballs is found at every second pixel of every second row and between them where it is not smooth;
/// all over in final quality.
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
    bool shadows = true;    ///< no shadow pass is run without
    float softness = 0.0F;  ///< of shadows' edges, in radii of particles; at most 1
};

struct Ambient {
    glm::vec3 sky{0.35F};
    glm::vec3 ground{0.2F};
    float occlusion = 0.0F;  ///< 0: as bright in a crack as on a hill, 1: dark where no sky is seen
};

/// What mirrors show.
struct Surroundings {
    glm::vec3 top{0.9F};
    glm::vec3 horizon{0.6F};
    glm::vec3 bottom{0.2F};
};

/// How the particles' surface answers light; obstacles and ground are matt.
struct Surface {
    float specular = 0.0F;      ///< reflectance at normal incidence; 0 is matt and costs nothing
    int glossExponent = 6;      ///< the highlight's exponent is 2 to the power of this
    float reflection = 0.0F;    ///< of the surroundings, on top of Fresnel's term
    float metal = 0.0F;         ///< 1: no light leaves the body, and reflections have its color
    float roughness = 0.0F;     ///< 1: dust, as bright at its rim as in its middle
    float translucency = 0.0F;  ///< light from behind that thin parts let through
    float absorption = 0.0F;    ///< how much deeper the color of thick parts is
    float glow = 0.0F;          ///< light of its own
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

    bool operator==(const Background&) const = default;
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

/// plain: every ball where its particle is, with weight 1. smooth: the skin of a liquid rather than of a bag of balls.
enum class Skin { plain, smooth };

/// How far a ball of a smooth skin moves from its particle toward its neighbors' mean.
inline constexpr float kSkinPull = 0.85F;

/// The field of metaballs: sum over balls of weight (1 - d^2/R^2)^2 for d < R, with R = reach * radius. The surface is
/// where the field is (1 - 1/reach^2)^2, so that a lone ball keeps its radius. The normal is the negative gradient; the
/// color is the average of the balls' colors weighted by their kernels.
/// Smooth skin: with k = (1 - d^2/Q^2)^2 for all particles nearer than Q = reach times the mean of both radii (the
/// particle itself among them, k = 1), a ball's center is kSkinPull of the way from its particle to the mean of the
/// places weighted by k, and its weight is (sum of k)^(-3/4).
struct MetaballField {
    float reach = 2.5F;  ///< at least 1.2, at most 4
    Skin skin = Skin::plain;
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
    Surroundings surroundings;
    float exposure = 0.0F;  ///< multiplies all light before the shoulder; 0: no shoulder
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
