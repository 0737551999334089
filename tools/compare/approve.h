// Actual pictures become goldens, each with a sidecar that says where it comes from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tools {

struct ApproveJob {
    std::filesystem::path actual;
    std::filesystem::path expected;
    std::vector<std::string> names;  ///< as `compare` prints them; empty: every actual picture
    bool force = false;              ///< also where another GL renderer drew the golden
};

struct Approved {
    std::string name;
    bool isNew = false;  ///< there was no golden
};

/// Copies each picture and writes its sidecar; those that are the golden already, sidecar and all, are left alone and
/// out of the list. Throws: scenes::InputError naming every picture that was drawn by another GL renderer than its
/// golden, or is not there; render::SystemError for what cannot be read or written. Nothing is written before all of
/// them are known to be right.
std::vector<Approved> approvePictures(const ApproveJob& job);

/// The command that approves these pictures, to copy; empty where there is none: for no names, and for a video, whose
/// frames are approved instead.
std::string approvalLine(const std::filesystem::path& actual, const std::filesystem::path& expected,
                         const std::vector<std::string>& names);

}  // namespace tools
