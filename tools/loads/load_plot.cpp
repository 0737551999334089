// Each obstacle has three panels, one above the other. Where there are many obstacles, their panels fill several rows.
#include "tools/loads/load_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "scenes/text/input_error.h"
#include "scenes/text/read_file.h"
#include "tools/loads/load_table.h"
#include "tools/system/text.h"

namespace tools {
namespace {

/// Most obstacles side by side. Chosen: their numbers can be read on a page.
constexpr std::size_t kMostColumns = 3;

/// The numbers of a row of loads.csv.
constexpr std::size_t kNumbers = 12;

/// A row of loads.csv.
struct LoadRow {
    int obstacle = 0;
    LoadPoint point;
};

/// The row that a line is; nothing if it is none.
std::optional<LoadRow> rowOf(const std::string& line) {
    std::vector<double> row;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) {
        const auto number = parseNumber<double>(field);
        if (!number || !std::isfinite(*number)) return std::nullopt;
        row.push_back(*number);
    }
    constexpr double kMostObstacles = 1e9;  // more than a scene has
    if (row.size() != kNumbers || row[1] < 1.0 || row[1] > kMostObstacles) return std::nullopt;
    return LoadRow{static_cast<int>(row[1]),
                   {row[0], {row[2], row[3], row[4]}, {row[5], row[6], row[7]}, {row[8], row[9], row[10]}, row[11]}};
}

/// A text of gnuplot, in which nothing but the quotation mark has a meaning.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : printable(text)) result += c == '\'' ? "''" : c == '\n' || c == '\t' ? " " : std::string(1, c);
    return result + "'";
}

std::string fieldsOf(const std::array<double, 3>& vector) {
    return fmt::format("{} {} {}", vector[0], vector[1], vector[2]);
}

/// The data of an obstacle, named by its number: time, force, torque, work. A first line is of the start, where the
/// work is zero and the first interval begins, whose mean force and torque gnuplot's fsteps draw from there.
std::string dataOf(int obstacle, const std::vector<LoadPoint>& points) {
    const LoadPoint& first = points.front();
    std::string data =
        fmt::format("$load{} << EOD\n0 {} {} 0\n", obstacle, fieldsOf(first.force), fieldsOf(first.torque));
    for (const LoadPoint& point : points)
        data += fmt::format("{} {} {} {}\n", point.time, fieldsOf(point.force), fieldsOf(point.torque), point.work);
    return data + "EOD\n";
}

/// One of the panels of each obstacle.
struct Panel {
    const char* label;                                   ///< of the vertical axis
    std::size_t column;                                  ///< of the data, from 1; that of x for a vector
    std::array<double, 3> LoadPoint::*vector = nullptr;  ///< what it shows; null for the work
};
constexpr std::array kPanels = {Panel{"force (N)", 2, &LoadPoint::force}, Panel{"torque (N m)", 5, &LoadPoint::torque},
                                Panel{"work (J)", 8}};

/// Where the curves of a panel are zero throughout, as where nothing has touched an obstacle, the range of its axis;
/// otherwise gnuplot finds it. For an empty range gnuplot would write a warning into the plot.
std::string rangeOf(const Panel& panel, const std::vector<LoadPoint>& points) {
    const auto isZero = [&](const LoadPoint& point) {
        return panel.vector == nullptr ? point.work == 0.0 : point.*panel.vector == std::array<double, 3>{};
    };
    return std::ranges::all_of(points, isZero) ? "set yrange [-1:1]\n" : "set yrange [*:*]\n";
}

/// The plot command of a panel.
std::string curvesOf(const Panel& panel, int obstacle) {
    if (panel.vector == nullptr)
        return fmt::format("plot $load{} using 1:{} with lines linewidth 2 linecolor rgb '#444444' notitle\n", obstacle,
                           panel.column);
    constexpr std::array kAxes = {"x", "y", "z"};
    constexpr std::array kColors = {"#d55e00", "#009e73", "#0072b2"};
    std::string text = "plot ";
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis)
        text += fmt::format("{}$load{} using 1:{} with fsteps linewidth 1.6 linecolor rgb '{}' title '{}'",
                            axis == 0 ? "" : ", ", obstacle, panel.column + axis, kColors[axis], kAxes[axis]);
    return text + "\n";
}

/// Lengths in a figure, in pixels. Chosen: numbers and labels have room, and three obstacles fit on a page.
constexpr double kPanelHeight = 190.0;
constexpr double kGap = 24.0;          // between the panels of an obstacle
constexpr double kTitleHeight = 44.0;  // of the figure's title
constexpr double kNameHeight = 40.0;   // above the first panel of an obstacle
constexpr double kAxisHeight = 72.0;   // below its last panel
constexpr double kLeft = 118.0;        // beside a panel
constexpr double kRight = 24.0;
constexpr double kBlockHeight = kNameHeight + 3 * kPanelHeight + 2 * kGap + kAxisHeight;

/// The size of a figure, in pixels, and how many obstacles it has side by side.
struct Layout {
    explicit Layout(std::size_t obstacles)
        : columns(std::min(kMostColumns, obstacles)),
          columnWidth(columns == 1 ? 850.0 : 550.0),
          width(columnWidth * static_cast<double>(columns)),
          height(kTitleHeight + kBlockHeight * static_cast<double>((obstacles + columns - 1) / columns)) {}

    std::size_t columns;
    double columnWidth;
    double width;
    double height;
};

/// The commands that place a panel of an obstacle, both given by their position in their lists.
std::string placeOf(const Layout& layout, std::size_t panel, std::size_t obstacle) {
    const double left = kLeft + layout.columnWidth * static_cast<double>(obstacle % layout.columns);
    const double right = left + layout.columnWidth - kLeft - kRight;
    const double top = kTitleHeight + kBlockHeight * static_cast<double>(obstacle / layout.columns) + kNameHeight +
                       (kPanelHeight + kGap) * static_cast<double>(panel);
    // gnuplot measures from the lower edge.
    return fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin at "
        "screen {}\n",
        left / layout.width, right / layout.width, 1.0 - top / layout.height,
        1.0 - (top + kPanelHeight) / layout.height);
}

/// The commands of the three panels of an obstacle: its name and the key are above the first, the axis of time below
/// the last.
std::string panelsOf(const Layout& layout, std::size_t index, const std::pair<const int, std::string>& named,
                     const std::vector<LoadPoint>& points) {
    const auto& [obstacle, name] = named;
    std::string text = fmt::format("set label 1 {} at graph 0,1 offset 0,0.9 left font ',16'\nset key\n", quoted(name));
    for (std::size_t k = 0; k < kPanels.size(); ++k) {
        const bool isLast = k + 1 == kPanels.size();
        text += placeOf(layout, k, index);
        text += fmt::format("set format x '{}'\nset xlabel '{}'\nset ylabel '{}'\n", isLast ? "%g" : "",
                            isLast ? "time (s)" : "", kPanels[k].label);
        text += rangeOf(kPanels[k], points) + curvesOf(kPanels[k], obstacle) + "unset label\nunset key\n";
    }
    return text;
}

}  // namespace

LoadsOverTime readLoads(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = scenes::readFile(file.string());
    const std::string text(bytes.begin(), bytes.end());
    const auto fail = [&](int line, const std::string& message) {
        throw scenes::InputError({{file.string(), line, 0, message}});
    };
    if (!text.starts_with(kLoadsHead)) fail(1, "this is not a loads.csv of a run of globular");
    LoadsOverTime loads;
    std::istringstream lines(text.substr(kLoadsHead.size()));
    std::string line;
    for (int number = 2; std::getline(lines, line); ++number) {
        const auto row = rowOf(line);
        if (!row) fail(number, "this is not a row of loads");
        loads[row->obstacle].push_back(row->point);
    }
    if (loads.empty()) fail(0, "it has no rows yet: the run has not reached its second frame");
    return loads;
}

std::string loadPlotScript(const LoadsOverTime& loads, const LoadFigure& figure) {
    const Layout layout(figure.names.size());
    std::string text = fmt::format("set terminal {} size {},{} noenhanced font 'DejaVu Sans,14' background 'white'\n",
                                   figure.format == PlotFormat::svg ? "svg" : "pngcairo", layout.width, layout.height);
    text += R"(set grid xtics ytics linetype 1 linewidth 0.8 linecolor rgb '#dddddd'
set border linecolor rgb '#444444'
set xzeroaxis linetype 1 linewidth 1 linecolor rgb '#888888'
set tics nomirror
set key at graph 1,1.02 right bottom horizontal samplen 1.2 width -0.5 font ',13'
)";
    for (const auto& [obstacle, name] : figure.names) text += dataOf(obstacle, loads.at(obstacle));
    text += fmt::format("set xrange [0:{}]\nset multiplot title {} font ',18'\n",
                        loads.at(figure.names.begin()->first).back().time, quoted(figure.title));
    std::size_t index = 0;
    for (const auto& named : figure.names) text += panelsOf(layout, index++, named, loads.at(named.first));
    return text + "unset multiplot\n";
}

}  // namespace tools
