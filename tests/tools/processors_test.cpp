// Tests how many processors the program uses unless it is told.
#include "tests/catch.h"

#include <cmath>
#include <filesystem>

#include "tests/tools/program.h"
#include "tools/system/processors.h"

namespace fs = std::filesystem;

TEST_CASE("The quota of a control group and of the groups around it limits the processors", "[processors]") {
    const program::Folder folder;
    const fs::path self = folder / "self";
    const fs::path mounts = folder / "cgroup";
    const auto quota = [&] { return tools::processorQuota(self, mounts); };
    CHECK(std::isinf(quota()));  // no such files: not Linux's control groups

    SECTION("version 2") {
        program::writeText(self, "0::/outer/inner\n");
        CHECK(std::isinf(quota()));
        program::writeText(mounts / "outer/inner/cpu.max", "max 100000\n");
        CHECK(std::isinf(quota()));
        program::writeText(mounts / "outer/inner/cpu.max", "250000 100000\n");
        CHECK(quota() == 2.5);
        program::writeText(mounts / "outer/cpu.max", "150000 100000\n");
        CHECK(quota() == 1.5);
        program::writeText(mounts / "cpu.max", "50000 100000\n");  // as a container sees its own group
        CHECK(quota() == 0.5);
    }
    SECTION("version 1") {
        program::writeText(self, "7:memory:/job\n4:cpu,cpuacct:/job\n");
        for (const char* mount : {"cpu", "cpu,cpuacct"}) {
            program::writeText(mounts / mount / "job/cpu.cfs_period_us", "100000\n");
            program::writeText(mounts / mount / "job/cpu.cfs_quota_us", "-1\n");
            CHECK(std::isinf(quota()));
            program::writeText(mounts / mount / "job/cpu.cfs_quota_us", "300000\n");
            CHECK(quota() == 3.0);
            fs::remove_all(mounts / mount);
        }
        program::writeText(mounts / "memory/job/cpu.max", "100000 100000\n");
        CHECK(std::isinf(quota()));
    }
}

TEST_CASE("A process that is bound to one processor uses one thread", "[processors]") {
    const program::Folder folder;
    const std::string arguments = " simulate measured/fountain --frames 0 --quiet -o " + (folder / "a").string();
    const std::string firstAllowed = "$(taskset -cp $$ | sed \"s/.*: //; s/[-,].*//\")";
    REQUIRE(program::shell("taskset -c " + firstAllowed + " " GLOBULAR_PROGRAM + arguments).code == 0);
    CHECK(program::textOf(folder / "a/run.json").find("\"threads\": 1,") != std::string::npos);
}
