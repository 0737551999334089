// Corners are fetched from lists by their indices, so that each is handed over and transformed once, not once for each
// of its triangles. The samples of a pixel are drawn one after another, each to a target of its own whose pixels lie at
// the sample.
#include "render/opengl/mesh_passes.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "render/picture/system_error.h"

namespace render {

namespace {

constexpr std::size_t kWords = 0;  // index of the texture of a target with what is seen
constexpr std::array kSamplers = {"meshHits0", "meshHits1", "meshHits2", "meshHits3"};

/// The corners of a view's meshes, each with the number of its mesh, which floats have exactly up to 2^24.
std::vector<glm::vec4> cornersOf(const DrawnMeshes& meshes) {
    std::vector<glm::vec4> corners(meshes.positions.size());
    tbb::parallel_for(std::size_t{0}, corners.size(),
                      [&](std::size_t k) { corners[k] = glm::vec4(meshes.positions[k], 0.0F); });
    for (const DrawnTriangle& triangle : meshes.triangles)
        for (const std::uint32_t corner : triangle.corners) corners[corner].w = static_cast<float>(triangle.mesh);
    return corners;
}

std::vector<glm::vec4> asTexels(const std::vector<glm::vec3>& vectors) {
    std::vector<glm::vec4> texels(vectors.size());
    tbb::parallel_for(std::size_t{0}, texels.size(), [&](std::size_t k) { texels[k] = glm::vec4(vectors[k], 0.0F); });
    return texels;
}

void uploadIndices(const Gl& gl, const BufferName& buffer, const std::vector<TriangleCorners>& triangles) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(triangles));
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.get());
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STREAM_DRAW);
    if (gl.GetError() == GL_OUT_OF_MEMORY)
        throw OpenGlError(fmt::format("OpenGL has not got the {:.0f} MB of memory for the triangles of meshes",
                                      1e-6 * static_cast<double>(bytes.size())));
}

}  // namespace

MeshPasses::MeshPasses(const Gl& gl, ShaderPrograms& programs, PictureSize size)
    : gl_(gl),
      programs_(programs),
      size_(size),
      corners_(gl, GL_RGBA32F),
      normals_(gl, GL_RGBA32F),
      colors_(gl, GL_RGBA32F),
      seenIndices_(generate<BufferName>(gl, gl.GenBuffers)),
      unlitIndices_(generate<BufferName>(gl, gl.GenBuffers)) {}

void MeshPasses::upload(const PreparedView& view) {
    seen_ = seenTriangles(view);
    uploadList(corners_, cornersOf(view.meshes), "the corners of meshes");
    uploadList(normals_, asTexels(view.meshes.normals), "the normals of meshes");
    uploadList(colors_, asTexels(view.meshes.colors), "the colors of meshes");
    uploadIndices(gl_, seenIndices_, seen_.triangles);
    if (view.meshDepthMap.empty()) return;
    const std::vector<TriangleCorners> unlit = unlitTriangles(view);
    unlitCount_ = unlit.size();
    uploadIndices(gl_, unlitIndices_, unlit);
}

void MeshPasses::drawTriangles(const BufferName& indices, std::size_t count) const {
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.get());
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT, nullptr);
}

void MeshPasses::drawDepthMap(const PreparedView& view) {
    const DepthMapGrid& grid = view.meshDepthMap;
    if (grid.empty()) return;
    const PictureSize size{2 * grid.columns, 2 * grid.rows};
    if (!map_ || map_->size() != size) {
        map_.emplace(gl_, size, std::initializer_list<GLenum>{GL_DEPTH_COMPONENT32F});
        compareDepths(gl_, map_->texture(0));
    }
    map_->bind();
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    gl_.DepthMask(GL_TRUE);
    const float nothing = 1.0F;
    gl_.ClearBufferfv(GL_DEPTH, 0, &nothing);
    const ShaderProgram& program = programs_.get("mesh_depth_map.vert", "mesh_depth_map.frag", {});
    program.use(std::array{TextureBinding{"meshCorners", GL_TEXTURE_BUFFER, corners_.texture()}});
    setUniforms(view, program);
    drawTriangles(unlitIndices_, unlitCount_);
    gl_.Disable(GL_DEPTH_TEST);
}

void MeshPasses::draw(const PreparedView& view, std::span<const glm::vec2> offsets) {
    while (samples_.size() < offsets.size())
        samples_.emplace_back(gl_, size_, std::initializer_list<GLenum>{GL_RGBA32UI, GL_DEPTH_COMPONENT32F});
    Defines defines;
    if (view.frame.perspective) defines.emplace_back("PERSPECTIVE");
    if (view.frame.middle != glm::vec2(0.0F)) defines.emplace_back("SHIFTED");
    const ShaderProgram& program = programs_.get("mesh.vert", "mesh.frag", defines);
    program.use(std::array{TextureBinding{"meshCorners", GL_TEXTURE_BUFFER, corners_.texture()},
                           TextureBinding{"meshNormals", GL_TEXTURE_BUFFER, normals_.texture()},
                           TextureBinding{"meshColors", GL_TEXTURE_BUFFER, colors_.texture()}});
    program.set("depthRange", seen_.nearest, seen_.farthest);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_GREATER);
    gl_.DepthMask(GL_TRUE);
    const std::array<GLuint, 4> nothing{};
    const float farthest = 0.0F;
    for (std::size_t s = 0; s < offsets.size(); ++s) {
        samples_[s].bind();
        gl_.ClearBufferuiv(GL_COLOR, 0, nothing.data());
        gl_.ClearBufferfv(GL_DEPTH, 0, &farthest);
        program.set("target", glm::vec4(2.0F / glm::vec2(size_.width, size_.height), offsets[s]));
        drawTriangles(seenIndices_, seen_.triangles.size());
    }
    gl_.Disable(GL_DEPTH_TEST);
}

void MeshPasses::addBindings(std::vector<TextureBinding>& to) const {
    for (std::size_t s = 0; s < samples_.size(); ++s)
        to.push_back({kSamplers[s], GL_TEXTURE_2D, samples_[s].texture(kWords)});
    if (map_) to.push_back({"meshDepthMap", GL_TEXTURE_2D, map_->texture(0)});
}

void MeshPasses::addCorners(std::vector<TextureBinding>& to) const {
    to.push_back({"meshCorners", GL_TEXTURE_BUFFER, corners_.texture()});
    to.push_back({"meshNormals", GL_TEXTURE_BUFFER, normals_.texture()});
}

void MeshPasses::setUniforms(const PreparedView& view, const ShaderProgram& program) const {
    const DepthMapGrid& grid = view.meshDepthMap;
    program.set("meshMapGrid", glm::vec4(grid.origin, grid.texelSize, grid.top));
    program.set("meshMapSize",
                glm::vec4(grid.columns, grid.rows, 1.0F / std::max(grid.top - grid.bottom, 1e-30F), 0.0F));
}

}  // namespace render
