// The triangles of mesh obstacles that a picture may show, listed for its tiles. Made by cpu_renderer.cpp once for each
// picture, read by mesh_hits.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/drawn_meshes.h"
#include "render/prepare/cells/tiles.h"

namespace render {

/// A triangle on the picture.
struct TriangleBounds {
    Rect pixels;         ///< pixels whose samples it may cover; empty for a triangle that is not seen
    float front = 0.0F;  ///< least view depth of a corner, m
    float back = 0.0F;   ///< greatest view depth of a corner, m
};

struct MeshTiles {
    const DrawnMeshes* meshes = nullptr;  ///< null without meshes, and the lists below are empty
    /// Where each corner is seen, in pixels from the top left, and what is linear on the picture: in perspective 1 /
    /// its view depth, in parallel projection its view depth. Of no meaning for a corner that does not lie before the
    /// eye in perspective.
    std::vector<glm::vec3> corners;
    std::vector<float> depths;           ///< view depth of each corner, m
    std::vector<TriangleBounds> bounds;  ///< of each triangle
    CellLists tiles;                     ///< triangles that each tile may show, front to back
};

/// Whether a triangle is not seen as a whole: some corner lies behind the eye, or so near to its plane in comparison
/// with another that the place of the corner on the picture is not precise.
inline bool isCut(const CameraFrame& frame, float front, float back) {
    return frame.perspective && !(front > 1.0e-4F * back);
}

/// A point in homogeneous coordinates of the picture: (x w, y w, w) for a point that is seen at x and y, in pixels from
/// the top left. w is the view depth in perspective and 1 in parallel projection. The point may lie behind the eye.
/// @param point  in world axes, relative to the eye
glm::dvec3 homogeneousOnPicture(const CameraFrame& frame, glm::vec3 point);

/// Lists the triangles of each tile. Those that are turned away from the eye are left out where the eye is outside of
/// the box around their mesh: it cannot be inside of the solid, whose front hides them.
/// @param margin  how far beside a tile a triangle may lie that the tile lists, pixels
/// @param old     tiles that are no longer needed, whose memory is reused
MeshTiles meshTiles(const CameraFrame& frame, const DrawnMeshes& meshes, int margin, MeshTiles old);

}  // namespace render
