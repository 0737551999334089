// Tests the writing of files, base64, lines for a shell, tables and lists of frames.
#include <sys/stat.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tests/catch.h"
#include "tests/tools/program.h"
#include "tools/frames/frame_list.h"
#include "tools/pages/html.h"
#include "tools/system/output_file.h"
#include "tools/system/text.h"

namespace {

namespace fs = std::filesystem;

long entryCount(const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

}  // namespace

TEST_CASE("A file is written whole, and no temporary file is left", "[tools]") {
    const program::Folder folder;
    tools::writeFile(folder / "a.txt", std::string("first"));
    tools::writeFile(folder / "a.txt", std::string("second"));
    CHECK(program::textOf(folder / "a.txt") == "second");
    CHECK(entryCount(folder / "") == 1);
    const auto bytes = tools::readFile(folder / "a.txt");
    CHECK(std::string(bytes.begin(), bytes.end()) == "second");
}

TEST_CASE("A file that cannot be written names itself and the reason, and leaves what was there", "[tools]") {
    const program::Folder folder;
    tools::createFolder(folder / "taken");
    tools::writeFile(folder / "taken/inside", std::string("kept"));
    // A folder of the same name cannot be replaced by a file.
    CHECK_THROWS_AS(tools::writeFile(folder / "taken", std::string("x")), render::SystemError);
    CHECK(program::textOf(folder / "taken/inside") == "kept");
    CHECK(entryCount(folder / "") == 1);
    try {
        tools::writeFile(folder / "missing/a.txt", std::string("x"));
        FAIL("wrote into a folder that does not exist");
    } catch (const render::SystemError& error) {
        CHECK(std::string(error.what()).find("missing") != std::string::npos);
        CHECK(std::string(error.what()).find("No such file or directory") != std::string::npos);
    }
    CHECK_THROWS_AS(tools::readFile(folder / "nothing"), render::SystemError);
}

TEST_CASE("A link that was put where a temporary file might be is not followed", "[tools]") {
    const program::Folder folder;
    std::ofstream(folder / "victim.txt") << "untouched";
    for (const char* name : {".a.txt.partial", ".a.txt", "a.txt.partial"})
        fs::create_symlink("victim.txt", folder / name);
    tools::writeFile(folder / "a.txt", std::string("new"));
    CHECK(program::textOf(folder / "victim.txt") == "untouched");
    CHECK(program::textOf(folder / "a.txt") == "new");
    CHECK(fs::symlink_status(folder / "a.txt").type() == fs::file_type::regular);
}

TEST_CASE("Writers of one file all succeed, and the file is that of one of them", "[tools]") {
    const program::Folder folder;
    constexpr std::size_t kSize = 200000;  // many writes of a page
    std::atomic<int> failures = 0;
    std::vector<std::thread> writers;
    for (const char letter : {'a', 'b', 'c', 'd'})
        writers.emplace_back([&, letter] {
            for (int k = 0; k < 25; ++k) {
                try {
                    tools::writeFile(folder / "a.txt", std::string(kSize, letter));
                } catch (const render::SystemError&) {
                    ++failures;
                }
                const std::string text = program::textOf(folder / "a.txt");
                if (text != std::string(kSize, text.front())) ++failures;
            }
        });
    for (std::thread& writer : writers) writer.join();
    CHECK(failures == 0);
    CHECK(entryCount(folder / "") == 1);
}

TEST_CASE("A file keeps the permissions of the one it replaces, and a new one those of any new file", "[tools]") {
    const program::Folder folder;
    const auto modeOf = [&](const char* name) {
        return static_cast<unsigned>(fs::status(folder / name).permissions() & fs::perms::mask);
    };
    const mode_t umask = ::umask(027);
    tools::writeFile(folder / "a.txt", std::string("x"));
    CHECK(modeOf("a.txt") == 0640);
    for (const unsigned mode : {0600U, 0666U, 0444U}) {
        fs::permissions(folder / "a.txt", static_cast<fs::perms>(mode));
        tools::writeFile(folder / "a.txt", std::string("y"));
        CHECK(modeOf("a.txt") == mode);
    }
    ::umask(umask);
}

TEST_CASE("Names may have up to 255 bytes", "[tools]") {
    const program::Folder folder;
    std::string umlauts;
    while (umlauts.size() < 254) umlauts += "\xC3\xA4";
    for (const std::string& name : {std::string(250, 'n'), std::string(255, 'n'), umlauts}) {
        tools::writeFile(folder / name, name);
        CHECK(program::textOf(folder / name) == name);
    }
    CHECK_THROWS_AS(tools::writeFile(folder / std::string(256, 'n'), std::string("x")), render::SystemError);
    CHECK(entryCount(folder / "") == 3);
}

TEST_CASE("What a link leads to is replaced, a device or a pipe is not", "[tools]") {
    const program::Folder folder;
    tools::createFolder(folder / "else");
    fs::create_symlink("else/target.txt", folder / "link");  // does not exist yet
    for (const char* text : {"first", "second"}) {
        tools::writeFile(folder / "link", std::string(text));
        CHECK(fs::is_symlink(folder / "link"));
        CHECK(program::textOf(folder / "else/target.txt") == text);
    }
    fs::create_symlink("circle", folder / "circle");
    CHECK_THROWS_AS(tools::writeFile(folder / "circle", std::string("x")), render::SystemError);
    REQUIRE(::mkfifo((folder / "pipe.mp4").c_str(), 0600) == 0);
    CHECK_THROWS_AS(tools::writeFile(folder / "pipe.mp4", std::string("x")), render::SystemError);
    CHECK(fs::is_fifo(folder / "pipe.mp4"));
    const auto video = program::run("render measured/fountain --size 64x36 --frames 0 --quiet -o " + (folder / "a").string() +
                                    " --video " + (folder / "pipe.mp4").string());
    CHECK(video.code == 1);
    CHECK(video.err.find("a file is wanted") != std::string::npos);
    CHECK(fs::is_fifo(folder / "pipe.mp4"));
}

TEST_CASE("What is printed has no control characters but line ends and tabs", "[tools]") {
    CHECK(tools::printable("plain \xC3\xA4\n\ttext \xE2\x82\xAC") == "plain \xC3\xA4\n\ttext \xE2\x82\xAC");
    CHECK(tools::printable("\x1B[2J\r\x07\x7F") == "\\u001b[2J\\u000d\\u0007\\u007f");
    CHECK(tools::printable("\xC2\x9B"
                           "2J \xC2\xA0 \xC2") == "\\u009b2J \xC2\xA0 \xC2");
    const program::Folder folder;
    std::ofstream(folder / "a.toml") << "title = \"\\u001b[31mred\\u009b0m\"\nduration = 1\n\"\\u001b[2J\" = 1\n"
                                        "[[body]]\nshape = \"points\"\npositions = [[0, 0, 0]]\n";
    fs::copy_file(folder / "a.toml", folder / "\x1B[2J.toml");
    for (const char* name : {"a.toml", "\x1B[2J.toml", "\x1B[2J"})
        for (const char* format : {"", " --json"}) {
            const auto outcome = program::run("check '" + (folder / name).string() + "'" + format);
            CHECK(outcome.code == 2);
            CHECK((outcome.out + outcome.err).find('\x1B') == std::string::npos);
        }
    std::ofstream(folder / "b.toml") << "title = \"\\u001b[31mred\\u009b0m\"\nduration = 1\n"
                                        "[[body]]\nshape = \"points\"\npositions = [[0, 0, 0]]\n";
    for (const char* format : {"", " --json"}) {
        const auto outcome = program::run("check '" + (folder / "b.toml").string() + "'" + format);
        CHECK(outcome.code == 0);
        CHECK(outcome.out.find("\\u001b[31mred\\u009b0m") != std::string::npos);
        CHECK(outcome.out.find('\x1B') == std::string::npos);
        CHECK(outcome.out.find('\x9B') == std::string::npos);
    }
}

TEST_CASE("Base64 as in RFC 4648, section 10", "[tools]") {
    const auto encode = [](const std::string& text) { return tools::base64({text.begin(), text.end()}); };
    CHECK(encode("") == "");
    CHECK(encode("f") == "Zg==");
    CHECK(encode("fo") == "Zm8=");
    CHECK(encode("foo") == "Zm9v");
    CHECK(encode("foob") == "Zm9vYg==");
    CHECK(encode("fooba") == "Zm9vYmE=");
    CHECK(encode("foobar") == "Zm9vYmFy");
    CHECK(tools::base64({0xFF, 0xFE, 0xFD}) == "//79");
}

TEST_CASE("A shell reads the words of a quoted line back", "[tools]") {
    const std::vector<std::string> words = {"plain-1.png",           "",         "two words", "it's",
                                            "$HOME `ls` \"x\" \\ *", "a;b&c|d>e"};
    std::vector<std::string> command = {"printf", "<%s>"};
    command.insert(command.end(), words.begin(), words.end());
    const auto printed = program::shell(tools::shellLine(command));
    REQUIRE(printed.code == 0);
    CHECK(printed.out == "<plain-1.png><><two words><it's><$HOME `ls` \"x\" \\ *><a;b&c|d>e>");
    CHECK(tools::shellLine({"globular", "approve", "out/a", "golden/a"}) == "globular approve out/a golden/a");
}

TEST_CASE("Tables are aligned, and CSV files are read into tables", "[tools]") {
    const tools::Table table{{"name", "count"}, {{"a", "1000000"}, {"longer", "2"}}};
    CHECK(tools::textTable(table) ==
          "name      count\n"
          "a       1000000\n"
          "longer        2\n");
    const tools::Table read = tools::parseCsv("scene,step_s,text\nliquid,0.1,\"a, \"\"b\"\"\"\nsolid,,x\n", 1);
    CHECK(read.head == tools::Cells{"step s", "text"});
    REQUIRE(read.rows.size() == 2);
    CHECK(read.rows[0] == tools::Cells{"0.1", "a, \"b\""});
    CHECK(read.rows[1] == tools::Cells{"", "x"});
}

TEST_CASE("Frames are named one by one, as ranges with steps and open ends, and in lists", "[tools]") {
    using Numbers = std::vector<int>;
    const auto numbers = [](const char* text) { return tools::frameList(text, 10).numbers; };
    CHECK(numbers("") == Numbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    CHECK(numbers("3") == Numbers{3});
    CHECK(numbers("2-5") == Numbers{2, 3, 4, 5});
    CHECK(numbers("7-") == Numbers{7, 8, 9});
    CHECK(numbers("0-8:4") == Numbers{0, 4, 8});
    CHECK(numbers("1-:5") == Numbers{1, 6});
    CHECK(numbers("2-9:2147483647") == Numbers{2});
    CHECK(numbers("8,1-3,2,0-6:3") == Numbers{0, 1, 2, 3, 6, 8});
    for (const char* wrong : {"7-2", "0-10", "10-", "0,10", "a", "-1", "1-2-3", "3:2", "0-5:0", "0-5:", "0-5:-1", ",",
                              "1,", "1,,2", "0:5", "0:5-7", "1 2", "5-99999999999"})
        CHECK_THROWS_AS(tools::frameList(wrong, 10), scenes::InputError);
    CHECK(tools::frameList("1-30,47,60-90:2", 100).count() == 30 + 1 + 16);
    CHECK(numbers("1-3, 5,7-9:2") == Numbers{1, 2, 3, 5, 7, 9});
    CHECK(numbers(" 1 , 3 - 7 : 2 ") == Numbers{1, 3, 5, 7});
    CHECK(numbers("2-5,3,4-6,5") == Numbers{2, 3, 4, 5, 6});
    CHECK_THROWS_WITH(tools::frameList("0:100:10", 10),
                      "--frames 0:100:10: \"0:100:10\" is no frame and no range; write frames A, ranges A-B or A- and "
                      "every S-th frame of a range A-B:S, separated by commas, e.g. 0-119:10 or 3,7,60-");
    CHECK_THROWS_WITH(tools::frameList("3,1..8", 10),
                      "--frames 3,1..8: \"1..8\" is no frame and no range; did you mean 1-8?");
    CHECK_THROWS_WITH(tools::frameList("-1", 10),
                      "--frames -1: \"-1\" is no frame and no range; frames are counted from 0");
    CHECK_THROWS_WITH(tools::frameList("1 2", 10),
                      "--frames 1 2: \"1 2\" is no frame and no range; frames are separated by commas");
    CHECK_THROWS_WITH(tools::frameList("1,", 10), "--frames 1,: there is nothing between two commas or at an end");
    CHECK_THROWS_WITH(tools::frameList("0-5:0", 10), "--frames 0-5:0: the step of 0-5:0 is 0, must be at least 1");
    const tools::FrameList list = tools::frameList("2,5-7", 10);
    CHECK(list.indexOf(6) == 2);
    CHECK_FALSE(list.indexOf(4));
    CHECK_FALSE(list.indexOf(9));
}

TEST_CASE("A list of frames is written as --frames takes it", "[tools]") {
    using Numbers = std::vector<int>;
    CHECK(tools::listText({}).empty());
    CHECK(tools::listText({0}) == "0");
    CHECK(tools::listText({3, 4}) == "3-4");
    CHECK(tools::listText({3, 5}) == "3,5");
    CHECK(tools::listText({1, 5, 9, 13}) == "1-13:4");
    CHECK(tools::listText({1, 2, 3, 47, 60, 62, 64}) == "1-3,47,60-64:2");
    // Every set of the numbers 0 to 9 is read as it was written.
    for (unsigned set = 1; set < 1024; ++set) {
        Numbers frames;
        for (int frame = 0; frame < 10; ++frame)
            if ((set >> frame) & 1U) frames.push_back(frame);
        if (tools::frameList(tools::listText(frames), 10).numbers != frames) FAIL(tools::listText(frames));
    }
}
