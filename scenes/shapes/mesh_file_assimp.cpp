// Reads meshes by assimp: the module that mesh_file.cpp loads. The only file that includes assimp, whose library takes
// longer to load than the program does to start.
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <assimp/Importer.hpp>

#include "scenes/shapes/assimp_module.h"

namespace scenes {
namespace {

/// All but the points and faces is left out, so that vertices do not differ by it.
constexpr int kLeftOut = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                         aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                         aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS;

void append(const aiMesh& part, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (unsigned k = 0; k < part.mNumVertices; ++k)
        mesh.points.emplace_back(part.mVertices[k].x, part.mVertices[k].y, part.mVertices[k].z);
    for (unsigned k = 0; k < part.mNumFaces; ++k) {
        const aiFace& face = part.mFaces[k];
        if (face.mNumIndices == 3)
            mesh.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
}

std::string version() {
    return std::to_string(aiGetVersionMajor()) + '.' + std::to_string(aiGetVersionMinor()) + '.' +
           std::to_string(aiGetVersionPatch());
}

std::string read(const std::string& path, Mesh& mesh) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, kLeftOut);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    // Places the parts of a file where its nodes say.
    const aiScene* const scene = importer.ReadFile(path, aiProcess_RemoveComponent | aiProcess_Triangulate |
                                                             aiProcess_SortByPType | aiProcess_PreTransformVertices);
    if (scene == nullptr) return importer.GetErrorString();
    for (unsigned k = 0; k < scene->mNumMeshes; ++k) append(*scene->mMeshes[k], mesh);
    return "";
}

}  // namespace
}  // namespace scenes

const scenes::AssimpModule globularAssimp = {scenes::version, scenes::read};
