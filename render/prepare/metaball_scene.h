// The metaballs of one view as a camera, or the light, sees them: the balls of view.h's field in its coordinates,
// listed for each tile that their kernels reach. Made by the preparation of a view, read by everything that
// casts rays.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/cells/tiles.h"
#include "render/prepare/lighting/ambient_occlusion.h"
#include "render/prepare/skin/ellipsoid.h"
#include "render/prepare/skin/skin.h"

namespace render {

/// One ball of the field in view coordinates. Its kernel is (peak - d^2 slope^2)^2 up to the distance d = reach; in an
/// anisotropic skin it is that of its ellipsoid.
struct Metaball {
    glm::vec3 center{0.0F};
    float reach = 1.0F;  ///< how far the kernel reaches along the view depth, m: its radius if it is round
    float peak = 1.0F;   ///< square root of the ball's weight
    float slope = 1.0F;  ///< fourth root of the weight over the reach, 1/m; of no meaning for an ellipsoid
};

/// What a ball contributes to the surface around it, weighted by its kernel.
struct BallAttributes {
    glm::vec3 color{0.0F};
    SkyVisibility sky = kUnoccluded;
};

/// The balls of one view, and what casting rays at them depends on.
struct MetaballScene {
    CameraFrame frame;
    std::vector<Metaball> balls;
    std::vector<Ellipsoid> ellipsoids;       ///< shape of each ball of an anisotropic skin; empty in other skins
    std::vector<std::size_t> particles;      ///< index of the particle that each ball stands for
    std::vector<BallAttributes> attributes;  ///< attributes of each ball; without them, rays find depths only
    bool hasSky = false;                     ///< whether rays interpolate the balls' sky visibility
    CellLists tiles;                         ///< the balls whose kernels reach each tile, front to back
    float threshold = 0.5F;                  ///< value of the field at the surface of the metaballs
    float step = 0.05F;                      ///< view depth between two samples of the field on a ray, m
    float smallestRadius = 1.0F;             ///< smallest radius of the particles, at least a tenth of their mean, m
};

/// The balls of all particles whose radius is above zero, without attributes. The step between samples is half of the
/// smallest radius: metaball_test.cpp finds that no hit is missed, compared with the exact roots of the oracle.
/// @param balls  one per particle, as skinOf() makes them
MetaballScene metaballScene(const CameraFrame& frame, const View& view, std::span<const SkinBall> balls);

/// Sets the color and the sky visibility of each ball.
/// @param particleSky  sky visibility of each particle; empty if no term of the shading model needs it
void setAttributes(const View& view, std::span<const SkyVisibility> particleSky, MetaballScene& scene);

/// Limits within which the surface counts as smooth.
struct SmoothnessLimits {
    /// For a pixel between two hits: largest difference of its depths on the two tangent planes, and of the mean of
    /// these from its depth on the chord, m.
    float depth = 0.0F;
    /// A ray that misses the surface has no surface within a pixel of it if the field on it stays below this value.
    float maxField = 0.0F;
};

/// The limits for the balls of a scene.
SmoothnessLimits smoothnessLimits(const MetaballScene& scene);

}  // namespace render
