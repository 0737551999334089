// Reads both pictures of a pair, compares them, and explains a difference.
#include "tools/compare/compare_pictures.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "render/output/png.h"
#include "render/picture/system_error.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

PictureSide readSide(const std::optional<fs::path>& path, std::vector<std::string>& problems) {
    PictureSide side;
    if (!path) return side;
    side.path = *path;
    try {
        side.bytes = readFile(side.path);
        side.provenance = provenanceOf(side.path, side.bytes);
        side.image = render::decodePng(side.bytes, side.path.string());
    } catch (const render::SystemError& error) {
        problems.emplace_back(error.what());
    }
    return side;
}

void evaluate(PictureResult& result, const CompareJob& job) {
    const render::Image& expected = *result.expected.image;
    if (!job.mask.rgb.empty() && (job.mask.width != expected.width || job.mask.height != expected.height))
        throw render::SystemError(fmt::format("the mask is {}x{}, {} is {}x{}", job.mask.width, job.mask.height,
                                              result.expected.path.string(), expected.width, expected.height));
    result.comparison = render::compare(*result.actual.image, expected, job.limits, job.mask);
    result.reasons = result.comparison->reasons;
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
    return hasExtension(whole, ".mp4") ? fmt::format("{} in {}", name, whole.string()) : (whole / name).string();
}

PictureResult comparePair(const PicturePair& pair, const CompareJob& job) {
    PictureResult result;
    result.name = pair.name;
    result.actual = readSide(pair.actual, result.reasons);
    result.expected = readSide(pair.expected, result.reasons);
    if (!result.reasons.empty()) {
        result.status = PictureStatus::unreadable;
    } else if (!pair.expected) {
        result.status = PictureStatus::extra;
        result.reasons.push_back(
            fmt::format("there is no golden {}; approve it, or remove it", displayName(job.expected, pair.name)));
    } else if (!pair.actual) {
        result.status = PictureStatus::missing;
        result.reasons.push_back(fmt::format("there is no picture {}", displayName(job.actual, pair.name)));
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
                                     {"gl_renderer", provenance.glRenderer},
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
    const PictureSet actual = picturesOf(job.actual);
    const PictureSet expected = picturesOf(job.expected);
    CompareCounts counts;
    for (const PicturePair& pair : pairsOf(actual, expected)) {
        const PictureResult result = comparePair(pair, job);
        counts.add(result.status);
        visit(result);
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
