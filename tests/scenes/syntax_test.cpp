// Tests text with syntax errors: every statement in error is reported, and what follows it is still read.
#include "tests/catch.h"

#include "scenes/text/toml_statements.h"
#include "tests/scenes/scene_text.h"

using scenes_test::kBall;
using scenes_test::kTop;
using scenes_test::Lines;
using scenes_test::problemsOf;

TEST_CASE("all syntax errors are reported at their positions") {
    CHECK(problemsOf(kBall + "[physics]\nstep = 0..1\ndrag = = 2\ngravity 3\n") ==
          Lines{"pile.toml:7:10: syntax error: floating-point: expected decimal digit or exponent, saw '.'",
                "pile.toml:8:8: syntax error: value: could not determine value type",
                "pile.toml:9:9: syntax error: key-value pair: expected '=', saw '3'"});
}

TEST_CASE("a key whose value cannot be read is not reported as missing") {
    CHECK(problemsOf("title = x\nduration = 2\n[[body]]\nshape = \"ball\"\nradius = 1\n") ==
          Lines{"pile.toml:1:9: syntax error: value: could not determine value type"});
}

TEST_CASE("values are validated after a syntax error, too") {
    CHECK(problemsOf(kBall + "[physics]\nstep = 0..1\ndrag = -1\n") ==
          Lines{"pile.toml:7:10: syntax error: floating-point: expected decimal digit or exponent, saw '.'",
                "pile.toml:8:8: drag is -1, must be >= 0 (per second)"});
}

TEST_CASE("the message for a duplicate key names the line of the first") {
    CHECK(problemsOf(kBall + "radius = 3\n") == Lines{"pile.toml:6:1: key \"radius\" is given twice, first in line 5"});
    CHECK(problemsOf(kBall + "[[body]]\nshape = \"ball\"\nradius = 3\n") == Lines{});
}

TEST_CASE("a duplicate key within a value is not taken for the key of the value") {
    const Lines lines = problemsOf(kTop + "body = [{ shape = \"ball\", shape = \"ball\", radius = 1 }]\n");
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].find("pile.toml:3:") == 0);
    CHECK(lines[0].find("\"body\" is given twice") == std::string::npos);
}

TEST_CASE("duplicate tables are reported, and their keys are not taken for those of the table before") {
    CHECK(problemsOf("[physics]\nstep = 0.1\n[look]\nshadows = false\n[physics]\ndrag = 1\n") ==
          Lines{"pile.toml: title is missing, a scene needs it",
                "pile.toml: duration is missing, a scene needs it (seconds)",
                "pile.toml: there is nothing to simulate: give a [[body]] or an [[emitter]]",
                "pile.toml:5:1: table \"physics\" is given twice, first in line 1"});
    CHECK(
        problemsOf(kBall + "[body]\nshape = \"box\"\n") ==
        Lines{"pile.toml:6:1: table \"body\" is given twice, first in line 3 (several of them are written [[body]])"});
}

TEST_CASE("a header with a syntax error keeps its keys") {
    CHECK(problemsOf(kBall + "[physics\ndrag = -1\n") ==
          Lines{"pile.toml:6:9: syntax error: table header: expected ']', saw '\\n'",
                "pile.toml:7:8: drag is -1, must be >= 0 (per second)"});
    CHECK(problemsOf(kTop + "[[body]\nshape = \"ball\"\n") ==
          Lines{"pile.toml:3:1: radius is missing, a body of shape \"ball\" needs it (meters)",
                "pile.toml:3:8: syntax error: table header: expected ']', saw '\\n'"});
}

TEST_CASE("values that are never closed are reported where they start") {
    CHECK(problemsOf(kBall + "center = [0, 0\nvelocity = [0, 0, 0]\nspacing = 0\n") ==
          Lines{"pile.toml:6:1: the value of \"center\" is never closed",
                "pile.toml:8:11: spacing is 0, must be > 0 and <= 100000000 (meters)"});
    CHECK(problemsOf("title = \"t\nduration = -2\n") ==
          Lines{"pile.toml: there is nothing to simulate: give a [[body]] or an [[emitter]]",
                "pile.toml:1:1: the value of \"title\" is never closed",
                "pile.toml:2:12: duration is -2, must be > 0 and <= 1000000 (seconds)"});
    CHECK(problemsOf(kBall + "center = [0,\n# a comment\n0,\n[physics]\ndrag = -1\n") ==
          Lines{"pile.toml:6:1: the value of \"center\" is never closed",
                "pile.toml:10:8: drag is -1, must be >= 0 (per second)"});
}

TEST_CASE("an error inside a value of many lines is reported at its line, once") {
    CHECK(problemsOf(kTop +
                     "[[body]]\nshape = \"points\"\npositions = [\n  [0, 0, 0],\n  [1,, 0, 0],\n  [2,, 0, 0],\n]\n") ==
          Lines{"pile.toml:7:6: syntax error: array: expected value or closing ']', saw comma"});
}

TEST_CASE("text without any valid statement is rejected") {
    CHECK(problemsOf("\xFF\xFE") == Lines{"pile.toml:1:1: syntax error: invalid utf-8 sequence"});
    CHECK(problemsOf("]\n").front() ==
          "pile.toml:1:1: syntax error: root table: expected keys, tables, whitespace or comments, saw ']'");
}

TEST_CASE("carriage returns and a byte order mark are accepted") {
    CHECK(problemsOf("title = \"t\"\r\nduration = 2\r\n[[body]]\r\nshape = \"ball\"\r\nradius = -1\r\n") ==
          Lines{"pile.toml:5:10: radius is -1, must be > 0 and <= 100000000 (meters)"});
    CHECK(problemsOf("\xEF\xBB\xBF" + kBall) == Lines{});
}

TEST_CASE("statements are found without parsing their values") {
    const std::vector<std::string> lines = scenes::splitLines(
        "a = 1 # [\n\n# b\n[t]\nc = [\"]\",\n 2]\n[[ u ]]\nd = '''x\n[v]\n'''\ne = \"\\\"[\"\nf = [1,\ng = 2");
    const std::vector<scenes::Statement> statements = scenes::splitStatements(lines);
    std::string found;
    for (const scenes::Statement& statement : statements)
        found += statement.name + (statement.kind == scenes::StatementKind::tableHeader ? "!" : "") +
                 std::to_string(statement.firstLine) + "-" + std::to_string(statement.lastLine) +
                 (statement.isClosed ? " " : "? ");
    CHECK(found == "a0-0 t!3-3 c4-5 u!6-6 d7-9 e10-10 f11-11? g12-12 ");
}
