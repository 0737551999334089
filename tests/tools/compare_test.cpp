// Tests globular compare: exit codes, reasons, machine-readable results, and whether the simulation or the renderer
// changed.
#include "tests/catch.h"
#include "tests/tools/compared_sides.h"
#include "tests/tools/program.h"
#include "tools/compare/picture_set.h"

using namespace golden_files;
using namespace test_pictures;
using program::run;

TEST_CASE("compare: 0 within limits, 1 different, 2 trouble", "[compare]") {
    Sides sides;
    sides.both("frame-00000.png", balls());
    CHECK(sides.compare("--profile strict").code == 0);
    sides.both("deeper/frame-00001.png", balls());
    sides.actual("frame-00002.png", onePixel(balls(), 30, 40, 10));
    sides.expected("frame-00002.png", balls());
    const auto vendor = sides.compare();
    CHECK(vendor.code == 0);
    CHECK(vendor.out.find("3 pictures: 2 identical, 1 within limits (vendor), 0 different") != std::string::npos);
    const auto strict = sides.compare("--profile strict");
    CHECK(strict.code == 1);
    CHECK(strict.err == "");
    CHECK(strict.out.find("frame-00002.png: different (largest)") != std::string::npos);
    CHECK(strict.out.find("off by 10 at (30, 40), allowed are 0") != std::string::npos);
    CHECK(sides.compare("--profile strict --quiet").out == "");

    CHECK(sides.compare("--profile exact").code == 2);
    CHECK(run("compare " + (sides / "nothing").string() + " " + (sides / "expected").string()).code == 2);
    const auto mixed =
        run("compare " + (sides / "actual/frame-00000.png").string() + " " + (sides / "expected").string());
    CHECK(mixed.code == 2);
    CHECK(mixed.err.find("error: one side is a single picture") == 0);
    fs::create_directories(sides / "empty");
    const auto empty = run("compare " + (sides / "empty").string() + " " + (sides / "empty").string());
    CHECK(empty.code == 2);
    CHECK(empty.err.find("there are no PNG files") != std::string::npos);
}

TEST_CASE("compare: two files, whatever their names", "[compare]") {
    Sides sides;
    sides.actual("a.png", darker(balls(), 0.5));
    sides.expected("b.png", balls());
    const auto outcome =
        run("compare " + (sides / "actual/a.png").string() + " " + (sides / "expected/b.png").string());
    CHECK(outcome.code == 1);
    CHECK(outcome.out.find("b.png: different (largest)") == 0);
    CHECK(run("compare " + (sides / "actual/a.png").string() + " " + (sides / "actual/a.png").string()).code == 0);
    const auto missing =
        run("compare " + (sides / "actual/a.png").string() + " " + (sides / "expected/none.png").string());
    CHECK(missing.code == 1);
    CHECK(missing.out.find("there is no golden") != std::string::npos);
}

TEST_CASE("compare: extensions may be in capitals", "[compare]") {
    Sides sides;
    sides.both("one/A.PNG", balls());
    CHECK(sides.compare().out.find("1 pictures: 1 identical") == 0);
    const std::string picture = (sides / "actual/one/A.PNG").string();
    CHECK(run("compare " + picture + " " + (sides / "expected/none.PNG").string()).out.find("there is no golden") !=
          std::string::npos);
}

TEST_CASE("compare: pictures behind links to folders count, and no folder is entered from below itself", "[compare]") {
    Sides sides;
    sides.both("frame-00000.png", balls());
    writePicture(sides / "store/red/frame.png", flat(32, 32, {255, 0, 0}));
    writePicture(sides / "store/green/frame.png", flat(32, 32, {0, 255, 0}));
    fs::create_directory_symlink("../store/red", sides / "actual/more");
    fs::create_directory_symlink("../store/green", sides / "expected/more");
    fs::create_directory_symlink("..", sides / "store/red/around");
    CHECK(sides.compare().code == 1);
    const auto results = sides.results();
    CHECK(results.at("more/frame.png").at("status") == "different");
    CHECK(results.at("more/around/green/frame.png").at("status") == "extra");
    fs::create_directory_symlink("nowhere", sides / "actual/nowhere.png");
    CHECK(sides.results()["nowhere.png"]["status"] == "unreadable");
    CHECK(sides.compare().code == 2);
}

TEST_CASE("compare: what may be a picture and cannot be read is trouble, and the others are still compared",
          "[compare]") {
    Sides sides;
    sides.both("a.png", balls());
    sides.both("b.png", balls());
    sides.both(".hidden.png", balls());
    sides.expected("z.png", blank(balls()));
    sides.actual("z.png", balls());
    // One changed bit among the compressed pixels.
    auto bytes = tools::readFile(sides / "expected/b.png");
    bytes[bytes.size() / 2] ^= 1U;
    tools::writeFile(sides / "expected/b.png", bytes);
    tools::writeFile(sides / "actual/photo.JPG", std::string("Exif"));
    fs::create_directory_symlink("nowhere", sides / "actual/more");
    auto results = sides.results();
    CHECK(results["a.png"]["status"] == "identical");
    CHECK(results[".hidden.png"]["status"] == "identical");
    CHECK(results["z.png"]["status"] == "different");
    for (const char* name : {"b.png", "photo.JPG", "more"}) CHECK(results[name]["status"] == "unreadable");
    CHECK(results["b.png"]["reasons"].size() == 1);
    CHECK(results["done"]["unreadable"] == 3);
    CHECK(sides.compare("--quiet --report " + (sides / "actual/report").string()).code == 2);
    CHECK(fs::exists(sides / "actual/report/index-files"));
    CHECK(sides.results()["done"]["pictures"] == 6);  // pictures of a report do not count
    const auto outcome = sides.compare("--junit " + (sides / "junit.xml").string());
    CHECK(outcome.code == 2);
    CHECK(outcome.out.find("b.png: unreadable\n  expected picture: cannot read " + (sides / "expected/b.png").string() +
                           " as PNG: it is damaged: a checksum does not match\n") != std::string::npos);
    CHECK(outcome.out.find("more: unreadable\n  actual picture: ") != std::string::npos);
    CHECK(program::textOf(sides / "junit.xml").find("failures=\"1\" errors=\"3\"") != std::string::npos);
}

TEST_CASE("compare: names that differ in Unicode's form alone are pointed out", "[compare]") {
    CHECK(tools::differInUnicodeForm("\u00e9.png", "e\u0301.png"));
    CHECK(tools::differInUnicodeForm("e\u0301a\u0308.png", "\u00e9a\u0308.png"));
    CHECK(tools::differInUnicodeForm("\u1ebf", "\u00ea\u0301"));
    CHECK(tools::differInUnicodeForm("\uac01", "\u1100\u1161\u11a8"));
    CHECK_FALSE(tools::differInUnicodeForm("\u00e9", "\u00e9"));
    CHECK_FALSE(tools::differInUnicodeForm("\u00e9", "e"));
    CHECK_FALSE(tools::differInUnicodeForm("\u00e9", "e\u0301x"));
    CHECK_FALSE(tools::differInUnicodeForm("e\u0301", "ex"));
    CHECK_FALSE(tools::differInUnicodeForm("\xff", "e\u0301"));
    Sides sides;
    sides.actual("\u00e9.png", balls());
    sides.expected("e\u0301.png", balls());
    const auto outcome = sides.compare();
    CHECK(outcome.code == 1);
    CHECK(outcome.out.find("approve it, or remove it; the name of " + (sides / "expected/e\u0301.png").string() +
                           " looks the same") != std::string::npos);
    CHECK(outcome.out.find("; the name of " + (sides / "actual/\u00e9.png").string() + " looks the same") !=
          std::string::npos);
}

TEST_CASE("compare: the command that it prints works as it stands", "[compare]") {
    const auto approve = [](const program::Outcome& compared) {
        const std::string before = "to approve: globular ";
        const std::size_t begin = compared.out.find(before);
        REQUIRE(begin != std::string::npos);
        const std::string line = compared.out.substr(begin + before.size());
        return run(line.substr(0, line.find('\n')));
    };
    Sides sides;
    sides.actual("-front.png", balls());
    CHECK(approve(sides.compare()).code == 0);
    CHECK(sides.compare().code == 0);
    const std::string pair =
        "compare " + (sides / "actual/-front.png").string() + " " + (sides / "single.png").string();
    CHECK(approve(run(pair)).code == 0);
    CHECK(run(pair).code == 0);
}

TEST_CASE("compare: a signal ends it at once, and ffmpeg with it", "[compare]") {
    Sides sides;
    tools::createFolder(sides / "tmp");
    for (const char* file : {"a.mp4", "b.mp4"}) tools::writeFile(sides / file, std::string("film"));
    const fs::path pid = sides / "pid";
    tools::writeFile(sides / "ffmpeg", "#!/bin/sh\necho $$ > " + pid.string() + "\nexec sleep 100\n");
    fs::permissions(sides / "ffmpeg", fs::perms::owner_all);
    for (const auto& [signal, number] : {std::pair{"TERM", 15}, {"HUP", 1}}) {
        fs::remove(pid);
        const auto outcome = program::shell(
            "export TMPDIR=" + (sides / "tmp").string() + "; PATH=" + (sides / "").string() +
            ":$PATH " GLOBULAR_PROGRAM " compare " + (sides / "a.mp4").string() + " " + (sides / "b.mp4").string() +
            " & child=$!; until [ -s " + pid.string() + " ]; do sleep 0.02; done; kill -" + signal +
            " $child; wait $child; code=$?; if kill -0 $(cat " + pid.string() + "); then exit 99; fi; exit $code");
        INFO(outcome.out << outcome.err);
        CHECK(outcome.code == 128 + number);
        CHECK(fs::is_empty(sides / "tmp"));
    }
}

TEST_CASE("compare: missing, extra, unreadable and differently sized pictures have statuses of their own",
          "[compare]") {
    Sides sides;
    sides.both("frame-00000.png", balls());
    sides.actual("extra.png", balls());
    const auto extra = sides.compare();
    CHECK(extra.code == 1);
    CHECK(extra.out.find("extra.png: extra\n") == 0);
    fs::remove(sides / "actual/extra.png");
    sides.expected("missing.png", balls());
    CHECK(sides.compare().code == 1);
    sides.actual("size.png", balls(90, 160));
    sides.expected("size.png", balls());
    CHECK(sides.compare().code == 1);
    sides.actual("extra.png", balls());
    sides.both("broken.png", balls());
    auto bytes = tools::readFile(sides / "actual/broken.png");
    bytes.resize(bytes.size() / 2);
    tools::writeFile(sides / "actual/broken.png", bytes);
    CHECK(sides.compare().code == 2);

    auto results = sides.results();
    REQUIRE(results.size() == 6);
    CHECK(results["frame-00000.png"]["status"] == "identical");
    CHECK(results["extra.png"]["status"] == "extra");
    CHECK(results["missing.png"]["status"] == "missing");
    CHECK(results["broken.png"]["status"] == "unreadable");
    CHECK(results["broken.png"]["reasons"][0].get<std::string>().find("actual/broken.png as PNG") != std::string::npos);
    CHECK(results["size.png"]["rule"] == "size");
    CHECK(results["done"]["pictures"] == 5);
    for (const char* count : {"identical", "different", "missing", "extra", "unreadable"})
        CHECK(results["done"][count] == 1);
    const std::string approval = results["done"]["approve"];
    CHECK(approval == "globular approve " + (sides / "actual").string() + " " + (sides / "expected").string() +
                          " extra.png size.png");
}

TEST_CASE("compare: each threshold can be set, and a mask given", "[compare]") {
    Sides sides;
    sides.actual("a.png", noisy(balls(), 4));
    sides.expected("a.png", balls());
    CHECK(sides.results()["a.png"]["rule"] == "share");
    CHECK(sides.results("--threshold 4")["a.png"]["rule"] == "mean");
    CHECK(sides.results("--max-share 100")["a.png"]["rule"] == "mean");
    CHECK(sides.results("--max-share 100 --max-mean 3")["a.png"]["rule"] == "within-limits");
    CHECK(sides.results("--max-share 100 --max-mean 3 --min-ssim 0.9999")["a.png"]["rule"] == "ssim");
    CHECK(sides.results("--max-difference 3")["a.png"]["rule"] == "largest");
    CHECK(sides.compare("--max-share 101").code == 2);

    sides.actual("a.png", onePixel(balls(), 30, 40, 99));
    render::Image mask = flat(160, 90, {255, 255, 255});
    const std::string file = (sides / "mask.png").string();
    writePicture(file, mask);
    CHECK(sides.compare("--mask " + file).code == 1);
    std::fill_n(mask.rgb.begin() + 3 * (40 * 160 + 30), 3, std::uint8_t{0});
    writePicture(file, mask);
    CHECK(sides.compare("--profile strict --mask " + file).code == 0);
    writePicture(file, balls(32, 32));
    const auto wrong = sides.compare("--mask " + file);
    CHECK(wrong.code == 2);
    CHECK(wrong.err.find("error: the mask is 32x32") == 0);
    writePicture(file, blank(mask));
    CHECK(sides.compare("--mask " + file).code == 2);
}

TEST_CASE("compare: the state's hash tells whether the simulation or the renderer changed", "[compare]") {
    Sides sides;
    sides.actual("frame-00007.png", darker(balls(), 0.5));
    sides.expected("frame-00007.png", balls());
    const auto result = [&] { return sides.results()["frame-00007.png"]; };
    CHECK(result()["changed"] == "unknown");
    writeManifest(sides / "actual", "1111111111111111");
    CHECK(result()["changed"] == "unknown");
    CHECK(result()["explanation"].get<std::string>().find("the expected picture's state is not recorded") !=
          std::string::npos);
    writeManifest(sides / "expected", "1111111111111111", {.renderer = "another"});
    CHECK(result()["changed"] == "renderer");
    CHECK(result()["explanation"].get<std::string>().find("GL renderer llvmpipe (test) instead of another") !=
          std::string::npos);
    writeManifest(sides / "expected", "2222222222222222");
    CHECK(result()["changed"] == "simulation");
    CHECK(result()["actual"]["state_hash"] == "1111111111111111");
    CHECK(result()["expected"]["state_hash"] == "2222222222222222");

    // A manifest that describes other bytes does not count for these.
    sides.actual("frame-00007.png", darker(balls(), 0.6));
    CHECK(result()["changed"] == "unknown");
    CHECK(result()["explanation"].get<std::string>().find("manifest.json is about another picture") !=
          std::string::npos);

    // The same picture of another state passes, with an explanation.
    sides.actual("frame-00007.png", balls());
    writeManifest(sides / "actual", "1111111111111111");
    CHECK(result()["status"] == "identical");
    CHECK(result()["changed"] == "simulation");
    const auto said = sides.compare();
    CHECK(said.code == 0);
    CHECK(said.out.find("the simulation changed: state 1111111111111111 instead of 2222222222222222") !=
          std::string::npos);

    // Pictures of versions that copied what the CPU drew through OpenGL.
    tools::writeFile(sides / "actual/frame-00007.json",
                     "{\"png\": \"" + tools::checksumOf(tools::readFile(sides / "actual/frame-00007.png")) +
                         "\", \"gl_renderer\": \"llvmpipe\"}");
    CHECK(result()["actual"]["renderer"] == "cpu");
    CHECK_FALSE(result()["actual"].contains("gl_renderer"));
    fs::remove(sides / "actual/frame-00007.json");

    tools::writeFile(sides / "actual/manifest.json", std::string("{\"frames\": {\"00007\": 3}"));
    tools::writeFile(sides / "actual/run.json",
                     std::string("{\"scene_hash\": \"abc\", \"gl_renderer\": null, \"version\": 3}"));
    CHECK(result()["actual"]["scene_hash"] == "abc");
    CHECK_FALSE(result()["actual"].contains("gl_renderer"));
}

TEST_CASE("compare: pictures that one OpenGL driver drew must be the same bytes", "[compare]") {
    Sides sides;
    sides.actual("frame-00007.png", onePixel(balls(), 30, 40, 2));  // within the limits of vendor
    sides.expected("frame-00007.png", balls());
    const auto status = [&] { return sides.results()["frame-00007.png"]["status"]; };
    CHECK(status() == "within-limits");
    writeManifest(sides / "actual", "1111111111111111");
    CHECK(status() == "within-limits");
    writeManifest(sides / "expected", "1111111111111111");
    CHECK(status() == "different");
    CHECK(sides.compare().out.find("one driver drew both: OpenGL (llvmpipe (test), 4.5 Mesa (test))") !=
          std::string::npos);
    for (const char* own : {"--profile vendor", "--profile renderer", "--max-difference 3 --max-share 1 --max-mean 1"})
        CHECK(sides.compare(own).code == 0);
    CHECK(sides.compare("--max-difference 1").code == 1);
    using golden_files::RunFacts;
    for (const RunFacts& other : {RunFacts{.renderer = "another"}, RunFacts{.driver = "4.6"}, RunFacts{.driver = ""},
                                  RunFacts{.drawnBy = "cpu", .renderer = "", .driver = ""}}) {
        writeManifest(sides / "expected", "1111111111111111", other);
        CHECK(status() == "within-limits");
    }
    writeManifest(sides / "actual", "1111111111111111", {.drawnBy = "cpu", .renderer = "", .driver = ""});
    CHECK(status() == "within-limits");
}

TEST_CASE("compare: pictures with transparency or 16 bits a channel are refused", "[compare]") {
    Sides sides;
    const auto made = [&](const std::string& source, const std::string& format, const std::string& name) {
        const std::string command = "ffmpeg -loglevel error -nostdin -f lavfi -i " + source + " -frames:v 1 -pix_fmt " +
                                    format + " " + (sides / name).string();
        REQUIRE(program::shell(command).code == 0);
        return run("compare " + (sides / name).string() + " " + (sides / name).string());
    };
    CHECK(made("color=red@0.5:s=16x16,format=rgba", "rgba", "half.png").out.find("transparent") != std::string::npos);
    CHECK(made("color=red:s=16x16", "rgb48be", "deep.png").out.find("16 bits") != std::string::npos);
    CHECK(made("color=red:s=16x16,format=rgba", "rgba", "opaque.png").code == 0);
    tools::writeFile(sides / "text.png", std::string("no picture at all"));
    CHECK(run("compare " + (sides / "text.png").string() + " " + (sides / "text.png").string())
              .out.find("it is not a PNG file") != std::string::npos);
}

TEST_CASE("compare: exit code 2 if nothing can be concluded", "[compare]") {
    Sides sides;
    sides.both("a.png", noisy(balls(), 1));
    CHECK(sides.compare("--max-mean nan").code == 2);
    CHECK(sides.compare("--min-ssim nan").code == 2);
    CHECK(sides.compare("--max-share -1").code == 2);
    CHECK(
        run("compare " + (sides / "actual").string() + " " + (sides / "expected").string() + " >/dev/full 2>/dev/null")
            .code == 2);
    for (int k = 0; k < 20; ++k)
        sides.actual("film/frame-" + std::string(k < 10 ? "0000" : "000") + std::to_string(k) + ".png",
                     noisy(balls(), k));
    REQUIRE(run("video " + (sides / "actual/film").string() + " --quiet -o " + (sides / "a.mp4").string()).code == 0);
    fs::copy(sides / "a.mp4", sides / "short.mp4");
    fs::resize_file(sides / "short.mp4", fs::file_size(sides / "a.mp4") / 2);
    const auto cut = run("compare " + (sides / "short.mp4").string() + " " + (sides / "a.mp4").string());
    INFO(cut.out << cut.err);
    CHECK(cut.code == 2);
    CHECK(cut.err.find("short.mp4") != std::string::npos);
}
