// The script goes in by a pipe, the picture comes out by the child's output; no file of gnuplot's own is left behind.
#include "tools/system/gnuplot.h"

#include <fmt/format.h>

#include <string_view>

#include "render/output/child_process.h"
#include "render/picture/system_error.h"

namespace tools {
namespace {

/// Larger than any plot of ours, which take some 50 kB.
constexpr std::size_t kMostBytes = 64U << 20;

constexpr std::string_view kEnd = "</svg>";

render::ChildProcess started() {
    try {
        return render::ChildProcess({"gnuplot", "-"});
    } catch (const render::SystemError& error) {
        throw render::SystemError(fmt::format("{}; install gnuplot (Debian: gnuplot-nox) for the plots", error.what()));
    }
}

}  // namespace

std::string drawPlot(const std::string& script) {
    render::ChildProcess gnuplot = started();
    const bool taken = gnuplot.write({reinterpret_cast<const std::uint8_t*>(script.data()), script.size()});
    const std::string ending = gnuplot.wait();
    const std::string output = gnuplot.output(kMostBytes);
    const std::size_t first = output.find("<?xml");
    const std::size_t last = output.rfind(kEnd);
    const bool whole = first != std::string::npos && last != std::string::npos;
    // Its warnings come the same way, before the picture.
    if (!taken || !ending.empty() || !whole)
        throw render::SystemError(
            fmt::format("gnuplot ended with {}: {}", ending.empty() ? "no plot" : ending, output.substr(0, first)));
    return output.substr(first, last + kEnd.size() - first) + "\n";
}

}  // namespace tools
