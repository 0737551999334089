// Finds scene files by scanning folders each time, because there are few scenes.
#include "scenes/build/library.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "scenes/schema/document.h"
#include "scenes/text/edit_distance.h"
#include "scenes/text/input_error.h"
#include "scenes/text/read_file.h"

namespace scenes {
namespace {

namespace fs = std::filesystem;

/// Paths by name.
using Names = std::map<std::string, std::string>;

Names namesBelow(const fs::path& root) {
    Names names;
    std::error_code error;
    for (fs::recursive_directory_iterator file(root, error), end; !error && file != end; file.increment(error)) {
        if (file->path().extension() != ".toml") continue;
        std::error_code ignored;
        if (!file->is_regular_file(ignored)) continue;
        names.emplace(file->path().lexically_relative(root).replace_extension().generic_string(),
                      file->path().string());
    }
    return names;
}

std::string lastPart(const std::string& name) {
    return name.substr(name.find_last_of('/') + 1);
}

/// The title of a scene file, empty if it cannot be read. The rest of the file is not validated.
std::string titleOf(const std::string& path) {
    try {
        ProblemList problems(path, {});
        const Document document = parseDocument(asText(readFile(path, kMaxSceneFileBytes)), problems);
        const Entry* title = findEntry(document.root, "title");
        return title != nullptr && title->value.kind == ValueKind::string ? title->value.string : std::string{};
    } catch (const InputError&) {
        return {};
    }
}

[[noreturn]] void failUnknown(const std::string& name, const Names& names) {
    std::vector<std::string> known;
    for (const auto& [full, path] : names) {
        known.push_back(full);
        known.push_back(lastPart(full));
    }
    const std::string nearest = nearestName(name, known);
    throw InputError(
        name, nearest.empty()
                  ? "there is no such file and no built-in scene of that name (`globular scenes` lists them)"
                  : fmt::format("there is no such file or built-in scene, did you mean {}?", tomlString(nearest)));
}

}  // namespace

std::vector<LibraryEntry> listScenes(const std::string& root) {
    std::vector<LibraryEntry> entries;
    for (const auto& [name, path] : namesBelow(root)) entries.push_back({name, titleOf(path), path});
    return entries;
}

std::string resolveScene(const std::string& nameOrPath, const std::string& root) {
    std::error_code ignored;
    const fs::path path(nameOrPath);
    const bool exists = fs::exists(path, ignored) && !fs::is_directory(path, ignored);
    if (exists || path.extension() == ".toml") return nameOrPath;
    const Names names = namesBelow(root);
    if (const auto found = names.find(nameOrPath); found != names.end()) return found->second;
    std::vector<std::string> matches;
    for (const auto& [full, file] : names)
        if (lastPart(full) == nameOrPath) matches.push_back(full);
    if (matches.empty()) failUnknown(nameOrPath, names);
    if (matches.size() > 1)
        throw InputError(nameOrPath, fmt::format("is ambiguous, it may be any of {}", fmt::join(matches, ", ")));
    return names.at(matches[0]);
}

}  // namespace scenes
