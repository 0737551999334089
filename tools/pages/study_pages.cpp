// The pages of `globular study`. Tables that a study also writes as a CSV file are made from that file's text, so that
// both have the same columns.
#include "tools/pages/study_pages.h"

#include <fmt/format.h>

#include "engine/stepping/take_step.h"
#include "studies/stability/stability.h"
#include "tools/pages/html.h"

namespace tools {
namespace {

/// The table in a CSV text as HTML.
/// @param skippedColumns  how many columns on the left are left out
std::string csvHtml(const std::string& csv, std::size_t skippedColumns = 0) {
    return htmlTable(parseCsv(csv, skippedColumns));
}

std::string referenceText(const studies::SceneAccuracy& accuracy) {
    const studies::ReferenceFacts& facts = accuracy.reference;
    return fmt::format(
        "<p>{} particles, {:g} s of motion from {:.4g} s on; every run starts from the same state. Reference: {} at "
        "{:.4g} &micro;s, {:.3g} s; the last halving of its step changed it by {:.1e} radii{}. Errors below {:.1e} "
        "radii are not told from its own. Twins that begin 1e-9 radii apart end {:.1e} radii apart{}: errors are "
        "measured in {}.</p>\n",
        accuracy.particleCount, accuracy.window, accuracy.from, engine::nameOf(facts.variant.stepper),
        1e6 * facts.variant.asked, facts.seconds, facts.change,
        facts.settled ? "" : ", more than a twentieth of the smallest error (budget spent)", facts.resolution,
        facts.twinSeparation, facts.birthsDiffer ? ", and even the finest runs have other births" : "",
        studies::nameOf(facts.metric));
}

std::string accuracySection(const AccuracySection& section) {
    const studies::SceneAccuracy& accuracy = section.accuracy;
    return fmt::format("<section><h2>{}: {}</h2>\n", escaped(accuracy.name), escaped(accuracy.title)) +
           referenceText(accuracy) + "<div class=\"row\">\n" + svgImage("error against seconds", section.secondsPlot) +
           svgImage("error against force evaluations", section.evaluationsPlot) +
           "</div>\n<h3>auto against the best hand-picked stepper and step</h3>\n" +
           csvHtml(studies::autosCsv({accuracy}), 1) + "<h3>Orders</h3>\n" +
           csvHtml(studies::ordersCsv({accuracy}), 1) + "<details><summary>All runs</summary>\n" +
           csvHtml(studies::accuracyCsv({accuracy}), 1) + "</details></section>\n";
}

std::string accuracyText(const AccuracyRun& run) {
    return fmt::format(
        "<p><code>{}</code>, {} thread{}. Seconds are wall clock, {}. Costs in force evaluations include the implicit "
        "steppers' matrix-vector products, each at the share of an evaluation that the plots state, and all trial runs "
        "of "
        "the automatic stepper. It begins the window as in a run that has got there, with the stepper, the steps and "
        "the calibrations of a run of its own at the same error. Its trial runs are some dozens of frames apart, so "
        "that a short window holds none or one that costs nearly as much as itself: its evaluations and its seconds "
        "are charged with the share that these runs have of the scene from its start to the end of the window. Whole "
        "scenes, in which nothing is charged by share, are measured with --whole. The cost of "
        "a hand-picked stepper at an error is read off its line in the plot, log-linear between its points; the best "
        "is the cheapest of all fixed steppers. Drifts are differences from the reference "
        "at the end: of the energy, over the reference's kinetic energy and the sizes of its pair and contact "
        "energies; of the momenta, over its sums of |p| and of |x &times; p|. The same numbers are in accuracy.csv, "
        "orders.csv, auto.csv and references.csv.</p>\n",
        escaped(run.command), run.threads, run.threads == 1 ? "" : "s",
        run.isTimedOnce ? "each run timed once"
                        : "the least of three rounds for runs below 5 s, of up to twelve for short ones");
}

std::string peerTable(const std::vector<studies::PeerRow>& peers) {
    std::vector<Cells> cells;
    for (const studies::PeerRow& row : peers)
        cells.push_back({row.name, fmt::format("{}", studies::kPeerParticles),
                         fmt::format("{:.1f}", studies::kPeerNeighbors),
                         fmt::format("{:.2f}", 1e-6 * row.particleStepsPerSecond()), fmt::format("{:.2f}", row.ratio),
                         fmt::format("{:.2f}", row.ratioInFloat)});
    return htmlTable({{"program and force", "particles", "neighbors", "million particle-steps a second",
                       "ours over it, in double", "in float"},
                      cells});
}

std::string stabilitySummary(const std::vector<studies::CaseResult>& results) {
    std::vector<bool> isBad;
    for (const studies::CaseResult& result : results)
        isBad.push_back(!studies::oursPasses(result) || !studies::paperIsAsExpected(result));
    return htmlTable(stabilityTable(results), isBad);
}

std::string stabilitySection(const studies::CaseResult& result) {
    return fmt::format("<h2>{}. {}</h2>\n<p>{} <code>hard/{}</code></p>\n", result.study.number, escaped(result.name),
                       escaped(result.title), escaped(result.name)) +
           csvHtml(studies::stabilityCsv({result}), 2);
}

std::string glossary() {
    std::string html = "<h2>The observables</h2>\n<dl>\n";
    for (const scenes::ObservableInfo& info : scenes::observables())
        html += fmt::format("<dt><code>{}</code></dt><dd>{}</dd>\n", escaped(std::string(info.name)),
                            escaped(std::string(info.help)));
    return html + "</dl>\n";
}

}  // namespace

std::string accuracyPage(const std::vector<AccuracySection>& sections, const AccuracyRun& run) {
    std::string body = accuracyText(run);
    for (const AccuracySection& each : sections) body += accuracySection(each);
    return htmlPage("Globular dynamics: speed against error", body);
}

std::string wholePage(const std::vector<studies::WholeScene>& scenes, const AccuracyRun& run) {
    const std::string body =
        fmt::format(
            "<p><code>{}</code>, {} thread{}. {}</p>\n<p>Errors are root mean square distances in radii per second of "
            "motion, means over windows of 0.2 s that are spread over the run of the automatic stepper and compared "
            "with references that begin where the windows do. The reference's change is what the last halving of its "
            "step moved. A fixed stepper takes the cheapest step that divides a frame evenly and whose mean error over "
            "the same windows is at most the "
            "wanted one, over the whole scene; those that cost more than twice the best are left out. Costs are in "
            "force evaluations; those of the automatic stepper's trial runs are in a column of their own and in the "
            "sum. Seconds are wall clock, {}. The same numbers are in whole.csv, whole_steppers.csv, "
            "whole_windows.csv and whole_ladder.csv.</p>\n",
            escaped(run.command), run.threads, run.threads == 1 ? "" : "s", studies::wholeSentence(scenes),
            run.isTimedOnce ? "each run timed once" : "medians of three runs in turn, of one that takes over 5 s") +
        "<h2>auto against the best hand-picked stepper and step</h2>\n" + csvHtml(studies::wholeCsv(scenes)) +
        "<h2>Fixed steppers</h2>\n" + csvHtml(studies::wholeSteppersCsv(scenes)) +
        "<details><summary>All windows</summary>\n" + csvHtml(studies::wholeWindowsCsv(scenes)) +
        "</details>\n<details><summary>All steps of fixed steppers in the windows</summary>\n" +
        csvHtml(studies::wholeLadderCsv(scenes)) + "</details>\n";
    return htmlPage("Globular dynamics: the automatic stepper over whole scenes", body);
}

std::string picturesPage(const PictureResults& results, const std::string& command) {
    std::string body = fmt::format(
        "<p>Made by <code>{}</code>. {}. A dam that splashes, as many particles as the table says, in its full look. "
        "Both renderers draw every frame by turns. <em>Draw</em> is drawing and reading back. The camera moves from "
        "frame to frame, but <em>at rest</em> only the particles do. Bin, occlusion and shadow run side by side, so "
        "that together they may take longer than the frame. <em>Time ratio</em> and <em>RMSE ratio</em> are over the "
        "same picture on the CPU. <em>With PNG</em> and <em>with MP4</em> are milliseconds a frame of a run in which "
        "one frame is encoded while the next is drawn; encoding is measured with the pictures of the CPU's renderer "
        "alone. <em>MP4, once</em> is what a video takes besides its frames, for the encoder to start and to end; it "
        "is in no other column. Stages and frames are medians, PNG is a mean of three, MP4 and what is drawn with "
        "encoding are means over a run.</p>\n",
        escaped(command), escaped(results.openGl));
    body += svgImage("milliseconds a frame against particles", results.timesPlot);
    body +=
        "<h2>Error</h2>\n<p>Against a ray caster in double precision, in windows spread evenly over the picture; depth "
        "and normal are means over the right hits on particles.</p>\n";
    body += svgImage("error against milliseconds", results.errorsPlot) + csvHtml(studies::picturesCsv(results.rows));
    body +=
        "<h2>Looks</h2>\n<p>Metaballs in normal quality, with one more of what a look may have in each, and in final "
        "quality without and with blur; time ratio is over the look as it is.</p>\n" +
        csvHtml(studies::looksCsv(results.looks));
    body +=
        "<h2>Steadiness</h2>\n<p>A still scene while the camera moves an eighth of a pixel a frame: RMSE in steps of "
        "255 between one frame and the next (<em>change</em>), and between one such difference and the next "
        "(<em>jerk</em>: what flickers rather than moves).</p>\n" +
        csvHtml(studies::flickerCsv(results.flicker));
    body +=
        "<h2>Skins of metaballs</h2>\n<p>Frames of normal quality, drawn on the CPU; the volume within the surface of "
        "a "
        "level pool over its particles' cells, and within that of a particle alone over its sphere; the tilt of the "
        "pool's normals, RMS.</p>\n" +
        csvHtml(studies::smoothingCsv(results.smoothing));
    return htmlPage("globular: what pictures cost and how exact they are", body);
}

std::string meshesPage(const std::vector<studies::MeshRow>& rows, std::size_t particles, const std::string& command) {
    std::string body = fmt::format(
        "<p>Made by <code>{}</code>. The surface of metaballs of a dam break of {} particles as a mesh: the length of "
        "the cell, in particle radii; the size of the mesh and of its PLY file; the median time to make it; how far "
        "vertices and the middles of triangles are from the exact surface, by rays of the oracle along their normals; "
        "and the volume of the mesh of a level pool over its particles' cells.</p>\n",
        escaped(command), particles);
    body += csvHtml(studies::meshesCsv(rows));
    return htmlPage("globular: what meshes cost and how exact they are", body);
}

std::string scalingPage(const ScalingResults& results, const std::string& command) {
    std::string body = fmt::format(
        "<p>Made by <code>{}</code>. Milliseconds of one step: in the scenes of the paper's figures of 0.01 s, as the "
        "paper takes one for every frame, in face-centered cubic lattices of 0.002 s; medians of rounds that took "
        "turns. "
        "<em>Published</em> is Table 2 of the paper, with drawing, on its author's "
        "machine (GeForce RTX 4080, Ryzen 7 at 3.4 GHz). <em>Every pair</em> is the paper's method on this one, on one "
        "thread; <em>list</em> is ours. Hashes are of the state after the steps in double.</p>\n",
        escaped(command));
    body +=
        svgImage("milliseconds a step against particles", results.plot) + csvHtml(studies::scalingCsv(results.rows));
    body += "<h2>How time grows</h2>\n" + csvHtml(studies::fitsCsv(results.fits));
    if (!results.peerText.empty())
        body += fmt::format("<h2>Beside a peer</h2>\n<p>{}</p>\n", escaped(results.peerText));
    if (!results.peers.empty()) body += peerTable(results.peers);
    return htmlPage("globular: time against the number of particles", body);
}

Table stabilityTable(const std::vector<studies::CaseResult>& results) {
    Table table{studies::kStabilityColumns, {}};
    for (const studies::CaseResult& result : results) table.rows.push_back(studies::rowOf(result));
    return table;
}

std::string stabilityPage(const std::vector<studies::CaseResult>& results, const std::string& command) {
    std::string body = fmt::format(
        "<p>Made by <code>{}</code>. Each row shows the worst variant of a case: the paper's stepper (symplectic Euler "
        "at its published step, with its clamp of the distance) and ours, with the stepper that the scene names. "
        "Seconds and steps are ours.</p>\n",
        escaped(command));
    body += stabilitySummary(results);
    for (const studies::CaseResult& result : results) body += stabilitySection(result);
    return htmlPage("globular: the hard cases", body + glossary());
}

}  // namespace tools
