// Bytes of particles, written and read a byte at a time, so that the machine's own byte order does not matter.
#include "scenes/model/particle_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "scenes/model/ply_header.h"
#include "scenes/text/input_error.h"

namespace scenes {
namespace {

void putBytes(std::string& bytes, std::uint64_t bits, std::size_t count) {
    for (std::size_t byte = 0; byte < count; ++byte)
        bytes += static_cast<char>(static_cast<unsigned char>(bits >> (8 * byte)));
}

void putDouble(std::string& bytes, double number) {
    putBytes(bytes, std::bit_cast<std::uint64_t>(number), 8);
}

void putVector(std::string& bytes, const engine::Vec3& vector) {
    for (int axis = 0; axis < 3; ++axis) putDouble(bytes, vector[axis]);
}

std::uint64_t bitsAt(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint64_t bits = 0;
    for (std::size_t byte = 0; byte < count; ++byte)
        bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + byte])) << (8 * byte);
    return bits;
}

double numberAt(std::string_view bytes, std::size_t at, PlyType type) {
    const std::size_t size = sizeOf(type);
    const std::uint64_t bits = bitsAt(bytes, at, size);
    if (type == PlyType::float64) return std::bit_cast<double>(bits);
    if (type == PlyType::float32) return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    return static_cast<double>(bits);
}

/// The property "id" is not among them: ids follow the order of the rows.
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

/// Empty if a value is possible.
std::string whatIsWrong(const std::string& name, double value) {
    if (!std::isfinite(value)) return "must be finite";
    if ((name == "radius" || name == "mass") && !(value > 0.0)) return "must be > 0";
    return {};
}

}  // namespace

std::string encodeParticles(const engine::Particles& particles) {
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment globular particles\nelement vertex {}\n", particles.count());
    for (const char* name : {"x", "y", "z", "vx", "vy", "vz", "radius", "mass"})
        bytes += fmt::format("property double {}\n", name);
    bytes += "property uint material\nproperty uint id\nend_header\n";
    for (std::size_t index = 0; index < particles.count(); ++index) {
        putVector(bytes, particles.position[index]);
        putVector(bytes, particles.velocity[index]);
        putDouble(bytes, particles.radius[index]);
        putDouble(bytes, particles.mass[index]);
        putBytes(bytes, particles.material[index], 4);
        putBytes(bytes, particles.id[index], 4);
    }
    return bytes;
}

ParticleFile decodeParticles(std::string_view bytes, const std::string& fileName) {
    const PlyHeader header = readPlyHeader(bytes, fileName);
    ParticleFile file;
    file.hasVelocity = header.has("vx");
    file.hasRadius = header.has("radius");
    file.hasMass = header.has("mass");
    file.hasMaterial = header.has("material");
    std::size_t at = header.size;
    for (std::uint64_t index = 0; index < header.count; ++index) {
        engine::NewParticle particle;
        particle.radius = particle.mass = 0.0;
        for (const PlyProperty& property : header.properties) {
            const double value = numberAt(bytes, at, property.type);
            at += sizeOf(property.type);
            if (const std::string wrong = whatIsWrong(property.name, value); !wrong.empty())
                throw InputError(
                    {{fileName, 0, 0, fmt::format("particle {}: {} is {}, {}", index, property.name, value, wrong)}});
            setProperty(particle, property.name, value);
        }
        append(file.particles, particle);
    }
    return file;
}

}  // namespace scenes
