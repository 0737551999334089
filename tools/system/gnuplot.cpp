// The plot is cut out of what gnuplot prints, of which the rest are warnings.
#include "tools/system/gnuplot.h"

#include <fmt/format.h>

#include <string_view>

#include "render/output/child_process.h"
#include "render/picture/system_error.h"

namespace tools {
namespace {

using namespace std::string_view_literals;

/// How the files of a format begin and end.
struct Ends {
    std::string_view beginning;
    std::string_view end;
    std::string_view afterEnd;  ///< added to the file
};
constexpr Ends kSvgEnds = {"<?xml"sv, "</svg>"sv, "\n"sv};
constexpr Ends kPngEnds = {"\x89PNG\r\n"sv, "IEND\xAE\x42\x60\x82"sv, ""sv};

render::ChildProcess startGnuplot() {
    try {
        return render::ChildProcess({"gnuplot", "-"});
    } catch (const render::ProgramMissing& error) {
        throw render::SystemError(fmt::format("{}; install gnuplot (Debian: gnuplot-nox) for the plots", error.what()));
    }
}

}  // namespace

std::string drawWithGnuplot(const std::string& script, PlotFormat format) {
    render::ChildProcess gnuplot = startGnuplot();
    const bool taken = gnuplot.write({reinterpret_cast<const std::uint8_t*>(script.data()), script.size()});
    const std::string ending = gnuplot.wait();
    constexpr std::size_t kMostBytes = 64U << 20;  // limit on gnuplot's output; the plots take about 50 kB
    const std::string output = gnuplot.output(kMostBytes);
    const Ends& ends = format == PlotFormat::svg ? kSvgEnds : kPngEnds;
    const std::size_t first = output.find(ends.beginning);
    const std::size_t last = output.rfind(ends.end);
    const bool whole = first != std::string::npos && last != std::string::npos;
    if (!taken || !ending.empty() || !whole)
        throw render::SystemError(
            fmt::format("gnuplot ended with {}: {}", ending.empty() ? "no plot" : ending, output.substr(0, first)));
    return output.substr(first, last + ends.end.size() - first).append(ends.afterEnd);
}

}  // namespace tools
