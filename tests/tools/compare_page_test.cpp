// Tests the report of compare without a browser: the page fetches nothing but the pictures beside it, and its data
// cannot end the script element that holds them.
#include "tools/pages/compare_reports.h"

#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/golden_files.h"
#include "tests/tools/program.h"

using namespace golden_files;
using namespace test_pictures;

namespace {

/// The data of the page as its script reads them.
nlohmann::json dataOf(const std::string& page) {
    const std::string open = "<script type=\"application/json\" id=\"data\">";
    const std::size_t begin = page.find(open) + open.size();
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

}  // namespace

TEST_CASE("compare --report: a page, failures first, with the pictures that differ beside it", "[compare]") {
    const program::Folder folder;
    writePicture(folder / "actual/a.png", balls());
    writePicture(folder / "expected/a.png", balls());
    writePicture(folder / "actual/b<!--<script>.png", gray(balls()));
    writePicture(folder / "actual/z.png", onePixel(balls(), 3, 4, 100));
    writePicture(folder / "expected/z.png", balls());
    const std::string command = "compare " + (folder / "actual").string() + " " + (folder / "expected").string() +
                                " --report " + (folder / "new/report").string();
    const auto outcome = program::run(command);
    CHECK(outcome.code == 1);
    CHECK(outcome.out.find("to look at them: " + (folder / "new/report/index.html").string()) != std::string::npos);
    const std::string page = program::textOf(folder / "new/report/index.html");
    for (const char* reference : {"http:", "https:", "src=\"", "href=", "url(", "@import", "fetch("}) {
        INFO(reference);
        CHECK(page.find(reference) == std::string::npos);
    }
    const auto data = dataOf(page);
    REQUIRE(data["pictures"].size() == 3);
    CHECK(data["pictures"][0]["name"] == "z.png");
    CHECK(data["pictures"][1]["name"] == "b<!--<script>.png");
    CHECK(data["pictures"][2]["name"] == "a.png");
    CHECK(data["counts"]["failed"] == 2);
    CHECK_FALSE(data["pictures"][2].contains("images"));
    REQUIRE(data["pictures"][0]["images"].size() == 4);
    const auto bytesOf = [&](const char* kind) {
        return tools::readFile(folder / "new/report" / data["pictures"][0]["images"][kind].get<std::string>());
    };
    CHECK(bytesOf("actual") == tools::readFile(folder / "actual/z.png"));
    CHECK(bytesOf("expected") == tools::readFile(folder / "expected/z.png"));
    const render::Image difference = render::decodePng(bytesOf("difference"), "difference");
    CHECK(difference.rgb == render::differenceImage(onePixel(balls(), 3, 4, 100), balls()).rgb);
    CHECK(bytesOf("heat").size() > 100);
}

TEST_CASE("compare --report: the worst fifty pictures are shown, whatever the size of all", "[compare]") {
    const program::Folder folder;
    const auto nameOf = [](int k) { return "frame-" + std::to_string(k) + ".png"; };
    std::size_t bytes = 0;
    for (int k = 0; k < 60; ++k) {
        writePicture(folder / ("actual/" + nameOf(k)), noisy(balls(), k));  // the first is identical
        writePicture(folder / ("expected/" + nameOf(k)), balls());
        bytes += fs::file_size(folder / ("actual/" + nameOf(k))) + fs::file_size(folder / ("expected/" + nameOf(k)));
    }
    const std::string compare =
        "compare " + (folder / "actual").string() + " " + (folder / "expected").string() + " --quiet --report ";
    const fs::path report = folder / "report";
    REQUIRE(program::run(compare + report.string()).code == 1);
    CHECK(fs::file_size(report / "index.html") < bytes / 4);
    const auto data = dataOf(program::textOf(report / "index.html"));
    REQUIRE(data["pictures"].size() == 60);
    for (const auto& picture : data["pictures"]) {
        const int k = std::stoi(picture["name"].get<std::string>().substr(6));
        INFO(k);
        CHECK(picture.contains("images") == (k >= 10));
        if (k < 10) continue;
        for (const auto& [kind, image] : picture["images"].items())
            CHECK(fs::file_size(report / image.get<std::string>()) > 0);
    }
    const auto files = [&] { return std::distance(fs::directory_iterator(report / "index-files"), {}); };
    CHECK(files() == 4 * 50);

    // A later report removes the pictures of this one, and nothing else.
    tools::writeFile(report / "index-files/mine.png", std::string("mine"));
    for (int k = 0; k < 59; ++k) fs::remove(folder / ("actual/" + nameOf(k)));
    for (int k = 0; k < 59; ++k) fs::remove(folder / ("expected/" + nameOf(k)));
    REQUIRE(program::run(compare + report.string()).code == 1);
    CHECK(files() == 4 + 1);
}

TEST_CASE("compare --report: frames of videos have no files of their own", "[compare]") {
    const program::Folder folder;
    for (const char* side : {"a", "b"}) {
        for (int k = 0; k < 3; ++k)
            writePicture(folder / (side + ("/frame-0000" + std::to_string(k) + ".png")),
                         k == 1 && side[0] == 'b' ? shifted(balls()) : balls());
        const std::string files = (folder / side).string() + " -o " + (folder / side).string() + ".mp4";
        REQUIRE(program::run("video --quiet " + files).code == 0);
    }
    const auto outcome = program::run("compare " + (folder / "a.mp4").string() + " " + (folder / "b.mp4").string() +
                                      " --profile loose --report " + (folder / "report").string());
    CHECK(outcome.code == 1);
    const auto data = dataOf(program::textOf(folder / "report/index.html"));
    REQUIRE(data["pictures"].size() == 3);
    CHECK(data["pictures"][0]["name"] == "frame-00001.png");
    CHECK(data["pictures"][0]["images"].size() == 4);
    CHECK(data["pictures"][0]["actual"]["path"] == (folder / "a.mp4").string());
}
