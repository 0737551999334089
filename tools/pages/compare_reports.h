// The reports of `compare`. The page of --report is one file with all pictures in it that fetches nothing; its HTML,
// CSS and script are in tools/pages, and this code collects the data that they show. The file of --junit has the
// results in JUnit's XML format, which CI systems show as tests.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/compare/compare_pictures.h"
#include "tools/system/json.h"

namespace tools {

/// What the page of --report shows about the whole comparison.
struct PageHeading {
    std::string actual, expected;  ///< paths as given on the command line
    std::string profile;
    render::CompareLimits limits;
    CompareCounts counts;
    std::string approval;  ///< command line that accepts all pictures that fail; empty: none do
};

/// Collects results with their pictures and writes the page, failures first. Because a browser cannot show thousands of
/// pictures, those that passed are included up to kPassedBytes of base64 and those that failed up to kFailedBytes. The
/// others are shown by their numbers only. Both limits are chosen.
class ComparePage {
 public:
    static constexpr std::size_t kPassedBytes = std::size_t{48} << 20;
    static constexpr std::size_t kFailedBytes = std::size_t{128} << 20;

    /// @param approval  the command that accepts this picture, or empty
    void add(const PictureResult& result, const std::string& approval);
    std::string html(const PageHeading& heading) const;

 private:
    struct Entry {
        PictureStatus status;
        Json json;
    };
    void inlinePictures(const PictureResult& result, Json& json);
    void addRun(const PictureSide& side, Json& json);

    std::vector<Entry> entries_;
    std::map<std::string, nlohmann::json> runs_;  ///< the run.json files beside the pictures, by path
    std::size_t passedBytes_ = 0;
    std::size_t failedBytes_ = 0;
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
