// Triangles with Highway, one ray per lane; this file is compiled once per instruction set.
//
// Let P0, P1, P2 be the corners of a triangle in homogeneous coordinates of the picture, and d = (x, y, 1) a point of
// the picture. The ray through it meets the plane of the triangle at l0 P0 + l1 P1 + l2 P2 = t d, from which by
// Cramer's rule
//   l0 = t dot(d, cross(P1, P2)) / det,  and l1, l2 likewise,  with  det = dot(P0, cross(P1, P2)),
// so that the ray meets the triangle before the eye where the three edge functions dot(d, cross(Pi, Pj)) have the sign
// of det. Nothing needs to be clipped at the eye's plane (Olano and Greer 1997, triangle scan conversion using 2D
// homogeneous coordinates). As l0 + l1 + l2 = 1, the sum of the edge functions over det is 1/t. In perspective t is the
// view depth; in parallel projection, where w is 1, the depth is l0 z0 + l1 z1 + l2 z2. Both are linear in d.
//
// The coefficients are computed in double precision for the corner of a tile. Two triangles that share an edge have
// the same coefficients for it, but for the sign: rounding never opens a gap between them.
#include "render/cpu/raster/mesh_hits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/raster/mesh_hits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_rays-inl.h"

#ifndef RENDER_MESH_HITS_SETUP
#define RENDER_MESH_HITS_SETUP
namespace render {

/// A triangle as seen from a tile. A vector stands for a linear function of a point of the picture: x and y are
/// multiplied by the point's distances from the tile's corner, in pixels, and z is added.
struct TriangleSetup {
    std::array<glm::vec3, 3> edges;  ///< edge functions, which are positive inside
    glm::vec3 depth;                 ///< 1 / view depth in perspective, view depth in parallel projection
    float front = 0.0F;
    float back = 0.0F;
};

/// A power of two about as large as 1 / a positive number.
inline double inversePowerOfTwo(double number) {
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(number) >> 52U & 0x7ffU;
    return std::bit_cast<double>(std::clamp<std::uint64_t>(2046U - exponent, 1U, 2046U) << 52U);
}

inline TriangleSetup triangleSetup(const MeshTiles& meshes, bool perspective, std::uint32_t index, glm::dvec2 corner) {
    using glm::dvec3;
    const auto& [a, b, c] = meshes.meshes->triangles[index].corners;
    const dvec3& p0 = meshes.corners[a];
    const dvec3& p1 = meshes.corners[b];
    const dvec3& p2 = meshes.corners[c];
    const std::array<dvec3, 3> normals{cross(p1, p2), cross(p2, p0), cross(p0, p1)};
    const double volume = dot(p0, normals[0]);
    const auto atCorner = [&](const dvec3& plane) {
        return dvec3(plane.x, plane.y, plane.x * corner.x + plane.y * corner.y + plane.z);
    };
    double most = 0.0;
    TriangleSetup setup;
    std::array<dvec3, 3> edges;
    for (std::size_t k = 0; k < 3; ++k) {
        edges[k] = atCorner(normals[k]);
        most = std::max({most, std::abs(edges[k].x), std::abs(edges[k].y), std::abs(edges[k].z)});
    }
    // Scaling by a power of two rounds nothing, so that the functions of a shared edge stay the same.
    const double scale = std::copysign(inversePowerOfTwo(most), volume);
    for (std::size_t k = 0; k < 3; ++k) setup.edges[k] = glm::vec3(scale * edges[k]);
    const dvec3 sum = perspective ? normals[0] + normals[1] + normals[2]
                                  : normals[0] * double(meshes.depths[a]) + normals[1] * double(meshes.depths[b]) +
                                        normals[2] * double(meshes.depths[c]);
    setup.depth = glm::vec3(atCorner(sum) / volume);
    setup.front = meshes.bounds[index].front;
    setup.back = meshes.bounds[index].back;
    return setup;
}

}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The rays of a tile's samples: positions in pixels from the tile's corner.
struct MeshRays {
    alignas(64) std::array<std::array<float, kTilePixels>, 4> x, y;
    alignas(64) std::array<float, kTilePixels> farthest;  ///< the greatest depth of a pixel's samples so far

    MeshRays(glm::vec2 corner, std::span<const TileRays> samples) {
        const D d;
        for (std::size_t first = 0; first < kTilePixels; first += hn::Lanes(d)) {
            V most = splat(0.0F);
            for (std::size_t s = 0; s < samples.size(); ++s) {
                store(load(&samples[s].x[first]) - splat(corner.x), &x[s][first]);
                store(load(&samples[s].y[first]) - splat(corner.y), &y[s][first]);
                most = hn::Max(most, load(&samples[s].depth[first]));
            }
            store(most, &farthest[first]);
        }
    }

    float farthestOfTile() const {
        const D d;
        V most = load(farthest.data());
        for (std::size_t first = hn::Lanes(d); first < kTilePixels; first += hn::Lanes(d))
            most = hn::Max(most, load(&farthest[first]));
        return hn::GetLane(hn::MaxOfLanes(d, most));
    }
};

/// Adds one triangle to one vector of rays of sample s.
template <bool kPerspective>
HWY_INLINE void addTriangle(const TriangleSetup& setup, std::int32_t id, const MeshRays& rays, std::size_t s,
                            std::size_t first, TileRays& sample) {
    const V x = load(&rays.x[s][first]);
    const V y = load(&rays.y[s][first]);
    const auto valueOf = [&](glm::vec3 plane) { return splat(plane.x) * x + splat(plane.y) * y + splat(plane.z); };
    const V least = hn::Min(valueOf(setup.edges[0]), hn::Min(valueOf(setup.edges[1]), valueOf(setup.edges[2])));
    M isHit = least >= splat(0.0F);
    if (none(isHit)) return;
    const V linear = valueOf(setup.depth);
    V depth = linear;
    if constexpr (kPerspective) {
        // On the edge of a triangle that is seen at a grazing angle rounding may make the sum 0 or less: it is clamped.
        depth = splat(1.0F) / hn::Max(linear, splat(1.0e-37F));
    } else {
        isHit = hn::And(isHit, linear > splat(0.0F));
    }
    depth = hn::Min(hn::Max(depth, splat(setup.front)), splat(setup.back));
    isHit = hn::And(isHit, depth < load(&sample.depth[first]));
    store(hn::IfThenElse(isHit, depth, load(&sample.depth[first])), &sample.depth[first]);
    storeInt(hn::IfThenElse(hn::RebindMask(DI(), isHit), splatInt(id), loadInt(&sample.hitId[first])),
             &sample.hitId[first]);
}

template <bool kPerspective>
void addTriangles(const SolidGeometry& geometry, std::size_t tile, bool isAnywhere, std::span<TileRays> samples) {
    const D d;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    const MeshTiles& meshes = *geometry.meshes;
    const glm::vec2 corner = tileCorner(*geometry.tiles, tile);
    MeshRays rays(corner, samples);
    for (const std::uint32_t index : meshes.tiles.itemsOf(tile)) {
        const TriangleBounds& bounds = meshes.bounds[index];
        const Rect touched = isAnywhere
                                 ? Rect{0, 0, kTileSize - 1, kTileSize - 1}
                                 : withinTile(bounds.pixels, static_cast<int>(corner.x), static_cast<int>(corner.y));
        if (touched.x1 < touched.x0 || touched.y1 < touched.y0) continue;
        // The triangles are listed front to back: all later ones are behind what has been hit.
        if (bounds.front > rays.farthestOfTile()) break;
        const TriangleSetup setup = triangleSetup(meshes, kPerspective, index, glm::dvec2(corner));
        const std::int32_t id = kHitTriangle + static_cast<std::int32_t>(index);
        for (int row = touched.y0; row <= touched.y1; ++row) {
            for (int column = touched.x0 / lanes * lanes; column <= touched.x1; column += lanes) {
                const auto first = static_cast<std::size_t>(row * kTileSize + column);
                if (hn::AllTrue(d, load(&rays.farthest[first]) < splat(bounds.front))) continue;
                V most = splat(0.0F);
                for (std::size_t s = 0; s < samples.size(); ++s) {
                    addTriangle<kPerspective>(setup, id, rays, s, first, samples[s]);
                    most = hn::Max(most, load(&samples[s].depth[first]));
                }
                store(most, &rays.farthest[first]);
            }
        }
    }
}

void findHits(const SolidGeometry& geometry, std::size_t tile, bool isAnywhere, std::span<TileRays> samples) {
    geometry.frame.perspective ? addTriangles<true>(geometry, tile, isAnywhere, samples)
                               : addTriangles<false>(geometry, tile, isAnywhere, samples);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

namespace {

HWY_EXPORT(findHits);

// Two triangles may belong to one smooth surface if the cosine between their normals is at least this. Chosen: a fold
// by as much, 18 degrees, cannot be told from a bend within one pixel.
constexpr float kSmooth = 0.95F;

bool isTriangle(std::int32_t hitId) {
    return hitId >= kHitTriangle && hitId < kHitBox;
}

bool haveSharedCorner(const DrawnTriangle& a, const DrawnTriangle& b) {
    return std::ranges::any_of(a.corners, [&](std::uint32_t corner) {
        return corner == b.corners[0] || corner == b.corners[1] || corner == b.corners[2];
    });
}

/// Whether two samples of a pixel hit the same smooth surface: triangles that share a corner, where normals and
/// positions are the same, or triangles of one mesh with nearly the same normal at nearly the same depth.
bool isSmooth(const SolidGeometry& geometry, std::int32_t a, std::int32_t b, float depthA, float depthB) {
    const MeshTiles& meshes = *geometry.meshes;
    const auto first = static_cast<std::size_t>(a - kHitTriangle);
    const auto second = static_cast<std::size_t>(b - kHitTriangle);
    const DrawnTriangle& one = meshes.meshes->triangles[first];
    const DrawnTriangle& other = meshes.meshes->triangles[second];
    if (one.mesh != other.mesh) return false;
    if (haveSharedCorner(one, other)) return true;
    const glm::vec3 normal = meshes.bounds[first].normal;
    if (dot(normal, meshes.bounds[second].normal) < kSmooth) return false;
    const CameraFrame& frame = geometry.frame;
    const float pixel = frame.pixelWidth() * (frame.perspective ? std::min(depthA, depthB) : 1.0F);
    // Within a pixel a surface at this angle to the view gets deeper by pixel / cosine; twice that for its bend.
    const float cosine = std::max(std::abs(dot(normal, frame.forward)), 0.05F);
    return std::abs(depthA - depthB) <= 2.0F * pixel / cosine;
}

}  // namespace

void findMeshHits(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples) {
    HWY_DYNAMIC_DISPATCH(findHits)(geometry, tile, false, samples);
}

void findMeshHitsAnywhere(const SolidGeometry& geometry, std::size_t tile, TileRays& rays) {
    HWY_DYNAMIC_DISPATCH(findHits)(geometry, tile, true, {&rays, 1});
}

void mergeSmoothHits(const SolidGeometry& geometry, std::span<TileRays> samples) {
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        for (std::size_t s = 1; s < samples.size(); ++s) {
            const std::int32_t id = samples[s].hitId[k];
            if (id == samples[0].hitId[k] || !isTriangle(id)) continue;
            for (std::size_t earlier = 0; earlier < s; ++earlier) {
                const std::int32_t other = samples[earlier].hitId[k];
                if (other == id) break;
                if (!isTriangle(other) ||
                    !isSmooth(geometry, other, id, samples[earlier].depth[k], samples[s].depth[k]))
                    continue;
                samples[s].hitId[k] = other;
                break;
            }
        }
    }
}

}  // namespace render

#endif
