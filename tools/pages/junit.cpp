// One test case for each picture. Failures are differences, errors are pictures that cannot be read.
#include "tools/pages/junit.h"

#include <fmt/format.h>

#include "tools/pages/html.h"
#include "tools/system/json.h"

namespace tools {
namespace {

/// A text as an attribute. Control characters become question marks, because XML 1.0 cannot express them.
std::string attribute(const std::string& bytes) {
    std::string text = utf8(bytes);
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20) c = '?';
    return escaped(text);
}

}  // namespace

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
