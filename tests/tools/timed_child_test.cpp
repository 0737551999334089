// Work in a child process: what it reports arrives, and it ends when its time is up.
#include "tools/system/timed_child.h"

#include <chrono>
#include <csignal>
#include <stdexcept>

#include "render/picture/system_error.h"
#include "tests/catch.h"

TEST_CASE("What a child process reports arrives", "[tools]") {
    const tools::Json json = tools::runInChild(60, [](const tools::Report& report) {
        report({{"a", 1}, {"b", "first"}});
        report({{"b", "\xff second\n"}});
    });
    CHECK(json == tools::Json{{"a", 1}, {"b", "\xef\xbf\xbd second\n"}});
}

TEST_CASE("A child process that never ends is ended, and what it has reported is kept", "[tools]") {
    const auto start = std::chrono::steady_clock::now();
    const tools::Json json = tools::runInChild(1, [](const tools::Report& report) {
        report({{"a", 1}});
        for (volatile bool forever = true; forever;) {
        }
    });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    CHECK(json == tools::Json{{"a", 1}});
    CHECK(seconds > 0.9);   // the alarm counts whole seconds, from at most 0.1 s later
    CHECK(seconds < 10.0);  // on a machine with other work
}

TEST_CASE("Failures of a child process are failures of the caller", "[tools]") {
    CHECK_THROWS_AS(tools::runInChild(60, [](const tools::Report&) { throw std::runtime_error("no luck"); }),
                    render::SystemError);
    CHECK_THROWS_WITH(tools::runInChild(60, [](const tools::Report&) { throw std::runtime_error("no luck"); }),
                      "no luck");
    CHECK_THROWS_WITH(tools::runInChild(60, [](const tools::Report&) { std::raise(SIGKILL); }),
                      "the process that tries the scene was ended by signal 9 (Killed); is there enough memory?");
}
