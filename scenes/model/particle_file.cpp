// Positions, velocities, radii, masses, times of birth and materials as columns of PLY files. What is not known is
// skipped and named; what is known must be right, because a particle in the wrong place is harder to notice than a
// message.
#include "scenes/model/particle_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "engine/state/state_checks.h"
#include "scenes/text/input_error.h"
#include "scenes/text/ply.h"

namespace scenes {
namespace {

static_assert(std::endian::native == std::endian::little, "particle files are written little-endian");

constexpr std::array<std::string_view, 9> kRealProperties = {"x",  "y",      "z",    "vx",        "vy",
                                                             "vz", "radius", "mass", "birth_time"};

/// Names of the radius: ours, and those of Houdini and of programs that read its files.
constexpr std::array<std::string_view, 3> kRadiusNames = {"radius", "pscale", "psize"};

/// Properties that are read or may be left out silently: a body takes neither "birth_time", because its particles are
/// born when the run starts, nor "id", because they get new ids in the order of the rows.
constexpr std::array<std::string_view, 13> kReadProperties = {
    "x", "y", "z", "vx", "vy", "vz", "radius", "pscale", "psize", "mass", "birth_time", "material", "id"};

template <class Value>
void put(std::string& bytes, const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// What numbers a property may have: the same as the keys of scene files that mean it.
struct Rule {
    double low, high;
    bool isWhole = false;
};

constexpr Rule kCoordinate{-engine::kWorldLimit, engine::kWorldLimit};
constexpr Rule kRadius{engine::kLeastRadius, engine::kLargestRadius};
constexpr Rule kMass{engine::kLeastMass, engine::kLargestMass};
constexpr Rule kMaterial{0.0, std::numeric_limits<std::uint32_t>::max(), true};
constexpr Rule kId = kMaterial;
constexpr Rule kTime{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};

/// A property of the file, if it has one of that name. All its numbers keep the rule.
/// @throws InputError that names the first that does not
const PlyColumn* checkedColumn(const PlyVertices& vertices, std::string_view name, const Rule& rule,
                               const std::string& fileName) {
    const PlyColumn* const column = vertices.column(name);
    if (column == nullptr) return nullptr;
    for (std::size_t index = 0; index < vertices.count; ++index) {
        const double value = column->values[index];
        const bool isValid = rule.low <= value && value <= rule.high && !(rule.isWhole && value != std::floor(value));
        if (!isValid)
            throw InputError(fileName, fmt::format("particle {}: {} is {}, must be {}{} to {}", index, name, value,
                                                   rule.isWhole ? "a whole number from " : "", rule.low, rule.high));
    }
    return column;
}

/// The three columns of a vector's components; all or none of them are there.
std::array<const PlyColumn*, 3> vectorColumns(const PlyVertices& vertices, std::string_view prefix,
                                              const std::string& fileName) {
    std::array<const PlyColumn*, 3> columns{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        columns[axis] =
            checkedColumn(vertices, std::string(prefix) + static_cast<char>('x' + axis), kCoordinate, fileName);
    return columns;
}

std::string commentsOf(const std::optional<StateStamp>& stamp) {
    if (!stamp) return {};
    return fmt::format("comment frame {}\ncomment time {}\ncomment simulation_hash {}\n", stamp->frame, stamp->time,
                       stamp->simulationHash);
}

/// The words after the first one in the comment that begins with that one.
/// @throws InputError if there is no such comment
std::string commentNamed(const PlyVertices& vertices, const std::string& name, const std::string& fileName) {
    for (const std::string& comment : vertices.comments)
        if (comment.starts_with(name + ' ')) return comment.substr(name.size() + 1);
    throw InputError(fileName,
                     fmt::format("the header has no \"comment {} ...\": it is no state that this version of `globular "
                                 "simulate` has written",
                                 name));
}

template <class Number>
Number numberNamed(const PlyVertices& vertices, const std::string& name, const std::string& fileName) {
    const std::string text = commentNamed(vertices, name, fileName);
    Number number{};
    const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || !(number >= 0))
        throw InputError(fileName, fmt::format("the comment {} is \"{}\", must be a number >= 0", name, text));
    return number;
}

ParticleFile particlesOf(PlyVertices vertices, const std::string& fileName) {
    const auto position = vectorColumns(vertices, "", fileName);
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (position[axis] == nullptr)
            throw InputError(fileName, fmt::format("property \"{}\" is missing", static_cast<char>('x' + axis)));
    const auto velocity = vectorColumns(vertices, "v", fileName);
    const auto given = 3 - std::ranges::count(velocity, nullptr);
    if (given != 0 && given != 3) throw InputError(fileName, "velocities need all of vx, vy and vz");
    const PlyColumn* radius = nullptr;
    for (const std::string_view name : kRadiusNames)
        if (radius == nullptr)
            radius = checkedColumn(vertices, name, kRadius, fileName);
        else if (vertices.column(name) != nullptr)
            vertices.skipped.emplace_back(name);
    const PlyColumn* const mass = checkedColumn(vertices, "mass", kMass, fileName);
    const PlyColumn* const material = checkedColumn(vertices, "material", kMaterial, fileName);

    ParticleFile file;
    file.hasRadius = radius != nullptr;
    file.hasMass = mass != nullptr;
    file.hasMaterial = material != nullptr;
    file.skipped = std::move(vertices.skipped);
    const auto vectorAt = [](const std::array<const PlyColumn*, 3>& columns, std::size_t index) {
        return engine::Vec3(columns[0]->values[index], columns[1]->values[index], columns[2]->values[index]);
    };
    for (std::size_t index = 0; index < vertices.count; ++index) {
        engine::NewParticle particle;
        particle.position = vectorAt(position, index);
        particle.velocity = given == 3 ? vectorAt(velocity, index) : engine::Vec3(engine::Vec3::Zero());
        particle.radius = radius != nullptr ? radius->values[index] : 0.0;
        particle.mass = mass != nullptr ? mass->values[index] : 0.0;
        particle.material = material != nullptr ? static_cast<std::uint32_t>(material->values[index]) : 0;
        append(file.particles, particle);
    }
    return file;
}

}  // namespace

std::string encodeParticles(const engine::Particles& particles, const std::optional<StateStamp>& stamp) {
    std::string bytes =
        fmt::format("ply\nformat binary_little_endian 1.0\ncomment globular particles\n{}element vertex {}\n",
                    commentsOf(stamp), particles.count());
    for (const std::string_view name : kRealProperties) bytes += fmt::format("property double {}\n", name);
    bytes += "property uint material\nproperty uint id\nend_header\n";
    for (std::size_t index = 0; index < particles.count(); ++index) {
        put(bytes, particles.position[index]);
        put(bytes, particles.velocity[index]);
        put(bytes, particles.radius[index]);
        put(bytes, particles.mass[index]);
        put(bytes, particles.birthTime[index]);
        put(bytes, particles.material[index]);
        put(bytes, particles.id[index]);
    }
    return bytes;
}

ParticleFile decodeParticles(std::string_view bytes, const std::string& fileName) {
    return particlesOf(readPlyVertices(bytes, fileName, kReadProperties), fileName);
}

ParticleState decodeState(std::string_view bytes, const std::string& fileName) {
    PlyVertices vertices = readPlyVertices(bytes, fileName, kReadProperties);
    ParticleState state;
    state.stamp = {numberNamed<int>(vertices, "frame", fileName), numberNamed<double>(vertices, "time", fileName),
                   commentNamed(vertices, "simulation_hash", fileName)};
    for (const char* name : {"vx", "radius", "mass", "birth_time", "material", "id"})
        if (vertices.column(name) == nullptr)
            throw InputError(fileName, fmt::format("property \"{}\" is missing", name));
    const std::vector<double> birthTimes = checkedColumn(vertices, "birth_time", kTime, fileName)->values;
    const std::vector<double> ids = checkedColumn(vertices, "id", kId, fileName)->values;
    state.particles = particlesOf(std::move(vertices), fileName).particles;
    state.particles.birthTime = birthTimes;
    for (std::size_t index = 0; index < ids.size(); ++index)
        state.particles.id[index] = static_cast<std::uint32_t>(ids[index]);
    if (!ids.empty()) state.particles.nextId = state.particles.id.back() + 1;
    return state;
}

}  // namespace scenes
