// The program globular: its subcommands, and what it says about itself.
#include <fmt/format.h>

#include "render/mesh/isosurface.h"
#include "render/output/exr.h"
#include "scenes/shapes/mesh_file.h"
#include "tools/commands/commands.h"
#include "tools/system/text.h"

namespace {

std::string withLibrary(const char* name, const std::string& version) {
    return version.empty() ? fmt::format("without {}", name) : fmt::format("with {} {}", name, version);
}

/// What --version prints: the version, and which optional libraries are built in.
std::string versionText() {
#ifdef RENDER_HAS_OPENGL
    constexpr const char* kOpenGl = "with OpenGL";
#else
    constexpr const char* kOpenGl = "without OpenGL";
#endif
    return fmt::format(
        "globular " GLOBULAR_VERSION "\n{}, {}, {}, {}", kOpenGl, withLibrary("OpenVDB", render::openVdbVersion()),
        withLibrary("OpenEXR", render::openExrVersion()), withLibrary("assimp", scenes::assimpVersion()));
}

std::string licenses() {
    return std::string(tools::embeddedText("LICENSE")) + "\n" + std::string(tools::embeddedText("THIRD_PARTY.md"));
}

}  // namespace

int main(int argc, char** argv) {
    tools::prepareProcess();
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
    tools::addGalleryCommand(program);
    tools::addVideoCommand(program);
    tools::addAssembleCommand(program);
    tools::addCompareCommand(program);
    tools::addApproveCommand(program);
    tools::addCheckCommand(program);
    tools::addPlotCommand(program);
    tools::addScenesCommand(program);
    tools::addDevicesCommand(program);
    tools::addSchemaCommand(program);
    tools::addStudyCommand(program);
    tools::addBenchCommand(program);
    tools::addGenerateCommand(program);
    return tools::runProgram(program, argc, argv);
}
