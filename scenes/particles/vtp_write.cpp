// A file begins with XML that describes each array by its type and by where it begins in the appended data; there it is
// as its length in bytes and its numbers.
#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "scenes/particles/number_type.h"
#include "scenes/particles/vtp.h"
#include "scenes/text/color.h"

namespace scenes {
namespace {

/// The arrays of a file while they are appended.
struct AppendedArrays {
    std::string bytes;

    /// Appends an array, and returns the XML that describes it.
    std::string add(std::string_view type, std::string_view name, int componentCount, std::string_view numbers) {
        const std::size_t offset = bytes.size();
        putBytes(bytes, std::uint64_t{numbers.size()});
        bytes += numbers;
        return fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
            name, componentCount, offset);
    }

    template <class Value>
    std::string add(std::string_view type, std::string_view name, int componentCount,
                    const std::vector<Value>& values) {
        return add(type, name, componentCount,
                   {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
    }
};

/// Strings as VTK writes them: the codes of their characters, each string ending with 0.
std::string stringArray(std::string_view name, const std::vector<std::string>& strings) {
    std::string text = fmt::format("<DataArray type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">",
                                   name, strings.size());
    for (const std::string& string : strings) {
        for (const char letter : string)
            text += fmt::format("{} ", static_cast<unsigned>(static_cast<unsigned char>(letter)));
        text += "0 ";
    }
    return text + "</DataArray>\n";
}

std::string fieldData(const ParticleFrame& frame) {
    const auto number = [](std::string_view type, std::string_view name, auto value) {
        return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
                           type, name, value);
    };
    return "<FieldData>\n" + number("Float64", "TimeValue", frame.stamp.time) +
           number("Int64", "frame", frame.stamp.frame) + stringArray("simulation_hash", {frame.stamp.simulationHash}) +
           stringArray("material_names", frame.materialNames) + "</FieldData>\n";
}

std::string colorBytes(const ParticleFrame& frame) {
    std::string bytes;
    bytes.reserve(3 * frame.particles.count());
    for (const std::uint32_t material : frame.particles.material)
        for (const std::uint8_t component : srgbBytes(frame.materialColors.at(material)))
            bytes += static_cast<char>(component);
    return bytes;
}

}  // namespace

std::string encodeVtp(const ParticleFrame& frame) {
    static_assert(sizeof(engine::Vec3) == 3 * sizeof(double));
    const engine::Particles& particles = frame.particles;
    std::vector<std::int64_t> indices(particles.count() + 1);
    for (std::size_t index = 0; index < indices.size(); ++index) indices[index] = static_cast<std::int64_t>(index);
    const std::size_t indexBytes = particles.count() * sizeof(std::int64_t);
    const auto* const firstIndex = reinterpret_cast<const char*>(indices.data());

    AppendedArrays arrays;
    std::string piece = "<Points>\n" + arrays.add("Float64", "Points", 3, particles.position) + "</Points>\n";
    piece += "<PointData Scalars=\"material\" Vectors=\"velocity\">\n";
    piece += arrays.add("Float64", "velocity", 3, particles.velocity);
    piece += arrays.add("Float64", "radius", 1, particles.radius);
    piece += arrays.add("Float64", "mass", 1, particles.mass);
    piece += arrays.add("Float64", "birth_time", 1, particles.birthTime);
    if (!frame.temperature.empty()) piece += arrays.add("Float64", "temperature", 1, frame.temperature);
    piece += arrays.add("UInt32", "id", 1, particles.id);
    piece += arrays.add("UInt32", "material", 1, particles.material);
    piece += arrays.add("UInt8", "color", 3, colorBytes(frame));
    piece += "</PointData>\n<Verts>\n";
    // Cell k has the points connectivity[offsets[k - 1]] to connectivity[offsets[k] - 1]: point k alone.
    piece += arrays.add("Int64", "connectivity", 1, std::string_view(firstIndex, indexBytes));
    piece += arrays.add("Int64", "offsets", 1, std::string_view(firstIndex + sizeof(std::int64_t), indexBytes));
    piece += "</Verts>\n";
    return fmt::format(
               "<?xml version=\"1.0\"?>\n"
               "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
               "<PolyData>\n{}<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" "
               "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n{}</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_",
               fieldData(frame), particles.count(), particles.count(), piece) +
           arrays.bytes + "\n</AppendedData>\n</VTKFile>\n";
}

std::string encodeVtpSeries(std::span<const TimedFile> files) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const TimedFile& file : files) list.push_back({{"name", file.name}, {"time", file.time}});
    return nlohmann::ordered_json{{"file-series-version", "1.0"}, {"files", list}}.dump(1) + "\n";
}

}  // namespace scenes
