// Numbers become text and bytes here. Positions are float in the files: that is what readers of PLY expect, and seven
// digits are enough for a surface that is seen.
#include "render/mesh/mesh_files.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <iterator>

#include "render/overlay/coverage_mask.h"

namespace render {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY files are written little-endian");

constexpr const char* kVertexProperties =
    "property float x\nproperty float y\nproperty float z\n"
    "property float nx\nproperty float ny\nproperty float nz\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "property float vx\nproperty float vy\nproperty float vz\n";

/// Writes values one after another into memory that is large enough.
class Cursor {
 public:
    explicit Cursor(char* at) : at_(at) {}
    template <typename Value>
    void put(const Value& value) {
        std::memcpy(at_, &value, sizeof value);
        at_ += sizeof value;
    }

 private:
    char* at_;
};

}  // namespace

std::string encodePly(const TriangleMesh& mesh, const MeshLabel& label) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\n";
    for (const std::string& comment : label.comments) bytes += "comment " + comment + "\n";
    bytes += fmt::format("element vertex {}\n{}element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                         mesh.positions.size(), kVertexProperties, mesh.triangles.size());
    constexpr std::size_t kVertexBytes = 9 * sizeof(float) + 3;
    constexpr std::size_t kFaceBytes = 1 + sizeof(Triangle);
    const std::size_t header = bytes.size();
    bytes.resize(header + kVertexBytes * mesh.positions.size() + kFaceBytes * mesh.triangles.size());
    Cursor cursor(bytes.data() + header);
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        cursor.put(glm::vec3(label.origin + mesh.positions[k]));
        cursor.put(mesh.normals[k]);
        cursor.put(srgbBytes(mesh.colors[k]));
        cursor.put(mesh.velocities[k]);
    }
    for (const Triangle& triangle : mesh.triangles) {
        cursor.put(std::uint8_t{3});
        cursor.put(triangle);
    }
    return bytes;
}

std::string encodeObj(const TriangleMesh& mesh, const MeshLabel& label) {
    std::string text;
    for (const std::string& comment : label.comments) text += "# " + comment + "\n";
    const auto out = std::back_inserter(text);
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        const glm::vec3 at(label.origin + mesh.positions[k]);
        const Bytes color = srgbBytes(mesh.colors[k]);
        fmt::format_to(out, "v {} {} {} {:.4f} {:.4f} {:.4f}\n", at.x, at.y, at.z, color.x / 255.0, color.y / 255.0,
                       color.z / 255.0);
    }
    for (const glm::vec3& normal : mesh.normals)
        fmt::format_to(out, "vn {:.5f} {:.5f} {:.5f}\n", normal.x, normal.y, normal.z);
    for (const auto& [a, b, c] : mesh.triangles)
        fmt::format_to(out, "f {0}//{0} {1}//{1} {2}//{2}\n", a + 1, b + 1, c + 1);
    return text;
}

}  // namespace render
