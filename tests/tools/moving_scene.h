// A scene in which everything moves that a picture shows, and the commands that draw it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/catch.h"
#include "tests/tools/program.h"

namespace program {

/// A scene in which everything that a picture may take from the particles changes from frame to frame: births,
/// removals, ages as colors, two materials, a camera that moves, and a time stamp.
inline const std::string kMovingScene = R"(title = "everything that moves"
duration = 1
fps = 20
[physics]
stepper = "symplectic-euler"
step = 0.01
[world]
minimum = [-9, -0.6, -9]
[[material]]
name = "a"
preset = "liquid"
[[material]]
name = "b"
preset = "powder"
[[body]]
shape = "ball"
radius = 0.4
center = [0, 0.5, 0]
material = "b"
[[emitter]]
shape = "disc"
position = [1, 1, 0]
radius = 0.5
velocity = [-2, -1, 0]
rate = 100
until = 0.7
material = "a"
[[obstacle]]
shape = "sphere"
center = [0.5, 0, 0]
radius = 0.3
[[camera]]
time = 0
eye = [0, 1, 6]
[[camera]]
time = 1
eye = [3, 2, 5]
[look]
color_by = "age"
ground = true
[overlay]
time = true
color_bar = true
scale_bar = 0.5
)";

/// The scene, and a folder of its states.
struct MovingScene {
    program::Folder folder;
    std::string file = (folder / "s.toml").string();
    std::string states = (folder / "states").string();

    MovingScene() {
        program::writeText(file, kMovingScene);
        REQUIRE(run("simulate " + file + " --quiet -o " + states).code == 0);
    }

    /// A command that draws into a folder of this name.
    std::string draw(const std::string& name, const std::string& more) const {
        return "render " + file + " --size 160x90 --quiet -o " + (folder / name).string() + " " + more;
    }
    std::string fromStates(const std::string& name, const std::string& more = "") const {
        return draw(name, "--states " + states + " " + more);
    }

    /// The bytes of a frame that was drawn into a folder of this name.
    std::string frame(const std::string& name, int number) const {
        return textOf(folder / name /
                      ("frame-000" + std::string(number < 10 ? "0" : "") + std::to_string(number) + ".png"));
    }
    nlohmann::json json(const std::string& path) const { return nlohmann::json::parse(textOf(folder / path)); }
};

}  // namespace program
