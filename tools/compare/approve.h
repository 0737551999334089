// Makes actual pictures the goldens, each with a sidecar that records its provenance. Called by `approve`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tools {

struct ApproveJob {
    std::filesystem::path actual;
    std::filesystem::path expected;  ///< for a single picture, the golden or a folder, into which the picture goes
    std::vector<std::string> names;  ///< names of the pictures to approve, as `compare` prints them; empty: all
    bool force = false;              ///< also replaces goldens that another renderer or driver drew
};

struct Approved {
    std::string name;
    bool isNew = false;  ///< there was no golden of this name before
};

/// Copies each picture over its golden and writes the sidecar, the JSON file beside the golden that records its
/// provenance. Pictures whose golden and sidecar would stay the same are skipped and not returned. Nothing is written
/// unless all pictures are accepted.
/// @throws scenes::InputError naming every picture that does not exist or was drawn by another renderer than its
/// golden
/// @throws render::SystemError for files that cannot be read or written
std::vector<Approved> approvePictures(const ApproveJob& job);

/// The command line that approves these pictures; empty if there are no names, and for a video, of which only the
/// frames can be approved.
std::string approvalLine(const std::filesystem::path& actual, const std::filesystem::path& expected,
                         const std::vector<std::string>& names);

}  // namespace tools
