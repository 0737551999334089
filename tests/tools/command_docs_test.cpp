// Tests what a user reads about the program outside its help: licenses, the man page, and what bash completes.
#include <cstdlib>

#include "tests/catch.h"
#include "tests/tools/program.h"

using program::run;
using program::textOf;

namespace {

/// What the completion offers for the last word of a command line.
std::string completed(const program::Folder& folder, const std::string& words) {
    const auto outcome =
        program::shell("bash -c 'source " + (folder / "globular.bash").string() +
                       "; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _globular; echo \"${COMPREPLY[@]}\"' "
                       "bash " GLOBULAR_PROGRAM " " +
                       words);
    CHECK(outcome.err.empty());
    return outcome.out;
}

}  // namespace

TEST_CASE("--licenses prints the licenses of the program and of what is built into it", "[docs]") {
    const auto outcome = run("--licenses");
    CHECK(outcome.code == 0);
    for (const char* file : {"LICENSE", "THIRD_PARTY.md"})
        CHECK(outcome.out.find(textOf(std::filesystem::path(GLOBULAR_SOURCE) / file)) != std::string::npos);
    CHECK(outcome.out.find("DejaVu") != std::string::npos);
}

TEST_CASE("The man page names every command and flag, and roff finds nothing wrong with it", "[docs]") {
    const program::Folder folder;
    const std::string page = (folder / "globular.1").string();
    REQUIRE(run("generate man " + page).code == 0);
    const std::string text = textOf(page);
    for (const char* words : {".SS render", ".SS devices", "\\fB\\-\\-renderer\\fR \\fI", ".SS study accuracy",
                              "\\fB\\-o, \\-\\-output\\fR \\fIDIR\\fR", "\\fB\\-\\-licenses\\fR", ".SH EXIT STATUS"}) {
        INFO(words);
        CHECK(text.find(words) != std::string::npos);
    }
    CHECK(text.find("generate") == std::string::npos);
    if (std::system("command -v groff >/dev/null") != 0) {
        WARN("skipped: there is no groff to check the man page with");
        return;
    }
    const auto checked = program::shell("groff -man -Tutf8 -ww " + page);
    CHECK(checked.err == "");
    CHECK(checked.out.find("User Commands") != std::string::npos);
}

TEST_CASE("bash completes commands, flags, values and scenes", "[docs]") {
    const program::Folder folder;
    REQUIRE(run("generate completion " + (folder / "globular.bash").string()).code == 0);
    CHECK(completed(folder, "ren") == "render\n");
    CHECK(completed(folder, "study acc") == "accuracy\n");
    CHECK(completed(folder, "gen") == "\n");
    CHECK(completed(folder, "render --qual") == "--quality\n");
    CHECK(completed(folder, "render --quality ''") == "draft normal final\n");
    CHECK(completed(folder, "render --renderer ''") == "cpu opengl\n");
    CHECK(completed(folder, "compare --profile ''") == "strict vendor renderer loose\n");
    CHECK(completed(folder, "dev") == "devices\n");
    CHECK(completed(folder, "devices --") == "--help --json\n");
    CHECK(completed(folder, "render hon") == "honey\n");
    CHECK(completed(folder, "render hard/hon") == "hard/honey hard/honey-5000\n");
    CHECK(completed(folder, "render measured/liquid --video ''") == "\n");  // bash then completes file names
    CHECK(completed(folder, "scenes hon") == "\n");
}
