// Packing of normals and colours; the unpacking is in shaders/picture.frag.
#include "render/field_sample.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace render {

namespace {

std::uint32_t packedNormal(glm::vec3 n) {
    const float length = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    const float scale = length > 0.0F ? 1.0F / length : 0.0F;  // where the field has no slope: towards +z
    glm::vec2 folded(n.x * scale, n.y * scale);
    if (n.z < 0.0F) {
        folded = {(1.0F - std::abs(n.y * scale)) * (n.x >= 0.0F ? 1.0F : -1.0F),
                  (1.0F - std::abs(n.x * scale)) * (n.y >= 0.0F ? 1.0F : -1.0F)};
    }
    const auto packed = [](float at) {
        return static_cast<std::uint32_t>(std::clamp((at + 1.0F) * 32767.5F + 0.5F, 0.0F, 65535.0F));
    };
    return packed(folded.x) | packed(folded.y) << 16;
}

std::uint32_t packedRoots(glm::vec3 color) {
    const auto packed = [](float at, float most) {
        return static_cast<std::uint32_t>(std::sqrt(std::clamp(at, 0.0F, 1.0F)) * most + 0.5F);
    };
    return packed(color.x, 2047.0F) | packed(color.y, 2047.0F) << 11 | packed(color.z, 1023.0F) << 22;
}

}  // namespace

std::uint32_t packedOpenness(const RayBlock& block, std::size_t k) {
    if (!(block.depth[k] >= 0.0F)) return 0;
    const auto packed = [](float at) {
        return static_cast<std::uint32_t>(std::clamp(at, 0.0F, 1.0F) * 1023.0F + 0.5F);
    };
    return packed(block.open[0][k]) | packed(block.open[1][k]) << 10 | packed(block.open[2][k]) << 20;
}

FieldSample packedSample(const CameraFrame& frame, const RayBlock& block, std::size_t k) {
    if (!(block.depth[k] >= 0.0F)) return {};
    const glm::vec3 normal =
        block.normal[0][k] * frame.right + block.normal[1][k] * frame.up + block.normal[2][k] * frame.forward;
    // A hit at the eye itself still has to differ from no hit.
    const float depth = std::max(block.depth[k], 1e-30F);
    return {std::bit_cast<std::uint32_t>(depth), packedNormal(normal),
            packedRoots({block.color[0][k], block.color[1][k], block.color[2][k]}), 0};
}

}  // namespace render
