// Opens the report of `compare` as a file in a real browser and checks what it shows, what keys and mouse do, and that
// it fetches nothing.
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/golden_files.h"
#include "tests/tools/program.h"

using namespace golden_files;
using namespace test_pictures;

namespace {

using Json = nlohmann::json;
using Names = std::vector<std::string>;

bool hasBrowser() {
    return std::system("command -v chromium >/dev/null 2>&1") == 0;
}

/// The page's DOM after its scripts have run.
std::string domOf(const fs::path& page, const fs::path& folder) {
    const std::string command =
        "timeout 120 chromium --headless --no-sandbox --disable-gpu --no-first-run --user-data-dir=" +
        (folder / "profile").string() + " --virtual-time-budget=10000 --window-size=1280,900 --dump-dom file://" +
        page.string() + " >" + (folder / "dom").string() + " 2>" + (folder / "said").string();
    const int status = std::system(command.c_str());
    INFO(program::textOf(folder / "said"));
    REQUIRE(status == 0);
    return program::textOf(folder / "dom");
}

/// What tests/browser/drive.js found on the page.
Json drive(const fs::path& report, const fs::path& folder) {
    std::string page = program::textOf(report);
    const std::size_t head = page.find("<title>");
    REQUIRE(head != std::string::npos);
    page.insert(head, "<script>" + program::textOf(fs::path(GLOBULAR_SOURCE) / "tests/browser/drive.js") + "</script>");
    const fs::path driven = report.parent_path() / "driven.html";  // beside the folder of pictures
    tools::writeFile(driven, page);
    const std::string dom = domOf(driven, folder);
    const std::string open = "<pre id=\"outcome\">";
    const std::size_t begin = dom.find(open);
    INFO(dom.substr(0, 4000));
    REQUIRE(begin != std::string::npos);
    return Json::parse(dom.substr(begin + open.size(), dom.find("</pre>", begin) - begin - open.size()));
}

/// Writes one picture for each status.
void makeFolders(const program::Folder& folder) {
    const auto both = [&](const std::string& name, const render::Image& actual) {
        writePicture(folder / ("actual/" + name), actual);
        writePicture(folder / ("expected/" + name), balls());
    };
    both("frame-00000.png", balls());
    both("deeper/frame-00001.png", onePixel(balls(), 30, 40, 9));
    both("frame-00002.png", shifted(balls()));
    writeManifest(folder / "expected", "00000000000000aa");
    writePicture(folder / "actual/new <!--<script>.png", gray(balls()));
    writePicture(folder / "expected/gone.png", balls());
    both("size.png", balls(90, 160));
    both("broken.png", balls());
    tools::writeFile(folder / "actual/broken.png", std::string("no PNG"));
    tools::writeFile(folder / "actual/run.json", std::string("{\"scene_hash\": \"5ce4e\", \"stepper\": \"auto\"}"));
}

}  // namespace

TEST_CASE("The report works from file:// in a real browser", "[browser]") {
    if (!hasBrowser()) {
        WARN("skipped: browser_tests: there is no chromium");
        return;
    }
    const program::Folder folder;
    const program::Folder work;
    makeFolders(folder);
    const std::string sides = (folder / "actual").string() + " " + (folder / "expected").string();
    REQUIRE(program::run("compare " + sides + " --report " + (folder / "report").string()).code == 2);
    const Json seen = drive(folder / "report/index.html", work / "");
    INFO(seen.dump(2));

    CHECK(seen["protocol"] == "file:");
    CHECK(seen["problems"] == Json::array());
    CHECK(seen["fetched"] == Json::array());
    CHECK(seen["title"] == "5 of 7 pictures are not as expected");
    const Names failed = {"broken.png", "frame-00002.png", "size.png", "new <!--<script>.png", "gone.png"};
    Names names = failed;
    names.insert(names.end(), {"deeper/frame-00001.png", "frame-00000.png"});
    CHECK(seen["names"] == Json(names));
    CHECK(seen["first"] == "broken.png");
    const std::string four = "expected actual difference heat: 160,160,160,160";
    CHECK(seen["kinds"] == Json({{"broken.png", "expected: 160"},
                                 {"frame-00002.png", four},
                                 {"size.png", "expected: 160"},
                                 {"new <!--<script>.png", "actual: 160"},
                                 {"gone.png", "expected: 160"},
                                 {"deeper/frame-00001.png", four},
                                 {"frame-00000.png", ": "}}));
    CHECK(seen["four"] == Json(Names{"expected", "actual", "difference", "heat"}));
    CHECK(seen["fourDecoded"] == "160,160,160,160");
    REQUIRE(seen["reasons"].size() >= 2);
    CHECK(seen["reasons"][0].get<std::string>().find("a channel is off by") == 0);
    CHECK(seen["explanation"].get<std::string>().find("the actual picture's state is not recorded") !=
          std::string::npos);
    CHECK(seen["facts"].get<std::string>().find("00000000000000aa") != std::string::npos);
    CHECK(seen["runs"].get<std::string>().find("\"stepper\": \"auto\"") != std::string::npos);
    CHECK(seen["approve"] == "globular approve " + sides + " frame-00002.png");

    CHECK(seen["swapAtFirst"] == Json(Names{"expected"}));
    CHECK(seen["swapHovered"] == Json(Names{"actual"}));
    CHECK(seen["swapLeft"] == Json(Names{"expected"}));
    CHECK(seen["swapByKey"] == Json(Names{"actual"}));
    CHECK(seen["swapDecoded"] == "160");
    CHECK(seen["slider"] == "inset(0px 0px 0px 25%)");
    CHECK(seen["edge"] == "25%");
    CHECK(seen["markers"] == 4);
    CHECK(seen["selected"] == seen["approve"]);
    CHECK(seen["clipboard"] == seen["approve"]);
    CHECK(seen["copied"] == "Copied");

    CHECK(seen["second"] == "size.png");
    CHECK(seen["back"] == "frame-00002.png");
    CHECK(seen["failed"] == Json(failed));
    CHECK(seen["filtered"] == Json(Names{"deeper/frame-00001.png"}));
    CHECK(seen["filteredChoice"] == "deeper/frame-00001.png");
    CHECK(seen["unreachable"] == 0);
}
