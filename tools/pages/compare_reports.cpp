// Turns results into JSON with the pictures as data URIs, which goes into the page's template, and into JUnit's XML,
// where each picture is a test case.
#include "tools/pages/compare_reports.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/compare/compare.h"
#include "render/output/png.h"
#include "tools/pages/html.h"
#include "tools/system/json.h"

namespace tools {
namespace {

std::vector<std::uint8_t> pngOf(const PictureSide& side) {
    return side.bytes.empty() ? render::encodePng(*side.image) : side.bytes;
}

/// The pictures of a comparison as data URIs, under the names that the script of the page uses.
Json imagesOf(const PictureResult& result) {
    Json images = Json::object();
    if (result.actual.image) images["actual"] = dataUri("image/png", pngOf(result.actual));
    if (result.expected.image && result.status != PictureStatus::identical)
        images["expected"] = dataUri("image/png", pngOf(result.expected));
    if (!result.comparison || result.comparison->rule == render::CompareRule::size ||
        result.comparison->metrics.differing == 0)
        return images;
    images["difference"] =
        dataUri("image/png", render::encodePng(render::differenceImage(*result.actual.image, *result.expected.image)));
    images["heat"] =
        dataUri("image/png", render::encodePng(render::heatMap(*result.actual.image, *result.expected.image)));
    return images;
}

std::size_t byteCount(const Json& images) {
    std::size_t bytes = 0;
    for (const auto& image : images) bytes += image.get_ref<const std::string&>().size();
    return bytes;
}

/// JSON as the text of an HTML script element. The character < is escaped, so that nothing can end the element early.
std::string scriptJson(const Json& json) {
    std::string text;
    for (const char c : compactText(json)) {
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

Json headingJson(const PageHeading& heading) {
    const render::CompareLimits& limits = heading.limits;
    return {{"actual", heading.actual},
            {"expected", heading.expected},
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

/// A text as an attribute of an XML element. Bytes that are not UTF-8 become U+FFFD, and control characters, which
/// XML 1.0 cannot express, question marks.
std::string attribute(const std::string& bytes) {
    std::string text = Json::parse(compactText(bytes)).get<std::string>();
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20) c = '?';
    return escaped(text);
}

}  // namespace

void ComparePage::add(const PictureResult& result, const std::string& approval) {
    Json json = resultJson(result);
    json["approve"] = approval;
    addRun(result.actual, json["actual"]);
    addRun(result.expected, json["expected"]);
    inlinePictures(result, json);
    entries_.push_back({result.status, std::move(json)});
}

void ComparePage::inlinePictures(const PictureResult& result, Json& json) {
    std::size_t& spent = result.passed() ? passedBytes_ : failedBytes_;
    if (spent > (result.passed() ? kPassedBytes : kFailedBytes)) return;
    Json images = imagesOf(result);
    spent += byteCount(images);
    json["images"] = std::move(images);
}

void ComparePage::addRun(const PictureSide& side, Json& json) {
    if (side.bytes.empty()) return;
    const std::filesystem::path path = side.path.parent_path() / "run.json";
    auto known = runs_.find(path.string());
    if (known == runs_.end()) known = runs_.emplace(path.string(), readJson(path)).first;
    if (!known->second.is_null()) json["run"] = path.string();
}

std::string ComparePage::html(const PageHeading& heading) const {
    std::vector<const Entry*> sorted;
    for (const Entry& entry : entries_) sorted.push_back(&entry);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Entry* a, const Entry* b) { return a->status < b->status; });
    Json data = headingJson(heading);
    data["runs"] = runs_;
    data["pictures"] = Json::array();
    for (const Entry* entry : sorted) data["pictures"].push_back(entry->json);
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
