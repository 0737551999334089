// The reader of PLY files is strict: whatever it does not know is an error, because a particle in the wrong place is
// harder to notice than a message.
#include "scenes/model/particle_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <type_traits>
#include <vector>

#include "engine/stepping/state_checks.h"
#include "scenes/text/input_error.h"

namespace scenes {
namespace {

static_assert(std::endian::native == std::endian::little, "particle files are little-endian");

/// A type that numbers of a PLY file may have.
struct PlyType {
    std::string_view name;
    std::size_t size = 8;                   ///< bytes of a number of this type
    bool isReal = true;                     ///< floating point, otherwise unsigned integer
    double (*read)(const char*) = nullptr;  ///< reads a number of this type from its bytes
};

template <class Number>
double numberAt(const char* bytes) {
    Number number{};
    std::memcpy(&number, bytes, sizeof number);
    return static_cast<double>(number);
}

template <class Number>
constexpr PlyType plyType(std::string_view name) {
    return {name, sizeof(Number), std::is_floating_point_v<Number>, numberAt<Number>};
}

constexpr std::array kTypes = {plyType<float>("float"),          plyType<float>("float32"),
                               plyType<double>("double"),        plyType<double>("float64"),
                               plyType<std::uint8_t>("uchar"),   plyType<std::uint8_t>("uint8"),
                               plyType<std::uint16_t>("ushort"), plyType<std::uint16_t>("uint16"),
                               plyType<std::uint32_t>("uint"),   plyType<std::uint32_t>("uint32")};

struct PlyProperty {
    std::string name;
    PlyType type;
};

/// The header of a PLY file, which describes the rows of numbers that follow. A row has one number for each property.
struct PlyHeader {
    std::uint64_t rowCount = 0;
    std::vector<PlyProperty> properties;  ///< names and types of the numbers of a row, in order
    std::size_t size = 0;                 ///< size of the header, bytes

    bool has(std::string_view name) const { return std::ranges::count(properties, name, &PlyProperty::name) > 0; }
};

/// Largest size of a PLY header. Chosen: ten times the longest header that this program writes or understands.
constexpr std::size_t kMaxHeaderBytes = 65536;

const std::vector<std::string_view> kRealProperties = {"x", "y", "z", "vx", "vy", "vz", "radius", "mass"};
const std::vector<std::string_view> kIndexProperties = {"material", "id"};

bool contains(const std::vector<std::string_view>& names, std::string_view name) {
    return std::ranges::count(names, name) > 0;
}

/// The header of a PLY file while it is read line by line.
struct HeaderReader {
    std::string_view bytes;
    const std::string& fileName;
    PlyHeader header = {};
    int line = 0;
    bool hasFormat = false;
    bool hasElement = false;
};

[[noreturn]] void fail(const HeaderReader& reader, const std::string& message) {
    throw InputError({{reader.fileName, reader.line, reader.line > 0 ? 1 : 0, message}});
}

std::string nextLine(HeaderReader& reader) {
    ++reader.line;
    const std::string_view rest = reader.bytes.substr(reader.header.size);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos || reader.header.size + end > kMaxHeaderBytes)
        fail(reader, "the header has no end_header");
    reader.header.size += end + 1;
    std::string line(rest.substr(0, end));
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
}

std::vector<std::string> wordsOf(const std::string& line) {
    std::vector<std::string> words;
    std::istringstream rest(line);
    for (std::string word; std::getline(rest, word, ' ');)
        if (!word.empty()) words.push_back(word);
    return words;
}

void readElement(HeaderReader& reader, const std::vector<std::string>& words) {
    if (words.size() != 3 || words[1] != "vertex" || reader.hasElement)
        fail(reader, "must have the one element \"vertex\" and its count");
    const std::string& digits = words[2];
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), reader.header.rowCount);
    if (result.ec != std::errc{} || result.ptr != digits.data() + digits.size())
        fail(reader, fmt::format("the count of vertices is \"{}\", must be a whole number", digits));
    reader.hasElement = true;
}

void readProperty(HeaderReader& reader, const std::vector<std::string>& words) {
    if (!reader.hasElement) fail(reader, "property before its element");
    if (words.size() != 3) fail(reader, "a property must be a type and a name; lists are not supported");
    const auto* const type = std::ranges::find(kTypes, words[1], &PlyType::name);
    const std::string& name = words[2];
    if (!contains(kRealProperties, name) && !contains(kIndexProperties, name))
        fail(reader, fmt::format("unknown property \"{}\" (known: {}, {})", name, fmt::join(kRealProperties, ", "),
                                 fmt::join(kIndexProperties, ", ")));
    if (reader.header.has(name)) fail(reader, fmt::format("property \"{}\" is given twice", name));
    if (type == kTypes.end() || type->isReal != contains(kRealProperties, name))
        fail(reader, fmt::format("property \"{}\" has type {}, must be {}", name, words[1],
                                 contains(kRealProperties, name) ? "float or double" : "uchar, ushort or uint"));
    reader.header.properties.push_back({name, *type});
}

void readStatement(HeaderReader& reader, const std::vector<std::string>& words) {
    if (words[0] == "format") {
        if (words != std::vector<std::string>{"format", "binary_little_endian", "1.0"})
            fail(reader, "the format must be \"binary_little_endian 1.0\"");
        reader.hasFormat = true;
    } else if (words[0] == "element") {
        readElement(reader, words);
    } else if (words[0] == "property") {
        readProperty(reader, words);
    } else if (words[0] != "comment" && words[0] != "obj_info") {
        fail(reader, fmt::format("unknown header line \"{}\"", words[0].substr(0, 40)));
    }
}

void checkComplete(HeaderReader& reader) {
    reader.line = 0;
    const PlyHeader& header = reader.header;
    if (!reader.hasFormat) fail(reader, "the header has no format line");
    if (!reader.hasElement) fail(reader, "the header has no element \"vertex\"");
    for (const char* name : {"x", "y", "z"})
        if (!header.has(name)) fail(reader, fmt::format("property \"{}\" is missing", name));
    if (header.has("vx") != header.has("vy") || header.has("vx") != header.has("vz"))
        fail(reader, "velocities need all of vx, vy and vz");
}

/// Checks that the rows announced in the header fill the rest of the file exactly. Divides rather than multiplies, so
/// that no row count overflows.
void checkLength(HeaderReader& reader) {
    std::size_t stride = 0;
    for (const PlyProperty& property : reader.header.properties) stride += property.type.size;
    const std::size_t rest = reader.bytes.size() - reader.header.size;
    if (reader.header.rowCount > rest / stride)
        fail(reader, fmt::format("truncated: {} particles of {} bytes are announced, {} bytes follow",
                                 reader.header.rowCount, stride, rest));
    if (rest != reader.header.rowCount * stride)
        fail(reader, fmt::format("{} bytes follow the last particle", rest - reader.header.rowCount * stride));
}

/// Reads the header of a PLY file, and checks that the rows announced in it fill the rest of the file exactly.
PlyHeader readPlyHeader(std::string_view bytes, const std::string& fileName) {
    HeaderReader reader{bytes, fileName};
    if (bytes.substr(0, 3) != "ply" || nextLine(reader) != "ply") {
        reader.line = 0;
        fail(reader, "is not a PLY file");
    }
    while (true) {
        const std::vector<std::string> words = wordsOf(nextLine(reader));
        if (words.empty()) continue;
        if (words[0] == "end_header") break;
        readStatement(reader, words);
    }
    checkComplete(reader);
    checkLength(reader);
    return reader.header;
}

template <class Value>
void put(std::string& bytes, const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Stores one number of a row in a particle. The property "id" is ignored, because the particles get new ids in the
/// order of the rows.
void setProperty(engine::NewParticle& particle, const std::string& name, double value) {
    if (name == "x" || name == "y" || name == "z")
        particle.position[name[0] - 'x'] = value;
    else if (name == "vx" || name == "vy" || name == "vz")
        particle.velocity[name[1] - 'x'] = value;
    else if (name == "radius")
        particle.radius = value;
    else if (name == "mass")
        particle.mass = value;
    else if (name == "material")
        particle.material = static_cast<std::uint32_t>(value);
}

/// What the value of a property must be, for the message; empty if the value is valid. Positions and velocities have
/// the same bounds as in scene files.
std::string violatedRule(const std::string& name, double value) {
    if (!std::isfinite(value)) return "must be finite";
    if (name == "radius" || name == "mass") return value > 0.0 ? "" : "must be > 0";
    const bool isIndex = contains(kIndexProperties, name);
    if (!isIndex && std::abs(value) > engine::kWorldLimit)
        return fmt::format("must be {} to {}", -engine::kWorldLimit, engine::kWorldLimit);
    return {};
}

}  // namespace

std::string encodeParticles(const engine::Particles& particles) {
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment globular particles\nelement vertex {}\n", particles.count());
    for (const std::string_view name : kRealProperties) bytes += fmt::format("property double {}\n", name);
    bytes += "property uint material\nproperty uint id\nend_header\n";
    for (std::size_t index = 0; index < particles.count(); ++index) {
        put(bytes, particles.position[index]);
        put(bytes, particles.velocity[index]);
        put(bytes, particles.radius[index]);
        put(bytes, particles.mass[index]);
        put(bytes, particles.material[index]);
        put(bytes, particles.id[index]);
    }
    return bytes;
}

ParticleFile decodeParticles(std::string_view bytes, const std::string& fileName) {
    const PlyHeader header = readPlyHeader(bytes, fileName);
    ParticleFile file;
    file.hasRadius = header.has("radius");
    file.hasMass = header.has("mass");
    file.hasMaterial = header.has("material");
    std::size_t at = header.size;
    for (std::uint64_t index = 0; index < header.rowCount; ++index) {
        engine::NewParticle particle;
        particle.radius = particle.mass = 0.0;
        for (const PlyProperty& property : header.properties) {
            const double value = property.type.read(&bytes[at]);
            at += property.type.size;
            if (const std::string rule = violatedRule(property.name, value); !rule.empty())
                throw InputError(fileName, fmt::format("particle {}: {} is {}, {}", index, property.name, value, rule));
            setProperty(particle, property.name, value);
        }
        append(file.particles, particle);
    }
    return file;
}

}  // namespace scenes
