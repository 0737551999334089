// HTML by hand: two plots, two tables.
#include "tools/pages/pictures_page.h"

#include <fmt/format.h>

#include "tools/pages/html.h"

namespace tools {
namespace {

constexpr const char* kPicturesTitle = "globular: what pictures cost and how exact they are";

constexpr const char* kPicturesStyle = R"(body { max-width: 80rem; }
th, td { padding: 0.2rem 0.6rem; text-align: right; }
)";

std::string milliseconds(double seconds) {
    return seconds == 0.0 ? "" : fmt::format("{:.3g}", 1e3 * seconds);
}

Cells subjectOf(const studies::PictureRow& row) {
    return {studies::nameOf(row.style), fmt::format("{}", row.particles),
            fmt::format("{} x {}", row.size.width, row.size.height), studies::nameOf(row.quality)};
}

std::string timeTable(const std::vector<studies::PictureRow>& rows) {
    std::vector<Cells> table_;
    for (const studies::PictureRow& row : rows) {
        Cells cells = subjectOf(row);
        const render::DrawTimes& t = row.stages;
        for (const double seconds :
             {t.bin, t.occlusion, t.shadow, t.cast, t.color, t.openGl, t.readBack, row.png, row.mp4, row.mp4Once,
              row.draw, row.atRest, row.withPng, row.withMp4, row.baseline, row.atRestBaseline, row.fewestBaseline})
            cells.push_back(milliseconds(seconds));
        cells.push_back(fmt::format("{:.2f}", row.ratio()));
        cells.push_back(fmt::format("{:.2f}", row.ratioAtRest()));
        cells.push_back(fmt::format("{:.2f}", row.ratioToFewest()));
        table_.push_back(cells);
    }
    return table({"style",
                  "particles",
                  "size",
                  "quality",
                  "bin",
                  "occlusion",
                  "shadow",
                  "cast",
                  "color",
                  "OpenGL",
                  "read back",
                  "PNG",
                  "MP4",
                  "MP4, once",
                  "frame",
                  "at rest",
                  "with PNG",
                  "with MP4",
                  "quads",
                  "quads at rest",
                  "fewest quads",
                  "frame over quads",
                  "at rest over quads",
                  "frame over fewest quads"},
                 table_);
}

std::string errorTable(const std::vector<studies::PictureRow>& rows) {
    std::vector<Cells> table_;
    for (const studies::PictureRow& row : rows) {
        Cells cells = subjectOf(row);
        cells.push_back(fmt::format("{:.2f}", row.error.rmse));
        cells.push_back(fmt::format("{:.5f}", row.error.ssim));
        cells.push_back(fmt::format("{:.4f} %", 100.0 * row.error.wrongHits));
        cells.push_back(fmt::format("{:.2g}", row.error.depth));
        cells.push_back(fmt::format("{:.2g}", row.error.normal));
        cells.push_back(fmt::format("{}", row.error.pixels));
        table_.push_back(cells);
    }
    return table({"style", "particles", "size", "quality", "RMSE, steps of 255", "SSIM", "wrong hits", "depth, radii",
                  "normal, degrees", "pixels compared"},
                 table_);
}

std::string flickerTable(const std::vector<studies::FlickerRow>& rows) {
    std::vector<Cells> table_;
    for (const studies::FlickerRow& row : rows)
        table_.push_back({studies::nameOf(row.style), fmt::format("{}", row.particles),
                          fmt::format("{}x{}", row.size.width, row.size.height), studies::nameOf(row.quality),
                          fmt::format("{:.3f}", row.change), fmt::format("{:.3f}", row.jerk)});
    return table({"style", "particles", "size", "quality", "change", "jerk"}, table_);
}

std::string skinTable(const std::vector<studies::SmoothingRow>& rows) {
    std::vector<Cells> table_;
    for (const studies::SmoothingRow& row : rows)
        table_.push_back({studies::nameOf(row.skin), fmt::format("{}", row.particles), milliseconds(row.draw),
                          fmt::format("{:.3f}", row.volume), fmt::format("{:.3f}", row.lone),
                          fmt::format("{:.2f}", row.bumps)});
    return table({"skin", "particles", "frame", "volume", "lone volume", "bumps, degrees"}, table_);
}

}  // namespace

std::string picturesPage(const PictureResults& results, const PicturePlots& plots, const std::string& command) {
    const std::vector<studies::PictureRow>& rows = results.rows;
    std::string html = studyHead(kPicturesTitle, kPicturesStyle);
    html += fmt::format(
        "<p>Made by <code>{}</code>. A dam that splashes, as many particles as the table says, in its full look. "
        "<em>Frame</em> is drawing and reading back; <em>quads</em> is what one would write first, a quad that faces "
        "the eye for each sphere, with its depth written by the fragment shader, lit and nothing else, drawn in the "
        "same run. The camera moves from frame to frame, but <em>at rest</em> only the particles do, and the plain "
        "parts of the picture are kept. Bin, occlusion and shadow run side by side, so that together they may take "
        "longer than the frame. <em>With PNG</em> and <em>with MP4</em> are milliseconds a frame of a run in which one "
        "frame is encoded while the next is drawn. <em>MP4, once</em> is what a video takes besides its frames, for "
        "the "
        "encoder to start and to end; it is in no other column. Stages, frames and quads are medians, PNG is a mean of "
        "three, MP4 and what is drawn with encoding are means over a run.</p>\n",
        escaped(command));
    html += picture("milliseconds a frame against particles", plots.times) + timeTable(rows);
    html +=
        "<h2>Error</h2>\n<p>Against a ray caster in double precision, in windows spread evenly over the picture; depth "
        "and normal are means over the right hits on particles.</p>\n";
    html += picture("error against milliseconds", plots.errors) + errorTable(rows);
    html +=
        "<h2>Steadiness</h2>\n<p>A still scene while the camera moves an eighth of a pixel a frame: RMSE in steps of "
        "255 between one frame and the next (<em>change</em>), and between one such difference and the next "
        "(<em>jerk</em>: what flickers rather than moves).</p>\n" +
        flickerTable(results.flicker);
    html +=
        "<h2>Skins of metaballs</h2>\n<p>Frames of normal quality; the volume within the surface of a level pool over "
        "its "
        "particles' cells, and within that of a particle alone over its sphere; the tilt of the pool's normals, "
        "RMS.</p>\n" +
        skinTable(results.smoothing);
    return html + "</body></html>\n";
}

}  // namespace tools
