// The page of `compare --report`: one file, pictures inlined, no network. Its HTML, CSS and script are in tools/pages;
// here is the data that they show.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/compare/compare_pictures.h"
#include "tools/system/json.h"

namespace tools {

/// What the page says of the comparison as a whole.
struct PageHeading {
    std::string actual, expected;  ///< as given on the command line
    std::string profile;
    render::CompareLimits limits;
    CompareCounts counts;
    std::string approval;  ///< the command that accepts everything that fails; empty: nothing to accept
};

/// Collects results with their pictures; html() is the page, failures first. A browser cannot show thousands of
/// pictures: those that passed are inlined up to kPassedBytes, those that failed up to kFailedBytes of base64, the rest
/// have numbers only.
class ComparePage {
 public:
    static constexpr std::size_t kPassedBytes = std::size_t{48} << 20;
    static constexpr std::size_t kFailedBytes = std::size_t{128} << 20;

    /// approval: the command that accepts this picture, or empty.
    void add(const PictureResult& result, const std::string& approval);
    std::string html(const PageHeading& heading) const;

 private:
    struct Entry {
        PictureStatus status;
        Json json;
    };
    void inlinePictures(const PictureResult& result, Json& json);
    void noteRun(const PictureSide& side, Json& json);

    std::vector<Entry> entries_;
    std::map<std::string, nlohmann::json> runs_;  ///< each run.json beside a picture
    std::size_t passedBytes_ = 0;
    std::size_t failedBytes_ = 0;
};

}  // namespace tools
