// Curves as data blocks and a plot command.
#include "studies/common/curves.h"

#include <fmt/format.h>

namespace studies {

const char* const kPlotFrame = R"(set terminal svg size 860,600 enhanced font "DejaVu Sans,15" background "white"
set logscale xy
set grid xtics ytics mxtics mytics linewidth 1 linecolor rgb "#d9d9d9", linewidth 0.5 linecolor rgb "#eeeeee"
set border linecolor rgb "#444444"
set lmargin 11
)";

std::string plotOf(const std::vector<Curve>& curves) {
    std::string data;
    std::string list;
    for (std::size_t k = 0; k < curves.size(); ++k) {
        if (curves[k].points.empty()) continue;
        data += fmt::format("$c{} << EOD\n{}EOD\n", k, curves[k].points);
        list += fmt::format("{}$c{} using 1:2 with {} title \"{}\"", list.empty() ? "" : ", \\\n  ", k, curves[k].look,
                            curves[k].title);
    }
    return data + "plot " + list + "\n";
}

}  // namespace studies
