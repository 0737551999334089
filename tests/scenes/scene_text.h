// Scene texts for tests, and the problems of a scene text as lines.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scenes/build/read_scene.h"
#include "scenes/text/input_error.h"
#include "scenes/view/frame_view.h"

namespace scenes_test {

using Lines = std::vector<std::string>;

// Not inline: each file has its own copies, which are made before those of its constants that extend them.

/// A valid scene: a title, a duration and one ball. Text that is appended starts in line 6.
const std::string kBall = "title = \"t\"\nduration = 2\n[[body]]\nshape = \"ball\"\nradius = 0.5\n";

/// The keys above the first table, without a body. Text that is appended starts in line 3.
const std::string kTop = "title = \"t\"\nduration = 2\n";

/// The problems of a scene with the file name pile.toml, one line for each.
inline Lines problemsOf(const std::string& text, const scenes::Overrides& overrides = {}) {
    try {
        scenes::readScene(text, "pile.toml", overrides);
    } catch (const scenes::InputError& error) {
        Lines lines;
        for (const scenes::Problem& problem : error.problems()) lines.push_back(scenes::formatProblem(problem));
        return lines;
    }
    return {};
}

inline scenes::Scene sceneOf(const std::string& text, const scenes::Overrides& overrides = {}) {
    return scenes::readScene(text, "pile.toml", overrides);
}

/// The view of a scene whose particles are still as at the start.
/// @param time  s
inline render::View viewAt(const scenes::Scene& scene, double time) {
    engine::Simulation simulation = engine::start(scene.setup);
    simulation.time = time;
    return scenes::frameView(scene, simulation);
}

/// A temporary folder that is removed with the object.
struct ScratchFolder {
    std::filesystem::path path;

    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "globular-scenes-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
        path = name;
    }
    ~ScratchFolder() { std::filesystem::remove_all(path); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::string write(const std::string& name, const std::string& bytes) const {
        const std::filesystem::path file = path / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << bytes;
        return file.string();
    }
};

}  // namespace scenes_test
