// Writes folders of pictures as runs leave them, for the tests of compare and approve.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "render/output/png.h"
#include "tests/render/test_pictures.h"
#include "tools/compare/picture_provenance.h"
#include "tools/frames/manifest.h"
#include "tools/system/output_file.h"

namespace golden_files {

namespace fs = std::filesystem;

inline void writePicture(const fs::path& path, const render::Image& image) {
    tools::createFolder(path.parent_path());
    tools::writeFile(path, render::encodePng(image));
}

/// What a manifest records about the run itself.
struct RunFacts {
    std::string scene = "5ce4e00000000000";
    std::string drawnBy = "opengl";
    std::string renderer = "llvmpipe (test)";
    std::string driver = "4.5 Mesa (test)";
    std::string version = "0.2.0";
};

/// Writes manifest.json for the frames in a folder, all of which show the same particle state.
inline void writeManifest(const fs::path& folder, const std::string& state, const RunFacts& run = {}) {
    tools::Manifest manifest;
    manifest.identity = {{"scene_hash", run.scene},
                         {"version", run.version},
                         {"renderer", run.drawnBy},
                         {"gl_renderer", run.renderer},
                         {"gl_version", run.driver},
                         {"quality", "normal"},
                         {"size", {160, 90}},
                         {"seed", 1},
                         {"fps", 30}};
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".png")
            manifest.frames[std::stoi(entry.path().stem().string().substr(6))] = {
                tools::checksumOf(tools::readFile(entry.path())), state};
    tools::writeFile(folder / "manifest.json", tools::encodeManifest(manifest));
}

}  // namespace golden_files
