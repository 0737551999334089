// Every built-in scene at two times and in both styles: the whole way from scene file to pixels. The actual pictures
// and, when one is not as expected, a report stay in the build folder; tests/golden/approve.sh makes the actuals the
// new goldens.
#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "render/output/png.h"
#include "scenes/build/library.h"
#include "tests/catch.h"
#include "tests/golden/draw_goldens.h"
#include "tools/compare/approve.h"
#include "tools/pages/compare_page.h"
#include "tools/system/output_file.h"

namespace {

namespace fs = std::filesystem;

const fs::path kExpected = fs::path(GLOBULAR_SOURCE) / "tests/golden/frames";
const fs::path kActual = fs::path(GOLDEN_OUTPUT) / "actual";
const fs::path kReport = fs::path(GOLDEN_OUTPUT) / "report";

// A sanitized suite would spend most of its time on later frames, where no other code runs than in early ones.
constexpr std::size_t kMoments = GOLDEN_MOMENTS;

/// Names of the pictures that are not drawn here.
std::set<std::string> leftOut() {
    std::set<std::string> names;
    for (const golden::GoldenScene& scene : golden::scenes())
        for (const char* style : {"spheres", "metaballs"})
            if (kMoments == 1) names.insert(fmt::format("{}/{}/frame-{:05}.png", scene.name, style, scene.second));
    return names;
}

std::string saidOf(const tools::PictureResult& result) {
    std::string text = result.name;
    for (const std::string& reason : result.reasons) text += ": " + reason;
    if (result.explanation) text += "; " + result.explanation->text;
    return text;
}

}  // namespace

TEST_CASE("Every built-in scene looks as it did", "[golden]") {
    fs::remove_all(kActual);
    golden::draw(golden::scenes(), kMoments, kActual);
    const std::set<std::string> undrawn = leftOut();
    const tools::CompareJob job{kActual, kExpected, render::limitsOf("vendor"), {}};
    tools::ComparePage page;
    std::vector<std::string> failed;
    const tools::CompareCounts counts = tools::comparePictures(job, [&](const tools::PictureResult& result) {
        if (undrawn.contains(result.name)) return;
        if (!result.passed()) failed.push_back(result.name);
        page.add(result, result.passed() ? "" : tools::approvalLine(kActual, kExpected, {result.name}));
        INFO(saidOf(result) << "\nThe report: " << (kReport / "index.html").string()
                            << "\nTo approve: tests/golden/approve.sh [PRESET] [NAME...]");
        CHECK(result.passed());
        // States are the same bits everywhere: another state is a change, even one that nobody sees.
        CHECK_FALSE((result.explanation && result.explanation->cause == tools::Cause::simulation));
    });
    CHECK(counts.pictures() == 4 * static_cast<int>(golden::scenes().size()));
    tools::createFolder(kReport);
    tools::writeFile(kReport / "index.html", page.html({kActual.string(), kExpected.string(), "vendor", job.limits,
                                                        counts, tools::approvalLine(kActual, kExpected, failed)}));
}

TEST_CASE("No built-in scene is without goldens", "[golden]") {
    std::set<std::string> wanted, known;
    for (const auto& entry : scenes::listScenes({GLOBULAR_SOURCE "/scenes/library"}))
        if (!entry.name.starts_with("hard/")) wanted.insert(entry.name);
    for (const golden::GoldenScene& scene : golden::scenes()) {
        known.insert(scene.name);
        CHECK(scene.first < scene.second);
    }
    CHECK(known == wanted);
}

TEST_CASE("A golden of another moment, and one of the other style, are noticed", "[golden]") {
    const auto picture = [](const std::string& name) {
        const fs::path path = kExpected / name;
        return render::decodePng(tools::readFile(path), path.string());
    };
    for (const golden::GoldenScene& scene : golden::scenes()) {
        // A powder and a liquid at rest do not move, and particles apart look the same in both styles.
        if (scene.name == "paper/attraction-1" || scene.name == "paper/attraction-2") continue;
        INFO(scene.name);
        const auto frame = [&](const char* style, int number) {
            return picture(fmt::format("{}/{}/frame-{:05}.png", scene.name, style, number));
        };
        const render::Image good = frame("spheres", scene.second);
        const render::CompareLimits limits = render::limitsOf("vendor");
        CHECK_FALSE(render::compare(frame("spheres", scene.first), good, limits).passed());
        CHECK_FALSE(render::compare(frame("metaballs", scene.second), good, limits).passed());
    }
}
