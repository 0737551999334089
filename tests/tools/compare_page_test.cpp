// Tests the report of compare without a browser: it is one file that refers to no other, and its data cannot end the
// script element that holds them.
#include "tools/pages/compare_reports.h"

#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/golden_files.h"
#include "tests/tools/program.h"
#include "tools/pages/html.h"

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

TEST_CASE("compare --report: one file, failures first, pictures inlined once", "[compare]") {
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
    CHECK(data["pictures"][2]["images"].size() == 1);
    CHECK(data["pictures"][0]["images"].size() == 4);
    for (const auto& [name, image] : data["pictures"][0]["images"].items())
        CHECK(image.get<std::string>().rfind("data:image/png;base64,", 0) == 0);
    CHECK(data["pictures"][0]["images"]["actual"] ==
          "data:image/png;base64," + tools::base64(tools::readFile(folder / "actual/z.png")));
}
