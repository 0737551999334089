// Positions, velocities, radii, masses and materials as columns of files. What is not known is skipped and named; what
// is known must be right, because a particle in the wrong place is harder to notice than a message.
#include "scenes/particles/particle_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "engine/state/state_checks.h"
#include "scenes/particles/extxyz.h"
#include "scenes/particles/lammps_dump.h"
#include "scenes/particles/number_type.h"
#include "scenes/particles/ply.h"
#include "scenes/particles/vtp.h"
#include "scenes/text/input_error.h"

namespace scenes {
namespace {

constexpr std::array<std::string_view, 9> kRealProperties = {"x",  "y",      "z",    "vx",        "vy",
                                                             "vz", "radius", "mass", "birth_time"};

/// Names of the radius: ours, and those of Houdini and of programs that read its files.
constexpr std::array<std::string_view, 3> kRadiusNames = {"radius", "pscale", "psize"};

/// Properties that are read or may be left out silently: a body takes neither "birth_time", because its particles are
/// born when the run starts, nor "id", because they get new ids in the order of the rows.
constexpr std::array<std::string_view, 15> kReadProperties = {
    "x",     "y",    "z",          "vx",       "vy", "vz",       "radius",     "pscale",
    "psize", "mass", "birth_time", "material", "id", "enthalpy", "temperature"};

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
constexpr Rule kEnthalpy{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
constexpr Rule kTime{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};

/// A table that was read from a file.
struct TableOfFile {
    ParticleTable& table;
    const std::string& fileName;
};

/// A column of the table, if it has one of that name. All its numbers keep the rule.
/// @throws InputError that names the first that does not
const NumberColumn* checkedColumn(const TableOfFile& file, std::string_view name, const Rule& rule) {
    const NumberColumn* const column = file.table.column(name);
    if (column == nullptr) return nullptr;
    for (std::size_t index = 0; index < file.table.count; ++index) {
        const double value = column->values[index];
        const bool isValid = rule.low <= value && value <= rule.high && !(rule.isWhole && value != std::floor(value));
        if (isValid) continue;
        const int line = file.table.firstLine > 0 ? file.table.firstLine + static_cast<int>(index) : 0;
        throw InputError({{file.fileName, line, 0,
                           fmt::format("particle {}: {} is {}, must be {}{} to {}", index, name, value,
                                       rule.isWhole ? "a whole number from " : "", rule.low, rule.high)}});
    }
    return column;
}

/// The three columns of a vector's components; all or none of them are there.
std::array<const NumberColumn*, 3> vectorColumns(const TableOfFile& file, std::string_view prefix) {
    std::array<const NumberColumn*, 3> columns{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        columns[axis] = checkedColumn(file, std::string(prefix) + static_cast<char>('x' + axis), kCoordinate);
    return columns;
}

/// The column of the radius, by the first of its names that the table has; the others count as skipped.
const NumberColumn* radiusColumn(const TableOfFile& file) {
    const NumberColumn* radius = nullptr;
    for (const std::string_view name : kRadiusNames)
        if (radius == nullptr)
            radius = checkedColumn(file, name, kRadius);
        else if (file.table.column(name) != nullptr)
            file.table.skipped.emplace_back(name);
    return radius;
}

std::string commentsOf(const std::optional<StateStamp>& stamp) {
    if (!stamp) return {};
    return fmt::format("comment frame {}\ncomment time {}\ncomment simulation_hash {}\n", stamp->frame, stamp->time,
                       stamp->simulationHash);
}

/// The words after the first one in the comment that begins with that one.
/// @throws InputError if there is no such comment
std::string commentNamed(const ParticleTable& vertices, const std::string& name, const std::string& fileName) {
    for (const std::string& comment : vertices.comments)
        if (comment.starts_with(name + ' ')) return comment.substr(name.size() + 1);
    throw InputError(fileName,
                     fmt::format("the header has no \"comment {} ...\": it is no state that this version of `globular "
                                 "simulate` has written",
                                 name));
}

template <class Number>
Number numberNamed(const ParticleTable& vertices, const std::string& name, const std::string& fileName) {
    const std::string text = commentNamed(vertices, name, fileName);
    Number number{};
    const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || !(number >= 0))
        throw InputError(fileName, fmt::format("the comment {} is \"{}\", must be a number >= 0", name, text));
    return number;
}

/// Reads the rows of a file of any format, which its first bytes tell.
ParticleTable readTable(std::string_view bytes, const std::string& fileName) {
    if (isPly(bytes)) return readPlyVertices(bytes, fileName, kReadProperties);
    if (isLammpsDump(bytes)) return readLammpsDump(bytes, fileName);
    if (isExtxyz(bytes)) return readExtxyz(bytes, fileName);
    if (isXml(bytes)) return readVtp(bytes, fileName);
    throw InputError(fileName,
                     "is no particle file: neither PLY nor VTK PolyData (.vtp), extended XYZ or a LAMMPS dump as text");
}

/// Makes particles of the rows of a file.
ParticleFile particlesOf(ParticleTable table, const std::string& fileName) {
    const TableOfFile source{table, fileName};
    const auto position = vectorColumns(source, "");
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (position[axis] == nullptr)
            throw InputError(fileName, fmt::format("property \"{}\" is missing", static_cast<char>('x' + axis)));
    const auto velocity = vectorColumns(source, "v");
    const auto given = 3 - std::ranges::count(velocity, nullptr);
    if (given != 0 && given != 3) throw InputError(fileName, "velocities need all of vx, vy and vz");
    const NumberColumn* const radius = radiusColumn(source);
    const NumberColumn* const mass = checkedColumn(source, "mass", kMass);
    const NumberColumn* const material = checkedColumn(source, "material", kMaterial);
    const NumberColumn* const enthalpy = checkedColumn(source, "enthalpy", kEnthalpy);
    const NumberColumn* const temperature = table.column("temperature");

    ParticleFile file;
    file.hasRadius = radius != nullptr;
    file.hasMass = mass != nullptr;
    file.hasMaterial = material != nullptr;
    const auto vectorAt = [](const std::array<const NumberColumn*, 3>& columns, std::size_t index) {
        return engine::Vec3(columns[0]->values[index], columns[1]->values[index], columns[2]->values[index]);
    };
    for (std::size_t index = 0; index < table.count; ++index) {
        engine::NewParticle particle;
        particle.position = vectorAt(position, index);
        particle.velocity = given == 3 ? vectorAt(velocity, index) : engine::Vec3(engine::Vec3::Zero());
        particle.radius = radius != nullptr ? radius->values[index] : 0.0;
        particle.mass = mass != nullptr ? mass->values[index] : 0.0;
        particle.material = material != nullptr ? static_cast<std::uint32_t>(material->values[index]) : 0;
        if (enthalpy != nullptr) particle.enthalpy = enthalpy->values[index];
        append(file.particles, particle);
    }
    if (temperature != nullptr) file.temperature = temperature->values;
    file.skipped = std::move(table.skipped);
    file.speciesNames = std::move(table.speciesNames);
    file.species = std::move(table.species);
    return file;
}

}  // namespace

std::string encodeParticles(const engine::Particles& particles, const std::optional<StateStamp>& stamp) {
    std::string bytes =
        fmt::format("ply\nformat binary_little_endian 1.0\ncomment globular particles\n{}element vertex {}\n",
                    commentsOf(stamp), particles.count());
    for (const std::string_view name : kRealProperties) bytes += fmt::format("property double {}\n", name);
    const bool hasHeat = !particles.enthalpy.empty();
    bytes += "property uint material\nproperty uint id\n";
    if (hasHeat) bytes += "property double enthalpy\n";
    bytes += "end_header\n";
    for (std::size_t index = 0; index < particles.count(); ++index) {
        putBytes(bytes, particles.position[index]);
        putBytes(bytes, particles.velocity[index]);
        putBytes(bytes, particles.radius[index]);
        putBytes(bytes, particles.mass[index]);
        putBytes(bytes, particles.birthTime[index]);
        putBytes(bytes, particles.material[index]);
        putBytes(bytes, particles.id[index]);
        if (hasHeat) putBytes(bytes, particles.enthalpy[index]);
    }
    return bytes;
}

ParticleFile decodeParticles(std::string_view bytes, const std::string& fileName) {
    return particlesOf(readTable(bytes, fileName), fileName);
}

ParticleState decodeState(std::string_view bytes, const std::string& fileName) {
    ParticleTable table = readPlyVertices(bytes, fileName, kReadProperties);
    const TableOfFile source{table, fileName};
    ParticleState state;
    state.stamp = {numberNamed<int>(table, "frame", fileName), numberNamed<double>(table, "time", fileName),
                   commentNamed(table, "simulation_hash", fileName)};
    for (const char* name : {"vx", "radius", "mass", "birth_time", "material", "id"})
        if (table.column(name) == nullptr) throw InputError(fileName, fmt::format("property \"{}\" is missing", name));
    const std::vector<double> birthTimes = checkedColumn(source, "birth_time", kTime)->values;
    const std::vector<double> ids = checkedColumn(source, "id", kId)->values;
    state.particles = particlesOf(std::move(table), fileName).particles;
    state.particles.birthTime = birthTimes;
    for (std::size_t index = 0; index < ids.size(); ++index)
        state.particles.id[index] = static_cast<std::uint32_t>(ids[index]);
    if (!ids.empty()) state.particles.nextId = state.particles.id.back() + 1;
    return state;
}

const NumberColumn* ParticleTable::column(std::string_view name) const {
    const auto found = std::ranges::find(columns, name, &NumberColumn::name);
    return found == columns.end() ? nullptr : &*found;
}

}  // namespace scenes
