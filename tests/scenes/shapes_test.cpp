// Profiles, tessellations, letters and images, and bodies that are filled with them: volumes and centers of mass
// against closed forms.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/core/rotation.h"
#include "scenes/shapes/profile.h"
#include "scenes/shapes/tessellation.h"
#include "scenes/shapes/text_outline.h"
#include "tests/catch.h"
#include "tests/scenes/scene_text.h"

namespace {

using engine::Vec3;
using scenes::Profile;
using scenes::ProfileSpec;
using scenes_test::kTop;
using scenes_test::Lines;
using scenes_test::problemsOf;
using std::numbers::pi;

constexpr double kSpacing = 0.02;

/// The particles of a body with these keys.
std::vector<Vec3> bodyOf(const std::string& keys) {
    const std::string packing = "\nspacing = 0.02\njitter = 0\nparticle_radius = 0.01\n";
    return scenes_test::sceneOf(kTop + "[[body]]\n" + keys + packing).setup.initial.position;
}

double volumeOf(const std::vector<Vec3>& positions) {
    return static_cast<double>(positions.size()) * kSpacing * kSpacing * kSpacing / std::sqrt(2.0);
}

Vec3 meanOf(const std::vector<Vec3>& positions) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& position : positions) sum += position;
    return sum / static_cast<double>(positions.size());
}

/// The largest angle between neighboring edges of a profile, in degrees.
double sharpestAngle(const Profile& points, bool isClosed) {
    double sharpest = 0.0;
    const std::size_t count = points.size();
    for (std::size_t k = isClosed ? 0 : 1; k + (isClosed ? 0 : 1) < count; ++k) {
        const auto& a = points[(k + count - 1) % count];
        const auto& b = points[k];
        const auto& c = points[(k + 1) % count];
        const double one = std::atan2(b.height - a.height, b.radius - a.radius);
        const double turn = std::remainder(std::atan2(c.height - b.height, c.radius - b.radius) - one, 2.0 * pi);
        sharpest = std::max(sharpest, std::abs(turn) * 180.0 / pi);
    }
    return sharpest;
}

/// Volume of a mesh by the divergence theorem, the number of its open edges, and the largest angle by which a normal is
/// off the triangles around it, as a cosine.
struct MeshFacts {
    double volume = 0.0;
    std::size_t openEdges = 0;
    double worstCosine = 1.0;
};

MeshFacts factsOf(const render::SolidMesh& mesh) {
    MeshFacts facts;
    std::map<std::array<std::array<float, 3>, 2>, int> sides;
    for (const auto& triangle : mesh.triangles) {
        const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[triangle[k]]); };
        facts.volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
        const glm::dvec3 normal = glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
        for (std::size_t k = 0; k < 3; ++k) {
            facts.worstCosine = std::min(facts.worstCosine, glm::dot(normal, glm::dvec3(mesh.normals[triangle[k]])));
            const auto key = [&](std::size_t corner) {
                const glm::vec3& p = mesh.positions[triangle[corner]];
                return std::array<float, 3>{p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};
            };
            auto ends = std::array{key(k), key((k + 1) % 3)};
            std::ranges::sort(ends);
            ++sides[ends];
        }
    }
    for (const auto& [ends, count] : sides) facts.openEdges += count % 2 == 1 ? 1 : 0;
    return facts;
}

}  // namespace

TEST_CASE("Angles in degrees turn exactly about quarters, and as libm does between", "[shapes]") {
    CHECK(engine::sineAndCosineOfDegrees(90.0).cosine == 0.0);
    CHECK(engine::sineAndCosineOfDegrees(-90.0).sine == -1.0);
    CHECK(engine::sineAndCosineOfDegrees(720.0).cosine == 1.0);
    for (double angle = -800.0; angle < 800.0; angle += 0.37) {
        const engine::SineAndCosine turn = engine::sineAndCosineOfDegrees(angle);
        // Of 800 degrees libm's argument is rounded by 2e-15.
        CHECK(std::abs(turn.cosine - std::cos(angle * pi / 180.0)) <= 4e-15);
        CHECK(std::abs(turn.sine - std::sin(angle * pi / 180.0)) <= 4e-15);
    }
    // About x, then y, then z.
    CHECK(engine::rotationOfDegrees({90.0, 0.0, 0.0}) * Vec3::UnitY() == Vec3::UnitZ());
    CHECK(engine::rotationOfDegrees({90.0, 90.0, 0.0}) * Vec3::UnitY() == Vec3::UnitX());
    CHECK(engine::rotationOfDegrees({90.0, 90.0, 90.0}) * Vec3::UnitY() == Vec3::UnitY());
}

TEST_CASE("Corners of walls and inner corners of solids are rounded", "[shapes]") {
    const Profile cup = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}};
    const ProfileSpec wall{.points = cup, .isClosed = false, .thickness = 0.1, .fillet = 0.3};
    const Profile rounded = scenes::refinedProfile(wall);
    CHECK(sharpestAngle(rounded, false) <= 3.0);
    // The arc is around (0.7, 0.3); its nearest point to the corner is 0.3 (sqrt(2) - 1) off.
    const engine::Revolution shape = scenes::revolutionOf(wall);
    CHECK(shape.at({1.0, 0.0, 0.0}).value == Approx(0.3 * (std::sqrt(2.0) - 1.0) - 0.05).margin(2e-4));
    CHECK(scenes::refinedProfile({.points = cup, .isClosed = false, .thickness = 0.1, .fillet = 0.0}).size() == 3);
    // A tank: its outer corners stay, its inner ones are rounded.
    const Profile tank = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.8, 1.0}, {0.8, 0.2}, {0.0, 0.2}};
    const Profile solid = scenes::refinedProfile({.points = tank, .fillet = 0.1});
    CHECK(solid.size() > 20);
    CHECK(std::ranges::count_if(solid, [](const auto& p) { return p.radius == 1.0; }) == 2);
    CHECK(std::ranges::none_of(solid, [](const auto& p) { return p.radius == 0.8 && p.height == 0.2; }));
    // A corner is cut no further than half of an edge.
    const Profile zigzag = {{0.5, 0.0}, {1.0, 0.0}, {1.0, 0.1}, {0.5, 0.1}};
    CHECK(sharpestAngle(scenes::refinedProfile({.points = zigzag, .isClosed = false, .thickness = 0.01, .fillet = 9.0}),
                        false) <= 3.0);
}

TEST_CASE("The tip of a funnel's or bowl's wall on the axis is rounded with its mirror image", "[shapes]") {
    const Profile bowl = scenes::refinedProfile(
        {.points = {{0.0, 0.0}, {1.0, 1.0}}, .isClosed = false, .thickness = 0.1, .fillet = 0.2});
    CHECK(bowl.front().radius == 0.0);
    CHECK(bowl.front().height == Approx(0.2 * (std::sqrt(2.0) - 1.0)));
    CHECK(std::abs(bowl[1].height - bowl[0].height) / bowl[1].radius <= std::tan(3.0 * pi / 180.0));
    const Profile dented = scenes::refinedProfile(
        {.points = {{0.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {0.0, 0.0}}, .isClosed = true, .fillet = 0.2});
    CHECK(dented.back().radius == 0.0);
    CHECK(dented.back().height == Approx(0.2 * (std::sqrt(2.0) - 1.0)));
}

TEST_CASE("A smooth profile goes through its points in small steps", "[shapes]") {
    const Profile glass = {{0.0, 0.0}, {0.08, 0.12}, {0.4, 1.0}, {0.55, 1.5}, {0.45, 2.0}};
    const ProfileSpec spec{.points = glass, .isClosed = false, .thickness = 0.03, .isSmooth = true};
    const Profile curve = scenes::refinedProfile(spec);
    CHECK(sharpestAngle(curve, false) <= 3.0);
    CHECK(curve.size() < 200);
    for (const auto& point : glass)
        CHECK(std::ranges::any_of(curve, [&](const auto& p) {
            return std::abs(p.radius - point.radius) + std::abs(p.height - point.height) <= 1e-15;
        }));
    // It leaves the axis level, and is nowhere wider than the widest point by more than a fiftieth.
    CHECK(std::abs(curve[1].height - curve[0].height) <= std::tan(4.5 * pi / 180.0) * curve[1].radius);
    for (const auto& point : curve) CHECK(point.radius <= 0.55 * 1.02);
    // A circle of eight points is one to 1 %.
    Profile ring;
    for (int k = 0; k < 8; ++k) ring.push_back({2.0 + std::cos(pi * k / 4.0), std::sin(pi * k / 4.0)});
    for (const auto& point : scenes::refinedProfile({.points = ring, .isClosed = true, .isSmooth = true}))
        CHECK(std::hypot(point.radius - 2.0, point.height) == Approx(1.0).epsilon(0.01));
}

TEST_CASE("Meshes of turned shapes are closed, look outward and have the volume", "[shapes]") {
    // 96 chords of a circle have 7e-4 less area.
    const double chords = 48.0 / pi * std::sin(pi / 48.0);
    const MeshFacts cylinder = factsOf(scenes::revolutionMesh(engine::cylinderProfile(0.5, 2.0), true, 0.0));
    CHECK(cylinder.volume == Approx(chords * pi * 0.25 * 2.0).epsilon(1e-6));
    CHECK(cylinder.openEdges == 0);
    CHECK(cylinder.worstCosine > 0.999);  // the rim is sharp
    const MeshFacts cone = factsOf(scenes::revolutionMesh(engine::frustumProfile(0.0, 0.5, 1.2), true, 0.0));
    CHECK(cone.volume == Approx(chords * pi * 0.25 * 1.2 / 3.0).epsilon(1e-6));
    CHECK(cone.openEdges == 0);
    const MeshFacts torus = factsOf(scenes::revolutionMesh({{1.0, 0.3}}, false, 0.25));
    CHECK(torus.volume == Approx(2.0 * pi * pi * 0.25 * 0.25).epsilon(0.01));
    CHECK(torus.openEdges == 0);
    CHECK(torus.worstCosine > 0.99);
    const MeshFacts capsule = factsOf(scenes::revolutionMesh(engine::capsuleProfile(0.3, 1.6), false, 0.3));
    CHECK(capsule.volume == Approx(pi * 0.09 * 1.0 + 4.0 / 3.0 * pi * 0.027).epsilon(0.01));
    CHECK(capsule.openEdges == 0);
    // A tube: 2 pi R t h, and half a torus at either end. Walls bend: inner corners leave hidden ends, no holes.
    const MeshFacts tube = factsOf(scenes::revolutionMesh({{0.5, 0.0}, {0.5, 1.0}}, false, 0.05));
    CHECK(tube.volume == Approx(2.0 * pi * 0.5 * (0.1 + pi * 0.0025)).epsilon(0.01));
    const ProfileSpec cup{.points = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}}, .isClosed = false, .thickness = 0.1};
    CHECK(factsOf(scenes::revolutionMesh(scenes::refinedProfile(cup), false, 0.05)).worstCosine > 0.95);
    const MeshFacts box = factsOf(scenes::cuboidMesh({1.0, 2.0, 3.0}));
    CHECK(box.volume == Approx(6.0));
    CHECK(box.openEdges == 0);
    CHECK(box.worstCosine == Approx(1.0));
}

TEST_CASE("Drawn points of turned shapes are on their surface", "[shapes]") {
    const ProfileSpec glass{.points = {{0.0, 0.0}, {0.08, 0.12}, {0.4, 1.0}, {0.55, 1.5}, {0.45, 2.0}},
                            .isClosed = false,
                            .thickness = 0.03,
                            .isSmooth = true};
    const Profile profile = scenes::refinedProfile(glass);
    const engine::Revolution shape = scenes::revolutionOf(glass);
    for (const glm::vec3& point : scenes::revolutionMesh(profile, false, 0.015).positions)
        CHECK(shape.at({point.x, point.y, point.z}).value <= 1e-6);  // floats of 2; none is outside
}

TEST_CASE("Bodies of any form have their volume and center of mass", "[shapes]") {
    const auto check = [](const std::string& keys, double volume, const Vec3& center) {
        INFO(keys);
        const std::vector<Vec3> positions = bodyOf(keys);
        // Points on the surface count as inside, so that volumes are too large by up to half a layer: 0.007 of 0.4.
        CHECK(volumeOf(positions) == Approx(volume).epsilon(0.05));
        CHECK((meanOf(positions) - center).norm() <= 0.5 * kSpacing);
    };
    check("shape = \"cylinder\"\nradius = 0.4\nheight = 1\ncenter = [1, 2, 3]", pi * 0.16, {1.0, 2.0, 3.0});
    check("shape = \"cone\"\nradius = 0.4\nheight = 1", pi * 0.16 / 3.0, {0.0, -0.25, 0.0});
    // On its side: about z by 90 degrees, up becomes -x.
    check("shape = \"cone\"\nradius = 0.4\nheight = 1\nrotation = [0, 0, 90]", pi * 0.16 / 3.0, {0.25, 0.0, 0.0});
    check("shape = \"frustum\"\nradius = 0.4\ntop_radius = 0.2\nheight = 1", pi / 3.0 * 0.28,
          {0.0, -0.5 + (0.16 + 2.0 * 0.08 + 3.0 * 0.04) / (4.0 * 0.28), 0.0});
    check("shape = \"capsule\"\nradius = 0.3\nheight = 1.2\nrotation = [30, 40, 50]",
          pi * 0.09 * 0.6 + 4.0 / 3.0 * pi * 0.027, Vec3::Zero());
    check("shape = \"shell\"\nradius = 0.5\nthickness = 0.1", 4.0 / 3.0 * pi * (0.125 - 0.064), Vec3::Zero());
    check("shape = \"ball\"\nradius = 0.5\nthickness = 0.1", 4.0 / 3.0 * pi * (0.125 - 0.064), Vec3::Zero());
    check("shape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [0.5, 0.6, 0.7]\nrotation = [10, 20, 30]", 0.21,
          {0.25, 0.3, 0.35});
    check("shape = \"revolution\"\nprofile = [[0.3, 0], [0.6, 0], [0.6, 0.4], [0.3, 0.4]]", pi * 0.27 * 0.4,
          {0.0, 0.2, 0.0});
    check("shape = \"revolution\"\nprofile = [[0.5, 0]]\nthickness = 0.4", 2.0 * pi * pi * 0.5 * 0.04, Vec3::Zero());
}

TEST_CASE("A body without rotation, thickness or new shape keeps its lattice", "[shapes]") {
    const auto plain = bodyOf("shape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [0.5, 0.6, 0.7]");
    const auto zero = bodyOf("shape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [0.5, 0.6, 0.7]\nrotation = [0, 0, 0]");
    CHECK(plain == zero);
}

TEST_CASE("A word has the area of its letters", "[shapes]") {
    // In DejaVu Sans, an I is a bar 0.201 by 1493 / 2048, and an em is the font's unit: its height is that of an H.
    const auto bar = bodyOf("shape = \"text\"\ntext = \"I\"\nheight = 1\ndepth = 0.3");
    double low = 1.0;
    double high = -1.0;
    for (const Vec3& position : bar) {
        low = std::min(low, position.y());
        high = std::max(high, position.y());
    }
    CHECK(high - low == Approx(1.0).margin(kSpacing));
    // A dot over an i is apart; an o has a hole: its middle is empty.
    const auto letter = bodyOf("shape = \"text\"\ntext = \"o\"\nheight = 1\ndepth = 0.3");
    CHECK(letter.size() > 1000);
    CHECK(std::ranges::none_of(letter,
                               [](const Vec3& position) { return std::hypot(position.x(), position.y()) < 0.1; }));
    CHECK((meanOf(letter)).norm() <= kSpacing);
    // Two lines are one above the other.
    const auto lines = bodyOf("shape = \"text\"\ntext = \"I\\nI\"\nheight = 1\ndepth = 0.3");
    CHECK(static_cast<double>(lines.size()) == Approx(2.0 * static_cast<double>(bar.size())).epsilon(0.05));
}

TEST_CASE("The outline of overlapping strokes has no hole where they overlap", "[shapes]") {
    const scenes::Outline outline = scenes::textOutline("O", 1.0, {}, "font");
    const scenes::Extrusion letter(outline, 0.2);
    CHECK(letter.distance({0.0, 0.0, 0.0}) > 0.2);
    CHECK(letter.distance({letter.bounds().high.x() - 0.05, 0.0, 0.0}) < 0.0);
    CHECK(letter.distance({0.0, 0.0, 1.0}) > 0.9);
}

TEST_CASE("What is wrong with a shape is said at its key", "[shapes]") {
    const auto wrong = [](const std::string& keys) {
        const Lines lines = problemsOf(kTop + "[[body]]\n" + keys);
        return lines.size() == 1 ? lines[0] : std::to_string(lines.size()) + " problems";
    };
    CHECK(wrong("shape = \"cylinder\"\nradius = 1") ==
          "pile.toml:3:1: height is missing, a body of shape \"cylinder\" needs it (meters)");
    CHECK(wrong("shape = \"revolution\"\nprofile = [[0, 0], [1, 1], [1, 0], [0, 1]]\nsmooth = false")
              .find("pile.toml:5:11: the profile crosses itself: the edge after point 1 and the one after 3") == 0);
    CHECK(wrong("shape = \"revolution\"\nprofile = [[0, 0], [1, 1]]").find("pile.toml:5:11: the profile has fewer") ==
          0);
    CHECK(wrong("shape = \"revolution\"\nprofile = [[0, 0], [1, 1], [0, 2]]\nclosed = false") ==
          "pile.toml:5:11: the profile is open and needs a thickness, or closed = true");
    CHECK(wrong("shape = \"revolution\"\nprofile = [[0, 0], [-1, 1], [0, 2]]") ==
          "pile.toml:5:11: profile[1][0] is -1, must be >= 0: it is a radius (meters)");
    CHECK(wrong("shape = \"revolution\"\nprofile = [[0, 0], [1]]") ==
          "pile.toml:5:20: profile[1] is a list of 1, must be two numbers [radius, height] (meters)");
    CHECK(wrong("shape = \"capsule\"\nradius = 1\nheight = 1") ==
          "pile.toml:6:10: height is 1, must be at least twice the radius, 2 (meters)");
    CHECK(wrong("shape = \"shell\"\nradius = 1\nthickness = 1")
              .find("pile.toml:6:13: thickness is 1, must be less than 1, or nothing is hollow") == 0);
    CHECK(wrong("shape = \"text\"\ntext = \" \"\nheight = 1\ndepth = 1") ==
          "pile.toml:5:8: text has no letters, so that nothing is filled");
    CHECK(wrong("shape = \"text\"\ntext = \"\xE6\x97\xA5\"\nheight = 1\ndepth = 1").find("the font has no") !=
          std::string::npos);
    CHECK(wrong("shape = \"mesh\"\nfile = \"none.obj\"").find("none.obj: cannot") != std::string::npos);
}

namespace {

std::string bigEndian(std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((number >> shift) & 0xFFU);
    return bytes;
}

std::string chunkOf(const std::string& kind, const std::string& data) {
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char c : kind + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int k = 0; k < 8; ++k) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return bigEndian(static_cast<std::uint32_t>(data.size())) + kind + data + bigEndian(~crc);
}

/// A gray PNG without compression, of rows of letters: '#' is black, '.' white.
std::string pngOf(const std::vector<std::string>& rows) {
    std::string raw;
    for (const std::string& row : rows) {
        raw += '\0';
        for (const char c : row) raw += c == '#' ? '\0' : '\xFF';
    }
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char c : raw) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint32_t>(raw.size());
    std::string data = "\x78\x01\x01";
    for (const std::uint32_t length : {size, ~size})
        for (const unsigned shift : {0U, 8U}) data += static_cast<char>((length >> shift) & 0xFFU);
    data += raw + bigEndian((b << 16U) | a);
    const std::string header = bigEndian(static_cast<std::uint32_t>(rows[0].size())) +
                               bigEndian(static_cast<std::uint32_t>(rows.size())) + std::string("\x08\0\0\0\0", 5);
    return "\x89PNG\r\n\x1A\n" + chunkOf("IHDR", header) + chunkOf("IDAT", data) + chunkOf("IEND", "");
}

}  // namespace

TEST_CASE("The dark pixels of an image are filled, its holes are not", "[shapes]") {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "globular_shapes_test";
    std::filesystem::create_directories(folder);
    // 10 by 8 pixels: a ring of 20 dark pixels, whose hole of 4 is light, and a dot at the lower right.
    std::ofstream(folder / "ring.png", std::ios::binary)
        << pngOf({"..........", ".######...", ".##..##...", ".##..##...", ".######...", "..........", "........#.",
                  ".........."});
    std::ofstream(folder / "no.png", std::ios::binary) << "no image";
    std::ofstream(folder / "white.png", std::ios::binary) << pngOf({"..", ".."});
    const auto textOf = [](const std::string& file) {
        return kTop + "[[body]]\nshape = \"image\"\nfile = \"" + file +
               "\"\nwidth = 1\ndepth = 0.4\nspacing = 0.02\njitter = 0\nparticle_radius = 0.01\n";
    };
    const auto at = (folder / "pile.toml").string();
    const auto positions = scenes::readScene(textOf("ring.png"), at, {}).setup.initial.position;
    // Corners between the middles of pixels are cut: 1/8 of a pixel's area at each of the ring's outer four, and all
    // but half of the lone pixel. The hole's four gain as much.
    CHECK(volumeOf(positions) == Approx((20.0 + 0.5) * 0.01 * 0.4).epsilon(0.08));
    for (const Vec3& position : positions) {
        const bool isInHole = std::abs(position.x() + 0.1) < 0.05 && std::abs(position.y() - 0.1) < 0.05;
        CHECK(!isInHole);
        CHECK(std::abs(position.z()) <= 0.2 + 1e-6);
    }
    // Pixel (8, 6) is at 8.5 - 5 and 4 - 6.5 tenths.
    CHECK(std::ranges::any_of(positions, [](const Vec3& p) { return (p - Vec3(0.35, -0.25, 0.0)).norm() < 0.02; }));
    const auto problemWith = [&](const std::string& file) {
        try {
            scenes::readScene(textOf(file), at, {});
        } catch (const scenes::InputError& error) {
            return scenes::formatProblem(error.problems()[0]);
        }
        return std::string();
    };
    CHECK(problemWith("no.png").find("not a PNG") != std::string::npos);
    CHECK(problemWith("white.png").find("the image has no pixel that is darker than middle gray") != std::string::npos);
    CHECK(problemWith("none.png").find("none.png: cannot") != std::string::npos);
    std::filesystem::remove_all(folder);
}

TEST_CASE("The height of a body of any form tells the compression of its material", "[shapes]") {
    const auto depthOf = [](const std::string& shape) {
        const auto scene =
            scenes_test::sceneOf(kTop + "[[material]]\nradius = 0.02\ncompression = 0.1\n[[body]]\n" + shape);
        return scene.bodyColumns.at(0).shape.height;
    };
    CHECK(depthOf("shape = \"cylinder\"\nradius = 0.2\nheight = 0.8\n") == Approx(0.8));
    CHECK(depthOf("shape = \"cylinder\"\nradius = 0.2\nheight = 0.8\nrotation = [90, 0, 0]\n") == Approx(0.4));
    // At 45 degrees: (0.8 + 0.4) / sqrt(2).
    CHECK(depthOf("shape = \"cylinder\"\nradius = 0.2\nheight = 0.8\nrotation = [45, 0, 0]\n") ==
          Approx(1.2 / std::sqrt(2.0)));
    CHECK(depthOf("shape = \"revolution\"\nprofile = [[0.5, 1]]\nthickness = 0.3\n") == Approx(0.3));
    CHECK(depthOf("shape = \"text\"\ntext = \"I\"\nheight = 0.7\ndepth = 0.3\n") == Approx(0.7));
}

TEST_CASE("A body that is too thin or too large is refused", "[shapes]") {
    const std::string particles = "\nspacing = 0.01\nparticle_radius = 0.005\n";
    const Lines thin = problemsOf(kTop +
                                  "[[body]]\nshape = \"cone\"\nradius = 0.0001\nheight = 0.0001\ncenter = [1, 0, 0]\n"
                                  "rotation = [0, 0, 1]\nthickness = 0.00001" +
                                  particles);
    REQUIRE(thin.size() == 1);
    CHECK(thin[0].find("pile.toml:4:9: no particle fits into the body: it is thinner than the spacing, 0.01 m") == 0);
    const Lines full = problemsOf(kTop + "[[body]]\nshape = \"cylinder\"\nradius = 20\nheight = 40" + particles);
    REQUIRE(full.size() == 1);
    CHECK(full[0].find("pile.toml:4:9: the body would have about 7.1e+10 particles") == 0);
    // So thin that the samples of its volume miss it.
    const Lines shell = problemsOf(kTop + "[[body]]\nshape = \"shell\"\nradius = 20\nthickness = 0.01" + particles);
    REQUIRE(shell.size() == 1);
    CHECK(shell[0].find("particles, at most 2000000 are allowed") != std::string::npos);
}
