// Tests `globular plot`: what is in its figures, and what it says of files that it cannot draw.
#include "tests/catch.h"
#include "tests/tools/program.h"

using program::run;
using program::textOf;

namespace {

namespace fs = std::filesystem;

constexpr const char* kLoads =
    "time_s,obstacle,force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm,"
    "impulse_x_Ns,impulse_y_Ns,impulse_z_Ns,work_J\n"
    "0.5,2,1,-2,0,0,0,0.5,0.5,-1,0,0.25\n"
    "0.5,11,0,0,0,0,0,0,0,0,0,0\n"
    "1,2,1,-1e-7,0,0,0,0.5,1,-1.00000005,0,0.5\n"
    "1,11,0,3,0,0,0,0,0,1.5,0,0\n";

/// A folder with what `plot` reads of a run.
struct Run {
    program::Folder folder;
    std::string path = (folder / "run").string();

    Run() {
        program::writeText(folder / "run/loads.csv", kLoads);
        program::writeText(folder / "run/run.json",
                           R"({"scene": "it's a \"mill\"\n$x", "obstacles": [{"obstacle": 2, "shape": "capsule"}]})");
    }
};

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("A plot names scene, obstacles, quantities and units", "[plot]") {
    const Run of;
    const auto outcome = run("plot " + of.path);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out == of.path + "/loads.svg\n");
    CHECK(outcome.err.empty());
    const std::string svg = textOf(of.folder / "run/loads.svg");
    CHECK(svg.rfind("<?xml", 0) == 0);
    CHECK(!has(svg, "Warning"));
    for (const char* text : {"it's a", "mill", "$x<", "obstacle 2 (capsule)<", "obstacle 11<", "force (N)",
                             "torque (N m)", "work (J)", "time (s)"}) {
        INFO(text);
        CHECK(has(svg, text));
    }

    const auto one = run("plot " + of.path + "/loads.csv --obstacle 11 --json -o " + of.path + "/new/one.svg");
    INFO(one.err);
    REQUIRE(one.code == 0);
    CHECK(has(one.out, R"("obstacles":[11])"));
    const std::string alone = textOf(of.folder / "run/new/one.svg");
    CHECK(has(alone, "obstacle 11<"));
    CHECK(!has(alone, "obstacle 2"));

    fs::remove(of.folder / "run/run.json");
    REQUIRE(run("plot --quiet " + of.path + " --obstacle 2,11 --obstacle 2 -o " + of.path + "/p.png").code == 0);
    CHECK(textOf(of.folder / "run/p.png").rfind("\x89PNG\r\n\x1a\n", 0) == 0);
    REQUIRE(run("plot --quiet " + of.path).code == 0);
    CHECK(has(textOf(of.folder / "run/loads.svg"), "obstacle 2<"));
}

TEST_CASE("What cannot be plotted is named, and nothing is written", "[plot]") {
    const Run of;
    const auto refused = [&](const std::string& arguments, const std::string& words, int code = 2) {
        const auto outcome = run("plot " + arguments);
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.code == code);
        CHECK(program::lineCount(outcome.err) == 1);
        CHECK(has(outcome.err, words));
    };
    refused(of.path + " --obstacle 3", "--obstacle 3: there are loads of 2, 11 alone");
    refused(of.path + " -o " + of.path + "/loads.pdf", "must end in .svg or .png");
    refused(of.path + "/nowhere", "No such file");
    fs::create_directory(of.folder / "empty");
    refused((of.folder / "empty").string(), "there is no loads.csv in it");
    fs::create_symlink(of.folder / "run/loads.csv", of.folder / "run/same.svg");
    refused(of.path + " -o " + of.path + "/same.svg", "this file is read by the same command");
    CHECK(textOf(of.folder / "run/loads.csv") == kLoads);

    const std::string head = std::string(kLoads).substr(0, std::string(kLoads).find('\n') + 1);
    program::writeText(of.folder / "run/loads.csv", head);
    refused(of.path, "it has no rows yet");
    for (const char* row :
         {"0.5,2,1\n", "0.5,2,1,-2,0,0,0,0.5,0.5,-1,0,0.25,7\n", "0.5,2,1,x,0,0,0,0.5,0.5,-1,0,0.25\n",
          "nan,2,1,1,0,0,0,0.5,0.5,-1,0,0.25\n", "0.5,1e20,1,1,0,0,0,0.5,0.5,-1,0,0.25\n"}) {
        program::writeText(of.folder / "run/loads.csv", head + row);
        refused(of.path, "loads.csv:2: this is not a row of loads");
    }
    program::writeText(of.folder / "run/loads.csv", "a,b\n1,2\n");
    refused(of.path, "loads.csv:1: this is not a loads.csv");
    CHECK(!fs::exists(of.folder / "run/loads.svg"));
}

TEST_CASE("Without gnuplot the message names the package", "[plot]") {
    const Run of;
    const auto outcome = run("plot " + of.path, "PATH=/nonexistent");
    CHECK(outcome.code == 1);
    CHECK(has(outcome.err, "gnuplot-nox"));
    CHECK(!fs::exists(of.folder / "run/loads.svg"));
}
