// The built-in scenes: scene files below a root folder, each known by its name. Used by every command that
// takes a SCENE.
#pragma once

#include <string>
#include <vector>

namespace scenes {

struct LibraryEntry {
    std::string name;   ///< path of the scene file below its root folder, without .toml: "liquid", "paper/figure-2"
    std::string title;  ///< title of the scene; empty if the file cannot be read
    std::string path;
};

/// All scenes below a root folder, sorted by name. There are none if the folder does not exist.
std::vector<LibraryEntry> listScenes(const std::string& root);

/// The file that a SCENE argument refers to. An existing file, or anything that ends in .toml, is a path; everything
/// else is the name of a built-in scene, in full ("paper/figure-2") or its last part ("figure-2").
/// @throws InputError with the nearest name, if there is no such scene
std::string resolveScene(const std::string& nameOrPath, const std::string& root);

}  // namespace scenes
