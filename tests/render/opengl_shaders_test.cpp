// The shaders of the renderer in OpenGL: their texts, what a compiler says about them, the terms that are compiled for
// a look, and implementations of OpenGL with smaller limits.
#include "tests/catch.h"

#ifdef RENDER_HAS_OPENGL

#include <algorithm>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "render/opengl/look_defines.h"
#include "render/opengl/objects/shader_program.h"
#include "render/opengl/objects/shader_text.h"
#include "render/picture/system_error.h"
#include "tests/render/pictures.h"
#include "tests/render/smaller_limits.h"
#include "tests/render/solid_meshes.h"

using namespace pictures;
using render::Quality;
using render::Style;
using render::TileClass;

namespace {

constexpr render::PictureSize kSize{121, 75};

/// The number of the first line of a shader that begins with a text, counted from 1.
std::ptrdiff_t lineOf(std::string_view shader, std::string_view beginning) {
    const std::string_view text = render::shaderText(shader);
    const std::size_t at = text.find(fmt::format("\n{}", beginning));
    REQUIRE(at != std::string_view::npos);
    return 2 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
}

/// The definitions for the tiles of objects of a view.
render::Defines definesOf(const render::View& view, TileClass kind) {
    render::PreparedView prepared;
    render::DrawTimes times;
    render::prepareView(view, {kSize}, prepared, times);
    render::Defines defines = render::lookDefines(prepared, kind);
    std::sort(defines.begin(), defines.end());
    return defines;
}

struct Term {
    std::function<void(render::View&)> add;
    render::Defines defines;  ///< that it adds, sorted
};

/// Spheres without any term of the look.
render::View plainView() {
    render::View view = cloud(20);
    view.surface.specular = 0.0F;
    view.ground.reset();
    return view;
}

std::vector<Term> terms() {
    using View = render::View;
    return {
        {[](View& v) { v.ground = render::Ground{}; }, {"GROUND"}},
        {[](View& v) { v.light.shadows = true; }, {"SHADOWS", "SPHERE_SHADOWS"}},
        {[](View& v) { v.light.softness = 0.5F; }, {"SOFT"}},
        {[](View& v) { v.ambient.occlusion = 0.5F; }, {"OCCLUSION", "PARTICLE_SKY"}},
        {[](View& v) { v.surface.specular = 0.1F; }, {"HIGHLIGHT"}},
        {[](View& v) { v.surface.metal = 0.1F; }, {"HIGHLIGHT", "METAL"}},
        {[](View& v) { v.surface.reflection = 0.1F; }, {"PARTICLE_SKY", "REFLECTION"}},
        {[](View& v) { v.surface.roughness = 0.1F; }, {"ROUGHNESS"}},
        {[](View& v) { v.surface.translucency = 0.1F; }, {"PARTICLE_SKY", "TRANSLUCENCY"}},
        {[](View& v) { v.surface.absorption = 0.1F; }, {"ABSORPTION", "PARTICLE_SKY"}},
        {[](View& v) { v.surface.glow = 0.1F; }, {"GLOW", "GLOW_LIGHT"}},
        {[](View& v) { v.light.rim.r = 0.1F; }, {"RIM"}},
        {[](View& v) { v.exposure = 1.0F; }, {"EXPOSURE"}},
        {[](View& v) {
             v.edges.push_back({{-1.0F, 1.0F, 0.0F}, {1.0F, 1.0F, 0.0F}});
         },
         {"LINES"}},
        {[](View& v) {
             v.boxObstacles.push_back({{-2.0F, 0.0F, -2.0F}, {-1.0F, 1.0F, -1.0F}});
         },
         {"BOXES"}},
        {[](View& v) { v.meshObstacles.push_back({meshBox(glm::vec3(-0.1F), glm::vec3(0.1F))}); }, {"MESHES"}},
    };
}

}  // namespace

TEST_CASE("A shader is its file and those that it includes, behind the version and the definitions", "[opengl]") {
    const render::ShaderSource source = render::shaderSource("plain.frag", {"FIRST 1", "SECOND"});
    CHECK(source.text.find("#version 330 core\n#define FIRST 1\n#define SECOND\n#line 1 0\n") == 0);
    CHECK(source.text.find("#include") == std::string::npos);
    REQUIRE(source.files.size() >= 3);
    CHECK(source.files[0] == "plain.frag");
    CHECK(source.files[1] == "frame.glsl");
    CHECK(source.files[2] == "frame_block.glsl");
    CHECK_THROWS_AS(render::shaderSource("missing.frag", {}), std::logic_error);
}

TEST_CASE("A compiler's log names files", "[opengl]") {
    const render::ShaderSource source = render::shaderSource("plain.frag", {});
    CHECK(render::withFileNames("1:17(20): error: `x' undeclared\n0:3(1): warning", source) ==
          "frame.glsl:17(20): error: `x' undeclared\nplain.frag:3(1): warning");
    CHECK(render::withFileNames("1(17) : error C1008", source) == "frame.glsl:17 : error C1008");
    CHECK(render::withFileNames("ERROR: 2:4: '' : syntax error", source) ==
          "ERROR: frame_block.glsl:4: '' : syntax error");
    CHECK(render::withFileNames("99:4: no such file; see 4.5 and note (3)", source) ==
          "99:4: no such file; see 4.5 and note (3)");
    CHECK(render::withFileNames("", source).empty());
}

TEST_CASE("A shader that does not compile is named with file, line and the compiler's words", "[opengl]") {
    render::Context& context = openGlContext();
    const render::CurrentContext current(context);
    const auto compile = [&](const render::Defines& defines) {
        const render::ShaderProgram program(context.gl(), "tile.vert", "plain.frag", defines);
        static_cast<void>(program);
    };
    CHECK_NOTHROW(compile({"POINT_SIZE 16"}));
    std::string message;
    try {
        compile({"POINT_SIZE 16", "imagePoint 1.0"});
    } catch (const render::OpenGlError& error) {
        message = error.what();
    }
    INFO(message);
    CHECK(message.find("OpenGL cannot compile the shader plain.frag: ") == 0);
    CHECK(message.find(fmt::format("frame.glsl:{}", lineOf("frame.glsl", "vec2 imagePoint("))) != std::string::npos);
    CHECK(message.find("error") != std::string::npos);
    render::checkGl(context.gl(), "testing that a failure leaves no error behind");
}

TEST_CASE("No term is compiled that a look does not use", "[opengl]") {
    const render::Defines plain = definesOf(plainView(), TileClass::flats);
    CHECK(plain == render::Defines{"PERSPECTIVE", "SPHERES"});
    for (const Term& term : terms()) {
        render::View view = plainView();
        term.add(view);
        const render::Defines with = definesOf(view, TileClass::flats);
        render::Defines added;
        std::set_difference(with.begin(), with.end(), plain.begin(), plain.end(), std::back_inserter(added));
        CHECK(added == term.defines);
        CHECK(with.size() == plain.size() + added.size());
    }
}

TEST_CASE("Terms of the whole picture, and tiles that show less, have their own definitions", "[opengl]") {
    render::View view = plainView();
    view.camera.projection = render::Projection::orthographic;
    CHECK(definesOf(view, TileClass::flats) == render::Defines{"SPHERES"});
    view.style = Style::metaballs;
    CHECK(definesOf(view, TileClass::flats) == render::Defines{"METABALLS"});
    for (render::Sphere& particle : view.particles) particle.radius = 0.1F;
    CHECK(definesOf(view, TileClass::flats) == render::Defines{"METABALLS", "ONE_REACH"});
    view = plainView();
    for (const Term& term : terms()) term.add(view);
    CHECK(definesOf(view, TileClass::background) == render::Defines{"PERSPECTIVE"});
    CHECK(definesOf(view, TileClass::openGround) == render::Defines{"EXPOSURE", "GROUND", "PERSPECTIVE", "SOFT"});
    CHECK(definesOf(view, TileClass::occludedGround) ==
          render::Defines{"BOX_SHADOWS", "EXPOSURE", "GLOW_LIGHT", "GROUND", "GROUND_OCCLUSION", "MESH_SHADOWS",
                          "OCCLUSION", "PERSPECTIVE", "SHADOWS", "SOFT", "SPHERE_SHADOWS"});
    const render::Defines objects = definesOf(view, TileClass::objects);
    for (const char* flat : {"BOXES", "LINES", "MESHES"})
        CHECK(std::find(objects.begin(), objects.end(), flat) == objects.end());
}

TEST_CASE("OpenGL draws a view with every term at once", "[opengl][long]") {
    // Shaders may have 32 samplers, also on graphics cards.
    render::View view = cloud(30);
    for (const Term& term : terms()) term.add(view);
    view.surface.metal = 0.0F;
    view.surface.medium.transparency = 0.7F;
    view.meshObstacles.back().medium.transparency = 0.7F;
    view.sphereObstacles.push_back({{0.0F, 0.5F, -1.0F}, 0.4F});
    for (const Style style : {Style::spheres, Style::metaballs}) {
        view.style = style;
        const render::Image byCpu = drawn(By::cpu, view, kSize, Quality::normal);
        const Difference difference = compare(drawn(By::openGl, view, kSize, Quality::normal), byCpu, 16);
        INFO(difference);
        CHECK(difference.share < 0.01);
    }
}

TEST_CASE("OpenGL with few varyings draws the same picture", "[opengl][long]") {
    render::View view = cloudWithObstacles(60);
    view.light.shadows = true;
    view.ambient.occlusion = 0.8F;
    view.edges.push_back({{-1.5F, 0.0F, -1.5F}, {1.5F, 2.0F, 1.5F}});
    for (const Style style : {Style::spheres, Style::metaballs}) {
        view.style = style;
        render::Context context(render::Device{});
        const render::Image many = render::Renderer(context, kSize, Quality::draft).draw(view);
        const SmallerLimits limits(context, {{GL_MAX_VARYING_COMPONENTS, 60}});  // the fewest that OpenGL 3.3 allows
        const Difference difference = compare(render::Renderer(context, kSize, Quality::draft).draw(view), many, 0);
        INFO(difference);
        CHECK(difference.largest == 0);
    }
}

TEST_CASE("Pictures and lists beyond OpenGL's limits are refused", "[opengl]") {
    render::Context context(render::Device{});
    CHECK_THROWS_AS(render::Renderer(context, {200000, 10}, Quality::draft), render::OpenGlError);
    CHECK_THROWS_WITH(render::Renderer(context, {200000, 10}, Quality::draft),
                      Catch::Contains("a picture of 200000 x 16 pixels is larger than OpenGL's limit of "));
    const SmallerLimits limits(context, {{GL_MAX_TEXTURE_SIZE, 1024}, {GL_MAX_TEXTURE_BUFFER_SIZE, 1000}});
    CHECK_THROWS_WITH(render::Renderer(context, {16, 1025}, Quality::draft),
                      Catch::Contains("16 x 1040 pixels is larger than OpenGL's limit of 1024"));
    render::Renderer renderer(context, {1024, 16}, Quality::draft);
    CHECK_THROWS_WITH(renderer.draw(cloud(1001)), Catch::Contains("the lists of what tiles show take ") &&
                                                      Catch::Contains(" texels, and OpenGL allows 1000 in a list"));
}

#endif
