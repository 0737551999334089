// HTML by hand: two templates.
#include "tools/pages/figures_page.h"

#include <fmt/format.h>

#include "tools/pages/html.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

constexpr const char* kFiguresHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Globular dynamics: the figures</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; margin: 0 auto; max-width: 76rem; padding: 2rem 1rem; color: #222; background: #f6f6f4; }
section { background: #fff; border: 1px solid #ddd; border-radius: 6px; margin: 2rem 0; padding: 1rem 1.5rem; }
.pictures { display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start; }
figure { margin: 0; flex: 1 1 22rem; }
img, video { width: 100%; background: #000; display: block; }
.strip { margin-top: 1rem; }
figcaption { color: #666; font-size: 0.85rem; margin-top: 0.3rem; }
table { border-collapse: collapse; font-size: 0.85rem; }
td { border-top: 1px solid #eee; padding: 0.1rem 1rem 0.1rem 0; vertical-align: top; }
code { background: #f0f0ec; padding: 0 0.2rem; }
</style></head><body>
<h1>Globular dynamics: the figures</h1>
<p>The figures of &ldquo;Exploration of Globular Dynamic Particle Systems&rdquo; (J. Cote), simulated and drawn anew by globular.</p>
)";

std::string inlined(const std::string& type, const std::string& path) {
    return dataUri(type, readFile(path));
}

std::string parameterTable(const FigureEntry& figure) {
    std::string rows;
    for (const auto& [key, value] : figure.parameters)
        rows += fmt::format("<tr><td><code>{}</code></td><td>{}</td></tr>\n", escaped(key), escaped(value));
    return "<table>\n" + rows + "</table>\n";
}

std::string section(const FigureEntry& figure) {
    return fmt::format(
        "<section><h2>{}</h2>\n<p>{}</p>\n<p><code>{}</code></p>\n<div class=\"pictures\">\n"
        "<figure><img alt=\"Figure {}\" src=\"{}\"><figcaption>Still at {} s</figcaption></figure>\n"
        "<figure><video controls loop muted src=\"{}\"></video><figcaption>The whole animation</figcaption></figure>\n"
        "</div>\n<figure class=\"strip\"><img alt=\"Figure {} at several times\" src=\"{}\">"
        "<figcaption>At {} s</figcaption></figure>\n<p>Again: <code>{}</code>; state of the last frame "
        "<code>{}</code></p>\n"
        "<details><summary>All parameters</summary>\n{}</details></section>\n",
        escaped(figure.title), escaped(figure.description), escaped(figure.constants), figure.number,
        inlined("image/png", figure.stillPath), figure.stillTime, inlined("video/mp4", figure.videoPath), figure.number,
        inlined("image/png", figure.stripPath), fmt::join(figure.stripTimes, ", "), escaped(figure.command),
        figure.stateHash, parameterTable(figure));
}

}  // namespace

std::string figuresPage(const std::vector<FigureEntry>& figures) {
    std::string html = kFiguresHead;
    for (const FigureEntry& figure : figures) html += section(figure);
    return html + "</body></html>\n";
}

}  // namespace tools
