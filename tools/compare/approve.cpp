// Makes pictures the goldens. Every picture is checked before the first one is written.
#include "tools/compare/approve.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/output/png.h"
#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tools/compare/picture_provenance.h"
#include "tools/compare/picture_set.h"
#include "tools/frames/manifest.h"
#include "tools/system/command_files.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/text.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// A picture that may become a golden.
struct Candidate {
    std::string name;
    fs::path from, to;
    std::string checksum;  ///< checksum of the picture's file when it was checked
    std::string sidecar;   ///< text of the sidecar to be written beside the golden
};

std::vector<Candidate> candidatesOf(const ApproveJob& job, const PictureSet& set) {
    std::vector<Candidate> candidates;
    std::vector<scenes::Problem> problems;
    if (set.isVideo)
        throw render::SystemError("frames of a video cannot be goldens; approve the PNG files it was made of");
    if (set.isSingle && !job.names.empty())
        throw scenes::InputError(job.names.front(), "names are of pictures in a folder");
    for (const std::string& name : job.names)
        if (!set.isSingle && set.pictures.count(name) == 0)
            problems.push_back({name, 0, 0, fmt::format("there is no such picture in {}", job.actual.string())});
    if (!problems.empty()) throw scenes::InputError(problems);
    const bool isInto = !job.expected.has_filename() || fs::is_directory(job.expected);
    for (const auto& [name, path] : set.pictures) {
        const bool chosen =
            set.isSingle || job.names.empty() || std::find(job.names.begin(), job.names.end(), name) != job.names.end();
        if (chosen)
            candidates.push_back({name, path, set.isSingle && !isInto ? job.expected : job.expected / name, {}, {}});
    }
    if (candidates.empty())
        throw render::SystemError(fmt::format("there are no pictures to approve in {}", job.actual.string()));
    return candidates;
}

std::string sidecarText(const Candidate& candidate, const std::vector<std::uint8_t>& bytes) {
    const render::Image image = render::decodePng(bytes, candidate.from.string());
    return indentedText(
        sidecarJson(provenanceOf(candidate.from, bytes), candidate.checksum, image.width, image.height));
}

/// The reason why a picture must not replace its golden; empty if it may.
std::string refusal(const Candidate& candidate) {
    const fs::path path = sidecarPath(candidate.to);
    if (!fs::exists(path)) return {};
    const nlohmann::json sidecar = readJson(path);
    if (!sidecar.is_object() || !sidecar.contains("png"))
        return fmt::format("its sidecar would replace {}, which is not a sidecar; --force replaces it", path.string());
    // The renderer that the sidecar names counts even if the golden was changed without its sidecar.
    const RendererRecord before = rendererIn(sidecar);
    if (before.name.empty()) return {};
    const RendererRecord now = provenanceOf(candidate.from, readFile(candidate.from)).renderer;
    if (now == before) return {};
    return fmt::format("drawn by {}, the golden by {}; --force approves it all the same", textOf(now), textOf(before));
}

/// Makes sure that no golden replaces a picture that is still to be read, or the golden of another picture. A picture
/// may be its own golden, which then gets a sidecar.
void checkOutputs(const ApproveJob& job, const std::vector<Candidate>& candidates) {
    CommandFiles files{{}, {}, {{"EXPECTED", job.expected, [](const fs::path&) { return false; }}}};
    for (const Candidate& candidate : candidates) {
        std::error_code ignored;
        files.inputs.push_back(candidate.from);
        if (!fs::equivalent(candidate.from, candidate.to, ignored)) files.outputs.push_back({"EXPECTED", candidate.to});
    }
    requireSeparate(files);
}

bool hasContent(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
    return fs::exists(path) && readFile(path) == bytes;
}

}  // namespace

std::vector<Approved> approvePictures(const ApproveJob& job) {
    if (!fs::exists(job.actual))
        throw render::SystemError(fmt::format("there is no file or folder {}", job.actual.string()));
    std::vector<Candidate> candidates = candidatesOf(job, picturesOf(job.actual));
    checkOutputs(job, candidates);
    std::vector<scenes::Problem> refusals;
    for (Candidate& candidate : candidates) {
        const std::vector<std::uint8_t> bytes = readFile(candidate.from);
        candidate.checksum = checksumOf(bytes);
        candidate.sidecar = sidecarText(candidate, bytes);
        const std::string why = job.force ? std::string{} : refusal(candidate);
        if (!why.empty()) refusals.push_back({candidate.from.string(), 0, 0, why});
    }
    if (!refusals.empty()) throw scenes::InputError(refusals);

    std::vector<Approved> approved;
    for (const Candidate& candidate : candidates) {
        const std::vector<std::uint8_t> bytes = readFile(candidate.from);
        if (checksumOf(bytes) != candidate.checksum)
            throw render::SystemError(fmt::format("{} has changed meanwhile", candidate.from.string()));
        const fs::path sidecar = sidecarPath(candidate.to);
        if (hasContent(candidate.to, bytes) &&
            hasContent(sidecar, {candidate.sidecar.begin(), candidate.sidecar.end()}))
            continue;
        approved.push_back({candidate.name, !fs::exists(candidate.to)});
        createFolderOf(candidate.to);
        writeFile(candidate.to, bytes);
        writeFile(sidecar, candidate.sidecar);
    }
    return approved;
}

std::string approvalLine(const fs::path& actual, const fs::path& expected, const std::vector<std::string>& names) {
    if (names.empty() || isVideoName(actual)) return {};
    std::vector<std::string> operands = {actual.string(), expected.string()};
    if (fs::is_directory(actual)) operands.insert(operands.end(), names.begin(), names.end());
    std::vector<std::string> words = {"globular", "approve"};
    const auto isLikeFlag = [](const std::string& word) { return word.starts_with('-'); };
    if (std::any_of(operands.begin(), operands.end(), isLikeFlag)) words.emplace_back("--");
    words.insert(words.end(), operands.begin(), operands.end());
    return shellLine(words);
}

}  // namespace tools
