// Tests how much memory a run of the program takes.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/program.h"

namespace {

namespace fs = std::filesystem;

/// The peak memory of a run of the program, in kB.
long peakOf(const std::string& arguments) {
    const std::string command = "exec " GLOBULAR_PROGRAM " " + arguments;
    const pid_t child = ::fork();
    if (child == 0) {
        ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        ::_exit(127);
    }
    int status = 0;
    struct rusage usage = {};
    REQUIRE(::wait4(child, &status, 0, &usage) == child);
    REQUIRE(status == 0);
    return usage.ru_maxrss;
}

}  // namespace

TEST_CASE("A long run takes no more memory than a short one", "[tools]") {
    const program::Folder folder;
    const auto frames = [&](int count) {
        return peakOf(
            "render attraction-1 --set fps=200 --set duration=5 --size 160x90 --quality draft --quiet --frames 0-" +
            std::to_string(count - 1) + " --checkpoint 0.1 -o " + (folder / std::to_string(count)).string());
    };
    const long brief = frames(100);
    const long lengthy = frames(700);
    INFO(brief << " kB, " << lengthy << " kB");
    // If the 600 additional pictures of 43 kB stayed in memory, that would be 25 MB. A frame's record in the manifest
    // takes at most 1 kB.
    CHECK(lengthy - brief < 4000);
}

TEST_CASE("The memory of a run does not grow with the square of the number of materials", "[tools]") {
    const program::Folder folder;
    const auto scene = [&](int materials) {
        const std::string path = (folder / "materials.toml").string();
        std::ofstream file(path);
        file << "title = \"materials\"\nduration = 0.1\n";
        for (int k = 0; k < materials; ++k)
            file << "[[material]]\nname = \"m" << k << "\"\nb1 = " << 0.01 + 1e-6 * k << "\n";
        for (int k = 0; k < 3; ++k)
            file << "[[body]]\nmaterial = \"m" << k << "\"\nshape = \"ball\"\nradius = 0.3\ncenter = [" << 0.5 * k
                 << ", 1, 0]\n";
        return path;
    };
    const auto simulated = [&](int materials) {
        return peakOf("simulate " + scene(materials) + " --quiet --overwrite -o " + (folder / "states").string());
    };
    const long few = simulated(3);
    const long many = simulated(1000);
    INFO(few << " kB, " << many << " kB");
    // A material takes some kB while the scene file is read. Mixtures of every two of a thousand would
    // take 96 MB for each of the six runs of an error estimate.
    CHECK(many - few < 30'000);
    const auto said = nlohmann::json::parse(program::run("check --json " + scene(1000)).out);
    CHECK(said["memory_bytes"].get<double>() > 1000 * 6 * 100);  // six runs, and more than 100 bytes a material
}

TEST_CASE("A run takes no more memory than check says, and not much less", "[tools]") {
    const program::Folder folder;
    const auto scene = [&](double height) {
        const std::string path = (folder / "block.toml").string();
        std::ofstream(path) << "title = \"block\"\nduration = 0.4\n[physics]\nstepper = \"auto\"\n"
                               "[material]\npreset = \"honey\"\n[[body]]\nshape = \"box\"\njitter = 0.02\n"
                               "minimum = [-3, 0.2, -3]\nmaximum = [3, "
                            << height
                            << ", 3]\n"
                               "[[obstacle]]\nshape = \"plane\"\n";
        return path;
    };
    const auto simulated = [&](const std::string& path) {
        return peakOf("simulate " + path + " --quiet --overwrite -o " + (folder / "states").string());
    };
    const long without = simulated(scene(0.5));
    const std::string path = scene(8.0);
    const auto said = nlohmann::json::parse(program::run("check --json " + path).out);
    const double taken = 1024.0 * static_cast<double>(simulated(path) - without);
    INFO(said["memory_bytes"] << " said, " << taken << " taken by " << said["particles_at_start"]);
    CHECK(taken < said["memory_bytes"].get<double>());
    CHECK(taken > 0.25 * said["memory_bytes"].get<double>());
}

TEST_CASE("A report of many pictures takes no more memory than one of a few", "[tools]") {
    const program::Folder folder;
    const auto report = [&](int count) {
        const fs::path work = folder / std::to_string(count);
        for (const char* side : {"1", "2"}) {
            fs::create_directories(work / side);
            const std::string noise = std::string("color=gray:s=640x360:r=1,noise=alls=80:allf=t:all_seed=") + side;
            const auto made =
                program::shell("ffmpeg -loglevel error -nostdin -f lavfi -i " + noise + " -frames:v " +
                               std::to_string(count) + " -pix_fmt rgb24 " + (work / side).string() + "/frame-%05d.png");
            INFO(made.err);
            REQUIRE(made.code == 0);
        }
        return peakOf("compare " + (work / "1").string() + " " + (work / "2").string() +
                      " --max-difference 255 --max-share 100 --max-mean 255 --min-ssim -1 --quiet --report " +
                      (work / "report").string());
    };
    const long brief = report(3);
    const long lengthy = report(24);
    INFO(brief << " kB, " << lengthy << " kB");
    // The PNG files of a picture, its golden and their two differences take 2.4 MB, those of 21 more pictures 50 MB.
    CHECK(lengthy - brief < 8000);
}
