// The page of `globular figures`: a section for each figure.
#include "tools/pages/figures_page.h"

#include <fmt/format.h>

#include "tools/pages/html.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

std::string inlineFile(const std::string& type, const std::string& path) {
    return dataUri(type, readFile(path));
}

std::string parameterTable(const FigureEntry& figure) {
    std::vector<Cells> rows;
    for (const auto& [key, value] : figure.parameters) rows.push_back({key, value});
    return htmlTable({{"key", "value"}, rows});
}

std::string section(const FigureEntry& figure) {
    return fmt::format(
        "<section><h2>{}</h2>\n<p>{}</p>\n<p><code>{}</code></p>\n<div class=\"row\">\n"
        "<figure><img alt=\"Figure {}\" src=\"{}\"><figcaption>Still at {} s</figcaption></figure>\n"
        "<figure><video controls loop muted src=\"{}\"></video><figcaption>The whole animation</figcaption></figure>\n"
        "</div>\n<figure><img alt=\"Figure {} at several times\" src=\"{}\">"
        "<figcaption>At {} s</figcaption></figure>\n<p>Again: <code>{}</code>; state of the last frame "
        "<code>{}</code></p>\n"
        "<details><summary>All parameters</summary>\n{}</details></section>\n",
        escaped(figure.title), escaped(figure.description), escaped(figure.constants), figure.number,
        inlineFile("image/png", figure.stillPath), figure.stillTime, inlineFile("video/mp4", figure.videoPath),
        figure.number, inlineFile("image/png", figure.stripPath), fmt::join(figure.stripTimes, ", "),
        escaped(figure.command), figure.stateHash, parameterTable(figure));
}

}  // namespace

std::string figuresPage(const std::vector<FigureEntry>& figures) {
    std::string body =
        "<p>The figures of &ldquo;Exploration of Globular Dynamic Particle Systems&rdquo; (J. Cote), simulated and "
        "drawn "
        "anew by globular.</p>\n";
    for (const FigureEntry& figure : figures) body += section(figure);
    return htmlPage("Globular dynamics: the figures", body);
}

}  // namespace tools
