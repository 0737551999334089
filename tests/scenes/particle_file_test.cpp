// Tests particle files: a round trip bit for bit, files of other programs that are accepted, and all that is rejected.
#include "tests/catch.h"

#include <bit>
#include <cstring>
#include <limits>

#include "scenes/model/particle_file.h"
#include "scenes/text/input_error.h"

using engine::Vec3;

namespace {

engine::Particles sample() {
    engine::Particles particles;
    append(particles, {.position = Vec3(0.1, -0.0, 1e-310),
                       .velocity = Vec3(1.0 / 3.0, -2.5, 1e-300),
                       .radius = 0.15,
                       .mass = 1.0,
                       .material = 0});
    append(
        particles,
        {.position = Vec3(4, 5, 6), .velocity = Vec3(7, 8, 9), .radius = 0.2, .mass = 0.03, .material = 4000000000U});
    return particles;
}

std::string header(const std::string& properties, int count = 1) {
    std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex ";
    text += std::to_string(count);
    text += '\n';
    return text + properties + "end_header\n";
}

template <class Number>
std::string bytesOf(Number number) {
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    static_assert(std::endian::native == std::endian::little);
    return bytes;
}

std::string problemOf(const std::string& bytes) {
    try {
        scenes::decodeParticles(bytes, "a.ply");
    } catch (const scenes::InputError& error) {
        return error.what();
    }
    return "no error";
}

const std::string kDoubles = "property double x\nproperty double y\nproperty double z\n";
const std::string kOrigin(24, '\0');

}  // namespace

TEST_CASE("a particle file preserves every bit") {
    const engine::Particles before = sample();
    const scenes::ParticleFile file = scenes::decodeParticles(scenes::encodeParticles(before), "a.ply");
    CHECK(file.hasRadius);
    CHECK(file.hasMass);
    CHECK(file.hasMaterial);
    REQUIRE(file.particles.count() == 2);
    for (std::size_t index = 0; index < 2; ++index)
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(std::bit_cast<std::uint64_t>(file.particles.position[index][axis]) ==
                  std::bit_cast<std::uint64_t>(before.position[index][axis]));
            CHECK(std::bit_cast<std::uint64_t>(file.particles.velocity[index][axis]) ==
                  std::bit_cast<std::uint64_t>(before.velocity[index][axis]));
        }
    CHECK(file.particles.radius == before.radius);
    CHECK(file.particles.mass == before.mass);
    CHECK(file.particles.material == before.material);
    CHECK(file.particles.id == before.id);
}

TEST_CASE("the format is as documented") {
    const std::string bytes = scenes::encodeParticles(sample());
    const std::string expected =
        "ply\nformat binary_little_endian 1.0\ncomment globular particles\nelement vertex 2\n"
        "property double x\nproperty double y\nproperty double z\nproperty double vx\nproperty double vy\nproperty "
        "double vz\n"
        "property double radius\nproperty double mass\nproperty uint material\nproperty uint id\nend_header\n";
    CHECK(bytes.substr(0, expected.size()) == expected);
    // Each row has 8 doubles and 2 unsigned integers.
    CHECK(bytes.size() == expected.size() + 2 * (8 * 8 + 2 * 4));
    CHECK(bytes.substr(expected.size(), 8) == bytesOf(0.1));
    CHECK(bytes.substr(bytes.size() - 4) == bytesOf(std::uint32_t{1}));
}

TEST_CASE("a file without particles is valid") {
    CHECK(scenes::decodeParticles(scenes::encodeParticles({}), "a.ply").particles.count() == 0);
}

TEST_CASE("properties may come in any order and precision, and velocities may be left out") {
    const std::string bytes =
        header("comment by hand\nproperty float z\nproperty uchar material\nproperty double x\nproperty float32 y\n") +
        bytesOf(3.5F) + std::string(1, '\x02') + bytesOf(1.25) + bytesOf(-2.0F);
    const scenes::ParticleFile file = scenes::decodeParticles(bytes, "a.ply");
    CHECK(file.particles.position.at(0) == Vec3(1.25, -2.0, 3.5));
    CHECK(file.particles.velocity.at(0) == Vec3(0.0, 0.0, 0.0));
    CHECK(file.particles.material.at(0) == 2);
    CHECK(file.hasMaterial);
    CHECK(!file.hasRadius);
    CHECK(!file.hasMass);
}

TEST_CASE("headers with mistakes are rejected") {
    CHECK(problemOf("") == "a.ply: is not a PLY file");
    CHECK(problemOf("plyx\n") == "a.ply: is not a PLY file");
    CHECK(problemOf("ply\nformat ascii 1.0\n") == "a.ply:2:1: the format must be \"binary_little_endian 1.0\"");
    CHECK(problemOf("ply\nformat binary_little_endian 1.0\n") == "a.ply:3:1: the header has no end_header");
    CHECK(problemOf(std::string("ply\n").append(70000, 'c') + '\n') == "a.ply:2:1: the header has no end_header");
    CHECK(problemOf(std::string("ply\nelement vertex 1\n") + kDoubles + "end_header\n" + kOrigin) ==
          "a.ply: the header has no format line");
    CHECK(problemOf("ply\nformat binary_little_endian 1.0\nend_header\n") ==
          "a.ply: the header has no element \"vertex\"");
    CHECK(problemOf(header("property list uchar int vertex_indices\n")) ==
          "a.ply:4:1: a property must be a type and a name; lists are not supported");
    CHECK(problemOf(header("element face 2\n")) == "a.ply:4:1: must have the one element \"vertex\" and its count");
    CHECK(problemOf("ply\nformat binary_little_endian 1.0\nelement vertex -1\n") ==
          "a.ply:3:1: the count of vertices is \"-1\", must be a whole number");
    CHECK(problemOf(header("sorcery\n")) == "a.ply:4:1: unknown header line \"sorcery\"");
    CHECK(problemOf("ply\nproperty double x\n") == "a.ply:2:1: property before its element");
}

TEST_CASE("properties with mistakes are rejected") {
    CHECK(problemOf(header("property int x\n")) == "a.ply:4:1: property \"x\" has type int, must be float or double");
    CHECK(problemOf(header("property uint x\n")) == "a.ply:4:1: property \"x\" has type uint, must be float or double");
    CHECK(problemOf(header("property double id\n")) ==
          "a.ply:4:1: property \"id\" has type double, must be uchar, ushort or uint");
    CHECK(problemOf(header("property double q\n")) ==
          "a.ply:4:1: unknown property \"q\" (known: x, y, z, vx, vy, vz, radius, mass, material, id)");
    CHECK(problemOf(header("property double x\nproperty double x\n")) == "a.ply:5:1: property \"x\" is given twice");
    CHECK(problemOf(header("property double x\nproperty double y\n")) == "a.ply: property \"z\" is missing");
    CHECK(problemOf(header(kDoubles + "property double vx\n")) == "a.ply: velocities need all of vx, vy and vz");
}

TEST_CASE("rows have to fill the file exactly") {
    CHECK(problemOf(header(kDoubles) + kOrigin) == "no error");
    CHECK(problemOf(header(kDoubles) + kOrigin.substr(1)) ==
          "a.ply: truncated: 1 particles of 24 bytes are announced, 23 bytes follow");
    CHECK(problemOf(header(kDoubles) + kOrigin + "x") == "a.ply: 1 bytes follow the last particle");
    // A count that would need more memory than there is has to be rejected before memory is allocated.
    CHECK(problemOf("ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\n" + kDoubles +
                    "end_header\n" + kOrigin) ==
          "a.ply: truncated: 18446744073709551615 particles of 24 bytes are announced, 24 bytes follow");
    // 2^61 + 1 rows of 24 bytes are 24 bytes modulo 2^64.
    CHECK(problemOf("ply\nformat binary_little_endian 1.0\nelement vertex 2305843009213693953\n" + kDoubles +
                    "end_header\n" + kOrigin) ==
          "a.ply: truncated: 2305843009213693953 particles of 24 bytes are announced, 24 bytes follow");
    const std::string whole = scenes::encodeParticles(sample());
    for (std::size_t length = 0; length < whole.size(); ++length)
        CHECK(problemOf(whole.substr(0, length)) != "no error");
}

TEST_CASE("numbers that are invalid for a particle are rejected") {
    const auto withRadius = [](double x, double radius) {
        return problemOf(header(kDoubles + "property double radius\n") + bytesOf(x) + kOrigin.substr(8) +
                         bytesOf(radius));
    };
    CHECK(withRadius(0.0, 0.1) == "no error");
    CHECK(withRadius(0.0, 0.0) == "a.ply: particle 0: radius is 0, must be > 0");
    CHECK(withRadius(0.0, -1.0) == "a.ply: particle 0: radius is -1, must be > 0");
    CHECK(withRadius(std::numeric_limits<double>::infinity(), 0.1) == "a.ply: particle 0: x is inf, must be finite");
    CHECK(withRadius(std::numeric_limits<double>::quiet_NaN(), 0.1) == "a.ply: particle 0: x is nan, must be finite");
    CHECK(withRadius(-1e8, 0.1) == "no error");
    CHECK(withRadius(2e8, 0.1) == "a.ply: particle 0: x is 200000000, must be -100000000 to 100000000");
    CHECK(problemOf(header(kDoubles + "property double vx\nproperty double vy\nproperty double vz\n", 2) +
                    std::string(48 + 24 + 16, '\0') + bytesOf(-1e9)) ==
          "a.ply: particle 1: vz is -1000000000, must be -100000000 to 100000000");
}
