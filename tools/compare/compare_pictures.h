// Pictures held against each other one pair at a time, so that memory does not grow with a folder. `compare` and the
// golden suite call it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/compare/compare.h"
#include "tools/compare/picture_pairs.h"
#include "tools/run/picture_provenance.h"
#include "tools/system/json.h"

namespace tools {

enum class PictureStatus { unreadable, different, extra, missing, withinLimits, identical };

/// Of the most pressing first, as in a report: "unreadable", "different", "extra" (there is no golden), "missing"
/// (there is no actual picture), "within-limits", "identical".
const char* nameOf(PictureStatus status);

/// One side of a pair.
struct PictureSide {
    std::filesystem::path path;  ///< empty: there is none
    std::vector<std::uint8_t> bytes;
    std::optional<render::Image> image;  ///< if it can be read
    PictureProvenance provenance;
};

struct PictureResult {
    std::string name;
    PictureStatus status = PictureStatus::identical;
    PictureSide actual;
    PictureSide expected;
    std::vector<std::string> reasons;              ///< why it fails; empty if it passed
    std::optional<render::Comparison> comparison;  ///< where both sides can be read
    std::optional<Explanation> explanation;        ///< where the pictures or their states differ

    bool passed() const { return status == PictureStatus::identical || status == PictureStatus::withinLimits; }
    /// What decided: a comparison's rule, else the status.
    std::string rule() const;
};

struct CompareJob {
    std::filesystem::path actual;
    std::filesystem::path expected;
    render::CompareLimits limits;
    render::Image mask;  ///< empty: every pixel counts
};

struct CompareCounts {
    int pictures = 0, identical = 0, withinLimits = 0, different = 0, missing = 0, extra = 0, unreadable = 0;

    int failed() const { return pictures - identical - withinLimits; }
};

/// Compares every pair and hands each result over once, by name. Pictures that are missing or cannot be read are
/// results like any other. Throws render::SystemError when nothing can be compared: no such file or folder, no pictures
/// at all, a mask of another size.
CompareCounts comparePictures(const CompareJob& job, const std::function<void(const PictureResult&)>& visit);

/// A result as an object for scripts: status, rule, reasons, metrics, worst pixels, what changed, the provenance of
/// both sides.
Json resultJson(const PictureResult& result);

}  // namespace tools
