// Reads both pictures of a pair, compares them, and explains a difference.
#include "tools/compare/compare_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>

#include "render/output/png.h"
#include "render/output/video_reader.h"
#include "render/picture/system_error.h"
#include "tools/compare/picture_set.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// One side of a comparison: its pictures in the order of their names. The frames of a video are decoded one by one.
class PictureQueue {
 public:
    PictureQueue(const PictureSet& set, const CompareJob& job)
        : set_(set), file_(set.pictures.begin()), whileWaiting_(job.whileWaiting) {
        if (set.isVideo) frame_ = video_.emplace(set.path.string()).next(whileWaiting_);
    }

    const PictureSet& set() const { return set_; }

    /// The name of the first picture; nothing if none is left.
    std::optional<std::string> name() const {
        if (frame_) return fmt::format("frame-{:05}.png", frameNumber_);
        return file_ == set_.pictures.end() ? std::nullopt : std::optional(file_->first);
    }

    /// Reads the first picture. Why it cannot be read is added to the problems.
    PictureSide read(const char* side, std::vector<std::string>& problems) {
        if (video_) return {set_.path, {}, std::move(frame_), {}};
        PictureSide picture{file_->second, {}, {}, {}};
        try {
            picture.bytes = readFile(picture.path);
            picture.provenance = provenanceOf(picture.path, picture.bytes);
            picture.image = render::decodePng(picture.bytes, picture.path.string());
        } catch (const render::SystemError& error) {
            problems.push_back(fmt::format("{} picture: {}", side, error.what()));
        } catch (const std::bad_alloc&) {
            problems.push_back(fmt::format("{} picture: {} does not fit into memory", side, picture.path.string()));
        }
        return picture;
    }

    /// Removes the first picture.
    void pop() {
        if (video_) {
            frame_ = video_->next(whileWaiting_);
            ++frameNumber_;
        } else {
            ++file_;
        }
    }

 private:
    const PictureSet& set_;
    decltype(PictureSet::pictures)::const_iterator file_;
    const std::function<void()>& whileWaiting_;
    std::optional<render::VideoReader> video_;
    std::optional<render::Image> frame_;
    int frameNumber_ = 0;
};

/// The two sides of a comparison.
struct Sides {
    PictureSet actual, expected;
};

/// The sides, where two single files have one name.
/// @throws render::SystemError if one side is a file and the other a folder or video
Sides sidesOf(const CompareJob& job) {
    Sides sides{picturesOf(job.actual), picturesOf(job.expected)};
    const auto isThere = [](const PictureSet& set) { return set.isVideo || !set.pictures.empty(); };
    if (!isThere(sides.actual) || !isThere(sides.expected)) return sides;
    if (sides.actual.isSingle != sides.expected.isSingle)
        throw render::SystemError(
            "one side is a single picture, the other a folder or a video; compare like with like");
    if (sides.actual.isSingle)
        sides.actual.pictures = {{sides.expected.pictures.begin()->first, sides.actual.pictures.begin()->second}};
    return sides;
}

void evaluate(PictureResult& result, const CompareJob& job) {
    const render::Image& expected = *result.expected.image;
    if (!job.mask.rgb.empty() && (job.mask.width != expected.width || job.mask.height != expected.height))
        throw render::SystemError(fmt::format("the mask is {}x{}, {} is {}x{}", job.mask.width, job.mask.height,
                                              result.expected.path.string(), expected.width, expected.height));
    const bool isStrict =
        job.isStrictForSameDriver && haveSameDriver(result.actual.provenance, result.expected.provenance);
    result.limits = isStrict ? render::limitsOf("strict") : job.limits;
    result.comparison = render::compare(*result.actual.image, expected, result.limits, job.mask);
    result.reasons = result.comparison->reasons;
    if (isStrict && !result.comparison->passed())
        result.reasons.push_back(fmt::format("equal pixels are wanted, because one driver drew both: {}",
                                             textOf(result.expected.provenance.renderer)));
    const bool identical = result.comparison->rule == render::CompareRule::identical;
    result.status = !result.comparison->passed() ? PictureStatus::different
                    : identical                  ? PictureStatus::identical
                                                 : PictureStatus::withinLimits;
    const std::string& state = result.actual.provenance.stateHash;
    const bool statesDiffer = !state.empty() && !result.expected.provenance.stateHash.empty() &&
                              state != result.expected.provenance.stateHash;
    if (!identical || statesDiffer) result.explanation = explain(result.actual.provenance, result.expected.provenance);
}

/// How messages name a picture of a folder or a frame of a video.
std::string displayName(const fs::path& whole, const std::string& name) {
    if (hasExtension(whole, ".png")) return whole.string();
    return isVideoName(whole) ? fmt::format("{} in {}", name, whole.string()) : (whole / name).string();
}

/// Says that a name of one side only has a twin on the other side that looks the same; empty if it has none.
std::string twinNote(const std::string& name, const PictureSet& here, const PictureSet& there) {
    if (std::all_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x80; })) return {};
    for (const auto& [other, path] : there.pictures)
        if (differInUnicodeForm(name, other) && here.pictures.count(other) == 0)
            return fmt::format(
                "; the name of {} looks the same, but one has composed, the other decomposed characters (Unicode NFC "
                "and NFD)",
                path.string());
    return {};
}

/// Compares the pictures of a name, of which at least one side has one at the head of its queue.
PictureResult compareNamed(const std::string& name, const CompareJob& job, PictureQueue& actual,
                           PictureQueue& expected) {
    PictureResult result;
    result.name = name;
    if (actual.name() == name) result.actual = actual.read("actual", result.reasons);
    if (expected.name() == name) result.expected = expected.read("expected", result.reasons);
    if (!result.reasons.empty()) {
        result.status = PictureStatus::unreadable;
    } else if (result.expected.path.empty()) {
        result.status = PictureStatus::extra;
        result.reasons.push_back(fmt::format("there is no golden {}; approve it, or remove it{}",
                                             displayName(job.expected, name),
                                             twinNote(name, actual.set(), expected.set())));
    } else if (result.actual.path.empty()) {
        result.status = PictureStatus::missing;
        result.reasons.push_back(fmt::format("there is no picture {}{}", displayName(job.actual, name),
                                             twinNote(name, expected.set(), actual.set())));
    } else {
        evaluate(result, job);
    }
    return result;
}

Json metricsJson(const render::PictureMetrics& metrics) {
    Json worst = Json::array();
    for (const render::PixelDifference& pixel : metrics.worst)
        worst.push_back({{"x", pixel.x}, {"y", pixel.y}, {"actual", pixel.actual}, {"expected", pixel.expected}});
    return {{"pixels", metrics.pixelCount},
            {"differing", metrics.differing},
            {"noticeable", metrics.noticeable},
            {"share", metrics.share()},
            {"largest", metrics.largest},
            {"mean", metrics.mean},
            {"ssim", metrics.ssim},
            {"psnr", std::isinf(metrics.psnr()) ? Json(nullptr) : Json(metrics.psnr())},
            {"worst", worst}};
}

Json sideJson(const PictureSide& side) {
    if (side.path.empty()) return nullptr;
    const PictureProvenance& provenance = side.provenance;
    Json json = {{"path", side.path.string()}};
    if (side.image) json["size"] = {side.image->width, side.image->height};
    for (const auto& [key, value] : {std::pair<const char*, const std::string&>{"scene_hash", provenance.sceneHash},
                                     {"state_hash", provenance.stateHash},
                                     {"version", provenance.version},
                                     {"renderer", provenance.renderer.name},
                                     {"gl_renderer", provenance.renderer.glRenderer},
                                     {"gl_version", provenance.renderer.glVersion},
                                     {"quality", provenance.quality},
                                     {"facts_from", provenance.source},
                                     {"note", provenance.note}})
        if (!value.empty()) json[key] = value;
    return json;
}

}  // namespace

const char* nameOf(PictureStatus status) {
    constexpr const char* kNames[] = {"unreadable", "different", "extra", "missing", "within-limits", "identical"};
    return kNames[static_cast<std::size_t>(status)];
}

int CompareCounts::pictures() const {
    return std::accumulate(counts_.begin(), counts_.end(), 0);
}

std::string PictureResult::rule() const {
    return comparison ? render::nameOf(comparison->rule) : nameOf(status);
}

CompareCounts comparePictures(const CompareJob& job, const std::function<void(const PictureResult&)>& visit) {
    if (!fs::exists(job.actual))
        throw render::SystemError(fmt::format("there is no file or folder {}", job.actual.string()));
    const Sides sides = sidesOf(job);
    PictureQueue actual(sides.actual, job), expected(sides.expected, job);
    CompareCounts counts;
    while (actual.name() || expected.name()) {
        job.whileWaiting();
        const std::string name = !actual.name()     ? *expected.name()
                                 : !expected.name() ? *actual.name()
                                                    : std::min(*actual.name(), *expected.name(), ByNumber{});
        const bool isActual = actual.name() == name, isExpected = expected.name() == name;
        if (job.only.empty() || job.only.contains(name)) {
            const PictureResult result = compareNamed(name, job, actual, expected);
            counts.add(result.status);
            visit(result);
        }
        if (isActual) actual.pop();
        if (isExpected) expected.pop();
    }
    // A check that has compared nothing must not pass.
    if (counts.pictures() == 0)
        throw render::SystemError(
            fmt::format("there are no PNG files in {} and {}", job.actual.string(), job.expected.string()));
    return counts;
}

Json resultJson(const PictureResult& result) {
    Json json = {
        {"name", result.name}, {"status", nameOf(result.status)}, {"rule", result.rule()}, {"reasons", result.reasons}};
    if (result.comparison && result.comparison->rule != render::CompareRule::size)
        json["metrics"] = metricsJson(result.comparison->metrics);
    if (result.explanation) {
        constexpr const char* kCauses[] = {"simulation", "renderer", "unknown"};
        json["changed"] = kCauses[static_cast<std::size_t>(result.explanation->cause)];
        json["explanation"] = result.explanation->text;
    }
    json["actual"] = sideJson(result.actual);
    json["expected"] = sideJson(result.expected);
    return json;
}

}  // namespace tools
