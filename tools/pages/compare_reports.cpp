// Turns results into JSON, which goes into the page's template, and into JUnit's XML, where each picture is a test
// case.
#include "tools/pages/compare_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <regex>
#include <string_view>

#include "render/compare/compare.h"
#include "render/output/png.h"
#include "tools/compare/picture_set.h"
#include "tools/pages/html.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

using Png = std::vector<std::uint8_t>;

Png pngOf(const PictureSide& side) {
    return side.bytes.empty() ? render::encodePng(*side.image) : side.bytes;
}

/// The pictures of a comparison under the names that the script of the page uses.
std::map<std::string, Png> imagesOf(const PictureResult& result) {
    std::map<std::string, Png> images;
    if (result.actual.image) images["actual"] = pngOf(result.actual);
    if (result.expected.image) images["expected"] = pngOf(result.expected);
    if (!result.comparison || result.comparison->rule == render::CompareRule::size ||
        result.comparison->metrics.differing == 0)
        return images;
    images["difference"] = render::encodePng(render::differenceImage(*result.actual.image, *result.expected.image));
    images["heat"] = render::encodePng(render::heatMap(*result.actual.image, *result.expected.image));
    return images;
}

/// Removes the pictures that an earlier report has left.
void removePictures(const fs::path& files) {
    static const std::regex pattern("[0-9]{5,}-(actual|expected|difference|heat)\\.png");
    std::error_code error;
    std::vector<fs::path> old;
    for (fs::directory_iterator file(files, error), end; !error && file != end; file.increment(error))
        if (std::regex_match(file->path().filename().string(), pattern)) old.push_back(file->path());
    for (const fs::path& path : old) fs::remove(path, error);
    fs::remove(files, error);  // fails if it holds something else
}

/// JSON as the text of an HTML script element. The character < is escaped, so that nothing can end the element early.
std::string scriptJson(const Json& json) {
    const std::string raw = compactText(json);
    std::string text;
    text.reserve(raw.size());
    for (const char c : raw) {
        if (c == '<')
            text += "\\u003c";
        else
            text += c;
    }
    return text;
}

/// The template of a page with each @NAME@ replaced by the value of that name.
std::string fillTemplate(std::string_view page, const std::map<std::string, std::string>& values) {
    std::string text;
    while (!page.empty()) {
        const std::size_t open = page.find('@');
        text += page.substr(0, open);
        if (open == std::string_view::npos) break;
        const std::size_t close = page.find('@', open + 1);
        text += values.at(std::string(page.substr(open + 1, close - open - 1)));
        page.remove_prefix(close + 1);
    }
    return text;
}

Json headingJson(const CompareJob& job, const PageHeading& heading) {
    const render::CompareLimits& limits = job.limits;
    return {{"actual", job.actual.string()},
            {"expected", job.expected.string()},
            {"profile", heading.profile},
            {"version", GLOBULAR_VERSION},
            {"limits",
             {{"threshold", limits.threshold},
              {"share", limits.share},
              {"largest", limits.largest},
              {"mean", limits.mean},
              {"ssim", limits.ssim}}},
            {"counts", {{"pictures", heading.counts.pictures()}, {"failed", heading.counts.failed()}}},
            {"approve", heading.approval}};
}

/// A text as an attribute of an XML element. Bytes that are not UTF-8, surrogates among them, become U+FFFD, and the
/// control characters and noncharacters that XML 1.0 cannot express, question marks.
std::string attribute(const std::string& bytes) {
    std::string text = Json::parse(compactText(bytes)).get<std::string>();
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20) c = '?';
    for (const std::string_view noncharacter : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})  // U+FFFE and U+FFFF
        for (std::size_t at = 0; (at = text.find(noncharacter, at)) != std::string::npos;)
            text.replace(at, noncharacter.size(), "?");
    return escaped(text);
}

}  // namespace

void ComparePage::add(const PictureResult& result, const std::string& approval) {
    Json json = resultJson(result);
    json["approve"] = approval;
    addRun(result.actual, json["actual"]);
    addRun(result.expected, json["expected"]);
    const bool isOtherSize = result.comparison && result.comparison->rule == render::CompareRule::size;
    const double difference = isOtherSize         ? std::numeric_limits<double>::infinity()
                              : result.comparison ? result.comparison->metrics.mean
                                                  : 0.0;
    entries_.push_back({result.status, difference, std::move(json)});
}

std::vector<ComparePage::Entry*> ComparePage::worst() {
    std::vector<Entry*> worst;
    for (Entry& entry : entries_)
        if (entry.status != PictureStatus::identical) worst.push_back(&entry);
    std::stable_sort(worst.begin(), worst.end(), [](const Entry* a, const Entry* b) {
        return a->status != b->status ? a->status < b->status : a->difference > b->difference;
    });
    worst.resize(std::min(worst.size(), kMostShown));
    return worst;
}

void ComparePage::addPictures(const fs::path& folder, CompareJob job) {
    const fs::path files = folder / kReportPictures;
    removePictures(files);
    std::map<std::string, Entry*> shown;
    for (Entry* entry : worst()) {
        shown[entry->json["name"].get<std::string>()] = entry;
        job.only.insert(entry->json["name"].get<std::string>());
    }
    if (shown.empty()) return;
    createFolder(files);
    try {
        comparePictures(job, [&](const PictureResult& result) {
            Entry& entry = *shown.at(result.name);
            for (const auto& [kind, png] : imagesOf(result)) {
                const std::string name = fmt::format("{:05}-{}.png", &entry - entries_.data(), kind);
                writeFile(files / name, png);
                entry.json["images"][kind] = fmt::format("{}/{}", kReportPictures, name);
            }
        });
    } catch (...) {
        removePictures(files);  // no page refers to them
        throw;
    }
}

void ComparePage::write(const fs::path& folder, const CompareJob& job, const PageHeading& heading) {
    createFolder(folder);
    // The pictures of an earlier report are replaced one by one. Its page must not outlive them.
    std::error_code ignored;
    fs::remove(folder / "index.html", ignored);
    addPictures(folder, job);
    writeFile(folder / "index.html", html(job, heading));
}

void ComparePage::addRun(const PictureSide& side, Json& json) {
    if (side.bytes.empty()) return;
    const fs::path path = side.path.parent_path() / "run.json";
    auto known = runs_.find(path.string());
    if (known == runs_.end()) known = runs_.emplace(path.string(), readJson(path)).first;
    if (!known->second.is_null()) json["run"] = path.string();
}

std::string ComparePage::html(const CompareJob& job, const PageHeading& heading) {
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry& a, const Entry& b) { return a.status < b.status; });
    Json data = headingJson(job, heading);
    data["runs"] = runs_;
    data["pictures"] = Json::array();
    for (Entry& entry : entries_) data["pictures"].push_back(std::move(entry.json));
    entries_.clear();
    return fillTemplate(embeddedText("compare.html"), {{"STYLE", std::string(embeddedText("compare.css"))},
                                                       {"SCRIPT", std::string(embeddedText("compare.js"))},
                                                       {"DATA", scriptJson(data)}});
}

void JunitReport::add(const PictureResult& result) {
    cases_ += fmt::format("  <testcase classname=\"globular.compare\" name=\"{}\"", attribute(result.name));
    if (result.passed()) {
        cases_ += "/>\n";
        return;
    }
    const char* tag = result.status == PictureStatus::unreadable ? "error" : "failure";
    cases_ += fmt::format(">\n    <{} type=\"{}\" message=\"{}\">", tag, attribute(result.rule()),
                          attribute(result.reasons.front()));
    for (const std::string& reason : result.reasons) cases_ += attribute(reason) + "\n";
    if (result.explanation) cases_ += attribute(result.explanation->text) + "\n";
    cases_ += fmt::format("</{}>\n  </testcase>\n", tag);
}

std::string JunitReport::text(const CompareCounts& counts) const {
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<testsuite name=\"globular compare\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n{}</testsuite>\n",
        counts.pictures(), counts.failed() - counts.of(PictureStatus::unreadable), counts.of(PictureStatus::unreadable),
        cases_);
}

}  // namespace tools
