// Tests the formats of particle files: round trips bit for bit, files of other programs that are accepted, and all that
// is rejected, with its line.
#include "tests/catch.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <limits>

#include "scenes/particles/formats.h"
#include "scenes/particles/particle_file.h"
#include "scenes/particles/vtp.h"
#include "scenes/text/input_error.h"

using engine::Vec3;
using scenes::ParticleFile;

namespace {

/// Three particles of two materials and three radii, whose ids have a gap, with numbers that are hard to write.
engine::Particles sample() {
    engine::Particles particles;
    append(
        particles,
        {.position = Vec3(0.1, -0.0, 1e-310), .velocity = Vec3(1.0 / 3.0, -2.5, 1e-300), .radius = 0.15, .mass = 1.0});
    append(particles, {.position = Vec3(9, 9, 9)});
    append(particles, {.position = Vec3(4, 5, 6),
                       .velocity = Vec3(7, 8, 9),
                       .radius = 0.2,
                       .mass = 0.03,
                       .birthTime = 1.0 / 7.0,
                       .material = 1});
    append(particles, {.position = Vec3(-12345678.901234567, 0.30000000000000004, 3e7), .radius = 2e-9, .mass = 1e30});
    keepWhere(particles, [](std::size_t index) { return index != 1; });
    return particles;
}

scenes::ParticleFrame frameOf(const engine::Particles& particles) {
    return {particles, {42, 1.4, "0123456789abcdef"}, {"red drops", "the \"other\""}, {Vec3(1, 0, 0), Vec3(0, 0.5, 1)}};
}

const scenes::ParticleFormat& formatNamed(std::string_view name) {
    for (const scenes::ParticleFormat& format : scenes::particleFormats())
        if (format.name == name) return format;
    throw std::logic_error("no such format");
}

std::string encoded(std::string_view format, const engine::Particles& particles) {
    return formatNamed(format).encode(frameOf(particles));
}

ParticleFile decoded(const std::string& bytes) {
    return scenes::decodeParticles(bytes, "a.dat");
}

std::string formatProblem(const std::string& bytes) {
    try {
        decoded(bytes);
    } catch (const scenes::InputError& error) {
        return error.what();
    }
    return "no error";
}

bool haveSameBits(const std::vector<Vec3>& here, const std::vector<Vec3>& there) {
    const auto bitsOf = [](const std::vector<Vec3>& vectors) {
        std::vector<std::uint64_t> bits;
        for (const Vec3& vector : vectors)
            for (int axis = 0; axis < 3; ++axis) bits.push_back(std::bit_cast<std::uint64_t>(vector[axis]));
        return bits;
    };
    return bitsOf(here) == bitsOf(there);
}

std::string replaced(std::string text, const std::string& before, const std::string& after) {
    const std::size_t at = text.find(before);
    REQUIRE(at != std::string::npos);
    return text.replace(at, before.size(), after);
}

const std::string kDump = "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp ff\n-1 1\n0 4\n0 10\n";

const std::string kVtpTop =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\">\n<PolyData>\n";

/// A VTP file with two points and their data in ASCII. The first array of the data is on line 8.
std::string vtp(const std::string& data, const std::string& points = "0 1 2 3 4 5") {
    return kVtpTop +
           "<Piece NumberOfPoints=\"2\">\n<Points>\n<DataArray type=\"Float32\" NumberOfComponents=\"3\" "
           "format=\"ascii\">" +
           points + "</DataArray></Points>\n<PointData>\n" + data + "\n</PointData></Piece></PolyData></VTKFile>\n";
}

}  // namespace

TEST_CASE("every format in double or in shortest text preserves every bit", "[formats]") {
    const engine::Particles before = sample();
    for (const char* format : {"ply", "vtp", "extxyz", "lammps"}) {
        INFO(format);
        const ParticleFile file = decoded(encoded(format, before));
        CHECK(file.hasRadius);
        CHECK(file.hasMass);
        CHECK(file.hasMaterial);
        CHECK(file.skipped.empty());
        REQUIRE(file.particles.count() == 3);
        CHECK(haveSameBits(file.particles.position, before.position));
        CHECK(haveSameBits(file.particles.velocity, before.velocity));
        CHECK(file.particles.radius == before.radius);
        CHECK(file.particles.mass == before.mass);
        CHECK(file.particles.material == before.material);
        CHECK(file.particles.id == std::vector<std::uint32_t>{0, 1, 2});
    }
}

TEST_CASE("single precision is what a float holds", "[formats]") {
    engine::Particles before = sample();
    before.mass[2] = 2.0;
    const ParticleFile file = decoded(encoded("ply-float", before));
    CHECK(file.skipped.empty());
    REQUIRE(file.particles.count() == 3);
    for (std::size_t index = 0; index < 3; ++index)
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(file.particles.position[index][axis] == static_cast<float>(before.position[index][axis]));
            CHECK(file.particles.velocity[index][axis] == static_cast<float>(before.velocity[index][axis]));
        }
    CHECK(file.particles.radius[0] == static_cast<double>(0.15F));
    CHECK(file.particles.material == before.material);
}

TEST_CASE("no particles are a valid file in every format", "[formats]") {
    for (const scenes::ParticleFormat& format : scenes::particleFormats()) {
        INFO(format.name);
        const ParticleFile file = decoded(format.encode(frameOf(engine::Particles())));
        CHECK(file.particles.count() == 0);
        CHECK(file.skipped.empty());
    }
}

TEST_CASE("no part of a file is taken for the whole", "[formats]") {
    for (const char* format : {"ply", "ply-float", "vtp", "extxyz", "lammps"}) {
        engine::Particles particles = sample();
        particles.mass[2] = 2.0;
        const std::string whole = encoded(format, particles);
        // A text may end within its last number without that being noticed.
        const std::size_t last = whole.back() == '\n' ? whole.find_last_of(" >") : whole.size() - 1;
        for (std::size_t length = 0; length <= last; ++length) {
            INFO(format << " of " << length << " bytes");
            REQUIRE(formatProblem(whole.substr(0, length)) != "no error");
        }
    }
}

TEST_CASE("the formats have names of their own and different files", "[formats]") {
    std::vector<std::string> files;
    for (const scenes::ParticleFormat& format : scenes::particleFormats())
        files.push_back(fmt::format("{}00042{}", format.prefix, format.extension));
    CHECK(files == std::vector<std::string>{"particles-00042.ply", "particles-float-00042.ply", "particles-00042.vtp",
                                            "particles-00042.xyz", "particles-00042.lammpstrj"});
}

TEST_CASE("a series of VTP files is a list of names and times", "[formats]") {
    const std::vector<scenes::TimedFile> files = {{"a.vtp", 0.0}, {"b.vtp", 1.0 / 3.0}};
    CHECK(
        scenes::encodeVtpSeries(files) ==
        "{\n \"file-series-version\": \"1.0\",\n \"files\": [\n  {\n   \"name\": \"a.vtp\",\n   \"time\": 0.0\n  },\n  "
        "{\n   \"name\": \"b.vtp\",\n   \"time\": 0.3333333333333333\n  }\n ]\n}\n");
}

TEST_CASE("a file of no known format is rejected", "[formats]") {
    const std::string problem =
        "a.dat: is no particle file: neither PLY nor VTK PolyData (.vtp), extended XYZ or a LAMMPS dump as text";
    for (const char* bytes : {"", "nonsense", "\n\n", "3 4\n", "-3\n\n", "# vtk DataFile Version 3.0\n", "\x1f\x8b"})
        CHECK(formatProblem(bytes) == problem);
}

TEST_CASE("LAMMPS' dumps are read with their columns in any order", "[formats]") {
    const ParticleFile file = decoded(
        kDump + "ITEM: ATOMS vz id vx type vy diameter z y x q\n3 7 1 2 2 0.5 30 20 10 -1\n6 1 4 1 5 1 3 2 1 1\n");
    CHECK(file.particles.position == std::vector<Vec3>{Vec3(10, 20, 30), Vec3(1, 2, 3)});
    CHECK(file.particles.velocity == std::vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6)});
    CHECK(file.particles.material == std::vector<std::uint32_t>{1, 0});
    CHECK(file.particles.radius == std::vector<double>{0.25, 0.5});
    CHECK_FALSE(file.hasMass);
    CHECK(file.skipped == std::vector<std::string>{"q"});
    CHECK(decoded(kDump + "ITEM: ATOMS id xu yu zu\r\n1 1 2 3\r\n2 4 5 6\r\n").particles.position[1] == Vec3(4, 5, 6));
    CHECK(decoded(kDump + "ITEM: ATOMS id xs ys zs\n1 0 0 0\n2 0.5 0.25 1\n").particles.position[1] == Vec3(0, 1, 10));
    CHECK(decoded("ITEM: UNITS\nlj\n" + kDump + "ITEM: ATOMS x y z\n0 0 0\n1 1 1\n").skipped ==
          std::vector<std::string>{"units lj"});
}

TEST_CASE("of several snapshots the last is read, which is said", "[formats]") {
    const std::string first = kDump + "ITEM: ATOMS x y z\n0 0 0\n1 1 1\n";
    const ParticleFile dump = decoded(first + first + replaced(first, "100", "300") + "\n");
    CHECK(dump.particles.count() == 2);
    CHECK(dump.skipped == std::vector<std::string>{"2 snapshots before the last, which is that of time step 300"});
    const ParticleFile xyz = decoded("2\n\nA 0 0 0\nA 1 1 1\n1\n\nA 1 2 3\n");
    CHECK(xyz.particles.position == std::vector<Vec3>{Vec3(1, 2, 3)});
    CHECK(xyz.skipped == std::vector<std::string>{"1 frames before the last"});
}

TEST_CASE("dumps with mistakes are rejected with their line", "[formats]") {
    const std::string atoms = kDump + "ITEM: ATOMS id type x y z\n";
    CHECK(formatProblem(atoms + "1 1 0 0 0\n") == "a.dat:11: the file ends before its last particle");
    CHECK(formatProblem(atoms + "1 1 0 0 0\n2 1 0 0\n") == "a.dat:11: z is missing: the line must have 5 words");
    CHECK(formatProblem(atoms + "1 1 0 0 0\n2 1 0 0 0 0\n") == "a.dat:11: the line must have 5 words, not more");
    CHECK(formatProblem(atoms + "1 1 0 0 0\n2 1 0 0 0x\n") == "a.dat:11: z is \"0x\", must be a number");
    CHECK(formatProblem(atoms + "1 1 0 0 0\n2 0 0 0 0\n") ==
          "a.dat:11: particle 1: material is -1, must be a whole number from 0 to 4294967295");
    CHECK(formatProblem(atoms + "1 1 0 0 0\n2 1 0 0 1e300\n") ==
          "a.dat:11: particle 1: z is 1e+300, must be -100000000 to 100000000");
    CHECK(formatProblem(atoms + "1 1 0 0 0\n2 1 0 0 0\n3 1 0 0 0\n") ==
          "a.dat:12: must be an ITEM: there are more lines than atoms, or a line is damaged");
    CHECK(formatProblem(kDump + "ITEM: ATOMS id x y\n1 0 0\n1 0 0\n") ==
          "a.dat:9: ITEM: ATOMS has no columns x y z (nor xu yu zu, xs ys zs)");
    CHECK(formatProblem(kDump + "ITEM: ATOMS x y z radius diameter\n1 0 0 1 1\n1 0 0 1 1\n") ==
          "a.dat:9: column radius is given twice");
    CHECK(formatProblem(replaced(atoms, "OF ATOMS\n2", "OF ATOMS\n-2")) ==
          "a.dat:4: the number of atoms is \"-2\", must be a whole number");
    CHECK(formatProblem(replaced(atoms, "OF ATOMS\n2", "OF ATOMS\n18446744073709551615") + "1 1 0 0 0\n") ==
          "a.dat:11: the file ends before its last particle");
    CHECK(formatProblem("ITEM: TIMESTEP\n0\nITEM: ATOMS x y z\n") ==
          "a.dat:3: ITEM: ATOMS without ITEM: NUMBER OF ATOMS before it");
    CHECK(formatProblem("ITEM: ENTRIES x\n") == "a.dat:1: unknown ITEM: ENTRIES x");
    CHECK(formatProblem(replaced(kDump, "pp pp ff", "xy xz yz pp pp ff") + "ITEM: ATOMS xs ys zs\n0 0 0\n0 0 0\n") ==
          "a.dat:9: scaled positions need an orthogonal box; dump x y z instead");
}

TEST_CASE("extended XYZ files are read as others write them", "[formats]") {
    const ParticleFile plain = decoded("  2 \na comment\nHe 1 2 3\nH\t-1 0 1e-3\n");
    CHECK(plain.particles.position == std::vector<Vec3>{Vec3(1, 2, 3), Vec3(-1, 0, 1e-3)});
    CHECK(plain.speciesNames == std::vector<std::string>{"He", "H"});
    CHECK(plain.species == std::vector<std::uint32_t>{0, 1});
    CHECK_FALSE(plain.hasMaterial);
    CHECK_FALSE(plain.hasRadius);
    const ParticleFile file = decoded(
        "1\nLattice=\"1 0 0 0 1 0 0 0 1\" note='Properties=no' Properties=id:I:1:vel:R:3:forces:R:3:ok:L:1:pos:R:"
        "3:radii:R:1:masses:R:1 pbc=\"T T T\"\n7 1 2 3 9 9 9 T 4 5 6 0.5 2\n");
    CHECK(file.particles.position.at(0) == Vec3(4, 5, 6));
    CHECK(file.particles.velocity.at(0) == Vec3(1, 2, 3));
    CHECK(file.particles.radius.at(0) == 0.5);
    CHECK(file.particles.mass.at(0) == 2.0);
    CHECK(file.skipped == std::vector<std::string>{"forces", "ok", "Lattice"});
}

TEST_CASE("extended XYZ files with mistakes are rejected with their line", "[formats]") {
    const auto with = [](const std::string& properties, const std::string& row = "1 2 3\n") {
        return formatProblem("1\nProperties=" + properties + "\n" + row);
    };
    CHECK(with("pos:R:3") == "no error");
    CHECK(with("pos:R") == "a.dat:2: Properties: the number of columns of \"pos\" is \"\", must be a whole number");
    CHECK(with("pos:Q:3") == "a.dat:2: Properties: the type of \"pos\" is \"Q\", must be S, R, I or L");
    CHECK(with("pos:R:2") == "a.dat:2: Properties: pos is R:2, must have 3 columns of type R");
    CHECK(with("pos:S:3") == "a.dat:2: Properties: pos is S:3, must have 3 columns of type R");
    CHECK(with("a:R:18446744073709551615:b:R:2:pos:R:3") == "a.dat:2: Properties: there are more than 1000 columns");
    CHECK(with("pos:R:3:velo:R:3:vel:R:3") == "a.dat:2: Properties: vel is given twice");
    CHECK(with("velo:R:3") == "a.dat: property \"x\" is missing");
    CHECK(with("pos:R:3", "1 2 nan\n") == "a.dat:3: particle 0: z is nan, must be -100000000 to 100000000");
    CHECK(formatProblem("2\n\nA 1 2 3\n") == "a.dat:4: the file ends before its last particle");
    CHECK(formatProblem("99999999999999999999\n\n") ==
          "a.dat:1: the number of particles is \"99999999999999999999\", must be a whole number");
    CHECK(formatProblem("1\n") == "a.dat:2: the file ends before its line of properties");
    CHECK(formatProblem("1\n\nA 1 2 3\nB 1 2 3\n") ==
          "a.dat:4: the number of particles is \"B\", must be a whole number");
}

TEST_CASE("VTP files are read as others write them", "[formats]") {
    const ParticleFile file =
        decoded("\xEF\xBB\xBF<!-- a > comment -->" +
                vtp("<DataArray type='Float64' Name = 'Velocity' NumberOfComponents='3' format='ascii'>\n1 2 3\n4 5 "
                    "6<InformationKey name='a'/></DataArray><DataArray type=\"Int8\" Name=\"material\" "
                    "format=\"ascii\">1 0</DataArray>\n<DataArray "
                    "type=\"String\" Name=\"label\"/><DataArray type=\"Float32\" Name=\"pressure\" format=\"ascii\">1 "
                    "2</DataArray>"));
    CHECK(file.particles.position == std::vector<Vec3>{Vec3(0, 1, 2), Vec3(3, 4, 5)});
    CHECK(file.particles.velocity == std::vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6)});
    CHECK(file.particles.material == std::vector<std::uint32_t>{1, 0});
    CHECK(file.skipped == std::vector<std::string>{"pressure"});
    // Four bytes of length, then 0.5 and 0.25 as float, in base64: with the length apart, and together.
    for (const char* text : {"CAAAAA==AAAAPwAAgD4=", "\n CAAAAAAA\nAD8AAIA+ "}) {
        INFO(text);
        CHECK(decoded(vtp(std::string("<DataArray type=\"Float32\" Name=\"radius\" format=\"binary\">") + text +
                          "</DataArray>"))
                  .particles.radius == std::vector<double>{0.5, 0.25});
    }
}

TEST_CASE("VTP files with mistakes are rejected with their line", "[formats]") {
    const auto withRadius = [](const std::string& attributes, const std::string& text = "1 1") {
        return formatProblem(vtp("<DataArray Name=\"radius\" " + attributes + ">" + text + "</DataArray>"));
    };
    CHECK(withRadius("type=\"Float32\" format=\"ascii\"") == "no error");
    CHECK(withRadius("type=\"Float32\" format=\"ascii\"", "1") ==
          "a.dat:8: radius: number 1 of 2 is \"\", must be a number");
    CHECK(withRadius("type=\"Half\" format=\"ascii\"") == "a.dat:8: type is \"Half\", must be a number type");
    CHECK(withRadius("type=\"Int8\" format=\"ascii\" NumberOfComponents=\"2\"") ==
          "a.dat:8: radius has 2 components, must have 1");
    CHECK(withRadius("type=\"Int8\" format=\"ascii\" NumberOfComponents=\"18446744073709551615\"") ==
          "a.dat:8: radius has 18446744073709551615 components, must have 1");
    CHECK(withRadius("type=\"Int8\" format=\"morse\"") == "a.dat:8: format \"morse\" is unknown");
    CHECK(withRadius("type=\"Int8\" format=\"appended\" offset=\"0\"") == "a.dat:8: the file has no AppendedData");
    CHECK(withRadius("type=\"Int8\" format=\"binary\"", "AAA") == "a.dat:8: radius: the file ends before its data");
    CHECK(withRadius("type=\"Int8\" format=\"binary\"", "AwAAAAEB") == "a.dat:8: radius: has 3 bytes, must have 2");
    CHECK(withRadius("type=\"Int8\" format=\"binary\"", "AgAAAA==") ==
          "a.dat:8: radius: the file ends before its data do");
    CHECK(formatProblem("<html></html>") == "a.dat:1: is not a VTK file");
    CHECK(formatProblem("<VTKFile type=\"UnstructuredGrid\">") ==
          "a.dat:1: holds UnstructuredGrid, must hold PolyData (.vtp)");
    CHECK(formatProblem(kVtpTop + "<Piece NumberOfPoints=\"99999999999\">") ==
          "a.dat:4: has 121 bytes, too few for 99999999999 points");
    CHECK(formatProblem(kVtpTop + "<Piece NumberOfPoints=\"1\"/><Piece NumberOfPoints=\"1\"/>") ==
          "a.dat:4: has several pieces; save it as one");
    CHECK(formatProblem(kVtpTop + "<Piece NumberOfPoints=\"1\"/></VTKFile>") == "a.dat: has no Points");
    CHECK(formatProblem(kVtpTop + "</VTKFile>") == "a.dat: has no Piece");
    CHECK(formatProblem(kVtpTop) == "a.dat: the file ends before </VTKFile>");
    CHECK(formatProblem(kVtpTop + "<Piece NumberOfPoints=1/>") ==
          "a.dat:4: the value of NumberOfPoints is not in quotation marks");
    CHECK(formatProblem(kVtpTop + "<Piece") == "a.dat:4: <Piece does not end");
    CHECK(formatProblem("<!-- ") == "a.dat:1: a comment or declaration does not end");
    const std::string compressed =
        replaced(vtp("<DataArray type=\"Int8\" Name=\"radius\" format=\"binary\">AAAA</DataArray>"), "byte_order",
                 "compressor=\"vtkZLibDataCompressor\" byte_order");
    CHECK(formatProblem(compressed).find("a.dat:8: radius: is compressed; save it without compression") == 0);
}
