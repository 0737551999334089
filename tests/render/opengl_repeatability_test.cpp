// OpenGL's pictures are the same bytes in every run on a device: with any number of threads, from any thread, whatever
// was drawn before. Both libraries of contexts give the same bytes where the same driver draws.
#include "tests/catch.h"

#ifdef RENDER_HAS_OPENGL

#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "render/output/child_process.h"
#include "tests/render/pictures.h"

using namespace pictures;
using render::Quality;
using render::Style;

namespace {

constexpr render::PictureSize kSize{200, 117};

render::View spheres() {
    render::View view = cloudWithObstacles(300);
    view.light.shadows = true;
    view.edges.push_back({{-1.5F, 0.0F, -1.5F}, {1.5F, 2.0F, 1.5F}});
    return view;
}

render::View metaballs() {
    render::View view = spheres();
    view.style = Style::metaballs;
    view.light.softness = 0.7F;
    view.ambient.occlusion = 0.8F;
    view.surface = {0.04F, 8, 1.0F, 0.3F, 0.4F, 0.5F, 0.6F, 0.2F};
    view.exposure = 1.2F;
    view.field.skin = render::Skin::smooth;
    return view;
}

constexpr std::string_view kMark = "the pictures of a child process: ";

std::string checksum(const render::Image& image) {
    const std::string_view bytes(reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size());
    return fmt::format("{:016x}", std::hash<std::string_view>()(bytes));
}

/// What one process draws on a device, in one line: the driver, and a checksum of each picture.
std::string pictureLine(render::Context& context) {
    std::string line = context.rendererName() + ", " + context.versionName();
    for (const render::View& view : {spheres(), metaballs()}) {
        render::Renderer renderer(context, kSize, Quality::normal);
        line += ", " + checksum(renderer.draw(view));
        CHECK(line.ends_with(checksum(renderer.draw(view))));
    }
    return line;
}

/// The line that a child process prints.
/// @param settings  environment variables
std::string lineOfChild(const std::string& test, const std::vector<std::string>& settings) {
    std::vector<std::string> arguments = {"env"};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    arguments.push_back(std::filesystem::read_symlink("/proc/self/exe").string());
    arguments.push_back(test);
    render::ChildProcess child(arguments);
    const std::string problem = child.wait();
    const std::string output = child.output();
    INFO(problem << "\n" << output);
    REQUIRE(problem.empty());
    const std::size_t at = output.find(kMark);
    REQUIRE(at != std::string::npos);
    return output.substr(at, output.find('\n', at) - at);
}

/// Views of which each changes what the next one needs: style, number of particles, projection, ground, obstacles.
std::vector<render::View> differentViews() {
    render::View bare = cloud(40);
    bare.ground.reset();
    bare.camera.projection = render::Projection::orthographic;
    bare.camera.halfHeight = 2.0F;
    render::View noBalls = metaballs();
    noBalls.particles.clear();
    render::View fewBalls = bare;
    fewBalls.style = Style::metaballs;
    return {spheres(), metaballs(), bare, noBalls, fewBalls};
}

}  // namespace

TEST_CASE("prints the pictures that OSMesa draws, for the test of child processes", "[.child-osmesa]") {
    render::Context context(render::Device{render::Backend::osmesa});
    std::cout << kMark << pictureLine(context) << std::endl;
}

TEST_CASE("prints the pictures that EGL draws, for the test of child processes", "[.child-egl]") {
    render::Context context(render::Device{render::Backend::egl});
    std::cout << kMark << pictureLine(context) << std::endl;
}

TEST_CASE("OpenGL draws the same bytes in every process with any number of threads", "[opengl][long]") {
    const std::string expected = std::string(kMark) + pictureLine(openGlContext());
    // Shaders optimized as users have them, whatever the tests are run with.
    CHECK(lineOfChild("[.child-osmesa]", {"LP_NUM_THREADS=0", "GALLIVM_PERF="}) == expected);
    for (const char* threads : {"LP_NUM_THREADS=1", "LP_NUM_THREADS=2"})
        CHECK(lineOfChild("[.child-osmesa]", {threads}) == expected);
    const std::string byEgl = lineOfChild("[.child-egl]", {"LP_NUM_THREADS=2"});
    const render::Context& osmesa = openGlContext();
    if (byEgl.find(fmt::format("{}{}, {}", kMark, osmesa.rendererName(), osmesa.versionName())) == 0)
        CHECK(byEgl == expected);
    else
        WARN("skipped: EGL draws with another driver than OSMesa: " << byEgl);
}

TEST_CASE("Renderers of one context do not disturb each other", "[opengl]") {
    const render::View view = cloud(20);
    render::Renderer first(openGlContext(), {33, 17}, Quality::draft);
    const render::Image expected = first.draw(view);
    {
        render::Renderer second(openGlContext(), {16, 16}, Quality::draft);
        second.draw(cloud(0));
        CHECK(first.draw(view).rgb == expected.rgb);
    }
    CHECK(first.draw(view).rgb == expected.rgb);
}

TEST_CASE("What OpenGL drew before does not show", "[opengl]") {
    std::vector<render::View> views = differentViews();
    for (const Quality quality : {Quality::normal, Quality::final}) {
        const render::PictureSize size = quality == Quality::normal ? kSize : render::PictureSize{50, 30};
        // The shaders of the longest look take seconds to compile.
        if (quality == Quality::final) views.erase(views.begin() + 1);
        const auto renderer = makeRenderer(By::openGl, size, quality);
        std::vector<render::Image> forward;
        for (const render::View& view : views) forward.push_back(renderer->draw(view));
        for (std::size_t k = views.size(); k-- > 0;) {
            INFO("quality " << static_cast<int>(quality) << ", view " << k);
            renderer->visiblePoints(views[(k + 2) % views.size()]);
            const Difference difference = compare(renderer->draw(views[k]), forward[k], 0);
            INFO(difference);
            CHECK(difference.largest == 0);
            if (k + 1 == views.size())
                CHECK(makeRenderer(By::openGl, size, quality)->draw(views[k]).rgb == forward[k].rgb);
        }
    }
}

TEST_CASE("OpenGL draws from one thread after another", "[opengl]") {
    render::Renderer& renderer = openGlRenderer(kSize, Quality::normal);
    const render::Image expected = renderer.draw(spheres());
    for (int k = 0; k < 2; ++k) {
        render::Image image;
        std::thread([&] { image = renderer.draw(spheres()); }).join();
        CHECK(image.rgb == expected.rgb);
    }
}

#else

#include "tests/render/pictures.h"

TEST_CASE("OpenGL's pictures", "[opengl]") {
    WARN("skipped: tests of OpenGL's pictures: this globular was built without OpenGL");
    CHECK(pictures::renderers() == std::vector{pictures::By::cpu});
}

#endif
