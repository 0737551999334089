// Compares pictures pair by pair, so that the memory does not grow with the folder or the video. Called by `compare`,
// by its report and by the golden suite.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "render/compare/compare.h"
#include "tools/compare/picture_provenance.h"
#include "tools/system/json.h"

namespace tools {

/// The outcome of comparing two pictures, the most urgent outcome first, as in a report. `extra` means that there is no
/// golden, `missing` that there is no actual picture.
enum class PictureStatus { unreadable, different, extra, missing, withinLimits, identical };

/// Name of an outcome: "unreadable", "different", "extra", "missing", "within-limits" or "identical".
const char* nameOf(PictureStatus status);

/// The actual or the expected picture of a comparison.
struct PictureSide {
    std::filesystem::path path;          ///< path of the file or the video; empty if there is no picture
    std::vector<std::uint8_t> bytes;     ///< content of the file; empty for a frame of a video
    std::optional<render::Image> image;  ///< decoded picture; none if the file cannot be read
    PictureProvenance provenance;
};

struct PictureResult {
    std::string name;
    PictureStatus status = PictureStatus::identical;
    PictureSide actual;
    PictureSide expected;
    std::vector<std::string> reasons;              ///< why the comparison fails; empty if it passed
    render::CompareLimits limits;                  ///< limits that the comparison was held to
    std::optional<render::Comparison> comparison;  ///< metrics and verdict; none if a picture cannot be read
    std::optional<Explanation> explanation;        ///< what changed; none if pictures and particle states are the same

    bool passed() const { return status == PictureStatus::identical || status == PictureStatus::withinLimits; }
    /// The name of the comparison rule that decided, or of the status if nothing was compared.
    std::string rule() const;
};

struct CompareJob {
    std::filesystem::path actual;
    std::filesystem::path expected;
    render::CompareLimits limits;
    render::Image mask;                          ///< picture whose black pixels do not count; empty: every pixel counts
    std::set<std::string> only = {};             ///< names of the pictures to compare; empty: all
    std::function<void()> whileWaiting = [] {};  ///< called many times a second; ends the comparison by throwing
    bool isStrictForSameDriver = true;           ///< whether pictures of one OpenGL driver must have equal pixels
};

/// Counts the pairs of pictures by outcome.
class CompareCounts {
 public:
    void add(PictureStatus status) { ++counts_[static_cast<std::size_t>(status)]; }
    int of(PictureStatus status) const { return counts_[static_cast<std::size_t>(status)]; }
    int pictures() const;
    int failed() const { return pictures() - of(PictureStatus::identical) - of(PictureStatus::withinLimits); }

 private:
    std::array<int, 6> counts_ = {};
};

/// Compares every pair of pictures with the same name and passes each result to `visit`, ordered by name. Two single
/// files form a pair under the expected file's name. Missing and unreadable pictures are results like any other.
/// @throws render::SystemError if nothing can be compared: no such file or folder, no pictures at all, one side a
/// single picture and the other not, a video that ffmpeg cannot decode, or a mask of another size
CompareCounts comparePictures(const CompareJob& job, const std::function<void(const PictureResult&)>& visit);

/// A result as an object for scripts: status, rule, reasons, metrics, worst pixels, what changed, and the provenance of
/// both sides.
Json resultJson(const PictureResult& result);

}  // namespace tools
