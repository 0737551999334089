// Tests the studies as a user runs them, in their smallest form.
#include <fstream>

#include "tests/catch.h"
#include "tests/tools/program.h"

using program::run;

namespace {

namespace fs = std::filesystem;

std::string commandOn(const program::Folder& folder) {
    std::ofstream(folder / "pair.toml") << "title = \"two <particles>\"\nduration = 1\nfps = 30\n"
                                           "[physics]\nstepper = \"auto\"\nerror = 0.05\n"
                                           "[material]\npreset = \"liquid\"\n"
                                           "[[body]]\nshape = \"grid\"\ncenter = [0, 0, 0]\ncounts = [2, 1, 1]\n"
                                           "spacing = 0.2\n";
    return "study accuracy " + (folder / "pair.toml").string() + " --quick --threads 1 -o " +
           (folder / "study").string();
}

}  // namespace

TEST_CASE("A study writes tables, plots and a page that stands alone", "[tools]") {
    const program::Folder folder;
    const auto outcome = run(commandOn(folder));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.find("pair: reference ") != std::string::npos);
    for (const char* name : {"accuracy.csv", "orders.csv", "auto.csv", "references.csv"})
        CHECK(program::lineCount(program::textOf(folder / "study" / name)) >= 2);
    // The error that the scene asks for is among those of the study.
    CHECK(program::textOf(folder / "study" / "auto.csv").find("\npair,0.05,") != std::string::npos);
    for (const char* name : {"pair-seconds.svg", "pair-evaluations.svg"}) {
        const std::string svg = program::textOf(folder / "study" / name);
        CHECK(svg.rfind("<?xml", 0) == 0);
        CHECK(svg.find("velocity-verlet") != std::string::npos);
    }
    const std::string page = program::textOf(folder / "study" / "index.html");
    CHECK(page.find("two &lt;particles&gt;") != std::string::npos);
    CHECK(page.find("src=\"data:image/svg+xml;base64,") != std::string::npos);
    CHECK(page.find("pair.toml --quick --threads 1") != std::string::npos);
}

TEST_CASE("A study of whole scenes writes its tables and a page with a sentence to quote", "[tools]") {
    const program::Folder folder;
    const auto outcome = run(commandOn(folder) + " --whole");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    for (const char* name : {"whole.csv", "whole_steppers.csv", "whole_windows.csv", "whole_ladder.csv"})
        CHECK(program::lineCount(program::textOf(folder / "study" / name)) >= 2);
    const std::string page = program::textOf(folder / "study" / "index.html");
    CHECK(page.find("its trial runs included, the automatic stepper spends at most") != std::string::npos);
    CHECK(page.find("accuracy --whole") != std::string::npos);
    CHECK(run(commandOn(folder) + " --whole --from 1").code == 2);
}

TEST_CASE("Without gnuplot the tables are there and the message names the package", "[tools]") {
    const program::Folder folder;
    const auto outcome = run(commandOn(folder) + " --quiet", "PATH=/nonexistent");
    CHECK(outcome.code == 1);
    CHECK(outcome.out == "");
    CHECK(program::lineCount(outcome.err) == 1);
    CHECK(outcome.err.find("gnuplot-nox") != std::string::npos);
    CHECK(fs::exists(folder / "study" / "accuracy.csv"));
    CHECK_FALSE(fs::exists(folder / "study" / "index.html"));
}

TEST_CASE("A study of two scenes of one name is refused", "[tools]") {
    const auto outcome = run("study accuracy liquid liquid -o /nonexistent/study");
    CHECK(outcome.code != 0);
    const program::Folder folder;
    const auto twice = run("study accuracy liquid liquid -o " + (folder / "study").string());
    CHECK(twice.code == 2);
    CHECK(twice.err.find("two scenes would share its files") != std::string::npos);
}

TEST_CASE("Windows that never end, or hold no frame, are refused", "[tools]") {
    const program::Folder folder;
    for (const char* window : {"liquid:inf", "liquid:1e12", "liquid --window 1e300", "liquid --from 1e300"}) {
        const auto outcome = run("study accuracy " + std::string(window) + " -o " + (folder / "study").string());
        INFO(window);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find("beyond the 100000 frames") != std::string::npos);
    }
    const auto outcome = run("study accuracy liquid:0.001 -o " + (folder / "study").string());
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("shorter than a frame") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "study"));
}

TEST_CASE("The study of scaling writes tables, a plot and a page, and says when a peer is missing", "[tools]") {
    const program::Folder folder;
    std::filesystem::create_directory(folder / "bin");
    std::filesystem::create_symlink("/usr/bin/gnuplot", folder / "bin" / "gnuplot");
    const std::string command = "study scaling --quick --threads 1 --peer lammps -o " + (folder / "scaling").string();
    const auto outcome = run(command, "PATH=" + (folder / "bin").string());
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.find("install LAMMPS: Debian's package lammps") != std::string::npos);
    const std::string table = program::textOf(folder / "scaling" / "scaling.csv");
    CHECK(program::lineCount(table) ==
          1 + 4 + 3 * 3);  // the head, a row of Table 2 for each figure, three cubes for each material
    CHECK(table.find("paper/figure-1,100,") != std::string::npos);
    CHECK(table.find("powder,32000,") != std::string::npos);
    CHECK(program::textOf(folder / "scaling" / "exponents.csv").find("solid,list,10000,32000,") != std::string::npos);
    CHECK(program::textOf(folder / "scaling" / "scaling.svg").rfind("<?xml", 0) == 0);
    CHECK(program::textOf(folder / "scaling" / "index.html").find("data:image/svg+xml;base64,") != std::string::npos);
    CHECK(run("study scaling --peer gromacs").code == 2);
}

TEST_CASE("A study of pictures that is interrupted leaves the rows that it has reported", "[tools]") {
    const program::Folder folder;
    const std::string table = (folder / "pictures" / "pictures.csv").string();
    const std::string study = "exec " GLOBULAR_PROGRAM
                              " study pictures --quick --particles 100 200 --size 256x144 --threads 1 -o " +
                              (folder / "pictures").string() + " 2>&1 >/dev/null";
    const auto outcome = program::shell("sh -c 'echo $$; " + study + "' | (read study; grep -q -m1 spheres; cat " +
                                        table + "; kill $study)");
    INFO(outcome.out);
    REQUIRE(outcome.code == 0);
    CHECK(program::lineCount(outcome.out) >= 2);  // the head and the row that was reported
    CHECK(program::lineCount(outcome.out) < 1 + 2 * 2 * 3);
    CHECK(outcome.out.find("spheres,100,256,144,draft,cpu,") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "pictures" / "index.html"));
}

TEST_CASE("The study of pictures writes its table, plots and a page, and leaves no video behind", "[tools]") {
    const program::Folder folder;
    const std::string command = "study pictures --particles 100 --size 256x144 --quick --threads 1";
    const auto outcome = run(command + " -o " + (folder / "pictures").string());
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
#ifdef RENDER_HAS_OPENGL
    constexpr int kRenderers = 2;
    CHECK(outcome.out.find("\nOpenGL is ") != std::string::npos);
#else
    constexpr int kRenderers = 1;
    CHECK(program::lineCount(outcome.err) == 1 + 6);  // the warning and the rows
    CHECK(outcome.err.find("built without OpenGL; the renderer on the CPU is measured alone\n") != std::string::npos);
#endif
    CHECK(program::lineCount(program::textOf(folder / "pictures" / "pictures.csv")) ==
          1 + 2 * 3 * kRenderers);  // the head; two styles, three qualities
    for (const char* name : {"times.svg", "errors.svg"})
        CHECK(program::textOf(folder / "pictures" / name).rfind("<?xml", 0) == 0);
    CHECK(program::textOf(folder / "pictures" / "index.html").find(command) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "pictures" / ".timing.mp4"));
    CHECK(run("study pictures --size 100x100 -o /nonexistent/pictures").code == 2);
    CHECK(run("study pictures --particles 3 -o /nonexistent/pictures").code == 2);
    CHECK(run("study pictures --gl vulkan -o /nonexistent/pictures").code == 2);
    const auto elsewhere = run("study pictures --gl egl:4711 -o /nonexistent/pictures");
    CHECK(elsewhere.code == 1);
    CHECK(elsewhere.err.find("error: OpenGL on egl:4711 cannot be used: ") == 0);
}
