// The reports of `compare`. The page of --report fetches nothing from a network; the worst pictures are in files beside
// it, which are loaded when they are looked at. Its HTML, CSS and script are in tools/pages, and this code collects the
// data that they show. The file of --junit has the results in JUnit's XML format, which CI systems show as tests.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tools/compare/compare_pictures.h"
#include "tools/system/json.h"

namespace tools {

/// What the page of --report shows about the whole comparison.
struct PageHeading {
    std::string profile;
    CompareCounts counts;
    std::string approval;  ///< command line that accepts all pictures that fail; empty: none do
};

/// Collects results and writes the page, failures first. It shows the kMostShown worst pictures that differ, and the
/// others by their numbers only, so that neither the page nor the memory grows with the size of pictures.
class ComparePage {
 public:
    /// Chosen: more than one looks at.
    static constexpr std::size_t kMostShown = 50;

    /// @param approval  the command that accepts this picture, or empty
    void add(const PictureResult& result, const std::string& approval);

    /// Writes index.html into a folder, which is created, and the pictures into the folder kReportPictures beside it,
    /// where those of an earlier report are removed. The pictures to show are compared once more, because only now it
    /// is known which they are.
    /// @throws render::SystemError
    void write(const std::filesystem::path& folder, const CompareJob& job, const PageHeading& heading);

 private:
    struct Entry {
        PictureStatus status;
        double difference;  ///< mean difference; infinite for pictures of different sizes
        Json json;
    };
    std::vector<Entry*> worst();
    void addPictures(const std::filesystem::path& folder, CompareJob job);
    void addRun(const PictureSide& side, Json& json);
    std::string html(const CompareJob& job, const PageHeading& heading);

    std::vector<Entry> entries_;
    std::map<std::string, nlohmann::json> runs_;  ///< the run.json files beside the pictures, by path
};

/// Collects the results of a comparison; text() is the content of the JUnit file.
class JunitReport {
 public:
    void add(const PictureResult& result);
    std::string text(const CompareCounts& counts) const;

 private:
    std::string cases_;
};

}  // namespace tools
