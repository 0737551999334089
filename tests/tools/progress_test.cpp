// Tests the progress of runs: its line on terminals of any width, and what it says before the first frame is done.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tests/catch.h"
#include "tests/tools/program.h"
#include "tools/system/progress.h"
#include "tools/system/text.h"

using tools::fitColumns;
using tools::progressLine;

namespace {

const std::vector<std::string> kParts = {"12/400", "frame 13, 32 % of its time, steps of 2e-06 s", "1.3 frames/s",
                                         "5:00 left"};

int columnsOf(const std::string& text) {
    return fitColumns(text, 1000).columns;
}

}  // namespace

TEST_CASE("Texts are cut at the width that a terminal gives their characters", "[progress]") {
    CHECK(fitColumns("plain", 3).text == "pla");
    CHECK(fitColumns("plain", 0).text.empty());
    CHECK(fitColumns("plain", -5).text.empty());
    const std::string umlauts = "\xC3\xA4\xC3\xB6\xC3\xBC";
    CHECK(fitColumns(umlauts, 2).text == umlauts.substr(0, 4));
    CHECK(columnsOf(umlauts) == 3);
    const std::string chinese = "\xE4\xB8\xAD\xE6\x96\x87";  // two characters of two columns
    CHECK(columnsOf(chinese) == 4);
    CHECK(fitColumns(chinese, 3).text == chinese.substr(0, 3));
    CHECK(fitColumns(chinese, 3).columns == 2);
    CHECK(columnsOf("e\xCC\x81") == 1);                     // a letter and an accent above it
    CHECK(fitColumns("a\xFF\x1b[2J", 9).text == "a??[2J");  // no UTF-8, and the start of a terminal's command
}

TEST_CASE("The line of progress fits any terminal", "[progress]") {
    const std::string longName(100, 'n');
    const std::string chinese = "\xE4\xB8\xAD\xE6\x96\x87\xE4\xB8\xAD\xE6\x96\x87\xE4\xB8\xAD\xE6\x96\x87";
    for (const std::string& title : {std::string("scene"), longName, chinese, std::string()})
        for (int columns = 0; columns <= 200; ++columns) {
            const std::string line = progressLine(title, 0.3, kParts, columns);
            INFO(columns << ": " << line);
            CHECK(columnsOf(line) <= std::max(1, columns - 4));
            CHECK(line.find(kParts[0].substr(0, static_cast<std::size_t>(std::max(1, columns - 4)))) !=
                  std::string::npos);
        }
    CHECK(progressLine("scene", 0.5, {"1/2"}, 24) == "scene [####....] 1/2");
    CHECK(progressLine("scene", std::nullopt, {"3 done"}, 80) == "scene 3 done");
    CHECK(progressLine("scene", 0.5, {"1/2"}, 18) == "scene 1/2");
    CHECK(progressLine("scene", 0.5, {"1/2"}, 12) == "1/2");
    CHECK(progressLine("scene", 0.5, {"1/2", "1.3 frames/s"}, 14) == "scene 1/2");
    CHECK(progressLine("scene", 0.5, {"1/2", "1.3 frames/s"}, 6) == "1/");
}

TEST_CASE("On a terminal, frames that are not drawn count, and no line is too wide", "[progress]") {
    const program::Folder folder;
    const std::string frames = " render measured/fountain --size 64x36 --frames 60-61 --threads 1 -o " + (folder / "a").string();
    for (const int columns : {50, 15}) {
        const auto outcome = program::shell("script -qec 'stty cols " + std::to_string(columns) +
                                            "; " GLOBULAR_PROGRAM + frames + "' /dev/null </dev/null");
        INFO(outcome.out);
        REQUIRE(outcome.code == 0);
        std::istringstream text(outcome.out);
        std::vector<std::string> lines;  // of progress
        const std::string erase = "\x1b[K";
        for (std::string line; std::getline(text, line, '\r');)
            if (line.ends_with(erase)) lines.push_back(line.substr(0, line.size() - erase.size()));
        REQUIRE(lines.size() >= 2);
        for (const std::string& line : lines) CHECK(columnsOf(line) < columns);
        const auto has = [&](const std::string& words) {
            return std::any_of(lines.begin(), lines.end(),
                               [&](const std::string& line) { return line.find(words) != std::string::npos; });
        };
        CHECK(has(columns == 50 ? " of 60" : "simulating"));
        CHECK(has("2/2"));
    }
}

TEST_CASE("A comparison counts its pictures on a terminal, and its summary has a line of its own", "[progress]") {
    const program::Folder folder;
    const std::string frames = (folder / "a").string();
    REQUIRE(program::run("render measured/fountain --size 64x36 --frames 0-2 --quiet -o " + frames).code == 0);
    const auto outcome =
        program::shell("script -qec '" GLOBULAR_PROGRAM " compare " + frames + " " + frames + "' /dev/null </dev/null");
    INFO(outcome.out);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("compare 1 done\x1b[K") != std::string::npos);
    CHECK(outcome.out.find("\r\x1b[K3 pictures: 3 identical") != std::string::npos);
}
