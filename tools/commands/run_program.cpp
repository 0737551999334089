// Turns exceptions into error lines and exit codes. Errors are caught here and nowhere else; each problem gets one
// line.
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
#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tools/commands/commands.h"
#include "tools/system/memory.h"
#include "tools/system/process.h"
#include "tools/system/text.h"

namespace tools {
namespace {

/// Makes glibc keep freed memory. Every frame and every neighbor list asks for the memory that the last one has freed.
/// By default glibc returns blocks of 128 KiB and more to the system, which fills the pages with zeros again when they
/// are next used. That took up to a quarter of the time of a frame.
void keepFreedMemory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20);  // size of blocks, bytes; the largest that glibc accepts
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

int report(const std::string& problems, int exitCode) {
    std::istringstream lines(problems);
    for (std::string line; std::getline(lines, line);) printToStderr(fmt::format("error: {}\n", line));
    return exitCode;
}

}  // namespace

void prepareProcess() {
    keepFreedMemory();
    prepareStandardStreams();
    ensureTemporaryFolder();
}

int runProgram(CLI::App& program, int argc, char** argv) {
    try {
        runCommandLine(program, argc, argv);
        // Flushed here, so that a full disk behind standard output is reported like any other failure.
        flushStandardOutput();
        return 0;
    } catch (const scenes::InputError& error) {
        return report(error.what(), kInputErrorCode);
    } catch (const engine::InstabilityError& error) {
        return report(error.what(), kUnstableCode);
    } catch (const ExitStatus& status) {
        return report(status.what(), status.code());
    } catch (const render::OpenGlError& error) {
        return report(fmt::format("{}; without OpenGL: --renderer cpu", error.what()), kOutsideFailedCode);
    } catch (const std::system_error& error) {
        // fmt::print throws std::system_error when it cannot write to standard output.
        const bool isReaderGone = error.code() == std::errc::broken_pipe;
        return isReaderGone ? kReaderGoneCode : report(error.what(), kOutsideFailedCode);
    } catch (const std::bad_alloc& error) {
        return report(memoryMessage(error, "", ""), kOutsideFailedCode);
    } catch (const std::logic_error& error) {
        report(fmt::format("internal error: {}", error.what()), 0);
        std::abort();  // an abort leaves a core dump for the debugger
    } catch (const std::exception& error) {
        return report(error.what(), kOutsideFailedCode);
    }
}

}  // namespace tools
