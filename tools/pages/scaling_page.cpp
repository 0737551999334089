// HTML by hand: plot, Table 2 and beyond, exponents, the peer.
#include "tools/pages/scaling_page.h"

#include <fmt/format.h>

#include "tools/pages/html.h"

namespace tools {
namespace {

constexpr const char* kScalingTitle = "globular: time against the number of particles";

constexpr const char* kScalingStyle = R"(body { max-width: 70rem; }
th, td { padding: 0.2rem 0.7rem; text-align: left; }
)";

std::string milliseconds(const std::optional<double>& seconds) {
    return seconds ? fmt::format("{:.4g}", 1e3 * *seconds) : "";
}

std::string scalingTable(const std::vector<studies::ScalingRow>& rows) {
    std::vector<Cells> cells;
    for (const studies::ScalingRow& row : rows)
        cells.push_back({row.subject, fmt::format("{}", row.particles), fmt::format("{:.1f}", row.neighbors),
                         milliseconds(row.published), milliseconds(row.everyPair), milliseconds(row.list),
                         milliseconds(row.listInFloat), row.stateHash});
    return table({"scene or material", "particles", "neighbors", "published, ms", "every pair, ms", "list, ms",
                  "list in float, ms", "state hash"},
                 cells);
}

std::string fitTable(const std::vector<studies::ScalingFit>& fits) {
    std::vector<Cells> cells;
    for (const studies::ScalingFit& fit : fits)
        cells.push_back({fit.subject, fit.method, fmt::format("{} to {}", fit.from, fit.to),
                         fmt::format("N^{:.2f}", fit.exponent)});
    return table({"scene or material", "method", "particles", "time grows like"}, cells);
}

std::string peerTable(const std::vector<studies::PeerRow>& peers) {
    std::vector<Cells> cells;
    for (const studies::PeerRow& row : peers)
        cells.push_back({row.name, fmt::format("{}", row.particles), fmt::format("{:.1f}", row.neighbors),
                         fmt::format("{:.2f}", 1e-6 * row.particleStepsPerSecond()), fmt::format("{:.2f}", row.ratio),
                         fmt::format("{:.2f}", row.ratioInFloat)});
    return table({"program and force", "particles", "neighbors", "million particle-steps a second",
                  "ours over it, in double", "in float"},
                 cells);
}

}  // namespace

std::string scalingPage(const ScalingResults& results, const std::string& plot, const std::string& command) {
    std::string html = studyHead(kScalingTitle, kScalingStyle);
    html += fmt::format(
        "<p>Made by <code>{}</code>. Milliseconds of one step: in the scenes of the paper's figures of 0.01 s, as the "
        "paper takes one for every frame, in face-centered cubic lattices of 0.002 s; medians of rounds that took "
        "turns. "
        "<em>Published</em> is Table 2 of the paper, with drawing, on its author's "
        "machine (GeForce RTX 4080, Ryzen 7 at 3.4 GHz). <em>Every pair</em> is the paper's method on this one, on one "
        "thread; <em>list</em> is ours. Hashes are of the state after the steps in double.</p>\n",
        escaped(command));
    html += picture("milliseconds a step against particles", plot) + scalingTable(results.rows);
    html += "<h2>How time grows</h2>\n" + fitTable(results.fits);
    if (!results.peerText.empty())
        html += fmt::format("<h2>Beside a peer</h2>\n<p>{}</p>\n", escaped(results.peerText));
    if (!results.peers.empty()) html += peerTable(results.peers);
    return html + "</body></html>\n";
}

}  // namespace tools
