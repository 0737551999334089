// Tests what the program says when memory runs out. A limit on the address space makes it run out.
#include <fstream>
#include <string>
#include <vector>

#include "tests/catch.h"
#include "tests/tools/program.h"

namespace {

/// Runs the program with so many megabytes of address space.
program::Outcome runWithin(int megabytes, const std::string& arguments) {
    return program::shell("ulimit -v " + std::to_string(megabytes * 1000) + "; " GLOBULAR_PROGRAM " " + arguments +
                          " --threads 1");
}

/// A scene of a cube of particles, whose edge is so many diameters of a particle long.
std::string cube(const program::Folder& folder, int edge) {
    const std::string path = (folder / "cube.toml").string();
    std::ofstream(path) << "title = \"cube\"\nduration = 0.1\n[physics]\nstepper = \"velocity-verlet\"\n"
                           "[material]\nradius = 0.05\n[[body]]\nshape = \"box\"\nminimum = [0, 0, 0]\nmaximum = ["
                        << 0.1 * edge << ", " << 0.1 * edge << ", " << 0.1 * edge << "]\n";
    return path;
}

void checkMessage(const program::Outcome& outcome, const std::vector<std::string>& parts) {
    INFO(outcome.err);
    CHECK(outcome.code == 1);
    for (const std::string& part : parts) CHECK(outcome.err.find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("When memory runs out, the message says what for, how much, and what to change", "[tools]") {
    const program::Folder folder;
    const std::string output = " --quiet --overwrite -o " + (folder / "run").string();
    // More than 27 million particles take more than a hundred bytes each.
    checkMessage(runWithin(1500, "check --limit particles=100000000 " + cube(folder, 300)),
                 {"error: memory ran out while reading the scene " + (folder / "cube.toml").string() + ": ",
                  " MB more were asked for, after up to ", " MB had been taken, where ulimit -v allows 1536 MB",
                  "; give the scene fewer particles\n"});
    // A million particles, more densely packed than a cubic grid, take 100 bytes each to read, and 1000 with their
    // neighbor list.
    checkMessage(runWithin(900, "simulate " + cube(folder, 90) + " --frames 0-1" + output),
                 {"error: memory ran out while simulating 1", " asked for, ", "; simulate fewer particles\n"});
    // A picture takes some twenty bytes a pixel.
    checkMessage(runWithin(700, "render measured/liquid --size 8192x4000 --limit pixels=100000000 --frames 0" + output),
                 {" MB ", "8192 x 4000 pixels", "; choose "});
}
