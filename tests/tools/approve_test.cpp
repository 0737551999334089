// Tests globular approve: actual pictures become goldens with sidecars, and a golden by another OpenGL renderer is not
// replaced by accident.
#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/golden_files.h"
#include "tests/tools/program.h"

using namespace golden_files;
using namespace test_pictures;
using program::run;
using program::textOf;

namespace {

nlohmann::json jsonOf(const fs::path& path) {
    return nlohmann::json::parse(textOf(path));
}

}  // namespace

TEST_CASE("approve: a picture that differs becomes the golden, with a sidecar", "[approve]") {
    const program::Folder folder;
    const std::string sides = (folder / "actual").string() + " " + (folder / "golden").string();
    writePicture(folder / "actual/liquid/frame-00003.png", balls());
    writePicture(folder / "actual/liquid/frame-00009.png", shifted(balls()));
    writeManifest(folder / "actual/liquid", "00000000000000aa");
    CHECK(run("compare " + sides).code == 1);
    CHECK(fs::exists(folder / "actual/liquid/frame-00003.png"));

    const auto chosen = run("approve " + sides + " liquid/frame-00003.png");
    CHECK(chosen.code == 0);
    CHECK(chosen.out == "new golden: liquid/frame-00003.png\n");
    CHECK_FALSE(fs::exists(folder / "golden/liquid/frame-00009.png"));
    CHECK(run("approve " + sides).out == "new golden: liquid/frame-00009.png\n");
    CHECK(run("compare --profile strict " + sides).code == 0);
    CHECK(textOf(folder / "golden/liquid/frame-00009.png") == textOf(folder / "actual/liquid/frame-00009.png"));
    const auto sidecar = jsonOf(folder / "golden/liquid/frame-00009.json");
    CHECK(sidecar["scene_hash"] == "5ce4e00000000000");
    CHECK(sidecar["state_hash"] == "00000000000000aa");
    CHECK(sidecar["version"] == "0.2.0");
    CHECK(sidecar["renderer"] == "opengl");
    CHECK(sidecar["gl_renderer"] == "llvmpipe (test)");
    CHECK(sidecar["gl_version"] == "4.5 Mesa (test)");
    CHECK(sidecar["quality"] == "normal");
    CHECK(sidecar["size"] == nlohmann::json({160, 90}));
    CHECK(sidecar["png"] == tools::checksumOf(tools::readFile(folder / "actual/liquid/frame-00009.png")));
    CHECK(run("approve " + sides).out.find("nothing to approve") == 0);

    // From now on the golden's provenance comes from the sidecar.
    writePicture(folder / "actual/liquid/frame-00009.png", blank(balls()));
    writeManifest(folder / "actual/liquid", "00000000000000bb");
    const auto changed = run("compare " + sides);
    CHECK(changed.code == 1);
    CHECK(changed.out.find("the simulation changed: state 00000000000000bb instead of 00000000000000aa") !=
          std::string::npos);
}

TEST_CASE("approve: refuses another renderer or driver without --force, and then writes nothing", "[approve]") {
    const program::Folder folder;
    const std::string approve = "approve " + (folder / "actual").string() + " " + (folder / "golden").string();
    writePicture(folder / "actual/frame-00001.png", balls());
    writeManifest(folder / "actual", "00000000000000aa");
    REQUIRE(run(approve).code == 0);
    const std::string before = textOf(folder / "golden/frame-00001.png");

    writePicture(folder / "actual/frame-00000.png", balls());
    writePicture(folder / "actual/frame-00001.png", darker(balls(), 0.9));
    writeManifest(folder / "actual", "00000000000000aa", {.renderer = "another GPU"});
    const auto refused = run(approve);
    CHECK(refused.code == 2);
    CHECK(refused.err.find(
              "frame-00001.png: drawn by OpenGL (another GPU, 4.5 Mesa (test)), the golden by OpenGL (llvmpipe "
              "(test), 4.5 Mesa (test)); --force") != std::string::npos);
    CHECK(textOf(folder / "golden/frame-00001.png") == before);
    CHECK_FALSE(fs::exists(folder / "golden/frame-00000.png"));
    fs::remove(folder / "actual/manifest.json");
    CHECK(run(approve).err.find("drawn by an unknown renderer") != std::string::npos);
    CHECK(run(approve + " frame-00000.png").code == 0);  // there is no golden that another renderer drew
    writeManifest(folder / "actual", "00000000000000aa", {.renderer = "another GPU"});
    CHECK(run(approve + " --force").code == 0);
    CHECK(jsonOf(folder / "golden/frame-00001.json")["gl_renderer"] == "another GPU");
    for (const auto& other : {golden_files::RunFacts{.drawnBy = "cpu", .renderer = "", .driver = ""},
                              golden_files::RunFacts{.renderer = "another GPU", .driver = "4.6 Mesa (test)"}}) {
        writeManifest(folder / "actual", "00000000000000aa", other);
        CHECK(run(approve).code == 2);
    }
    CHECK(textOf(folder / "golden/frame-00001.png") != before);
}

TEST_CASE("approve: single files, names that do not exist, files that are not sidecars", "[approve]") {
    const program::Folder folder;
    writePicture(folder / "actual/a.png", balls());
    const std::string one = "approve " + (folder / "actual/a.png").string() + " " + (folder / "golden/b.png").string();
    CHECK(run(one).code == 0);
    CHECK(textOf(folder / "golden/b.png") == textOf(folder / "actual/a.png"));
    const auto sidecar = jsonOf(folder / "golden/b.json");
    for (const char* key : {"renderer", "gl_renderer", "gl_version"}) CHECK(sidecar.at(key).is_null());

    for (const char* into : {"golden", "more/"})
        CHECK(run("approve " + (folder / "actual/a.png").string() + " " + (folder / into).string()).code == 0);
    CHECK(textOf(folder / "golden/a.png") == textOf(folder / "actual/a.png"));
    CHECK(fs::exists(folder / "more/a.json"));
    fs::remove(folder / "golden/a.png");

    const std::string folders = "approve " + (folder / "actual").string() + " " + (folder / "golden").string();
    const auto unknown = run(folders + " c.png");
    CHECK(unknown.code == 2);
    CHECK(unknown.err.find("error: c.png: there is no such picture in") == 0);
    CHECK(run("approve " + (folder / "nothing").string() + " " + (folder / "golden").string()).code == 1);

    tools::writeFile(folder / "golden/a.json", std::string("{\"mine\": true}"));
    const auto taken = run(folders);
    CHECK(taken.code == 2);
    CHECK(jsonOf(folder / "golden/a.json")["mine"] == true);
    CHECK_FALSE(fs::exists(folder / "golden/a.png"));
    CHECK(run(folders + " --force").code == 0);

    tools::writeFile(folder / "actual/a.png", std::string("no PNG"));
    CHECK(run(one).code == 1);
    CHECK(textOf(folder / "golden/b.png") != "no PNG");
}
