// Tests what globular compare writes as JUnit's XML, and comparisons of videos and of whole runs.
#include "tests/catch.h"
#include "tests/tools/compared_sides.h"
#include "tests/tools/program.h"

using namespace golden_files;
using namespace test_pictures;
using program::run;

TEST_CASE("compare: JUnit's XML counts failures and errors, and stays XML", "[compare]") {
    Sides sides;
    sides.both("frame-00000.png", balls());
    sides.actual("a<b>&\".png", blank(balls()));
    sides.expected("a<b>&\".png", balls());
    sides.both("no \xff UTF-8.png", balls());
    sides.both("broken.png", balls());
    tools::writeFile(sides / "actual/broken.png", std::string("no PNG"));
    CHECK(sides.compare("--junit " + (sides / "junit.xml").string()).code == 2);
    const std::string xml = program::textOf(sides / "junit.xml");
    CHECK(xml.find("<?xml") == 0);
    CHECK(xml.find("tests=\"4\" failures=\"1\" errors=\"1\"") != std::string::npos);
    CHECK(xml.find("name=\"no \xEF\xBF\xBD UTF-8.png\"/>") != std::string::npos);
    CHECK(xml.find("name=\"frame-00000.png\"/>") != std::string::npos);
    CHECK(xml.find("name=\"a&lt;b&gt;&amp;&quot;.png\">\n    <failure type=\"largest\"") != std::string::npos);
    CHECK(xml.find("<error type=\"unreadable\"") != std::string::npos);
    fs::remove(sides / "actual/broken.png");
    fs::remove(sides / "expected/broken.png");
    CHECK(sides.compare("--quiet --junit " + (sides / "no/such/folder.xml").string()).code == 1);
    CHECK(program::textOf(sides / "no/such/folder.xml").find("errors=\"0\"") != std::string::npos);
    // What cannot be written is known before the first picture is compared.
    const auto folder = sides.compare("--junit " + (sides / "no").string());
    CHECK(folder.code == 2);
    CHECK(folder.out.empty());
    CHECK(folder.err.find("it is a folder") != std::string::npos);
}

TEST_CASE("compare: JUnit's XML has no characters that XML cannot express", "[compare]") {
    Sides sides;
    // U+FFFE, U+FFFF, a lone surrogate, an overlong form, control characters; U+1FFFE and DEL are allowed.
    for (const char* name : {"\xEF\xBF\xBE\xEF\xBF\xBF.png", "\xED\xA0\x80.png", "\xC0\x80.png", "\x01\x1B\n.png",
                             "\xF0\x9F\xBF\xBE\x7F.png"})
        sides.actual(name, balls());
    CHECK(sides.compare("--junit " + (sides / "junit.xml").string()).code == 1);
    const std::string xml = program::textOf(sides / "junit.xml");
    std::u32string characters;
    REQUIRE_NOTHROW(characters = fs::path(xml).u32string());  // the whole is UTF-8
    for (const char32_t c : characters) {
        const bool isAllowed =
            c == 9 || c == 10 || c == 13 || (c >= 0x20 && c <= 0xD7FF) || (c >= 0xE000 && c <= 0xFFFD) || c >= 0x10000;
        CHECK(isAllowed);
    }
    CHECK(xml.find("name=\"??.png\"") != std::string::npos);
    CHECK(xml.find("name=\"\xF0\x9F\xBF\xBE\x7F.png\"") != std::string::npos);
    CHECK(program::shell("python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' " +
                         (sides / "junit.xml").string())
              .err.empty());
}

TEST_CASE("compare: frames of two videos", "[compare]") {
    Sides sides;
    for (int k = 0; k < 3; ++k) sides.actual("frame-0000" + std::to_string(k) + ".png", noisy(balls(), 2 * k));
    const auto video = [&](const std::string& folder, const std::string& name) {
        return run("video " + (sides / folder).string() + " --quiet -o " + (sides / name).string()).code;
    };
    REQUIRE(video("actual", "a.mp4") == 0);
    REQUIRE(video("actual", "same.mp4") == 0);
    REQUIRE(video("actual", "same.mkv") == 0);
    CHECK(run("compare " + (sides / "same.mkv").string() + " " + (sides / "a.mp4").string() + " --quiet").code == 0);
    fs::create_directories(sides / "50%d");
    fs::copy(sides / "a.mp4", sides / "take:1.mp4");
    const std::string within = "cd " + (sides / "").string() + " && TMPDIR=" + (sides / "50%d").string();
    CHECK(run("compare take:1.mp4 a.mp4 --quiet", within).code == 0);
    sides.actual("frame-00002.png", shifted(balls()));
    REQUIRE(video("actual", "other.mp4") == 0);
    const std::string compare = "compare --json ";
    const auto same =
        run(compare + (sides / "same.mp4").string() + " " + (sides / "a.mp4").string() + " --profile strict");
    CHECK(same.code == 0);
    CHECK(same.out.find("\"pictures\":3,\"identical\":3") != std::string::npos);
    const auto other =
        run(compare + (sides / "other.mp4").string() + " " + (sides / "a.mp4").string() + " --profile loose");
    CHECK(other.code == 1);
    CHECK(other.out.find("\"name\":\"frame-00002.png\",\"status\":\"different\"") != std::string::npos);
    // A video against the frames that it was made of. Flat colors are not changed by 4:2:0 subsampling. Luma has 219
    // and chroma 224 levels for the 255 of a channel, so that each rounding changes a channel by at most 0.5 (1.17 + 2
    // x 1.14) < 2 levels, and there are two roundings. A wrong color matrix would change it by about 20.
    int number = 0;
    for (const std::array<std::uint8_t, 3>& color :
         {std::array<std::uint8_t, 3>{200, 60, 40}, {30, 180, 90}, {20, 60, 220}})
        sides.expected("frame-0000" + std::to_string(number++) + ".png", flat(160, 90, color));
    REQUIRE(video("expected", "flat.mp4") == 0);
    const auto own = run(compare + (sides / "flat.mp4").string() + " " + (sides / "expected").string() +
                         " --max-difference 4 --max-share 100 --max-mean 4");
    INFO(own.out);
    CHECK(own.code == 0);
    tools::writeFile(sides / "broken.mp4", std::string("no video"));
    const auto broken = run(compare + (sides / "broken.mp4").string() + " " + (sides / "a.mp4").string());
    CHECK(broken.code == 2);
    CHECK(broken.err.find("error: ffmpeg cannot decode") == 0);
}

TEST_CASE("compare: the manifests of two runs tell what changed", "[compare]") {
    Sides sides;
    const auto draw = [&](const char* folder, const std::string& more) {
        return program::run("render measured/fountain --size 96x54 --frames 9 --quality draft --quiet --overwrite -o " +
                            (sides / folder).string() + more)
            .code;
    };
    const auto changed = [&] { return sides.results()["frame-00009.png"]["changed"]; };
    REQUIRE(draw("expected", "") == 0);
    REQUIRE(draw("actual", " --set look.specular=0.5") == 0);
    CHECK(changed() == "renderer");
    REQUIRE(draw("actual", " --set physics.drag=3") == 0);
    CHECK(changed() == "simulation");
}
