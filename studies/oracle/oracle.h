// The oracle of pictures: a slow, exact, obvious ray caster in double precision. It shares nothing with render/ but the
// input, render/picture/view.h, whose comments are the shading model that it realizes. Used by the renderer's tests and
// by the study of pictures.
//
// Conventions where view.h leaves room:
//   - Spheres, boxes and the metaball surface are solid: a ray that starts inside one hits it at distance 0. The normal
//     there is a sphere's radial direction, that of a box's nearest face, the field's negative gradient; where there is
//     none, it points against the ray.
//   - Rays start at the eye (orthographic: on the plane through the eye) with no near plane; nothing behind it is seen.
//   - The ground is one-sided in shading, not in sight: its normal is +y also when it is seen from below.
//   - The fade's d is the distance in space, height included; the fade mixes the unclamped ground color.
//   - toLight is scaled to unit length. The lines of View::edges are left out.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"
#include "studies/oracle/ball_grid.h"
#include "studies/oracle/oracle_sky.h"

namespace oracle {

using glm::dvec3;

/// What a ray meets first.
struct Hit {
    enum class Kind : std::uint8_t { none, particle, sphereObstacle, boxObstacle, ground };
    Kind kind = Kind::none;
    double distance = std::numeric_limits<double>::infinity();  ///< m along the ray from its origin, not a depth
    dvec3 point{0.0};
    dvec3 normal{0.0};  ///< unit length, outwards
    dvec3 albedo{0.0};
    SixValues open = kAllOpen;
};

/// A ball of the metaball field.
struct Ball {
    dvec3 center{0.0};
    double reach = 0.0;
    double weight = 1.0;
};

/// The balls of a view, one a particle, by its skin.
std::vector<Ball> ballsOf(const render::View& view);

/// A view with what takes long to find for each ray anew. The view must outlive it.
struct Scene {
    /// Balls sorted by place, or, everyone, each tried for each ray.
    explicit Scene(const render::View& view_, bool everyone = false);

    const render::View& view;
    std::vector<Ball> balls;
    BallGrid crowd;
    Sky sky;
};

/// A part of a picture: columns and rows from (x, y) on.
struct Window {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// A picture, or a window of it, without the lines of View::edges; row by row from the top left.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  ///< sRGB, 3 bytes a pixel
    std::vector<Hit::Kind> kinds;   ///< what the ray through the pixel's center meets
    std::vector<double> distances;  ///< its Hit::distance, infinity where it meets nothing
    std::vector<dvec3> normals;     ///< its Hit::normal
};

/// The ray through the point (px, py) of the picture in pixels: (0, 0) is the picture's top left corner, (0.5, 0.5)
/// the center of its first pixel. The camera's field of view or half height spans the picture's height.
/// An eye at its target, or an up along the view, is an error.
Ray pixelRay(const render::View& view, render::PictureSize size, double px, double py);

/// The nearest surface along a ray, every surface tried; Kind::none where there is none.
Hit trace(const render::View& view, const Ray& ray);
Hit trace(const Scene& scene, const Ray& ray);

/// The metaball field at a point; the surface is where it equals fieldThreshold.
double fieldAt(const render::View& view, const dvec3& point);
double fieldThreshold(const render::View& view);

/// Whether particles (spheres or the metaball surface, by style) or obstacles, but not the ground, hide the light from
/// a point of a surface with this normal; a hard shadow. Light::shadows is not looked at: shade does that.
bool inShadow(const Scene& scene, const dvec3& point, const dvec3& normal);

/// How much of the light reaches a point of a surface with this normal, by view.h's soft shadows, or 0 or 1 by
/// inShadow.
double visibility(const Scene& scene, const dvec3& point, const dvec3& normal);

/// Linear color of what a ray meets, before the clamp to [0,1]; screenT runs from 0 at the picture's bottom edge
/// to 1 at its top edge.
dvec3 shade(const render::View& view, const Hit& hit, const Ray& ray, double screenT);
dvec3 shade(const Scene& scene, const Hit& hit, const Ray& ray, double screenT);

/// Linear [0,1] to 8-bit sRGB by the standard's formula, rounded to nearest; anything else is an error.
std::uint8_t encodeSrgb(double linear);

/// The picture, each pixel the mean in linear light of samplesPerAxis^2 samples on a regular grid, each clamped
/// before the mean.
Picture draw(const render::View& view, render::PictureSize size, int samplesPerAxis);
/// A window of that picture.
Picture drawWindow(const Scene& scene, render::PictureSize size, const Window& window, int samplesPerAxis);

}  // namespace oracle
