// The results of the study of pictures as text: names, CSV tables and gnuplot scripts. See pictures.h.
#include <fmt/format.h>

#include "studies/common/report.h"
#include "studies/pictures/pictures.h"

namespace studies {
namespace {

/// gnuplot's style of a curve: the color shows the style, the point type the quality, and dashes are OpenGL's.
std::string curveStyle(render::Style style, render::Quality quality, RendererKind renderer) {
    const char* color = style == render::Style::spheres ? "#0072b2" : "#d55e00";
    const int point = quality == render::Quality::draft ? 6 : quality == render::Quality::normal ? 7 : 5;
    return fmt::format("linespoints pointtype {} pointsize 0.8 linewidth 1.5 linecolor rgb '{}' dashtype {}", point,
                       color, renderer == RendererKind::cpu ? 1 : 2);
}

/// Whether a picture has the size of the first picture in the table. Only pictures of this size are plotted.
bool hasFirstSize(const std::vector<PictureRow>& rows, const PictureRow& row) {
    return row.size.width == rows.front().size.width && row.size.height == rows.front().size.height;
}

/// A curve for each style, renderer and quality. point(row) returns a line of gnuplot data, "x y", for a picture.
template <typename Point>
std::vector<Curve> curvesOf(const std::vector<PictureRow>& rows, const Point& point) {
    std::vector<Curve> curves;
    for (const render::Style style : kStyles)
        for (const RendererKind renderer : kRendererKinds)
            for (const render::Quality quality : kQualities) {
                Curve curve{fmt::format("{}, {}, {}", nameOf(style), nameOf(quality), nameOf(renderer)),
                            curveStyle(style, quality, renderer)};
                for (const PictureRow& row : rows)
                    if (row.style == style && row.quality == quality && row.renderer == renderer &&
                        hasFirstSize(rows, row))
                        curve.points += point(row);
                curves.push_back(curve);
            }
    return curves;
}

constexpr const char* kSubjectColumns = "style,particles,width,height,quality,renderer";

/// The fields of a CSV line that say which picture was measured.
std::string subjectFields(const PictureSubject& subject) {
    return csvFields(nameOf(subject.style), subject.particles, subject.size.width, subject.size.height,
                     nameOf(subject.quality), nameOf(subject.renderer));
}

/// Fields of a CSV line with times in milliseconds, each after a comma.
std::string timeFields(std::initializer_list<double> seconds) {
    std::string fields;
    for (const double each : seconds) fields += fmt::format(",{:.4g}", 1e3 * each);
    return fields;
}

}  // namespace

const char* nameOf(RendererKind renderer) {
    return renderer == RendererKind::cpu ? "cpu" : "opengl";
}

const char* nameOf(render::Style style) {
    return style == render::Style::spheres ? "spheres" : "metaballs";
}

const char* nameOf(render::Quality quality) {
    return quality == render::Quality::draft ? "draft" : quality == render::Quality::normal ? "normal" : "final";
}

const char* nameOf(render::Skin skin) {
    if (skin == render::Skin::anisotropic) return "anisotropic";
    return skin == render::Skin::plain ? "plain" : "smooth";
}

std::string picturesCsv(const std::vector<PictureRow>& rows) {
    std::string csv =
        std::string(kSubjectColumns) +
        ",draw_ms,draw_at_rest_ms,bin_ms,occlusion_ms,shadow_ms,rays_ms,cast_ms,color_ms,upload_ms,read_back_ms,"
        "png_ms,mp4_ms,mp4_once_ms,with_png_ms,with_mp4_ms,time_ratio,rmse_ratio,rmse,ssim,wrong_hits,"
        "depth_error_radii,normal_error_degrees\n";
    for (const PictureRow& row : rows) {
        const render::DrawTimes& stages = row.moving.stages;
        csv += subjectFields(row) +
               timeFields({row.moving.draw, row.atRest.draw, stages.bin, stages.occlusion, stages.shadow, stages.rays,
                           stages.cast, stages.color, stages.upload, stages.readBack});
        if (const auto& encoding = row.encoding)
            csv += timeFields({encoding->png, encoding->mp4, encoding->mp4Once, encoding->withPng, encoding->withMp4});
        else
            csv += ",,,,,";
        csv += fmt::format(",{:.3g},{:.3g},{:.4g},{:.5f},{:.3g},{:.3g},{:.3g}\n", row.timeRatio, row.rmseRatio,
                           row.error.rmse, row.error.ssim, row.error.wrongHits, row.error.depth, row.error.normal);
    }
    return csv;
}

std::string looksCsv(const std::vector<LookRow>& rows) {
    std::string csv = "look," + std::string(kSubjectColumns) + ",draw_ms,time_ratio,rmse,ssim\n";
    for (const LookRow& row : rows)
        csv += row.look + "," + subjectFields(row) + "," +
               csvFields(1e3 * row.draw, row.timeRatio, row.error.rmse, row.error.ssim) + "\n";
    return csv;
}

std::string flickerCsv(const std::vector<FlickerRow>& rows) {
    std::string csv = std::string(kSubjectColumns) + ",change,jerk\n";
    for (const FlickerRow& row : rows) csv += subjectFields(row) + "," + csvFields(row.change, row.jerk) + "\n";
    return csv;
}

std::string smoothingCsv(const std::vector<SmoothingRow>& rows) {
    std::string csv = "skin,particles,draw_ms,volume,lone_volume,bumps_degrees\n";
    for (const SmoothingRow& row : rows)
        csv += csvFields(nameOf(row.skin), row.particles, 1e3 * row.draw, row.volume, row.lone, row.bumps) + "\n";
    return csv;
}

std::string pictureTimesPlot(const std::vector<PictureRow>& rows, const std::vector<SmoothingRow>& smoothing) {
    std::vector<Curve> curves = curvesOf(
        rows, [](const PictureRow& row) { return fmt::format("{} {:.6g}\n", row.particles, 1e3 * row.moving.draw); });
    Curve plain{"plain skin, normal, cpu", "linespoints pointtype 4 linecolor rgb '#e69f00' dashtype 1"};
    for (const SmoothingRow& row : smoothing)
        if (row.skin == render::Skin::plain) plain.points += fmt::format("{} {:.6g}\n", row.particles, 1e3 * row.draw);
    curves.push_back(plain);
    return plotScript(fmt::format("set xlabel \"particles\"\nset ylabel \"milliseconds a frame\"\n"
                                  "set title \"A frame of {} x {}, drawn and read back\"\n"
                                  "set key outside right reverse Left samplen 2 font \",13\"\n",
                                  rows.front().size.width, rows.front().size.height),
                      curves);
}

std::string pictureErrorsPlot(const std::vector<PictureRow>& rows) {
    return plotScript(
        "set xlabel \"milliseconds a frame\"\nset ylabel \"1 - SSIM\"\n"
        "set title \"Error against the exact picture, and what it costs\"\n"
        "set key outside right reverse Left samplen 2 font \",13\"\n",
        curvesOf(rows, [](const PictureRow& row) {
            return fmt::format("{:.6g} {:.6g}\n", 1e3 * row.moving.draw, 1.0 - row.error.ssim);
        }));
}

}  // namespace studies
