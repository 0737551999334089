// The study of pictures: its view, its measures of error, and a small run of it.
#include "studies/pictures/pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "studies/oracle/ball_grid.h"
#include "studies/pictures/dam_break_view.h"
#include "tests/catch.h"

using namespace studies;
using render::Quality;
using render::Style;

namespace {

constexpr render::PictureSize kSize{160, 90};

std::vector<ExactWindow> exactPicture(const render::View& view) {
    const oracle::Window whole{0, 0, kSize.width, kSize.height};
    return {{whole, oracle::drawWindow(oracle::Scene(view), kSize, whole, 1)}};
}

/// A context for the renderer in OpenGL; none in a build without it.
std::unique_ptr<render::Context> openGl() {
#ifdef RENDER_HAS_OPENGL
    return std::make_unique<render::Context>(render::Device{render::Backend::osmesa});
#else
    return nullptr;
#endif
}

/// The rows of one renderer.
template <typename Row>
std::vector<Row> rowsOf(const std::vector<Row>& rows, RendererKind renderer) {
    std::vector<Row> some;
    for (const Row& row : rows)
        if (row.renderer == renderer) some.push_back(row);
    return some;
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream of(line);
    for (std::string field; std::getline(of, field, ',');) fields.push_back(field);
    return fields;
}

}  // namespace

TEST_CASE("The dam break has as many particles as asked, the same in every call", "[pictures]") {
    for (const std::size_t count : {1000U, 10000U}) {
        const render::View view = damBreakView(count, Style::spheres);
        REQUIRE(view.particles.size() == count);
        const render::View again = damBreakView(count, Style::metaballs);
        CHECK(again.style == Style::metaballs);
        for (std::size_t k = 0; k < count; ++k) REQUIRE(view.particles[k].center == again.particles[k].center);
    }
}

TEST_CASE("The oracle finds the same hits with its grid as without", "[pictures]") {
    for (const Style style : {Style::spheres, Style::metaballs}) {
        const render::View view = damBreakView(1500, style);
        const oracle::Scene scene(view);
        const oracle::Scene bruteForce(view, true);
        int hits = 0;
        std::size_t most = 0;
        for (int k = 0; k < 200; ++k) {
            const oracle::Ray ray = oracle::pixelRay(view, kSize, k * 0.79 + 0.3, (k * 53 % 90) + 0.4);
            const oracle::Hit expected = oracle::trace(bruteForce, ray);
            const oracle::Hit hit = oracle::trace(scene, ray);
            REQUIRE(hit.kind == expected.kind);
            REQUIRE(hit.distance == expected.distance);
            REQUIRE(hit.normal == expected.normal);
            hits += expected.kind == oracle::Hit::Kind::particle ? 1 : 0;
            most = std::max(most, scene.ballsAlong(ray).size());
        }
        CHECK(hits > 50);
        CHECK(most < 750);  // of 1500: most are left out
    }
    // A ray along an axis, which stays at the border between cells.
    const render::View view = damBreakView(1500, Style::spheres);
    const oracle::Ray ray{glm::dvec3(view.particles[7].center) + glm::dvec3(0.0, 50.0, 0.0), {0.0, -1.0, 0.0}};
    CHECK(oracle::trace(oracle::Scene(view), ray).distance == oracle::trace(view, ray).distance);
    CHECK(oracle::BallGrid(std::vector<oracle::Extent>{}).along(ray).empty());
}

TEST_CASE("The error of a picture is small for the right view and large for another", "[pictures]") {
    const render::View view = damBreakView(1500, Style::spheres);
    const std::vector<ExactWindow> exact = exactPicture(view);
    render::Renderer renderer(kSize, Quality::draft);
    const PictureError right = errorOf(renderer.draw(view), renderer.visiblePoints(view), view, exact);
    CHECK(right.pixels == 160 * 90);
    CHECK(right.wrongHits <= 4.0 / 14400.0);  // at outlines, where single precision decides otherwise
    CHECK(right.depth < 1e-4);                // radii: 1e-7 of 12 m over 0.2 m
    CHECK(right.normal < 0.1);                // degrees: the same error over the slope at outlines
    CHECK(right.ssim > 0.98);
    render::View moved = view;
    moved.camera.eye.x += 0.3F;
    const PictureError wrong = errorOf(renderer.draw(moved), renderer.visiblePoints(moved), moved, exact);
    CHECK(wrong.wrongHits > 0.2);
    CHECK(wrong.ssim < 0.9);
    CHECK(wrong.rmse > 2.0 * right.rmse);
}

TEST_CASE("Better quality is steadier under a camera that moves slowly", "[pictures][long]") {
    const auto context = openGl();
    const std::size_t rendererCount = context ? 2 : 1;
    FlickerSettings settings;
    settings.particles = 1500;
    settings.size = {320, 180};
    settings.frames = 5;
    std::size_t told = 0;
    const std::vector<FlickerRow> all = measureFlicker(
        settings, context.get(), [&](const std::vector<FlickerRow>& soFar) { CHECK(soFar.size() == ++told); });
    CHECK(all.size() == 6 * rendererCount);
    CHECK(told == all.size());
    for (std::size_t renderer = 0; renderer < rendererCount; ++renderer) {
        const std::vector<FlickerRow> rows = rowsOf(all, kRendererKinds[renderer]);
        REQUIRE(rows.size() == 6);
        for (std::size_t k = 0; k < rows.size(); k += 3) {  // draft, normal, final of a style
            CAPTURE(renderer, k, rows[k].jerk, rows[k + 1].jerk, rows[k + 2].jerk);
            CHECK(rows[k].change > 0.0);
            CHECK(rows[k + 1].jerk < 0.8 * rows[k].jerk);
            CHECK(rows[k + 2].jerk < rows[k + 1].jerk);
        }
    }
    settings.pixelsPerFrame = 0.0;
    for (const FlickerRow& row : measureFlicker(settings, context.get(), [](const auto&) {})) CHECK(row.change == 0.0);
    const std::string csv = flickerCsv(all);
    CHECK(csv.find("\nmetaballs,1500,320,180,final,cpu,") != std::string::npos);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == static_cast<std::ptrdiff_t>(1 + all.size()));
}

TEST_CASE("Looks are measured after the dam break's own, by every renderer", "[pictures][long]") {
    const auto context = openGl();
    PictureSettings settings;
    settings.particles = {800};
    settings.sizes = {kSize};
    settings.frames = 1;
    settings.windowColumns = 2;
    settings.windowRows = 1;
    settings.samplesPerAxis = 2;
    std::size_t told = 0;
    const std::vector<LookRow> rows = measureLooks(
        settings, context.get(), [&](const std::vector<LookRow>& soFar) { CHECK(soFar.size() == ++told); });
    CHECK(told == rows.size());
    REQUIRE(rows.size() >= 2 * (context ? 2 : 1));
    CHECK(rows.front().look == "as it is");
    for (const LookRow& row : rows) {
        INFO(row.look << ", " << nameOf(row.renderer) << ": RMSE " << row.error.rmse << ", SSIM " << row.error.ssim);
        CHECK(row.draw > 0.0);
        CHECK(row.timeRatio > 0.0);
        // Against four exact samples a pixel (measured: at least 0.97); another look would be below 0.9.
        CHECK(row.error.ssim > 0.95);
    }
    const std::string csv = looksCsv(rows);
    CHECK(csv.find("\ntransparent,metaballs,800,") != std::string::npos);
    CHECK(csv.find("\nopen shutter,metaballs,800,160,90,final,") != std::string::npos);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == static_cast<std::ptrdiff_t>(1 + rows.size()));
}

TEST_CASE("A single particle keeps its sphere's volume, and a pool keeps its own with smoothing", "[pictures][long]") {
    render::View view;
    view.style = Style::metaballs;
    view.particles.push_back({glm::vec3(0.3F, 1.0F, -0.2F), 0.2F, glm::vec3(0.8F)});
    const double sphere = 4.0 / 3.0 * std::numbers::pi * 0.008;
    // With a spacing of a fiftieth of a radius the surface passes through 31,000 cells, whose errors average out.
    CHECK(fieldVolume(view, 0.02) == Approx(sphere).epsilon(1e-3));
    SmoothingSettings settings;
    settings.particles = {1000};
    settings.size = kSize;
    settings.frames = 1;
    settings.spacing = 0.5;
    std::size_t told = 0;
    const std::vector<SmoothingRow> rows =
        measureSmoothing(settings, [&](const std::vector<SmoothingRow>& soFar) { CHECK(soFar.size() == ++told); });
    REQUIRE(rows.size() == 3);
    CHECK(told == 3);
    CHECK(rows[0].skin == render::Skin::plain);
    CHECK(rows[2].skin == render::Skin::anisotropic);
    for (const SmoothingRow& row : rows) {
        CHECK(row.draw > 0.0);
        CHECK(row.lone == Approx(1.0).epsilon(0.01));
        CHECK(row.bumps > 0.5);
        CHECK(row.bumps < 10.0);  // those of spheres are 40 and more
    }
    // Kernels of three radii push a plain surface outward by two thirds of a radius on every side.
    CHECK(rows[0].volume > 1.2);
    CHECK(rows[1].volume == Approx(1.0).epsilon(0.03));
    CHECK(rows[2].volume == Approx(1.0).epsilon(0.03));
    CHECK(rows[2].bumps < 0.6 * rows[1].bumps);  // ellipsoids that lie along the surface
    const std::string csv = smoothingCsv(rows);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 4);
}

TEST_CASE("A small study has a row for each style, number, size, quality and renderer", "[pictures][long]") {
    const auto context = openGl();
    PictureSettings settings;
    settings.particles = {500, 100};
    settings.sizes = {kSize};
    settings.frames = 2;
    settings.encodedFrames = 2;
    settings.windowColumns = 2;
    settings.windowRows = 2;
    settings.samplesPerAxis = 1;
    settings.videoPath = (std::filesystem::temp_directory_path() / "globular-pictures-test.mp4").string();
    std::size_t told = 0;
    const auto rows = measurePictures(settings, context.get(),
                                      [&](const std::vector<PictureRow>& soFar) { CHECK(soFar.size() == ++told); });
    std::filesystem::remove(settings.videoPath);
    REQUIRE(rows.size() == (context ? 24 : 12));
    CHECK(told == rows.size());
    CHECK(rowsOf(rows, RendererKind::cpu).size() == 12);
    const PictureRow* onCpu = nullptr;  // the row of the same picture by the renderer on the CPU, which comes first
    for (const PictureRow& row : rows) {
        const bool isCpu = row.renderer == RendererKind::cpu;
        CAPTURE(nameOf(row.style), nameOf(row.quality), row.particles, isCpu);
        if (isCpu) onCpu = &row;
        CHECK(row.moving.draw > 0.0);
        CHECK(row.atRest.draw > 0.0);
        CHECK(row.moving.stages.color > 1e-5);
        const render::DrawTimes& stages = row.moving.stages;
        CHECK(stages.cast + stages.color + stages.readBack < 2.0 * row.moving.draw);
        for (const double stage : {stages.bin, stages.occlusion, stages.shadow}) CHECK(stage < 2.0 * row.moving.draw);
        // Less than 1e-5 s is the clock's own cost.
        if (isCpu) CHECK((row.moving.stages.cast > 1e-5) == (row.style == Style::metaballs));
        CHECK(row.encoding.has_value() == isCpu);
        CHECK(row.error.ssim > 0.9);
        CHECK(row.error.wrongHits <= 4.0 / 4096.0);  // at outlines, where single precision decides otherwise
        CHECK(row.error.normal < 2.0);               // degrees; wrong hits are left out of it
        CHECK(row.particles == onCpu->particles);
        CHECK(row.quality == onCpu->quality);
        CHECK(row.timeRatio == row.moving.draw / onCpu->moving.draw);
        CHECK(row.rmseRatio == row.error.rmse / onCpu->error.rmse);
        CHECK(row.rmseRatio == Approx(1.0).epsilon(0.1));  // both draw the same picture but for roundings
    }
    const std::string csv = picturesCsv(rows);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == static_cast<std::ptrdiff_t>(1 + rows.size()));
    // Each line has as many fields as the header, and every value stands under its own name.
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> names = split(line);
    for (const PictureRow& row : rows) {
        std::getline(lines, line);
        const std::vector<std::string> fields = split(line);
        REQUIRE(fields.size() == names.size());
        const auto field = [&](const char* name) {
            return fields[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
        };
        CHECK(field("renderer") == nameOf(row.renderer));
        CHECK(std::stod(field("draw_ms")) == Approx(1e3 * row.moving.draw).epsilon(1e-3));
        CHECK(field("with_mp4_ms").empty() != row.encoding.has_value());
        CHECK(std::stod(field("time_ratio")) == Approx(row.timeRatio).epsilon(0.01));
        CHECK(std::stod(field("ssim")) == Approx(row.error.ssim).epsilon(1e-4));
    }
    CHECK(csv.find("metaballs,500,160,90,final,cpu,") != std::string::npos);
    CHECK(pictureTimesPlot(rows, {{render::Skin::plain, 700}}).find("700 ") != std::string::npos);
    const std::string plot = pictureErrorsPlot(rows);
    CHECK(plot.find("\"metaballs, normal, cpu\"") != std::string::npos);
    CHECK((plot.find("\"metaballs, normal, opengl\"") != std::string::npos) == (context != nullptr));
}
