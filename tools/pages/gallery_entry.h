// What `globular gallery` knows of a scene: what the scene says of itself, and what was measured when its film was
// made. The latter is kept in a file beside the film, so that a later call does not draw the scene again.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/system/json.h"

namespace tools {

/// What a run of a scene has measured.
struct GalleryRun {
    std::size_t particles = 0;  ///< largest number at any time
    std::size_t births = 0;
    std::size_t deaths = 0;
    std::size_t steps = 0;
    double seconds = 0.0;  ///< wall-clock time of simulating, drawing and encoding the film
    int threads = 1;
    std::string instructionSet;  ///< vector instructions of the kernels, such as "AVX2"
    std::string processor;       ///< its model; empty if it is not known
};

/// One scene of the gallery. Names of files are relative to the gallery's folder.
struct GalleryEntry {
    std::string name;  ///< of the scene in the library, such as "paper/figure-1"
    std::string title;
    std::string description;                                ///< may have backquotes around code
    std::string command;                                    ///< command line that makes the film
    std::string text;                                       ///< the scene file
    double duration = 0.0;                                  ///< of the animation, s
    std::vector<std::pair<std::string, std::string>> look;  ///< the given keys of [look] and their values as TOML
    std::string filmName;
    std::string stillName;
    std::string textName;
    std::string recordName;
    std::optional<GalleryRun> run;  ///< nothing until the film and the still exist
    std::string failure;            ///< why the scene could not be drawn; empty if it was, or was not tried yet
};

/// The content of the file that records a run.
/// @param identity  everything that determines the film and the still
Json galleryRecord(const Json& identity, const GalleryRun& run);

/// The run in such a file; nothing if it is of other pictures than those of the identity, or is no such file.
std::optional<GalleryRun> galleryRunIn(const Json& record, const Json& identity);

}  // namespace tools
