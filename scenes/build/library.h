// The built-in scenes: files below a list of root folders, known by name. Used by every command that takes a SCENE.
#pragma once

#include <string>
#include <vector>

namespace scenes {

struct LibraryEntry {
    std::string name;   ///< path below its root without .toml: "liquid", "paper/figure-2"
    std::string title;  ///< empty if the file cannot be read
    std::string path;
};

/// All built-in scenes, sorted by name. Of two with the same name that of the earlier root counts; roots that do not
/// exist hold none.
std::vector<LibraryEntry> listScenes(const std::vector<std::string>& roots);

/// The file a SCENE stands for: a file that exists or anything that ends in .toml is a path; else it is a built-in
/// name, in full ("paper/figure-2") or the last part of it ("figure-2"). Throws: InputError with the nearest names.
std::string resolveScene(const std::string& nameOrPath, const std::vector<std::string>& roots);

}  // namespace scenes
