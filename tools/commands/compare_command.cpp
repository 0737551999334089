// globular compare: compares pictures with their goldens and names the rule that a difference breaks. The exit code is
// 0 if all pictures are within the limits, 1 if one is not, and 2 if at least one could not be compared.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "render/output/atomic_file.h"
#include "render/output/png.h"
#include "render/picture/system_error.h"
#include "tools/commands/commands.h"
#include "tools/compare/approve.h"
#include "tools/compare/compare_pictures.h"
#include "tools/compare/picture_provenance.h"
#include "tools/compare/picture_set.h"
#include "tools/pages/compare_reports.h"
#include "tools/system/command_files.h"
#include "tools/system/interrupts.h"
#include "tools/system/json.h"
#include "tools/system/memory.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"
#include "tools/system/progress.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

constexpr int kDifferent = 1;
constexpr int kTrouble = 2;

struct CompareOptions {
    std::string actual, expected;
    std::string profile = "vendor";
    std::optional<int> threshold, largest;
    std::optional<double> sharePercent, mean, ssim;
    std::vector<const CLI::Option*> limitFlags;  ///< --profile and the flags of single limits
    std::string mask, junit, report;
    RunOptions run;  ///< --json and --quiet; the number of threads is not used
};

render::CompareLimits limitsOf(const CompareOptions& options) {
    render::CompareLimits limits = render::limitsOf(options.profile);
    limits.threshold = options.threshold.value_or(limits.threshold);
    limits.largest = options.largest.value_or(limits.largest);
    if (options.sharePercent) limits.share = *options.sharePercent / 100.0;
    limits.mean = options.mean.value_or(limits.mean);
    limits.ssim = options.ssim.value_or(limits.ssim);
    return limits;
}

/// Whether the command line says how far pictures may differ.
bool hasOwnLimits(const CompareOptions& options) {
    return std::any_of(options.limitFlags.begin(), options.limitFlags.end(),
                       [](const CLI::Option* flag) { return flag->count() > 0; });
}

render::Image readMask(const std::string& path) {
    if (path.empty()) return {};
    render::Image mask = render::decodePng(readFile(path), path);
    const bool allBlack = std::all_of(mask.rgb.begin(), mask.rgb.end(), [](std::uint8_t value) { return value == 0; });
    if (allBlack) throw render::SystemError(fmt::format("{} is black: no pixel would count", path));
    return mask;
}

std::string numbers(const render::PictureMetrics& metrics, int threshold) {
    std::string text =
        fmt::format("largest {}, {:.3f} % off by more than {}, mean {:.4f}, SSIM {:.5f}, PSNR {:.2f} dB",
                    metrics.largest, 100.0 * metrics.share(), threshold, metrics.mean, metrics.ssim, metrics.psnr());
    for (const render::PixelDifference& pixel : metrics.worst)
        text += fmt::format("\n    ({}, {}): {} {} {} instead of {} {} {}", pixel.x, pixel.y, pixel.actual[0],
                            pixel.actual[1], pixel.actual[2], pixel.expected[0], pixel.expected[1], pixel.expected[2]);
    return text;
}

std::string pictureText(const PictureResult& result) {
    const std::string rule = result.comparison ? fmt::format(" ({})", result.rule()) : "";
    std::string text = fmt::format("{}: {}{}\n", result.name, nameOf(result.status), rule);
    for (const std::string& reason : result.reasons) text += fmt::format("  {}\n", reason);
    if (result.comparison && result.comparison->metrics.differing > 0)
        text += fmt::format("  {}\n", numbers(result.comparison->metrics, result.limits.threshold));
    if (result.explanation) text += fmt::format("  {}\n", result.explanation->text);
    return text;
}

/// Whether the result of a picture is printed without --json: not if it passes, unless it or its state has changed.
bool isWorthPrinting(const PictureResult& result) {
    return !result.passed() || result.explanation;
}

/// Prints the result of one picture.
void printPicture(const CompareOptions& options, const PictureResult& result) {
    Json json = {{"event", "picture"}};
    json.update(resultJson(result));
    printResult(options.run, json, isWorthPrinting(result) ? pictureText(result) : "");
}

void printSummary(const CompareOptions& options, const CompareCounts& counts, const std::string& approval) {
    const auto count = [&](PictureStatus status) { return counts.of(status); };
    Json json = {{"event", "done"},
                 {"pictures", counts.pictures()},
                 {"identical", count(PictureStatus::identical)},
                 {"within_limits", count(PictureStatus::withinLimits)},
                 {"different", count(PictureStatus::different)},
                 {"missing", count(PictureStatus::missing)},
                 {"extra", count(PictureStatus::extra)},
                 {"unreadable", count(PictureStatus::unreadable)}};
    std::string text = fmt::format(
        "{} pictures: {} identical, {} within limits ({}), {} different, {} missing, {} without a golden, {} "
        "unreadable\n",
        counts.pictures(), count(PictureStatus::identical), count(PictureStatus::withinLimits), options.profile,
        count(PictureStatus::different), count(PictureStatus::missing), count(PictureStatus::extra),
        count(PictureStatus::unreadable));
    if (!options.report.empty())
        text += fmt::format("to look at them: {}\n", (fs::path(options.report) / "index.html").string());
    if (!approval.empty()) {
        json["approve"] = approval;
        text += fmt::format("to approve: {}\n", approval);
    }
    printResult(options.run, json, text);
}

bool canBeApproved(const PictureResult& result) {
    return result.status == PictureStatus::different || result.status == PictureStatus::extra;
}

/// Makes sure that the reports replace nothing that is compared or that says where a picture comes from.
void checkOutputs(const CompareOptions& options) {
    CommandFiles files;
    if (!options.mask.empty()) files.inputs.emplace_back(options.mask);
    for (const std::string& side : {options.actual, options.expected}) {
        files.inputs.emplace_back(side);
        for (const auto& [name, picture] : picturesOf(side).pictures)
            for (const fs::path& input : {picture, sidecarPath(picture), picture.parent_path() / "manifest.json",
                                          picture.parent_path() / "run.json"})
                files.inputs.push_back(input);
    }
    if (!options.junit.empty()) files.outputs.push_back({"--junit", options.junit});
    if (!options.report.empty())
        files.folders = {
            {"--report", options.report, [](const fs::path& file) { return file.filename() == "index.html"; }},
            {"--report", fs::path(options.report) / kReportPictures,
             [](const fs::path& file) { return hasExtension(file, ".png"); }}};
    requireSeparate(files);
}

void compareAll(const CompareOptions& options) {
    checkOutputs(options);
    const InterruptWatch watch;
    const auto endIfInterrupted = [&] {
        if (watch.signal() != 0) throw ExitStatus(kSignalExitBase + watch.signal(), "");
    };
    const CompareJob job{.actual = options.actual,
                         .expected = options.expected,
                         .limits = limitsOf(options),
                         .mask = readMask(options.mask),
                         .whileWaiting = endIfInterrupted,
                         .isStrictForSameDriver = !hasOwnLimits(options)};
    // Opened first, so that a report that cannot be written is known before the pictures are compared.
    std::optional<render::AtomicFile> junitFile;
    if (!options.junit.empty()) {
        createFolderOf(options.junit);
        junitFile.emplace(options.junit);
    }
    if (!options.report.empty()) createFolder(options.report);
    JunitReport junit;
    ComparePage page;
    std::vector<std::string> failed;
    const bool isShown = options.run.verbosity() == Verbosity::normal;  // JSON has a line for each picture
    std::optional<Progress> progress(std::in_place, "compare", 0, isShown ? Verbosity::normal : Verbosity::quiet);
    const CompareCounts counts = comparePictures(job, [&](const PictureResult& result) {
        if (isWorthPrinting(result)) progress->hide();
        if (canBeApproved(result)) failed.push_back(result.name);
        printPicture(options, result);
        if (junitFile) junit.add(result);
        if (!options.report.empty())
            page.add(result, canBeApproved(result) ? approvalLine(options.actual, options.expected, {result.name})
                                                   : std::string{});
        progress->frameDone(0, 0.0);
    });
    progress->hide();
    progress.reset();
    const std::string approval = approvalLine(options.actual, options.expected, failed);
    if (junitFile) {
        const std::string text = junit.text(counts);
        junitFile->write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
        junitFile->commit();
    }
    if (!options.report.empty()) {
        page.write(options.report, job, {options.profile, counts, approval});
    }
    printSummary(options, counts, approval);
    flushStandardOutput();
    if (counts.of(PictureStatus::unreadable) > 0) throw ExitStatus(kTrouble, "");
    if (counts.failed() > 0) throw ExitStatus(kDifferent, "");
}

void compareOrTrouble(const CompareOptions& options) {
    try {
        compareAll(options);
    } catch (const ExitStatus&) {
        throw;
    } catch (const std::bad_alloc& error) {
        throw ExitStatus(kTrouble, memoryMessage(error, "comparing pictures", "compare smaller pictures"));
    } catch (const std::exception& error) {
        throw ExitStatus(kTrouble, error.what());
    }
}

void addLimits(CLI::App& command, CompareOptions& options) {
    command
        .add_option(
            "--profile", options.profile,
            "strict: the same bytes; vendor: the last bits of another OpenGL driver; renderer: what OpenGL draws "
            "otherwise than the CPU; loose: the same at a glance")
        ->check(CLI::IsMember({"strict", "vendor", "renderer", "loose"}))
        ->capture_default_str();
    command.add_option("--threshold", options.threshold, "a pixel is noticeable when a channel is off by more")
        ->check(CLI::Range(0, 255));
    command.add_option("--max-share", options.sharePercent, "how many pixels may be noticeable, in percent")
        ->check(numberFrom(0.0, 100.0));
    command.add_option("--max-difference", options.largest, "how far any channel may be off")
        ->check(CLI::Range(0, 255));
    command.add_option("--max-mean", options.mean, "mean difference over all channels, at most")
        ->check(numberFrom(0.0, 255.0));
    command.add_option("--min-ssim", options.ssim, "structural similarity, at least")->check(numberFrom(-1.0, 1.0));
    for (const char* flag : {"--profile", "--threshold", "--max-share", "--max-difference", "--max-mean", "--min-ssim"})
        options.limitFlags.push_back(command.get_option(flag));
}

}  // namespace

void addCompareCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand(
        "compare", "pictures against what they should be; exit code 0 same, 1 different, 2 trouble");
    const auto options = std::make_shared<CompareOptions>();
    command.add_option("ACTUAL", options->actual, "a PNG, a folder of PNGs, or a video")->required();
    command.add_option("EXPECTED", options->expected, "the golden one, or their folder")->required();
    addLimits(command, *options);
    command.add_option("--mask", options->mask, "a PNG whose black pixels do not count")->type_name("FILE.png");
    command.add_option("--report", options->report, "also write DIR/index.html, a page to look at everything")
        ->type_name("DIR");
    command.add_option("--junit", options->junit, "also write the results for CI systems")->type_name("FILE.xml");
    command.add_flag("--json", options->run.json, "results as JSON, one object a line");
    command.add_flag("--quiet", options->run.quiet, "only the exit code");
    command.footer(
        "Without --profile and limits, pictures that the same OpenGL driver drew must be the same bytes.\n"
        "Example: globular compare out/liquid golden/liquid --report out/report");
    command.callback([options] { compareOrTrouble(*options); });
}

}  // namespace tools
