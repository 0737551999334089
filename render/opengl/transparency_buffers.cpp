// Lists are interleaved to the texels that shaders fetch together.
#include "render/opengl/transparency_buffers.h"

#include <cstdint>

#include <tbb/parallel_for.h>

namespace render {

namespace {

/// All numbers of the cells in one list, as shaders/field_crossing.glsl describes it.
std::vector<std::int32_t> cellNumbers(const BallCells& cells, const FieldCells& field) {
    constexpr std::size_t kHead = 4;
    std::vector<std::int32_t> numbers(kHead);
    numbers.reserve(kHead + cells.begin.size() + field.blocks.size() + 2 * field.subcells.size() + field.balls.size());
    const auto end = [&] { return static_cast<std::int32_t>(numbers.size()); };
    numbers.insert(numbers.end(), cells.begin.begin(), cells.begin.end());
    numbers[0] = field.along;
    numbers[1] = end();
    numbers.insert(numbers.end(), field.blocks.begin(), field.blocks.end());
    numbers[2] = end();
    for (const Subcell& subcell : field.subcells) {
        numbers.push_back(static_cast<std::int32_t>(subcell.first));
        numbers.push_back(subcell.count);
    }
    numbers[3] = end();
    numbers.insert(numbers.end(), field.balls.begin(), field.balls.end());
    return numbers;
}

}  // namespace

TransparencyBuffers::TransparencyBuffers(const Gl& gl)
    : cellNumbers_(gl, GL_R32I),
      cellBalls_(gl, GL_RGBA32F),
      cellSky_(gl, GL_RGBA32UI),
      nodes_(gl, GL_RGBA32F),
      links_(gl, GL_R32I),
      solids_(gl, GL_R32I),
      triangles_(gl, GL_RGBA32UI),
      media_(gl, GL_RGBA32F),
      opticalDepths_(gl, GL_RGBA32F) {}

void TransparencyBuffers::upload(const PreparedView& view) {
    uploadBalls(view);
    uploadSolids(view);
    uploadOpticalDepths(view);
}

void TransparencyBuffers::uploadBalls(const PreparedView& view) {
    const BallCells& cells = view.ballCells;
    const std::size_t texels = cells.isAnisotropic() ? 4 : 2;
    std::vector<glm::vec4> balls(texels * cells.particle.size());
    std::vector<SphereAttributes> sky(view.particleSky.empty() ? 0 : cells.particle.size());
    tbb::parallel_for(std::size_t{0}, cells.particle.size(), [&](std::size_t k) {
        const auto particle = static_cast<std::size_t>(cells.particle[k]);
        balls[texels * k] = {cells.x[k], cells.y[k], cells.z[k], cells.peak[k]};
        balls[texels * k + 1] = {view.view->particles[particle].color, cells.squaredSlope[k]};
        if (cells.isAnisotropic()) {
            const SymmetricMatrix<float> form = cells.formOf(k);
            balls[texels * k + 2] = {form.xx, form.yy, form.zz, form.xy};
            balls[texels * k + 3] = {form.xz, form.yz, 0.0F, 0.0F};
        }
        if (!sky.empty()) sky[k] = particleAttributes(view.view->particles[particle].color, view.particleSky[particle]);
    });
    uploadList(cellNumbers_, cellNumbers(cells, view.fieldCells), "the cells of metaballs");
    uploadList(cellBalls_, balls, "the metaballs of cells");
    uploadList(cellSky_, sky, "the sky that metaballs see");
}

void TransparencyBuffers::uploadSolids(const PreparedView& view) {
    const std::vector<TreeNode>& tree = view.solids.nodes;
    std::vector<glm::vec4> nodes(2 * tree.size());
    std::vector<std::uint32_t> links(2 * tree.size());
    tbb::parallel_for(std::size_t{0}, tree.size(), [&](std::size_t k) {
        nodes[2 * k] = glm::vec4(tree[k].low, 0.0F);
        nodes[2 * k + 1] = glm::vec4(tree[k].high, 0.0F);
        links[2 * k] = tree[k].first;
        links[2 * k + 1] = tree[k].count;
    });
    std::vector<glm::vec4> media;
    for (const MeshObstacle& mesh : view.meshes.obstacles) {
        media.emplace_back(mesh.color, mesh.medium.transparency);
        media.emplace_back(mesh.medium.refractiveIndex, 1.0F / mesh.medium.attenuationDistance, 0.0F, 0.0F);
    }
    uploadList(nodes_, nodes, "the boxes around solids");
    uploadList(links_, links, "the boxes around solids");
    uploadList(solids_, view.solids.solids, "the solids");
    uploadList(triangles_, view.meshes.triangles, "the triangles of meshes");
    uploadList(media_, media, "the colors of meshes");
}

void TransparencyBuffers::uploadOpticalDepths(const PreparedView& view) {
    const std::vector<float>& depths = view.opticalDepth.depths;
    std::vector<glm::vec4> texels(depths.size() / 3);
    for (std::size_t k = 0; k < texels.size(); ++k)
        texels[k] = {depths[3 * k], depths[3 * k + 1], depths[3 * k + 2], 0.0F};
    uploadList(opticalDepths_, texels, "the map of what metaballs let through");
}

void TransparencyBuffers::addBindings(std::vector<TextureBinding>& to) const {
    const auto add = [&](const char* sampler, const TextureBuffer& buffer) {
        to.push_back({sampler, GL_TEXTURE_BUFFER, buffer.texture()});
    };
    add("cellNumbers", cellNumbers_);
    add("cellBalls", cellBalls_);
    add("cellSky", cellSky_);
    add("solidNodes", nodes_);
    add("solidLinks", links_);
    add("solidIds", solids_);
    add("triangles", triangles_);
    add("meshMedia", media_);
    add("opticalDepths", opticalDepths_);
}

void TransparencyBuffers::setUniforms(const PreparedView& view, const ShaderProgram& program) {
    const BallCells& cells = view.ballCells;
    const MetaballScene& metaballs = view.metaballs;
    const Medium medium = view.hasMetaballs ? view.view->surface.medium : Medium{};
    const OpticalDepthMap& map = view.opticalDepth;
    program.set("cellGrid", glm::vec4(cells.low, cells.side));
    program.set("cellCount", glm::vec4(cells.count, cells.empty() ? 0.0F : 1.0F));
    program.set("castField", glm::vec4(metaballs.threshold, metaballs.step, 0.05F * metaballs.smallestRadius, 0.0F));
    program.set("solidCount", glm::vec4(static_cast<float>(view.solids.nodes.size()), 0.0F, 0.0F, 0.0F));
    program.set("metaballMedium",
                glm::vec4(medium.transparency, medium.refractiveIndex, 1.0F / medium.attenuationDistance, 0.0F));
    program.set("opticalGrid", glm::vec4(map.origin, 1.0F / map.texelSize, static_cast<float>(map.columns)));
    program.set("opticalRows", glm::vec4(static_cast<float>(map.rows), 0.0F, 0.0F, 0.0F));
}

}  // namespace render
