// The oracle of pictures: a slow, exact and simple ray caster in double precision. It shares nothing with render/ but
// the input, render/picture/view.h, and computes the model of render/picture/shading_model.h. Used by the renderer's
// tests and by the study of pictures.
//
// Conventions where the shading model leaves room:
//   - Spheres, boxes and the metaball surface are solid: a ray that starts inside one hits it at distance 0. The normal
//     there is a sphere's radial direction, the normal of a box's nearest face, or the negative gradient of the field;
//     where that is zero, the normal points against the ray.
//   - A mesh is its surface: a ray that starts inside one meets the inner side of the surface, whose normal points to
//     the inside.
//   - Rays start at the eye (orthographic: on the plane through the eye) with no near plane. Nothing behind it is seen.
//   - The ground can be seen from both sides, but its normal is always +y.
//   - The fade of the ground depends on the distance in space, height included, and mixes the unclamped color.
//   - toLight is scaled to unit length. The lines of View::edges are left out.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"
#include "studies/oracle/ball_grid.h"
#include "studies/oracle/box_union.h"
#include "studies/oracle/glow_light.h"
#include "studies/oracle/intersections.h"
#include "studies/oracle/mesh_tree.h"
#include "studies/oracle/sky_visibility.h"

namespace oracle {

/// A ball that contributes to the metaball field.
struct Ball {
    dvec3 center{0.0};
    double reach = 0.0;  ///< greatest distance at which the contribution ends, m: R of view.h if the ball is round
    double weight = 1.0;
    glm::dmat3 form{1.0};  ///< M of view.h, 1/m^2, in an anisotropic skin; else I/R^2
};

/// The balls of a view's metaball field, one for each particle, as view.h makes them for its skin.
std::vector<Ball> ballsOf(const render::View& view);

/// A view with all that is computed once for all rays. Holds a reference to the view.
struct Scene {
    /// @param bruteForce  try every ball for every ray, instead of sorting the balls into a grid
    explicit Scene(const render::View& view_, bool bruteForce = false);

    const render::View& view;
    std::vector<Ball> balls;
    std::optional<BallGrid> grid;  ///< grid of the balls; empty: every ball is tried for every ray
    SkyVisibility sky;
    MeshTree meshes;
    std::vector<SignedBox> shadowBoxes;
    GlowLight glow;

    /// The indices of all balls that a ray may cross, and perhaps of some that it misses.
    Indices ballsAlong(const Ray& ray) const;
};

/// A rectangle of pixels of a picture, whose top left pixel is (x, y).
struct Window {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// The pixels of a picture, or of a window of it, row by row from the top left.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  ///< colors in sRGB, 3 bytes a pixel
    std::vector<Hit::Kind> kinds;   ///< kind of surface that the ray through each pixel's center meets
    std::vector<double> distances;  ///< distance of the surface at each pixel's center, m; infinity for none
    std::vector<dvec3> normals;     ///< normal of the surface at each pixel's center
};

/// The ray through the point (px, py) of the picture in pixels: (0, 0) is the picture's top left corner, (0.5, 0.5)
/// the center of its first pixel. The camera's field of view or half height spans the picture's height.
/// @throws std::domain_error if the eye is at its target, or up is parallel to the view
Ray pixelRay(const render::View& view, render::PictureSize size, double px, double py);

/// The nearest hit along a ray; Kind::none if there is none. With a view in place of a scene, every ball is tried.
Hit trace(const render::View& view, const Ray& ray);
Hit trace(const Scene& scene, const Ray& ray);

/// The metaball field of a view at a point. The metaball surface is where it equals fieldThreshold(). With a view in
/// place of a scene, every ball is placed anew, which takes far longer.
double fieldAt(const render::View& view, const dvec3& point);
double fieldAt(const Scene& scene, const dvec3& point);
/// The contributions of some balls to the metaball field at a point.
double fieldAt(const Scene& scene, const Indices& balls, const dvec3& point);
double fieldThreshold(const render::View& view);

/// Mean radius of the particles, m; 0 without particles.
double meanRadius(const render::View& view);

/// Whether a point of a surface with this normal lies in a hard shadow of particles (spheres or the metaball surface,
/// by style) or of obstacles. Light::shadows is ignored here; shade() respects it.
bool isInShadow(const Scene& scene, const dvec3& point, const dvec3& normal);

/// The share of the light that reaches a point of a surface with this normal: lightVisibility in shading_model.h, of
/// the color that most of it reaches. If the light has no softness and no metaballs are transparent, it is 0 or 1 by
/// isInShadow().
double lightVisibility(const Scene& scene, const dvec3& point, const dvec3& normal);

/// The share of the light's red, green and blue that reaches a point of a surface with this normal. Transparent
/// metaballs color it.
dvec3 lightReaching(const Scene& scene, const dvec3& point, const dvec3& normal);

/// What a transparent body shows of its own.
struct OwnLight {
    double bodyShare = 1.0;  ///< share of the body's color that is seen
    dvec3 added{0.0};        ///< light that is mirrored beside the surface's own terms
};

/// The linear color of the surface that a ray meets, or of the background, before it is clamped to [0, 1].
/// @param screenT  height in the picture: 0 at the picture's bottom edge, 1 at its top edge
dvec3 shade(const render::View& view, const Hit& hit, const Ray& ray, double screenT);
dvec3 shade(const Scene& scene, const Hit& hit, const Ray& ray, double screenT, const OwnLight& own = {});

/// What a mirror shows in a direction: surroundings(d) of shading_model.h.
dvec3 surroundings(const render::View& view, const dvec3& d);

/// Direction to the light, unit length.
dvec3 unitToLight(const render::View& view);

/// The nearest point of the metaball surface along a ray; Kind::none if there is none.
/// @param isInside  whether the ray begins inside the metaballs
Hit traceField(const Scene& scene, const Ray& ray, bool isInside);

/// Whether a ray from outside meets the metaballs.
bool isFieldMet(const Scene& scene, const Ray& ray);

/// The nearest point along a ray of anything but metaballs; Kind::none if there is none.
Hit traceSolids(const Scene& scene, const Ray& ray);

/// Threshold of a pixel of the picture: (m + 1/2)/64 of section 5 of shading_model.h.
double ditherThreshold(int x, int y);

/// Converts a linear value to 8-bit sRGB by the formula of the standard. What it exceeds a whole step by is rounded up
/// from 1 - threshold on; by default to the nearest.
/// @throws std::domain_error if the value is not in [0, 1]
std::uint8_t encodeSrgb(double linear, double threshold = 0.5);

/// Draws a picture, or a window of it. Each pixel is the mean in linear light of samplesPerAxis^2 samples on a regular
/// grid, each of which is clamped to [0, 1] before.
Picture draw(const render::View& view, render::PictureSize size, int samplesPerAxis);
Picture drawWindow(const Scene& scene, render::PictureSize size, const Window& window, int samplesPerAxis);

}  // namespace oracle
