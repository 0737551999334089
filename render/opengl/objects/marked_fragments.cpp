// Groups are laid out as blocks of 4 x 2 pixels, sixteen in a row.
#include "render/opengl/objects/marked_fragments.h"

namespace render {

void MarkedFragments::finish(PictureSize size, int tileSize) {
    constexpr std::size_t kBlocks = kColumns / 4;  // blocks in a row
    const std::size_t blocks = groups_.size() / kGroup;
    const std::size_t rows = 2 * ((blocks + kBlocks - 1) / kBlocks);
    placesOfPixels_.assign(rows * kColumns, groups_.empty() ? 0 : groups_.back());
    for (std::size_t k = 0; k < groups_.size(); ++k) {
        const std::size_t block = k / kGroup;
        const std::size_t column = block % kBlocks * 4 + k % 4;
        const std::size_t row = block / kBlocks * 2 + k % kGroup / 4;
        placesOfPixels_[row * kColumns + column] = groups_[k];
    }
    grid_ = glm::vec4(kColumns, size.width, size.width / tileSize, tileSize);
    uploadList(marked_, placesOfPixels_, "the marked pixels");
}

}  // namespace render
