// The script is piped to gnuplot and the SVG is read from its output, so that gnuplot writes no files.
#include "tools/system/gnuplot.h"

#include <fmt/format.h>

#include <string_view>

#include "render/output/child_process.h"
#include "render/picture/system_error.h"

namespace tools {
namespace {

/// A limit for broken output. The studies' plots take about 50 kB.
constexpr std::size_t kMostBytes = 64U << 20;

constexpr std::string_view kEnd = "</svg>";

render::ChildProcess startGnuplot() {
    try {
        return render::ChildProcess({"gnuplot", "-"});
    } catch (const render::SystemError& error) {
        throw render::SystemError(fmt::format("{}; install gnuplot (Debian: gnuplot-nox) for the plots", error.what()));
    }
}

}  // namespace

std::string drawPlot(const std::string& script) {
    render::ChildProcess gnuplot = startGnuplot();
    const bool taken = gnuplot.write({reinterpret_cast<const std::uint8_t*>(script.data()), script.size()});
    const std::string ending = gnuplot.wait();
    const std::string output = gnuplot.output(kMostBytes);
    const std::size_t first = output.find("<?xml");
    const std::size_t last = output.rfind(kEnd);
    const bool whole = first != std::string::npos && last != std::string::npos;
    // Output before the picture consists of warnings.
    if (!taken || !ending.empty() || !whole)
        throw render::SystemError(
            fmt::format("gnuplot ended with {}: {}", ending.empty() ? "no plot" : ending, output.substr(0, first)));
    return output.substr(first, last + kEnd.size() - first) + "\n";
}

}  // namespace tools
