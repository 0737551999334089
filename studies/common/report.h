// Parts of the reports that the studies write: lines of CSV tables, and gnuplot scripts of log-log plots.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace studies {

/// A text as a field of a CSV line, in quotation marks if it needs them (RFC 4180).
std::string csvText(std::string_view text);

/// A value as a field of a CSV line: "yes" or "no" for a bool, six digits of a floating-point number, an empty field
/// for an optional without a value.
template <typename T>
std::string csvField(const T& value) {
    if constexpr (std::is_same_v<T, bool>)
        return value ? "yes" : "no";
    else if constexpr (std::is_floating_point_v<T>)
        return fmt::format("{:.6g}", value);
    else if constexpr (std::is_integral_v<T>)
        return fmt::format("{}", value);
    else if constexpr (std::is_convertible_v<T, std::string_view>)
        return csvText(value);
    else
        return value ? csvField(*value) : std::string();
}

/// Several values as fields of a CSV line, separated by commas, without the end of the line.
template <typename... Fields>
std::string csvFields(const Fields&... fields) {
    std::string line;
    ((line += csvField(fields) + ","), ...);
    line.pop_back();
    return line;
}

/// One curve of a plot.
struct Curve {
    std::string title;
    std::string style;        ///< gnuplot's "with ..." clause, without "with"
    std::string points = "";  ///< a line "x y" for each point of the curve; an empty line interrupts the curve
};

/// A gnuplot script that draws curves as SVG on logarithmic axes with a grid. Curves without points are left out.
/// @param settings  gnuplot commands for the axes, the title and the key, each with a line end
std::string plotScript(const std::string& settings, const std::vector<Curve>& curves);

}  // namespace studies
