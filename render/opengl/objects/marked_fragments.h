// Fragments of a target that a pass has marked to be drawn again in a more expensive way. They are few and scattered,
// and are drawn side by side in a target of their own: llvmpipe draws eight fragments at a time, and GPUs 32, whether
// all of them are wanted or one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/opengl/objects/gl_objects.h"
#include "render/opengl/objects/shader_program.h"

namespace render {

class MarkedFragments {
 public:
    explicit MarkedFragments(const Gl& gl) : marked_(gl, GL_R32I) {}

    /// Lists the marked fragments of some tiles, in groups of eight of one tile, which run through the same lists of
    /// spheres and balls.
    /// @param isMarked  isMarked(column + row * width) tells whether a fragment is marked
    /// @param size      of the target
    /// @param tileSize  pixels of the target along a side of a tile
    /// @param tiles     indices of the tiles
    template <typename IsMarked>
    void list(const IsMarked& isMarked, PictureSize size, int tileSize, std::span<const std::int32_t> tiles) {
        groups_.clear();
        for (const std::int32_t tile : tiles) addTile(isMarked, size, tileSize, tile);
        finish(size, tileSize);
    }

    bool empty() const { return groups_.empty(); }

    /// The size of the target in which they lie side by side.
    PictureSize size() const { return {kColumns, static_cast<int>(placesOfPixels_.size()) / kColumns}; }

    /// Binds the list to the sampler of shaders/place.glsl.
    TextureBinding binding() const { return {"marked", GL_TEXTURE_BUFFER, marked_.texture()}; }
    /// The numbers with which place.glsl finds a fragment's place: columns of this target and of the marked one,
    /// columns of tiles, pixels along a side of a tile.
    glm::vec4 grid() const { return grid_; }

    /// For each pixel of this target, row by row: the place of its fragment in the marked target, as
    /// column + row * width. Several pixels may stand for one fragment.
    std::span<const std::int32_t> placesOfPixels() const { return placesOfPixels_; }

 private:
    static constexpr int kColumns = 64;
    static constexpr std::size_t kGroup = 8;  // fragments of 4 x 2 pixels, which llvmpipe draws together

    template <typename IsMarked>
    void addTile(const IsMarked& isMarked, PictureSize size, int tileSize, std::int32_t tile);
    void finish(PictureSize size, int tileSize);

    std::vector<std::int32_t> groups_;  // places of the marked fragments, group after group
    std::vector<std::int32_t> placesOfPixels_;
    TextureBuffer marked_;
    glm::vec4 grid_{0.0F};
};

template <typename IsMarked>
void MarkedFragments::addTile(const IsMarked& isMarked, PictureSize size, int tileSize, std::int32_t tile) {
    const int columns = size.width / tileSize;
    const int left = tile % columns * tileSize;
    const int top = tile / columns * tileSize;
    for (int row = top; row < top + tileSize; ++row)
        for (int column = left; column < left + tileSize; ++column) {
            const std::int32_t place = column + row * size.width;
            if (isMarked(static_cast<std::size_t>(place))) groups_.push_back(place);
        }
    // A group is completed by its last fragment.
    while (groups_.size() % kGroup != 0) groups_.push_back(groups_.back());
}

}  // namespace render
