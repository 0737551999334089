// Tests the renderer's input for a frame of a scene: numbers, colors, obstacles and their edges.
#include "tests/catch.h"

#include <fmt/format.h>

#include <numbers>
#include <set>

#include "scenes/text/color.h"
#include "scenes/view/frame_view.h"
#include "tests/scenes/scene_text.h"

using engine::Vec3;
using scenes_test::kBall;
using scenes_test::kTop;
using scenes_test::sceneOf;

namespace {

render::View viewOf(const std::string& text, double time = 0.0) {
    return scenes_test::viewAt(sceneOf(text), time);
}

const std::string kPoint = kTop + "[[body]]\nshape = \"points\"\npositions = [[0.1, 0.2, 0.3]]\nvelocity = [3, 0, 4]\n";

}  // namespace

TEST_CASE("particles keep position, radius and order, in single precision") {
    const render::View view = viewOf(
        kTop + "[[body]]\nshape = \"points\"\npositions = [[0.1, 0.2, 0.3], [1, 2, 3]]\nparticle_radius = 0.7\n");
    REQUIRE(view.particles.size() == 2);
    CHECK(view.particles[0].center == glm::vec3(0.1F, 0.2F, 0.3F));
    CHECK(view.particles[1].center == glm::vec3(1.0F, 2.0F, 3.0F));
    CHECK(view.particles[0].radius == 0.7F);
}

TEST_CASE("positions far from the origin are relative to a point near the camera's target") {
    const auto viewFar = [](double x) {
        return viewOf(kTop + fmt::format("[[body]]\nshape = \"points\"\npositions = [[{}, 2.125, 3]]\n"
                                         "[[obstacle]]\nshape = \"sphere\"\ncenter = [{}, 0, 0]\nradius = 1\n"
                                         "[[obstacle]]\nshape = \"box\"\nminimum = [{}, 0, 0]\nmaximum = [{}, 1, 1]\n"
                                         "edges = true\n[camera]\neye = [{}, 2, 10]\ntarget = [{}, 0, 0]\n"
                                         "[look]\nground = true\n",
                                         x + 0.0625, x - 0.125, x + 1.25, x + 2.5, x + 0.5, x));
    };
    const render::View here = viewFar(0.0);
    CHECK(here.particles.at(0).center == glm::vec3(0.0625F, 2.125F, 3.0F));
    // Half the height of the picture is 10 tan(20 degrees) = 3.7 m: the point moves in steps of 1024 m.
    CHECK(viewFar(511.0).camera.target == glm::vec3(511.0F, 0.0F, 0.0F));
    const render::View moved = viewFar(1024.0 * 50000.0);
    CHECK(moved.particles.at(0).center == here.particles.at(0).center);
    CHECK(moved.sphereObstacles.at(0).center == here.sphereObstacles.at(0).center);
    CHECK(moved.boxObstacles.at(0).minimum == here.boxObstacles.at(0).minimum);
    CHECK(moved.boxObstacles.at(0).maximum == here.boxObstacles.at(0).maximum);
    CHECK(moved.edges.at(11).to == here.edges.at(11).to);
    CHECK(moved.camera.eye == here.camera.eye);
    CHECK(moved.camera.target == here.camera.target);
    CHECK(moved.ground.value().center == here.ground.value().center);
}

TEST_CASE("the ground is drawn at its height far from the origin") {
    const auto groundAt = [](double y) {
        return viewOf(kBall + fmt::format("[camera]\neye = [0, {}, 10]\ntarget = [0, {}, 0]\n"
                                          "[look]\nground = true\nground_height = {}\n",
                                          y + 2.0, y, y - 0.75));
    };
    CHECK(groundAt(0.0).ground.value().height == -0.75F);
    CHECK(groundAt(-1024.0 * 3000.0).ground.value().height == -0.75F);
}

TEST_CASE("numbers beyond single precision stay finite") {
    const scenes::Scene scene = sceneOf(kPoint);
    engine::Simulation simulation = engine::start(scene.setup);
    simulation.particles.position.at(0) = Vec3(1e300, -1e300, 0.0);
    const render::View view = scenes::frameView(scene, simulation);
    CHECK(view.particles.at(0).center.x == std::numeric_limits<float>::max());
    CHECK(view.particles.at(0).center.y == -std::numeric_limits<float>::max());
}

TEST_CASE("color by material") {
    const std::string two =
        "[[material]]\nname = \"a\"\ncolor = [0.1, 0.2, 0.3]\n[[material]]\nname = \"b\"\ncolor = \"#ffffff\"\n";
    const render::View view =
        viewOf(kPoint + "material = \"b\"\n" + "[[body]]\nshape = \"points\"\npositions = [[1, 1, 1]]\n" + two);
    CHECK(view.particles.at(0).color == glm::vec3(1.0F));
    CHECK(view.particles.at(1).color == glm::vec3(0.1F, 0.2F, 0.3F));
}

TEST_CASE("colors by speed and by age interpolate the ramp in linear light") {
    const std::string ramp = "colors = [\"#000000\", \"#ffffff\"]\n";
    // The speed of (3, 0, 4) is 5: half of the range from 0 to 10, and a quarter of that from 4 to 8.
    CHECK(viewOf(kPoint + "[look]\ncolor_by = \"speed\"\ncolor_range = [0, 10]\n" + ramp).particles.at(0).color ==
          glm::vec3(0.5F));
    CHECK(viewOf(kPoint + "[look]\ncolor_by = \"speed\"\ncolor_range = [4, 8]\n" + ramp).particles.at(0).color ==
          glm::vec3(0.25F));
    CHECK(viewOf(kPoint + "[look]\ncolor_by = \"speed\"\ncolor_range = [0, 2]\n" + ramp).particles.at(0).color ==
          glm::vec3(1.0F));
    CHECK(viewOf(kPoint + "[look]\ncolor_by = \"speed\"\ncolor_range = [6, 8]\n" + ramp).particles.at(0).color ==
          glm::vec3(0.0F));
    // By default the range of ages ends at the duration, 2 s.
    CHECK(viewOf(kPoint + "[look]\ncolor_by = \"age\"\n" + ramp, 0.5).particles.at(0).color == glm::vec3(0.25F));
}

TEST_CASE("the age of a particle counts from its emission") {
    const scenes::Scene scene =
        sceneOf(kPoint + "[look]\ncolor_by = \"age\"\ncolors = [\"#000000\", \"#ffffff\"]\ncolor_range = [0, 4]\n");
    engine::Simulation simulation = engine::start(scene.setup);
    simulation.time = 2.0;
    simulation.particles.birthTime.at(0) = 1.0;
    CHECK(scenes::frameView(scene, simulation).particles.at(0).color == glm::vec3(0.25F));
    simulation.particles.birthTime.at(0) = -1.0;
    CHECK(scenes::frameView(scene, simulation).particles.at(0).color == glm::vec3(0.75F));
}

TEST_CASE("obstacles are drawn, planes are not") {
    const render::View view =
        viewOf(kBall +
               "[[obstacle]]\nshape = \"plane\"\n[[obstacle]]\nshape = \"sphere\"\ncenter = [1, 2, 3]\nradius = "
               "0.5\ncolor = [0.1, 0.2, 0.3]\n"
               "[[obstacle]]\nshape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [1, 2, 3]\n"
               "[[obstacle]]\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.5\nvisible = false\n");
    REQUIRE(view.sphereObstacles.size() == 1);
    CHECK(view.sphereObstacles[0].center == glm::vec3(1.0F, 2.0F, 3.0F));
    CHECK(view.sphereObstacles[0].radius == 0.5F);
    CHECK(view.sphereObstacles[0].color == glm::vec3(0.1F, 0.2F, 0.3F));
    REQUIRE(view.boxObstacles.size() == 1);
    CHECK(view.boxObstacles[0].maximum == glm::vec3(1.0F, 2.0F, 3.0F));
    CHECK(view.edges.empty());
    CHECK(!view.ground.has_value());
}

TEST_CASE("a container has twelve different edges along the axes") {
    const render::View view = viewOf(
        kBall +
        "[[obstacle]]\nshape = \"container\"\nminimum = [0, 0, 0]\nmaximum = [1, 2, 4]\n[look]\nedge_width = 3\n");
    REQUIRE(view.edges.size() == 12);
    CHECK(view.boxObstacles.empty());
    std::set<std::vector<float>> different;
    float length = 0.0F;
    for (const render::Edge& edge : view.edges) {
        different.insert({edge.from.x, edge.from.y, edge.from.z, edge.to.x, edge.to.y, edge.to.z});
        length += glm::length(edge.to - edge.from);
        CHECK(edge.color == glm::vec3(1.0F, 0.9F, 0.0F));
        CHECK(edge.width == 3.0F);
    }
    CHECK(different.size() == 12);
    // Four edges along each axis: 4 (1 + 2 + 4), exact in single precision.
    CHECK(length == 28.0F);
}

TEST_CASE("edges have the color of the look or of the container") {
    const std::string corners = "minimum = [0, 0, 0]\nmaximum = [1, 1, 1]\n";
    const std::string look = "[look]\nedge_color = [0, 0, 1]\n";
    CHECK(viewOf(kBall + "[[obstacle]]\nshape = \"container\"\n" + corners + look).edges.at(0).color ==
          glm::vec3(0, 0, 1));
    CHECK(
        viewOf(kBall + "[[obstacle]]\nshape = \"container\"\ncolor = [1, 0, 0]\n" + corners + look).edges.at(0).color ==
        glm::vec3(1, 0, 0));
    const render::View box =
        viewOf(kBall + "[[obstacle]]\nshape = \"box\"\nedges = true\ncolor = [1, 0, 0]\n" + corners + look);
    CHECK(box.edges.at(0).color == glm::vec3(0, 0, 1));
    CHECK(box.boxObstacles.at(0).color == glm::vec3(1, 0, 0));
    CHECK(viewOf(kBall + "[[obstacle]]\nshape = \"container\"\nvisible = false\n" + corners).edges.empty());
    CHECK(viewOf(kBall + "[[obstacle]]\nshape = \"container\"\nedges = false\n" + corners).edges.empty());
}

TEST_CASE("transparent obstacles are drawn as meshes, whatever their shape") {
    const auto obstacles = [](const std::string& keys) {
        return viewOf(kPoint + "[[obstacle]]\nshape = \"sphere\"\ncenter = [0, 2, 0]\nradius = 0.5\n" + keys +
                      "[[obstacle]]\nshape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [1, 2, 1]\n" + keys +
                      "[[obstacle]]\nshape = \"cylinder\"\nradius = 1\nheight = 2\n" + keys);
    };
    const render::View opaque = obstacles("");
    CHECK(opaque.meshObstacles.size() == 1);
    CHECK(opaque.meshObstacles.at(0).medium == render::Medium{0.0F, 1.5F, 1.0F});
    const render::View glass = obstacles("transparency = 0.9\nattenuation_distance = 0.3\n");
    CHECK(glass.sphereObstacles.empty());
    CHECK(glass.boxObstacles.empty());
    REQUIRE(glass.meshObstacles.size() == 3);
    for (const render::MeshObstacle& mesh : glass.meshObstacles) {
        CHECK(mesh.medium == render::Medium{0.9F, 1.5F, 0.3F});
        CHECK(mesh.color.y > mesh.color.x);  // the default of glass
    }
    CHECK(glass.meshObstacles[0].position == glm::vec3(0.0F, 2.0F, 0.0F));
    for (const glm::vec3& corner : glass.meshObstacles[0].mesh->positions)
        CHECK(glm::length(corner) == Approx(0.5F).epsilon(1e-6));  // rounding
    for (const glm::vec3& normal : glass.meshObstacles[0].mesh->normals) CHECK(glm::length(normal) == Approx(1.0F));
}

TEST_CASE("the camera and the look reach the renderer") {
    const render::View view =
        viewOf(kBall +
               "[camera]\neye = [1, 2, 3]\ntarget = [4, 5, 7]\nup = [0, 0, 1]\nfov = 90\n"
               "[look]\ntransparency = 0.5\nrefractive_index = 1.4\nattenuation_distance = 2\n"
               "style = \"metaballs\"\nmetaball_reach = 3\nlight_direction = [0, 0, 2]\nlight_color = [2, 1, "
               "0.5]\nshadows = false\n"
               "ambient_sky = [0.1, 0.2, 0.3]\nambient_ground = [0.4, 0.5, 0.6]\nspecular = 0.04\ngloss = 7\n"
               "background_top = \"#ffffff\"\nbackground_bottom = \"#000000\"\n"
               "ground = true\nground_height = -2\nground_color = [0.7, 0.8, 0.9]\nground_fade = 12\n");
    CHECK(view.camera.projection == render::Projection::perspective);
    CHECK(view.camera.eye == glm::vec3(1, 2, 3));
    CHECK(view.camera.target == glm::vec3(4, 5, 7));
    CHECK(view.camera.up == glm::vec3(0, 0, 1));
    CHECK(view.camera.verticalFov == static_cast<float>(std::numbers::pi / 2.0));
    CHECK(view.style == render::Style::metaballs);
    CHECK(view.field.reach == 3.0F);
    CHECK(view.light.toLight == glm::vec3(0, 0, 1));
    CHECK(view.light.color == glm::vec3(2.0F, 1.0F, 0.5F));
    CHECK(!view.light.shadows);
    CHECK(view.ambient.sky == glm::vec3(0.1F, 0.2F, 0.3F));
    CHECK(view.ambient.ground == glm::vec3(0.4F, 0.5F, 0.6F));
    CHECK(view.surface.specular == 0.04F);
    CHECK(view.surface.glossExponent == 7);
    CHECK(view.surface.medium == render::Medium{0.5F, 1.4F, 2.0F});
    CHECK(view.background.top == glm::vec3(1.0F));
    CHECK(view.background.bottom == glm::vec3(0.0F));
    REQUIRE(view.ground.has_value());
    CHECK(view.ground->height == -2.0F);
    CHECK(view.ground->color == glm::vec3(0.7F, 0.8F, 0.9F));
    CHECK(view.ground->center == glm::vec3(4, -2, 7));
    CHECK(view.ground->fadeDistance == 12.0F);
}

TEST_CASE("the default distance at which the ground fades suits the size of the picture") {
    const auto fadeAt = [](double halfHeight) {
        return viewOf(kBall + fmt::format("[camera]\nprojection = \"orthographic\"\nhalf_height = {}\n"
                                          "[look]\nground = true\n",
                                          halfHeight))
            .ground.value()
            .fadeDistance;
    };
    CHECK(fadeAt(0.5) == 30.0F);
    CHECK(fadeAt(15.0) == 30.0F);
    CHECK(fadeAt(1e6) == 2e6F);
    CHECK(fadeAt(1e-6) == 6e-5F);
}

TEST_CASE("an orthographic camera has a half height") {
    const render::View view = viewOf(kBall + "[camera]\nprojection = \"orthographic\"\nhalf_height = 6\n");
    CHECK(view.camera.projection == render::Projection::orthographic);
    CHECK(view.camera.halfHeight == 6.0F);
}

TEST_CASE("the schema has the same defaults as the renderer") {
    const render::View view = viewOf(kBall);
    const render::View plain;
    CHECK(view.ambient.sky == plain.ambient.sky);
    CHECK(view.ambient.ground == plain.ambient.ground);
    CHECK(view.light.color == plain.light.color);
    CHECK(view.light.shadows == plain.light.shadows);
    CHECK(view.surface.specular == plain.surface.specular);
    CHECK(view.surface.glossExponent == plain.surface.glossExponent);
    CHECK(view.field.reach == plain.field.reach);
    CHECK(view.camera.eye == plain.camera.eye);
    CHECK(view.camera.up == plain.camera.up);
}
