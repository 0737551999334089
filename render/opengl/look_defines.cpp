// One definition a term, each on the condition under which shading_model.h has the term.
#include "render/opengl/look_defines.h"

#include <fmt/format.h>

#include "render/opengl/metaball_passes.h"

namespace render {

namespace {

void addIf(bool condition, const char* define, Defines& defines) {
    if (condition) defines.emplace_back(define);
}

/// The terms of the light that reaches what the tiles show.
void addLight(const PreparedView& prepared, TileClass kind, Defines& defines) {
    const View& view = *prepared.view;
    const bool castsShadows = view.light.shadows && kind != TileClass::openGround;
    const bool bySpheres = castsShadows && !prepared.lightGrid.empty();
    const bool byBoxes = castsShadows && !prepared.shadowBoxes.boxes.empty();
    addIf(bySpheres, "SPHERE_SHADOWS", defines);
    addIf(byBoxes, "BOX_SHADOWS", defines);
    addIf(byBoxes && !prepared.lightBoxes.isFew(), "BOX_CELLS", defines);
    const bool byMetaballs = castsShadows && !prepared.depthMap.empty();
    addIf(byMetaballs, "METABALL_SHADOWS", defines);
    const bool byMeshes = castsShadows && !prepared.meshDepthMap.empty();
    addIf(byMeshes, "MESH_SHADOWS", defines);
    addIf(bySpheres || byBoxes || byMetaballs || byMeshes, "SHADOWS", defines);
    addIf(view.light.softness > 0.0F, "SOFT", defines);
    const bool isOccluded = prepared.hasOcclusion() && kind != TileClass::openGround;
    addIf(isOccluded, "OCCLUSION", defines);
    addIf(!prepared.glowGrid.empty() && kind != TileClass::openGround, "GLOW_LIGHT", defines);
    const bool isThroughMetaballs = prepared.hasMetaballs && view.surface.medium.isTransparent();
    addIf(isThroughMetaballs, "METABALL_MEDIUM", defines);
    addIf(castsShadows && !prepared.opticalDepth.empty(), "LIGHT_TINT", defines);
    addIf(isOccluded && view.ground, "GROUND_OCCLUSION", defines);
}

/// The terms that particles alone have.
void addSurface(const PreparedView& prepared, Defines& defines) {
    const Surface& surface = prepared.view->surface;
    addIf(prepared.needsSkyVisibility, "PARTICLE_SKY", defines);
    addIf(surface.specular > 0.0F || surface.metal > 0.0F, "HIGHLIGHT", defines);
    addIf(surface.metal > 0.0F, "METAL", defines);
    addIf(surface.reflection > 0.0F, "REFLECTION", defines);
    addIf(prepared.view->light.rim != glm::vec3(0.0F), "RIM", defines);
    addIf(surface.roughness > 0.0F, "ROUGHNESS", defines);
    addIf(surface.translucency > 0.0F, "TRANSLUCENCY", defines);
    addIf(surface.absorption > 0.0F, "ABSORPTION", defines);
    addIf(surface.glow > 0.0F, "GLOW", defines);
}

}  // namespace

Defines lookDefines(const PreparedView& prepared, TileClass kind) {
    const View& view = *prepared.view;
    Defines defines;
    addIf(prepared.frame.perspective, "PERSPECTIVE", defines);
    addIf(prepared.frame.middle != glm::vec2(0.0F), "SHIFTED", defines);
    if (kind == TileClass::background) return defines;
    addIf(view.ground.has_value(), "GROUND", defines);
    addIf(view.exposure > 0.0F, "EXPOSURE", defines);
    addLight(prepared, kind, defines);
    if (kind == TileClass::openGround || kind == TileClass::occludedGround) return defines;
    addSurface(prepared, defines);
    addIf(!prepared.viewSpheres.empty(), "SPHERES", defines);
    addIf(prepared.hasMetaballs, "METABALLS", defines);
    addIf(prepared.hasMetaballs && hasOneReach(prepared.metaballs), "ONE_REACH", defines);
    addIf(prepared.hasMetaballs && !prepared.metaballs.ellipsoids.empty(), "ELLIPSOIDS", defines);
    if (occludesObstacles(prepared)) {
        defines.emplace_back("OBSTACLE_OCCLUSION");
        defines.push_back(fmt::format("SKY_SAMPLE_OFFSET {:.2f}", kSkySampleOffset));
    }
    if (prepared.hasTransparency) {
        defines.emplace_back("TRANSPARENCY");
        addIf(!view.boxObstacles.empty(), "VIEW_BOXES", defines);
        addIf(!prepared.meshes.empty(), "VIEW_MESHES", defines);
    }
    if (kind == TileClass::objects) return defines;
    addIf(!view.boxObstacles.empty(), "BOXES", defines);
    addIf(!prepared.meshes.empty(), "MESHES", defines);
    addIf(!prepared.lines.lines.empty(), "LINES", defines);
    return defines;
}

}  // namespace render
