// Both forms are made of the same texts: facts about a run, and sentences of the scene file.
#include "tools/pages/gallery_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "render/output/video.h"
#include "tools/pages/html.h"

namespace tools {
namespace {

/// A number with commas between thousands.
std::string grouped(std::size_t number) {
    std::string text = std::to_string(number);
    for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
    return text;
}

/// What produced the numbers of a run, such as "2 threads with AVX2".
std::string machineOf(const GalleryRun& run) {
    return fmt::format("{} {} with {}{}{}", run.threads, run.threads == 1 ? "thread" : "threads", run.instructionSet,
                       run.processor.empty() ? "" : " on ", run.processor);
}

std::set<std::string> machinesOf(const std::vector<GalleryGroup>& groups) {
    std::set<std::string> machines;
    for (const GalleryGroup& group : groups)
        for (const GalleryEntry& entry : group.entries)
            if (entry.run) machines.insert(machineOf(*entry.run));
    return machines;
}

/// The sentence about births and deaths; empty for a scene in which nothing dies.
std::string turnoverOf(const GalleryRun& run) {
    if (run.deaths == 0) return "";
    return fmt::format(" {} particles were born, {} left the world.", grouped(run.births), grouped(run.deaths));
}

/// The numbers of a scene in one line.
std::string factsOf(const GalleryEntry& entry, const GalleryRun& run) {
    return fmt::format("{} particles, {} s of animation, {} steps. Made in {:.1f} s.{}", grouped(run.particles),
                       entry.duration, grouped(run.steps), run.seconds, turnoverOf(run));
}

std::string statusOf(const GalleryEntry& entry) {
    if (!entry.failure.empty()) return fmt::format("<p class=\"bad\">Not drawn: {}</p>\n", escaped(entry.failure));
    return "<p>Not drawn yet.</p>\n";
}

/// The film as HTML. A video does not load before it is played. A picture that moves stands still for who asks the
/// browser for less motion.
std::string film(const GalleryEntry& entry) {
    const auto kind = render::videoKindOf(entry.filmName);
    const std::string name = escaped(entry.filmName);
    const std::string still = escaped(entry.stillName);
    if (kind == render::VideoKind::mp4 || kind == render::VideoKind::mkv || kind == render::VideoKind::webm)
        return fmt::format(
            "<video controls loop muted playsinline preload=\"none\" poster=\"{}\" src=\"{}\"></video>\n", still, name);
    return fmt::format(
        "<picture><source media=\"(prefers-reduced-motion: reduce)\" srcset=\"{}\">"
        "<img loading=\"lazy\" alt=\"{}\" src=\"{}\"></picture>\n",
        still, escaped(entry.title), name);
}

std::string lookTable(const GalleryEntry& entry) {
    if (entry.look.empty()) return "";
    std::vector<Cells> rows;
    for (const auto& [key, value] : entry.look) rows.push_back({key, value});
    return fmt::format("<details><summary>Look</summary>\n{}</details>\n", htmlTable({{"key", "value"}, rows}));
}

/// Markdown without the backquotes around code.
std::string plainText(std::string markdown) {
    std::erase(markdown, '`');
    return markdown;
}

std::string card(const GalleryEntry& entry) {
    std::string html = fmt::format("<section id=\"{}\">\n<h3>{}</h3>\n", escaped(entry.name), escaped(entry.title));
    html += entry.run ? film(entry) : statusOf(entry);
    if (!entry.description.empty()) html += fmt::format("<p>{}</p>\n", escaped(plainText(entry.description)));
    html += fmt::format("<p><code>{}</code></p>\n", escaped(entry.command));
    if (entry.run)
        html += fmt::format(
            "<p class=\"facts\">{}</p>\n<p class=\"facts\"><a href=\"{}\">Still</a> &middot; "
            "<a href=\"{}\">Scene file</a></p>\n",
            escaped(factsOf(entry, *entry.run)), escaped(entry.stillName), escaped(entry.textName));
    html += lookTable(entry);
    html += fmt::format("<details><summary>Scene</summary>\n<pre>{}</pre></details>\n", escaped(entry.text));
    return html + "</section>\n";
}

std::string markdownSection(const GalleryEntry& entry, const std::string& level) {
    std::string text = fmt::format("{} {}\n\n", level, entry.title);
    if (entry.run) text += fmt::format("![{}]({})\n\n", entry.title, entry.stillName);
    if (!entry.description.empty()) text += entry.description + "\n\n";
    text += fmt::format("    {}\n\n", entry.command);
    const std::string link = fmt::format("[Scene file](../scenes/library/{}.toml)", entry.name);
    if (entry.run) return text + fmt::format("{} {}.\n\n", factsOf(entry, *entry.run), link);
    return text +
           fmt::format("{} {}.\n\n", entry.failure.empty() ? "Not drawn yet." : "Not drawn: " + entry.failure, link);
}

}  // namespace

std::string galleryPage(const std::vector<GalleryGroup>& groups) {
    std::string body =
        "<p>Times are those of the whole command by the clock on the wall: simulating, drawing and encoding.</p>\n";
    if (const auto machines = machinesOf(groups); !machines.empty())
        body += fmt::format("<p>Measured with {}.</p>\n", escaped(fmt::format("{}", fmt::join(machines, "; "))));
    for (const GalleryGroup& group : groups) {
        if (group.entries.empty()) continue;
        if (!group.heading.empty()) body += fmt::format("<h2>{}</h2>\n", escaped(group.heading));
        if (!group.text.empty()) body += fmt::format("<p>{}</p>\n", escaped(plainText(group.text)));
        body += "<div class=\"cards\">\n";
        for (const GalleryEntry& entry : group.entries) body += card(entry);
        body += "</div>\n";
    }
    return htmlPage("globular gallery", body);
}

std::string galleryMarkdown(const std::vector<GalleryGroup>& groups, const std::string& command) {
    std::string text = fmt::format(
        "# Gallery\n\nBuilt-in scenes: what each shows, how many particles it has at most, how long the animation is, "
        "and how "
        "long the\ncommand took, from the first step to the end of the video. Measured with {}.\n\n    {}\n\n"
        "prints this page; the stills are drawn in the best quality.\n\n",
        fmt::join(machinesOf(groups), "; "), command);
    for (const GalleryGroup& group : groups) {
        if (group.entries.empty()) continue;
        if (!group.heading.empty()) text += fmt::format("## {}\n\n", group.heading);
        if (!group.text.empty()) text += group.text + "\n\n";
        for (const GalleryEntry& entry : group.entries)
            text += markdownSection(entry, group.heading.empty() ? "##" : "###");
    }
    text.pop_back();  // the empty line at the end
    return text;
}

}  // namespace tools
