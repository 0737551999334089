// Draws every built-in scene at two times and in both styles, from scene file to pixels, and some also with OpenGL, and
// compares the pictures with the goldens in tests/golden/frames. The actual pictures and a report stay in the build
// folder; tests/golden/approve.sh makes the actual pictures the new goldens.
#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "render/output/png.h"
#include "scenes/build/library.h"
#include "tests/catch.h"
#include "tests/golden/draw_goldens.h"
#include "tools/compare/approve.h"
#include "tools/pages/compare_reports.h"
#include "tools/system/output_file.h"

namespace {

namespace fs = std::filesystem;

const fs::path kExpected = fs::path(GLOBULAR_SOURCE) / "tests/golden/frames";
const fs::path kActual = fs::path(GOLDEN_OUTPUT) / "actual";
const fs::path kReport = fs::path(GOLDEN_OUTPUT) / "report";

// How many of the two times are drawn. With sanitizers it is one: the suite would spend most of its time on the later
// frames, which run the same code as the early ones.
constexpr std::size_t kMoments = GOLDEN_MOMENTS;

/// The names of all goldens, and those of the goldens that are not drawn here.
struct GoldenNames {
    std::set<std::string> all, undrawn;
};

GoldenNames goldenNames() {
    GoldenNames names;
    const auto add = [&](const std::string& name, bool isDrawn) {
        names.all.insert(name);
        if (!isDrawn) names.undrawn.insert(name);
    };
    for (const golden::GoldenScene& scene : golden::scenes())
        for (const char* style : {"spheres", "metaballs"}) {
            add(golden::goldenName(scene, style, scene.first, "cpu"), true);
            add(golden::goldenName(scene, style, scene.second, "cpu"), kMoments == 2);
            if (scene.isDrawnWithOpenGl)
                add(golden::goldenName(scene, style, scene.second, "opengl"),
                    kMoments == 2 && golden::canDrawWithOpenGl());
        }
    return names;
}

/// The picture of a golden.
render::Image picture(const std::string& name) {
    const fs::path path = kExpected / name;
    return render::decodePng(tools::readFile(path), path.string());
}

/// What failed and why, for the log.
std::string describe(const tools::PictureResult& result) {
    std::string text = result.name;
    for (const std::string& reason : result.reasons) text += ": " + reason;
    if (result.explanation) text += "; " + result.explanation->text;
    return text;
}

/// Whether the golden is known to show the same particle state as the actual picture. States are the same bits on every
/// machine, so that another state, or one that is not recorded, is a failure even if the pictures look the same.
bool showsSameState(const tools::PictureResult& result) {
    const std::string& state = result.actual.provenance.stateHash;
    return !state.empty() && state == result.expected.provenance.stateHash;
}

}  // namespace

TEST_CASE("Every built-in scene looks as it did", "[golden]") {
    fs::remove_all(kActual);
    golden::draw(golden::scenes(), kMoments, kActual);
    const GoldenNames names = goldenNames();
    const tools::CompareJob job{kActual, kExpected, render::limitsOf("vendor"), {}};
    tools::ComparePage page;
    std::vector<std::string> failed;
    const tools::CompareCounts counts = tools::comparePictures(job, [&](const tools::PictureResult& result) {
        CHECK(names.all.contains(result.name));
        if (names.undrawn.contains(result.name)) return;
        if (!result.passed()) failed.push_back(result.name);
        page.add(result, result.passed() ? "" : tools::approvalLine(kActual, kExpected, {result.name}));
        INFO(describe(result) << "\nThe report: " << (kReport / "index.html").string()
                              << "\nTo approve: tests/golden/approve.sh [PRESET] [NAME...]");
        CHECK(result.passed());
        CHECK(showsSameState(result));
    });
    CHECK(counts.pictures() == static_cast<int>(names.all.size()));
    page.write(kReport, job, {"vendor", counts, tools::approvalLine(kActual, kExpected, failed)});
}

TEST_CASE("A golden whose particle state is not known fails", "[golden]") {
    const fs::path folder = fs::path(GOLDEN_OUTPUT) / "provenance";
    const fs::path source = kExpected / "liquid/spheres";
    fs::remove_all(folder);
    for (const char* side : {"actual", "expected"}) {
        fs::create_directories(folder / side);
        for (const char* file : {"frame-00005.png", "frame-00005.json"}) fs::copy(source / file, folder / side / file);
    }
    const auto result = [&] {
        tools::PictureResult last;
        tools::comparePictures({folder / "actual", folder / "expected", render::limitsOf("vendor"), {}},
                               [&](const tools::PictureResult& each) { last = each; });
        return last;
    };
    CHECK(result().passed());
    CHECK(showsSameState(result()));
    const fs::path sidecar = folder / "expected/frame-00005.json";
    fs::copy_file(source / "frame-00030.json", sidecar, fs::copy_options::overwrite_existing);  // of another picture
    CHECK(result().passed());
    CHECK_FALSE(showsSameState(result()));
    fs::remove(sidecar);
    CHECK(result().passed());
    CHECK_FALSE(showsSameState(result()));
}

TEST_CASE("No built-in scene is without goldens", "[golden]") {
    std::set<std::string> wanted, known;
    for (const auto& entry : scenes::listScenes(GLOBULAR_SOURCE "/scenes/library"))
        if (!entry.name.starts_with("hard/") && !entry.name.starts_with("measured/")) wanted.insert(entry.name);
    for (const golden::GoldenScene& scene : golden::scenes()) {
        known.insert(scene.name);
        CHECK(scene.first < scene.second);
    }
    CHECK(known == wanted);
}

TEST_CASE("A golden of another time or of the other style is noticed", "[golden]") {
    for (const golden::GoldenScene& scene : golden::scenes()) {
        // At rest the powder and the liquid do not move, and particles far apart look the same in both styles.
        if (scene.name == "paper/attraction-1" || scene.name == "paper/attraction-2") continue;
        INFO(scene.name);
        const auto frame = [&](const char* style, int number) {
            return picture(golden::goldenName(scene, style, number, "cpu"));
        };
        const render::Image good = frame("spheres", scene.second);
        const render::CompareLimits limits = render::limitsOf("vendor");
        CHECK_FALSE(render::compare(frame("spheres", scene.first), good, limits).passed());
        CHECK_FALSE(render::compare(frame("metaballs", scene.second), good, limits).passed());
    }
}

TEST_CASE("Goldens by OpenGL show what those by the CPU show", "[golden]") {
    render::CompareLimits limits = render::limitsOf("renderer");
    limits.largest = 255;  // a pixel of an outline may be on the surface with one renderer and beside it with the other
    for (const golden::GoldenScene& scene : golden::scenes()) {
        if (!scene.isDrawnWithOpenGl) continue;
        for (const char* style : {"spheres", "metaballs"}) {
            INFO(scene.name << ", " << style);
            // Behind the bends of jets neighboring rays go to places far apart, and roundings decide which.
            limits.share = scene.name == "fountain" ? 0.015 : render::limitsOf("renderer").share;
            const render::Image drawn = picture(golden::goldenName(scene, style, scene.second, "opengl"));
            const auto byCpu = [&](int frame) { return picture(golden::goldenName(scene, style, frame, "cpu")); };
            CHECK(render::compare(drawn, byCpu(scene.second), limits).passed());
            CHECK_FALSE(render::compare(drawn, byCpu(scene.first), limits).passed());
        }
    }
}
