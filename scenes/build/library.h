// The built-in scenes: scene files below a list of root folders, each known by its name. Used by every command that
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

/// All built-in scenes, sorted by name. If several roots have a scene of the same name, that of the first root is used.
/// Roots that do not exist are skipped.
std::vector<LibraryEntry> listScenes(const std::vector<std::string>& roots);

/// The file that a SCENE argument refers to. An existing file, or anything that ends in .toml, is a path; everything
/// else is the name of a built-in scene, in full ("paper/figure-2") or its last part ("figure-2").
/// @throws InputError with the nearest name, if there is no such scene
std::string resolveScene(const std::string& nameOrPath, const std::vector<std::string>& roots);

}  // namespace scenes
