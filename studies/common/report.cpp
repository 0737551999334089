// Writes CSV fields and gnuplot scripts for the reports of the studies. See report.h.
#include "studies/common/report.h"

namespace studies {

std::string csvText(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string plotScript(const std::string& settings, const std::vector<Curve>& curves) {
    constexpr const char* kHeader =
        R"(set terminal svg size 860,600 enhanced font "DejaVu Sans,15" background "white"
set logscale xy
set grid xtics ytics mxtics mytics linewidth 1 linecolor rgb "#d9d9d9", linewidth 0.5 linecolor rgb "#eeeeee"
set border linecolor rgb "#444444"
set lmargin 11
)";
    std::string data;
    std::string list;
    for (std::size_t k = 0; k < curves.size(); ++k) {
        if (curves[k].points.empty()) continue;
        data += fmt::format("$c{} << EOD\n{}EOD\n", k, curves[k].points);
        list += fmt::format("{}$c{} using 1:2 with {} title \"{}\"", list.empty() ? "" : ", \\\n  ", k, curves[k].style,
                            curves[k].title);
    }
    // gnuplot refuses a plot command without curves.
    return kHeader + settings + data + "plot " + (list.empty() ? "1 notitle linecolor rgb \"white\"" : list) + "\n";
}

}  // namespace studies
