// A prepared view in OpenGL's memory, uploaded once for each picture.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/opengl/objects/gl_objects.h"
#include "render/opengl/objects/shader_program.h"
#include "render/prepare/prepared_view.h"

namespace render {

/// What a pass over the picture draws: tiles of one kind.
enum class TileClass : std::uint8_t {
    background,      ///< nothing but the background
    openGround,      ///< nothing but ground that nothing occludes
    occludedGround,  ///< nothing but ground
    objects,         ///< spheres and metaballs, and what is behind them
    flats            ///< boxes, meshes and lines as well
};
inline constexpr std::size_t kTileClassCount = 5;

/// The lists of a view that lie one after another in two buffers, in the order of shaders/lists.glsl: first those of
/// whole numbers, then those of texels.
enum class ViewList : std::uint8_t {
    sphereBegins,
    sphereItems,
    boxBegins,
    lineBegins,
    lineItems,
    casterBegins,
    boxCasterBegins,
    spheres,
    tileSpheres,
    boxes,
    tileBoxes,
    lines,
    casters,
    boxCasters
};
inline constexpr std::size_t kViewListCount = 14;

class ViewBuffers {
 public:
    explicit ViewBuffers(const Gl& gl);

    /// @param meshTiles  per tile: whether it may show a mesh; empty without meshes
    /// @throws OpenGlError if a list is too long for OpenGL, or memory runs out
    void upload(const PreparedView& view, std::span<const char> meshTiles);

    /// The samplers of the shaders and their textures.
    std::vector<TextureBinding> bindings() const;

    /// Indices of the tiles of a class.
    std::span<const std::int32_t> tileIndices(TileClass kind) const {
        return tileIndices_[static_cast<std::size_t>(kind)];
    }
    TextureBinding tiles(TileClass kind) const {
        return {"tiles", GL_TEXTURE_BUFFER, tiles_[static_cast<std::size_t>(kind)].texture()};
    }

 private:
    void uploadTiles(const PreparedView& view, std::span<const char> meshTiles);
    void addSpheres(const PreparedView& view);
    void addCasters(const PreparedView& view);
    void addBoxes(const PreparedView& view);
    void addLines(const PreparedView& view);
    void uploadSky(const PreparedView& view);

    /// Appends a list of whole numbers.
    void add(ViewList list, std::span<const std::uint32_t> numbers);
    /// Appends a list of texels, which are to be filled in.
    std::span<glm::vec4> addTexels(ViewList list, std::size_t count);

    std::vector<std::int32_t> numbers_;  ///< of `lists`, which begin with the place of each list
    std::vector<glm::vec4> texels_;      ///< of `listedTexels`
    TextureBuffer lists_, listedTexels_, sphereAttributes_, groundSky_, skyGrid_, glowGrid_;
    std::array<TextureBuffer, kTileClassCount> tiles_;
    std::array<std::vector<std::int32_t>, kTileClassCount> tileIndices_;
};

/// Whether a view has obstacles that ambient occlusion darkens.
bool occludesObstacles(const PreparedView& view);

}  // namespace render
