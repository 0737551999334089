// Tests the page of the figures: it contains everything that was drawn, and the times of the pictures.
#include "tools/pages/figures_page.h"
#include "tests/catch.h"
#include "tests/tools/program.h"
#include "tools/pages/html.h"
#include "tools/system/output_file.h"

TEST_CASE("The page holds still, strip and video of every figure, and the times of the strip", "[tools]") {
    const program::Folder folder;
    tools::FigureEntry entry;
    entry.number = 3;
    entry.title = "Figure 3 <solid>";
    entry.stillPath = (folder / "still.png").string();
    entry.stripPath = (folder / "strip.png").string();
    entry.videoPath = (folder / "video.mp4").string();
    entry.stillTime = 78.0;
    entry.stripTimes = {9.8, 39.0, 78.0};
    for (const std::string& path : {entry.stillPath, entry.stripPath, entry.videoPath})
        tools::writeFile(path, "bytes of " + path);
    const std::string html = tools::figuresPage({entry});
    for (const std::string& path : {entry.stillPath, entry.stripPath, entry.videoPath})
        CHECK(html.find(";base64," + tools::base64(tools::readFile(path))) != std::string::npos);
    CHECK(html.find("Still at 78 s") != std::string::npos);
    CHECK(html.find("At 9.8, 39, 78 s") != std::string::npos);
    CHECK(html.find("Figure 3 &lt;solid&gt;") != std::string::npos);
}
