// Tests the edit distance, and the suggestion of a known name for a mistyped one.
#include "tests/catch.h"

#include "scenes/text/edit_distance.h"

using scenes::editDistance;
using scenes::nearestName;

TEST_CASE("the edit distance counts insertions, deletions, replacements and swaps") {
    CHECK(editDistance("", "") == 0);
    CHECK(editDistance("abc", "") == 3);
    CHECK(editDistance("", "abc") == 3);
    CHECK(editDistance("gravty", "gravity") == 1);
    CHECK(editDistance("kitten", "sitting") == 3);
    CHECK(editDistance("raduis", "radius") == 1);
    CHECK(editDistance("ab", "ba") == 1);
    CHECK(editDistance("sunday", "saturday") == 3);
}

TEST_CASE("the edit distance is symmetric") {
    for (const char* a : {"drag", "spacing", "fov", "", "center"})
        for (const char* b : {"dragg", "sapcing", "fvo", "center", "x"})
            CHECK(editDistance(a, b) == editDistance(b, a));
}

TEST_CASE("only a close name is suggested, the first of equals") {
    const std::vector<std::string> known = {"gravity", "drag", "step", "fov", "stop"};
    CHECK(nearestName("gravty", known) == "gravity");
    CHECK(nearestName("darg", known) == "drag");
    CHECK(nearestName("stip", known) == "step");
    CHECK(nearestName("temperature", known) == "");
    CHECK(nearestName("", known) == "");
    CHECK(nearestName(std::string(100000, 'x'), known) == "");
    CHECK(nearestName("x", {"y"}) == "");
}
