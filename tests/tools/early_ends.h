// Small runs that are ended early by a signal, and what they have left.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/tools/program.h"

namespace early_ends {

namespace fs = std::filesystem;
using program::textOf;

/// A small run with births, obstacles, shadows, a video, and a checkpoint at every frame.
inline std::string fountain(const fs::path& folder, const std::string& more = "") {
    return "render measured/fountain --size 96x54 --frames 0-19 --quiet --checkpoint 0 -o " + folder.string() + " --video " +
           folder.string() + ".mp4 " + more;
}

/// The bytes of the frames and the video of a run. run.json is left out because it has times in it.
inline std::map<std::string, std::string> filesOf(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".png" || entry.path().extension() == ".ply")
            files[entry.path().filename().string()] = textOf(entry.path());
    if (fs::exists(folder.string() + ".mp4")) files["video"] = textOf(folder.string() + ".mp4");
    return files;
}

inline nlohmann::json runOf(const fs::path& folder) {
    return nlohmann::json::parse(textOf(folder / "run.json"));
}

inline std::vector<fs::path> checkpointsIn(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".state") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
}

/// Shell commands that wait.
inline std::string after(int milliseconds) {
    return "sleep " + std::to_string(milliseconds / 1000.0);
}
inline std::string onceThat(const std::string& condition) {
    return "while ! " + condition + " && kill -0 $child; do sleep 0.01; done";
}

/// Starts a run in the background and sends it a signal after the shell commands `when`. Returns its exit code.
/// @param start  "--default-signal": the run starts as from a terminal, although a shell without one makes background
/// processes ignore SIGINT; "--ignore-signal": it starts ignoring the signal, as under nohup
inline int interrupted(const std::string& arguments, const std::string& signal, const std::string& when,
                       const fs::path& log, const std::string& start = "--default-signal") {
    const std::string env = signal == "KILL" ? "" : "env " + start + "=" + signal + " ";
    const std::string command = "sh -c '" + env + GLOBULAR_PROGRAM " " + arguments + " 2>" + log.string() +
                                " & child=$!; " + when + "; date +%s%N >" + log.string() + ".sent; kill -" + signal +
                                " $child 2>/dev/null; wait $child; code=$?; date +%s%N >" + log.string() +
                                ".ended; exit $code'";
    return program::shell(command).code;
}

}  // namespace early_ends
