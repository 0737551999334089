// A view as both renderers take it: what is seen and what shades it, sorted into tiles of the picture and cells of the
// light's plane. Made by the Renderer for each picture. Positions are relative to the eye where nothing else is said.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/picture/camera_frame.h"
#include "render/picture/draw_times.h"
#include "render/picture/drawn_meshes.h"
#include "render/picture/view.h"
#include "render/prepare/cells/tiles.h"
#include "render/prepare/drawn_spheres.h"
#include "render/prepare/lighting/ambient_occlusion.h"
#include "render/prepare/lighting/depth_map_grid.h"
#include "render/prepare/lighting/glow_light.h"
#include "render/prepare/lighting/light_space.h"
#include "render/prepare/lighting/optical_depth_map.h"
#include "render/prepare/lighting/shadow_boxes.h"
#include "render/prepare/metaball_scene.h"
#include "render/prepare/rays/ball_cells.h"
#include "render/prepare/rays/field_cells.h"
#include "render/prepare/rays/solid_tree.h"
#include "render/prepare/screen_lines.h"
#include "render/prepare/skin/skin.h"

namespace render {

/// What a renderer wants to be prepared.
struct PrepareSettings {
    PictureSize size;
    int depthMapTexels = 1024;     ///< number of texels along the longer side of the metaballs' depth map
    int depthMapRaysPerTexel = 1;  ///< rays along each side of a texel: pixels of the picture that the light sees
    bool isShaded = true;          ///< whether light is computed; if not, nothing is prepared for it
};

struct PreparedView {
    const View* view = nullptr;  ///< the view without its strays
    PrepareSettings settings;
    CameraFrame frame;
    float meanRadius = 0.0F;  ///< mean radius of the particles, m

    DrawnSpheres drawn;
    std::vector<SphereAttributes> sphereAttributes;
    std::vector<ViewSphere> viewSpheres;  ///< the drawn spheres in view coordinates
    std::vector<Rect> spherePixels;       ///< bounds of the pixels that each drawn sphere may touch
    CellLists sphereTiles;                ///< drawn spheres of each tile, front to back

    bool hasMetaballs = false;
    std::vector<SkinBall> skin;  ///< in world coordinates; only with metaballs, as the next three
    MetaballScene metaballs;
    DepthMapGrid depthMap;         ///< empty unless metaballs cast shadows
    OpticalDepthMap opticalDepth;  ///< empty unless metaballs are transparent and cast shadows
    MetaballScene lightMetaballs;  ///< the metaballs as the light sees them, for the depth map; without attributes

    bool hasTransparency = false;  ///< whether rays are followed through transparent bodies
    BallCells ballCells;           ///< the metaballs for these rays; only with metaballs and transparency
    FieldCells fieldCells;         ///< of these balls
    SolidTree solids;              ///< everything else but the ground for these rays; only with transparency

    DrawnMeshes meshes;         ///< the mesh obstacles at their places
    DepthMapGrid meshDepthMap;  ///< of the heights of meshes over the light's plane; empty unless they cast shadows

    LineList lines;
    std::vector<float> boxFronts;       ///< view depths that no point of a box is before, m
    CellLists boxTiles;                 ///< boxes that a tile or a line in it may show, front to back
    std::vector<TileKind> groundTiles;  ///< per tile: what it shows as long as nothing stands before the ground

    LightBasis light;
    LightGrid lightGrid;              ///< empty unless spheres cast shadows
    ShadowBoxes shadowBoxes;          ///< empty unless boxes cast shadows
    LightBoxGrid lightBoxes;          ///< of shadowBoxes
    bool needsSkyVisibility = false;  ///< whether some term of the shading model needs it
    SkyVisibilityGrid skyGrid;        ///< empty unless needed or particles glow
    SkyVisibilityMap groundSky;
    std::vector<SkyVisibility> particleSky;
    GlowGrid glowGrid;  ///< empty unless particles glow

    std::optional<View> withoutStrays;  ///< what `view` points to if strays were removed

    /// Height of the ground over the eye, m.
    std::optional<float> groundHeight() const {
        return view->ground ? std::optional(view->ground->height - frame.eye.y) : std::nullopt;
    }
    /// How far beside a tile rays through the points of a line that are nearest to the tile's pixels may pass, pixels:
    /// half the width of the widest line.
    int lineMargin() const;
    /// Whether ambient light is occluded.
    bool hasOcclusion() const { return needsSkyVisibility && view->ambient.occlusion > 0.0F; }
};

/// Prepares a view, which must outlive what is prepared.
/// @param prepared  overwritten; its memory is reused
/// @param times     the times of the stages are added to it
void prepareView(const View& view, const PrepareSettings& settings, PreparedView& prepared, DrawTimes& times);

}  // namespace render
