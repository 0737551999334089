// The program globular. Adds the subcommands, runs the one that was called, and turns exceptions into error lines and
// exit codes. Errors are caught here and nowhere else; each problem gets one line.
#include <fmt/format.h>

#include <cstdlib>
#include <new>
#include <sstream>
#include <stdexcept>
#include <system_error>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "engine/run/advance.h"
#include "render/mesh/isosurface.h"
#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tools/commands/commands.h"
#include "tools/system/memory.h"
#include "tools/system/process.h"
#include "tools/system/text.h"

namespace {

constexpr int kOutsideFailed = 1;
constexpr int kUnstable = 3;

/// Makes glibc keep freed memory. Every frame and every neighbor list asks for the memory that the last one has freed.
/// By default glibc returns blocks of 128 KiB and more to the system, which fills the pages with zeros again when they
/// are next used. That took up to a quarter of the time of a frame.
void keepFreedMemory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20);  // size of blocks, bytes; the largest that glibc accepts
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

/// What --version prints: the version, and which optional libraries are built in.
std::string versionText() {
#ifdef RENDER_HAS_OPENGL
    constexpr const char* kOpenGl = "with OpenGL";
#else
    constexpr const char* kOpenGl = "without OpenGL";
#endif
    const std::string openVdb = render::openVdbVersion();
    return fmt::format("globular " GLOBULAR_VERSION "\n{}, {}", kOpenGl,
                       openVdb.empty() ? "without OpenVDB" : "with OpenVDB " + openVdb);
}

std::string licenses() {
    return std::string(tools::embeddedText("LICENSE")) + "\n" + std::string(tools::embeddedText("THIRD_PARTY.md"));
}

int report(const std::string& problems, int exitCode) {
    std::istringstream lines(problems);
    for (std::string line; std::getline(lines, line);) tools::printToStderr(fmt::format("error: {}\n", line));
    return exitCode;
}

int run(CLI::App& program, int argc, char** argv) {
    try {
        tools::runCommandLine(program, argc, argv);
        // Flushed here, so that a full disk behind standard output is reported like any other failure.
        tools::flushStandardOutput();
        return 0;
    } catch (const scenes::InputError& error) {
        return report(error.what(), tools::kInputErrorCode);
    } catch (const engine::InstabilityError& error) {
        return report(error.what(), kUnstable);
    } catch (const tools::ExitStatus& status) {
        return report(status.what(), status.code());
    } catch (const render::OpenGlError& error) {
        return report(fmt::format("{}; without OpenGL: --renderer cpu", error.what()), kOutsideFailed);
    } catch (const std::system_error& error) {
        // fmt::print throws std::system_error when it cannot write to standard output.
        const bool isReaderGone = error.code() == std::errc::broken_pipe;
        return isReaderGone ? tools::kReaderGoneCode : report(error.what(), kOutsideFailed);
    } catch (const std::bad_alloc& error) {
        return report(tools::memoryMessage(error, "", ""), kOutsideFailed);
    } catch (const std::logic_error& error) {
        report(fmt::format("internal error: {}", error.what()), 0);
        std::abort();  // an abort leaves a core dump for the debugger
    } catch (const std::exception& error) {
        return report(error.what(), kOutsideFailed);
    }
}

}  // namespace

int main(int argc, char** argv) {
    keepFreedMemory();
    tools::prepareStandardStreams();
    tools::ensureTemporaryFolder();
    CLI::App program("turns a scene file into an animation of globular dynamics", "globular");
    program.require_subcommand(0, 1);
    program.set_version_flag("--version", versionText, "print the version, and which optional libraries are built in");
    // CLI11 prints the text of a CallForVersion exception and nothing else.
    program.add_flag_callback(
        "--licenses", [] { throw CLI::CallForVersion(licenses(), CLI::ExitCodes::Success); },
        "print the licenses of globular and of what is built into it");
    program.footer("Example: globular render liquid -o out/liquid --video out/liquid.mp4");
    tools::addRenderCommand(program);
    tools::addStripCommand(program);
    tools::addSimulateCommand(program);
    tools::addMeshCommand(program);
    tools::addFiguresCommand(program);
    tools::addVideoCommand(program);
    tools::addAssembleCommand(program);
    tools::addCompareCommand(program);
    tools::addApproveCommand(program);
    tools::addCheckCommand(program);
    tools::addScenesCommand(program);
    tools::addDevicesCommand(program);
    tools::addSchemaCommand(program);
    tools::addStudyCommand(program);
    tools::addBenchCommand(program);
    tools::addGenerateCommand(program);
    return run(program, argc, argv);
}
