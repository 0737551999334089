// Tests particle files: a round trip bit for bit, files of other programs that are accepted, and all that is rejected.
#include "tests/catch.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <limits>

#include "scenes/particles/particle_file.h"
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
    append(particles, {.position = Vec3(4, 5, 6),
                       .velocity = Vec3(7, 8, 9),
                       .radius = 0.2,
                       .mass = 0.03,
                       .birthTime = 0.1,
                       .material = 4000000000U});
    return particles;
}

const scenes::StateStamp kStamp = {45, 1.0 / 3.0, "0123456789abcdef"};

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
    CHECK(file.skipped.empty());
    CHECK(file.particles.birthTime == std::vector<double>{0.0, 0.0});  // a body is born when the run starts
}

TEST_CASE("a state says which moment of which scene it is, and has ids and times of birth") {
    engine::Particles before = sample();
    engine::keepWhere(before, [](std::size_t index) { return index == 1; });
    const scenes::ParticleState state = scenes::decodeState(scenes::encodeParticles(before, kStamp), "a.ply");
    CHECK(state.stamp == kStamp);
    CHECK(state.particles.position == before.position);
    CHECK(state.particles.birthTime == std::vector<double>{0.1});
    CHECK(state.particles.id == std::vector<std::uint32_t>{1});
    CHECK(state.particles.nextId == 2);
    CHECK(scenes::decodeState(scenes::encodeParticles({}, kStamp), "a.ply").particles.count() == 0);
}

TEST_CASE("what is no state of a run is rejected as one") {
    const auto problem = [](const std::string& bytes) {
        try {
            scenes::decodeState(bytes, "a.ply");
        } catch (const scenes::InputError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const auto without = [](const std::string& text) {
        std::string bytes = scenes::encodeParticles({}, kStamp);
        return bytes.erase(bytes.find(text), text.size());
    };
    const std::string by = ": it is no state that this version of `globular simulate` has written";
    CHECK(problem(scenes::encodeParticles(sample())) == "a.ply: the header has no \"comment frame ...\"" + by);
    CHECK(problem(without("comment time 0.3333333333333333\n")) ==
          "a.ply: the header has no \"comment time ...\"" + by);
    CHECK(problem(without("property double birth_time\n")) == "a.ply: property \"birth_time\" is missing");
    CHECK(problem(without("property uint id\n")) == "a.ply: property \"id\" is missing");
    std::string bytes = scenes::encodeParticles({}, kStamp);
    bytes.replace(bytes.find("frame 45"), 8, "frame -1");
    CHECK(problem(bytes) == "a.ply: the comment frame is \"-1\", must be a number >= 0");
    const std::string whole = scenes::encodeParticles(sample(), kStamp);
    for (std::size_t length = 0; length < whole.size(); ++length) CHECK(problem(whole.substr(0, length)) != "no error");
}

TEST_CASE("the format is as documented") {
    const std::string bytes = scenes::encodeParticles(sample());
    const std::string expected =
        "ply\nformat binary_little_endian 1.0\ncomment globular particles\nelement vertex 2\n"
        "property double x\nproperty double y\nproperty double z\nproperty double vx\nproperty double vy\nproperty "
        "double vz\n"
        "property double radius\nproperty double mass\nproperty double birth_time\nproperty uint material\nproperty "
        "uint id\nend_header\n";
    CHECK(bytes.substr(0, expected.size()) == expected);
    // Each row has 9 doubles and 2 unsigned integers.
    CHECK(bytes.size() == expected.size() + 2 * (9 * 8 + 2 * 4));
    CHECK(bytes.substr(expected.size(), 8) == bytesOf(0.1));
    CHECK(bytes.substr(bytes.size() - 4) == bytesOf(std::uint32_t{1}));
    CHECK(scenes::encodeParticles(sample(), kStamp)
              .starts_with("ply\nformat binary_little_endian 1.0\ncomment globular particles\ncomment frame 45\n"
                           "comment time 0.3333333333333333\ncomment simulation_hash 0123456789abcdef\n"
                           "element vertex 2\n"));
}

TEST_CASE("files of earlier versions, without times of birth, are still read") {
    const std::string bytes =
        header(kDoubles +
               "property double vx\nproperty double vy\nproperty double vz\nproperty double radius\n"
               "property double mass\nproperty uint material\nproperty uint id\n") +
        kOrigin + kOrigin + bytesOf(0.15) + bytesOf(1.0) + bytesOf(std::uint32_t{3}) + bytesOf(std::uint32_t{7});
    const scenes::ParticleFile file = scenes::decodeParticles(bytes, "a.ply");
    CHECK(file.particles.material == std::vector<std::uint32_t>{3});
    CHECK(file.skipped.empty());
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

TEST_CASE("particles are read from text and from either byte order") {
    const std::string properties = "property float x\nproperty double y\nproperty short z\nproperty uchar material\n";
    const auto file = [&](const std::string& format, const std::string& rows) {
        return scenes::decodeParticles(
            "ply\nformat " + format + " 1.0\nelement vertex 2\n" + properties + "end_header\n" + rows, "a.ply");
    };
    const auto swapped = [](std::string bytes) { return std::string(bytes.rbegin(), bytes.rend()); };
    const auto row = [](float x, double y, std::int16_t z) {
        return std::vector<std::string>{bytesOf(x), bytesOf(y), bytesOf(z)};
    };
    std::string little, big;
    for (const std::vector<std::string>& numbers : {row(0.5F, -1e-3, -300), row(2.25F, 7.0, 258)}) {
        for (const std::string& number : numbers) {
            little += number;
            big += swapped(number);
        }
        little += '\x02';
        big += '\x02';
    }
    for (const scenes::ParticleFile& read : {file("ascii", "0.5 -1e-3 -300 2\n  2.25\t7\r\n258 2"),
                                             file("binary_little_endian", little), file("binary_big_endian", big)}) {
        REQUIRE(read.particles.count() == 2);
        CHECK(read.particles.position[0] == Vec3(0.5, -1e-3, -300.0));
        CHECK(read.particles.position[1] == Vec3(2.25, 7.0, 258.0));
        CHECK(read.particles.material == std::vector<std::uint32_t>{2, 2});
        CHECK(read.skipped.empty());
    }
}

TEST_CASE("every number type is read, under both of its names") {
    const auto read = [](const std::string& type, const std::string& number) {
        const std::string bytes =
            header("property " + type + " x\nproperty uchar y\nproperty uchar z\n") + number + std::string(2, '\0');
        return scenes::decodeParticles(bytes, "a.ply").particles.position.at(0).x();
    };
    for (const char* type : {"char", "int8"}) CHECK(read(type, bytesOf(std::int8_t{-128})) == -128.0);
    for (const char* type : {"uchar", "uint8"}) CHECK(read(type, bytesOf(std::uint8_t{255})) == 255.0);
    for (const char* type : {"short", "int16"}) CHECK(read(type, bytesOf(std::int16_t{-32768})) == -32768.0);
    for (const char* type : {"ushort", "uint16"}) CHECK(read(type, bytesOf(std::uint16_t{65535})) == 65535.0);
    for (const char* type : {"int", "int32"}) CHECK(read(type, bytesOf(std::int32_t{-70000})) == -70000.0);
    for (const char* type : {"uint", "uint32"}) CHECK(read(type, bytesOf(std::uint32_t{70000})) == 70000.0);
    for (const char* type : {"float", "float32"}) CHECK(read(type, bytesOf(0.1F)) == static_cast<double>(0.1F));
    for (const char* type : {"double", "float64"}) CHECK(read(type, bytesOf(0.1)) == 0.1);
}

TEST_CASE("what other programs write beside particles is skipped and named") {
    // Colors and normals, lists before and after the vertices, elements of every kind, bytes at the end.
    const std::string bytes =
        "ply\nformat ascii 1.0\ncomment by another program\nobj_info of its own\nelement camera 1\n"
        "property list uchar float matrix\nproperty float\tfocus\nelement vertex 1\nproperty float nx\n" +
        kDoubles + "property list uchar int tags\nproperty int id\nelement face 1\n" +
        "property list uchar int vertex_indices\nend_header\n3 1 2 3 0.5\n9 4 5 6 2 7 8 77\n3 0 0 0\n";
    const scenes::ParticleFile file = scenes::decodeParticles(bytes, "a.ply");
    CHECK(file.particles.position.at(0) == Vec3(4, 5, 6));
    CHECK(file.particles.id.at(0) == 0);
    CHECK(file.skipped == std::vector<std::string>{"element camera", "nx", "tags", "element face"});
    CHECK(scenes::decodeParticles(header(kDoubles) + kOrigin + "x", "a.ply").skipped ==
          std::vector<std::string>{"1 bytes at the end"});
}

TEST_CASE("lines of a header may end as on any system") {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string text = header(kDoubles);
        for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
            text.replace(at, 1, end);
        // The first byte of the data is a line feed, which a reader of "\r" must not take for the end of a line.
        CHECK(scenes::decodeParticles(text + "\n" + kOrigin.substr(1), "a.ply").particles.count() == 1);
    }
}

TEST_CASE("the radius has other names elsewhere") {
    const auto radius = [](const std::string& properties, const std::string& numbers) {
        return scenes::decodeParticles(header(kDoubles + properties) + kOrigin + numbers, "a.ply");
    };
    CHECK(radius("property float pscale\n", bytesOf(0.25F)).particles.radius.at(0) == 0.25);
    CHECK(radius("property float psize\n", bytesOf(0.5F)).particles.radius.at(0) == 0.5);
    const auto both = radius("property float pscale\nproperty float radius\n", bytesOf(0.25F) + bytesOf(0.125F));
    CHECK(both.particles.radius.at(0) == 0.125);
    CHECK(both.skipped == std::vector<std::string>{"pscale"});
}

TEST_CASE("headers with mistakes are rejected") {
    CHECK(problemOf("plyx\n") == "a.ply: is not a PLY file");
    CHECK(problemOf("ply\nformat binary 1.0\n") ==
          "a.ply:2:1: the format must be ascii, binary_little_endian, binary_big_endian 1.0");
    CHECK(problemOf("ply\nformat ascii 2.0\n") ==
          "a.ply:2:1: the format must be ascii, binary_little_endian, binary_big_endian 1.0");
    CHECK(problemOf("ply\nformat binary_little_endian 1.0\n") == "a.ply:3:1: the header has no end_header");
    CHECK(problemOf(std::string("ply\n").append(70000, 'c') + '\n') == "a.ply:2:1: the header has no end_header");
    CHECK(problemOf(std::string("ply\nelement vertex 1\n") + kDoubles + "end_header\n" + kOrigin) ==
          "a.ply: the header has no format line");
    const std::string noVertex = "a.ply: the header must have one element \"vertex\"";
    CHECK(problemOf("ply\nformat binary_little_endian 1.0\nend_header\n") == noVertex);
    CHECK(problemOf(header("element vertex 2\n")) == noVertex);
    CHECK(problemOf(header("property list uchar int\n")) ==
          "a.ply:4:1: a property must be a type and a name, or a list");
    CHECK(problemOf("ply\nformat binary_little_endian 1.0\nelement vertex -1\n") ==
          "a.ply:3:1: the count is \"-1\", must be a whole number");
    CHECK(problemOf(header("sorcery\n")) == "a.ply:4:1: unknown header line \"sorcery\"");
    CHECK(problemOf("ply\nproperty double x\n") == "a.ply:2:1: property before its element");
    CHECK(problemOf(header("property half x\n")) == "a.ply:4:1: unknown type \"half\"");
}

TEST_CASE("properties with mistakes are rejected") {
    CHECK(problemOf(header("property list uchar float x\n")) == "a.ply: property \"x\" is a list, must be a number");
    CHECK(problemOf(header("property double x\nproperty double x\n")) == "a.ply: property \"x\" is given twice");
    CHECK(problemOf(header("property double x\nproperty double y\n") + kOrigin) == "a.ply: property \"z\" is missing");
    CHECK(problemOf(header(kDoubles + "property double vx\n") + kOrigin + kOrigin) ==
          "a.ply: velocities need all of vx, vy and vz");
}

TEST_CASE("a file that ends before its vertices do is rejected") {
    CHECK(problemOf(header(kDoubles) + kOrigin) == "no error");
    CHECK(problemOf(header(kDoubles) + kOrigin.substr(1)) ==
          "a.ply: vertex 0 of 1: z is missing, the file ends before it");
    // A count that would need more memory than there is has to be rejected before memory is allocated.
    CHECK(problemOf("ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\n" + kDoubles +
                    "end_header\n" + kOrigin) ==
          "a.ply: vertex 1 of 18446744073709551615: x is missing, the file ends before it");
    const std::string text = "ply\nformat ascii 1.0\nelement vertex 1\n" + kDoubles + "end_header\n";
    CHECK(problemOf(text + "1 2 3") == "no error");
    CHECK(problemOf(text + "1 2") == "a.ply: vertex 0 of 1: z is missing, the file ends before it");
    CHECK(problemOf(text + "1 2 3d") == "a.ply: vertex 0 of 1: z is \"3d\", must be a number");
    CHECK(problemOf(text + "1 2 nan") == "a.ply: particle 0: z is nan, must be -100000000 to 100000000");
    const std::string whole = scenes::encodeParticles(sample());
    for (std::size_t length = 0; length < whole.size(); ++length)
        CHECK(problemOf(whole.substr(0, length)) != "no error");
}

TEST_CASE("numbers that are invalid for a particle are rejected") {
    const auto with = [](double x, const std::string& property, double value) {
        return problemOf(header(kDoubles + "property double " + property + "\n") + bytesOf(x) + kOrigin.substr(8) +
                         bytesOf(value));
    };
    CHECK(with(0.0, "radius", 0.1) == "no error");
    for (const double radius : {0.0, -1.0, 1e-30, 1e39, std::numeric_limits<double>::quiet_NaN()})
        CHECK(with(0.0, "radius", radius) ==
              fmt::format("a.ply: particle 0: radius is {}, must be 1e-09 to 10000000", radius));
    CHECK(with(0.0, "mass", 0.0) == "a.ply: particle 0: mass is 0, must be 1e-30 to 1e+30");
    CHECK(with(0.0, "material", 1.5) ==
          "a.ply: particle 0: material is 1.5, must be a whole number from 0 to 4294967295");
    CHECK(with(0.0, "material", -1.0) ==
          "a.ply: particle 0: material is -1, must be a whole number from 0 to 4294967295");
    const std::string world = ", must be -100000000 to 100000000";
    CHECK(with(std::numeric_limits<double>::infinity(), "radius", 0.1) == "a.ply: particle 0: x is inf" + world);
    CHECK(with(std::numeric_limits<double>::quiet_NaN(), "radius", 0.1) == "a.ply: particle 0: x is nan" + world);
    CHECK(with(2e8, "radius", 0.1) == "a.ply: particle 0: x is 200000000" + world);
    CHECK(problemOf(header(kDoubles + "property double vx\nproperty double vy\nproperty double vz\n", 2) +
                    std::string(48 + 24 + 16, '\0') + bytesOf(-1e9)) == "a.ply: particle 1: vz is -1000000000" + world);
}
