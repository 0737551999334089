// globular study meshes: measures what meshes of metaballs cost, and how far they are from the exact surface.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "render/mesh/isosurface.h"
#include "render/picture/system_error.h"
#include "studies/meshes/meshes.h"
#include "studies/pictures/pictures.h"
#include "tools/commands/study/study_command.h"
#include "tools/pages/study_pages.h"
#include "tools/system/output_file.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct MeshesOptions : StudyOptions {
    std::size_t particles = 0;  ///< 0: by default
};

void reportRow(const MeshesOptions& options, const studies::MeshRow& row) {
    reportProgress(options,
                   {{"event", "row"},
                    {"skin", studies::nameOf(row.skin)},
                    {"cell", row.cell},
                    {"triangles", row.triangles},
                    {"seconds", row.seconds},
                    {"vertices_mean", row.atVertices.mean},
                    {"triangles_mean", row.atCenters.mean},
                    {"pool", row.pool}},
                   fmt::format("{} skin, cell {} radii: {} triangles, {:.4g} ms\n", studies::nameOf(row.skin), row.cell,
                               row.triangles, 1e3 * row.seconds));
}

void study(const MeshesOptions& options) {
    render::requireOpenVdb();
    prepareFolder(options, {});
    studies::MeshStudySettings settings;
    if (options.quick) settings = {2000, {1.0, 0.5}, 1, 2000};
    if (options.particles > 0) settings.particles = options.particles;
    std::vector<studies::MeshRow> rows;
    onThreads(threadCount(options.run), [&] {
        rows = studies::measureMeshes(settings, [&](const std::vector<studies::MeshRow>& done) {
            writeFile(fs::path(options.folder) / "meshes.csv", studies::meshesCsv(done));
            reportRow(options, done.back());
        });
    });
    std::vector<std::string> words;
    if (options.particles > 0) words = {"--particles", fmt::format("{}", options.particles)};
    finishStudy(options, meshesPage(rows, settings.particles, commandLineOf(options, words)),
                textTable(parseCsv(studies::meshesCsv(rows), 0)) + "\n");
}

}  // namespace

void addStudyMeshes(CLI::App& study) {
    CLI::App& command =
        *study.add_subcommand("meshes", "meshes of metaballs: time, size, distance from the exact surface");
    const auto options = std::make_shared<MeshesOptions>();
    command.add_option("--particles", options->particles, "how many (default: 6000)")
        ->check(CLI::Range(100, 10000000))
        ->type_name("N");
    addStudyFlags(command, *options, "fewer particles and cells");
    command.footer("Example: globular study meshes --quick -o out/meshes");
    command.callback([options] { tools::study(*options); });
}

}  // namespace tools
