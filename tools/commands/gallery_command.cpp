// globular gallery: films and stills of the built-in scenes in a folder with one page, which needs nothing else. A
// scene that is done is not drawn again, and one that fails does not keep the others from being drawn.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "engine/forces/simd_forces.h"
#include "render/output/png.h"
#include "render/output/video.h"
#include "render/picture/system_error.h"
#include "scenes/build/library.h"
#include "scenes/text/input_error.h"
#include "tools/commands/commands.h"
#include "tools/pages/gallery_page.h"
#include "tools/run/render_loop.h"
#include "tools/run/stills.h"
#include "tools/system/command_files.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"
#include "tools/system/processors.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct GalleryOptions {
    RunOptions run;
    DrawOptions draw;
    std::string folder = "out/gallery";
    std::vector<std::string> names;  ///< scenes and folders of the library; empty: all outside hard/ and measured/
    std::string film = "mp4";        ///< extension of the films, without the dot
    bool overwrite = false;          ///< whether scenes that are done are drawn again
    bool printsMarkdown = false;
};

/// The folders of the library in the order of the page.
std::vector<GalleryGroup> emptyGroups() {
    return {
        {"", "", "", {}},
        {"paper",
         "The paper's scenes",
         "They run the paper's method, symplectic Euler with a fixed step of 0.01 s. `globular figures` draws the four "
         "figures as\nstills, strips and videos.",
         {}},
        {"measured",
         "The measured scenes",
         "Steppers and frames are measured in them. They stay as they are, so that figures of different versions can "
         "be\ncompared.",
         {}},
        {"hard",
         "The hard cases",
         "These scenes are tests: each has an observable and a limit, and `globular study stability` runs them all.",
         {}}};
}

std::string folderOf(const std::string& name) {
    return fs::path(name).parent_path().string();
}

/// The scenes that are asked for, in the order of the library.
/// @throws scenes::InputError if there is no scene and no folder of a name
std::vector<scenes::LibraryEntry> selected(const GalleryOptions& options) {
    std::vector<scenes::LibraryEntry> library = scenes::listScenes(sceneFolder());
    if (options.names.empty()) {
        std::erase_if(library, [](const auto& scene) {
            return folderOf(scene.name) == "hard" || folderOf(scene.name) == "measured";
        });
        return library;
    }
    const auto isAskedFor = [&](const scenes::LibraryEntry& scene, const std::string& name) {
        const std::string folder = folderOf(scene.name);
        return folder == name || fs::path(scenes::resolveScene(name, sceneFolder())) == scene.path;
    };
    const auto isFolder = [&](const std::string& name) {
        return std::ranges::any_of(library, [&](const auto& scene) { return folderOf(scene.name) == name; });
    };
    std::erase_if(library, [&](const auto& scene) {
        return std::ranges::none_of(options.names, [&](const std::string& name) {
            return isFolder(name) ? folderOf(scene.name) == name : isAskedFor(scene, name);
        });
    });
    return library;
}

/// Everything that determines the film and the still.
Json identityOf(const GalleryOptions& options, const scenes::Scene& scene) {
    Json identity = sceneIdentity(scene);
    identity["size"] = {scene.size.width, scene.size.height};
    identity["quality"] = options.draw.quality;
    identity["renderer"] = options.draw.renderer;
    identity["device"] = options.draw.device;
    return identity;
}

/// What is known of a scene before it is read.
GalleryEntry entryOf(const GalleryOptions& options, const scenes::LibraryEntry& scene) {
    GalleryEntry entry;
    entry.name = scene.name;
    entry.title = scene.title.empty() ? scene.name : scene.title;
    const std::string called = folderOf(scene.name) == "paper" ? fs::path(scene.name).filename().string() : scene.name;
    entry.command = fmt::format("globular render {0} -o out/{0} --video out/{0}.{1}{2}", called, options.film,
                                drawFlags(options.draw));
    entry.filmName = fmt::format("{}.{}", scene.name, options.film);
    entry.stillName = scene.name + ".png";
    entry.textName = scene.name + ".toml";
    entry.recordName = scene.name + ".json";
    return entry;
}

/// Adds what the scene says of itself.
void describe(const scenes::Scene& scene, GalleryEntry& entry) {
    entry.title = scene.title;
    entry.description = scene.description;
    entry.duration = scene.duration;
    for (const scenes::EffectiveValue& value : scene.values)
        if (value.path.starts_with("look.") && value.origin != scenes::ValueOrigin::schemaDefault)
            entry.look.emplace_back(value.path.substr(5), value.toml);
}

/// The run that an earlier call has recorded, if its film and still are there.
std::optional<GalleryRun> runOnDisk(const fs::path& folder, const GalleryEntry& entry, const Json& identity) {
    for (const std::string& name : {entry.filmName, entry.stillName, entry.recordName})
        if (!fs::exists(folder / name)) return std::nullopt;
    return galleryRunIn(Json::parse(readFile(folder / entry.recordName), nullptr, false), identity);
}

/// Draws the still in the best quality.
void drawStill(const scenes::Scene& scene, const GalleryOptions& options, const GalleryEntry& entry) {
    DrawJob job = drawJob(scene, options.draw, options.run, entry.name + " still");
    job.quality = render::Quality::final;
    const StillPictures pictures = drawStills(job, {scenes::stillFrame(scene), {}});
    writeFile(fs::path(options.folder) / entry.stillName, render::encodePng(pictures.still));
}

GalleryRun makeFilm(const scenes::Scene& scene, const GalleryOptions& options, const GalleryEntry& entry) {
    const RenderJob job{drawJob(scene, options.draw, options.run, entry.name), frameList("", scenes::frameCount(scene)),
                        std::nullopt, (fs::path(options.folder) / entry.filmName).string()};
    FinishedRun done = renderFrames(job);
    if (!done.report.unstable.empty()) throw engine::InstabilityError(done.report.unstable);
    GalleryRun run;
    run.particles = engine::largestCount(done.simulation);
    run.births = engine::birthCount(done.simulation);
    run.deaths = done.simulation.removedCount;
    run.steps = done.simulation.steps.count;
    run.seconds = done.report.seconds.all;
    run.threads = job.threads;
    run.instructionSet = engine::simdInstructionSet();
    run.processor = processorKind().model;
    return run;
}

/// Reads a scene, and draws it unless that is done. The record is removed first and written last, so that it never
/// stands beside a film or a still of another run.
void makeEntry(const GalleryOptions& options, const std::string& path, GalleryEntry& entry) {
    const fs::path folder = options.folder;
    const scenes::Scene scene = load({path, {}, {}}, overridesOf(options.draw));
    describe(scene, entry);
    const auto bytes = readFile(path);
    entry.text.assign(bytes.begin(), bytes.end());
    const Json identity = identityOf(options, scene);
    createFolderOf(folder / entry.filmName);
    writeFile(folder / entry.textName, bytes);
    if (!options.overwrite) entry.run = runOnDisk(folder, entry, identity);
    if (entry.run) return;
    fs::remove(folder / entry.recordName);
    const GalleryRun run = makeFilm(scene, options, entry);
    drawStill(scene, options, entry);
    writeFile(folder / entry.recordName, indentedText(galleryRecord(identity, run)));
    entry.run = run;
}

/// A scene that could not be drawn.
struct Failure {
    std::string name;
    int exitCode = 0;
};

/// As makeEntry(), but a scene that cannot be drawn is recorded in the entry and in the failures.
void tryEntry(const GalleryOptions& options, const std::string& path, GalleryEntry& entry,
              std::vector<Failure>& failures) {
    const auto fail = [&](const std::exception& error, int exitCode) {
        entry.failure = error.what();
        failures.push_back({entry.name, exitCode});
        printWarning(fmt::format("{} is not drawn: {}", entry.name, error.what()));
    };
    try {
        makeEntry(options, path, entry);
    } catch (const scenes::InputError& error) {
        fail(error, kInputErrorCode);
    } catch (const engine::InstabilityError& error) {
        fail(error, kUnstableCode);
    } catch (const render::SystemError& error) {
        fail(error, kOutsideFailedCode);
    }
}

/// Makes sure that nothing of another origin is in the way: the folder is a gallery or holds nothing.
/// @throws scenes::InputError
void requireGalleryFolder(const GalleryOptions& options) {
    const fs::path page = fs::path(options.folder) / "index.html";
    requireSeparate(
        {{}, {}, {{"-o", options.folder, [](const fs::path& file) { return file.filename() == "index.html"; }}}});
    std::error_code ignored;
    if (!fs::exists(options.folder, ignored) || fs::exists(page, ignored) || fs::is_empty(options.folder, ignored))
        return;
    throw scenes::InputError("-o " + options.folder, "holds files and is no gallery; choose a new folder");
}

/// The groups with the scenes that are asked for.
std::vector<GalleryGroup> groupsOf(const GalleryOptions& options, const std::vector<scenes::LibraryEntry>& library) {
    std::vector<GalleryGroup> groups = emptyGroups();
    for (const scenes::LibraryEntry& scene : library) {
        auto group = std::ranges::find(groups, folderOf(scene.name), &GalleryGroup::folder);
        if (group == groups.end()) group = groups.insert(group, {folderOf(scene.name), folderOf(scene.name), "", {}});
        group->entries.push_back(entryOf(options, scene));
    }
    return groups;
}

void report(const GalleryOptions& options, const GalleryEntry& entry) {
    if (options.printsMarkdown || !entry.run) return;
    printResult(options.run,
                {{"event", "scene"},
                 {"scene", entry.name},
                 {"film", (fs::path(options.folder) / entry.filmName).string()},
                 {"still", (fs::path(options.folder) / entry.stillName).string()},
                 {"seconds", entry.run->seconds}},
                fmt::format("{}: {} particles, {:.1f} s\n", entry.name, entry.run->particles, entry.run->seconds));
}

/// The command line without the folder, which decides nothing that the page shows.
std::string markdownCommand(const GalleryOptions& options) {
    return fmt::format("globular gallery{}{} --markdown",
                       options.names.empty() ? "" : fmt::format(" --scenes {}", fmt::join(options.names, ",")),
                       drawFlags(options.draw));
}

void makeGallery(const GalleryOptions& options) {
    if (options.printsMarkdown && options.run.json)
        throw scenes::InputError("--json", "standard output is for the page, with --markdown");
    const std::vector<scenes::LibraryEntry> library = selected(options);
    requireGalleryFolder(options);
    rendererOf(options.draw);
    const fs::path page = fs::path(options.folder) / "index.html";
    render::requireEncoder({.path = "film." + options.film, .size = {}});
    createFolder(options.folder);
    std::vector<GalleryGroup> groups = groupsOf(options, library);
    std::vector<Failure> failures;
    writeFile(page, galleryPage(groups));
    for (GalleryGroup& group : groups)
        for (GalleryEntry& entry : group.entries) {
            tryEntry(options, std::ranges::find(library, entry.name, &scenes::LibraryEntry::name)->path, entry,
                     failures);
            writeFile(page, galleryPage(groups));  // an interrupted gallery has a page, too
            report(options, entry);
        }
    if (options.printsMarkdown)
        printText(galleryMarkdown(groups, markdownCommand(options)));
    else if (options.run.verbosity() == Verbosity::normal)
        printText(fmt::format("all of it: {}\n", page.string()));
    if (failures.empty()) return;
    throw ExitStatus(failures.front().exitCode, fmt::format("{} of {} scenes could not be drawn, the first of them {}",
                                                            failures.size(), library.size(), failures.front().name));
}

}  // namespace

void addGalleryCommand(CLI::App& program) {
    CLI::App& command =
        *program.add_subcommand("gallery", "films and stills of the built-in scenes, and one page that shows them");
    const auto options = std::make_shared<GalleryOptions>();
    command
        .add_option("-o,--output", options->folder,
                    "folder to write to: a new one, or a gallery, of which scenes that are done stay (default: "
                    "out/gallery)")
        ->type_name("DIR");
    command
        .add_option("--scenes", options->names,
                    "scenes or folders of the library, separated by commas (default: all but those of hard)")
        ->type_name("NAMES")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--film", options->film, "the kind of the films: mp4, webm, webp or gif (default: mp4)")
        ->check(CLI::IsMember({"mp4", "webm", "webp", "gif"}));
    command.add_flag("--overwrite", options->overwrite, "draw scenes that are done again");
    command.add_flag("--markdown", options->printsMarkdown,
                     "print the page as Markdown, as docs/gallery.md of the sources has it");
    addTo(command, options->draw);
    addTo(command, options->run);
    command.footer("Example: globular gallery -o out/gallery --scenes liquid,honey,paper --size 640x360");
    command.callback([options] { makeGallery(*options); });
}

}  // namespace tools
