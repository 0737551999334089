// Makes a scene from the text of its file in five steps: parse, apply the overrides of the command line, validate
// against the schema, build the parts of the scene, and throw if there were problems.
#include "scenes/build/read_scene.h"

#include <fmt/format.h>

#include <filesystem>

#include "engine/core/hash.h"
#include "engine/stepping/take_step.h"
#include "scenes/build/build_shapes.h"
#include "scenes/build/builders.h"
#include "scenes/schema/document.h"
#include "scenes/schema/read_sections.h"
#include "scenes/text/read_file.h"

namespace scenes {
namespace {

void readTop(const Section& top, Scene& scene) {
    scene.title = top.string("title");
    scene.description = top.string("description");
    scene.duration = top.number("duration");
    scene.fps = top.frameRate("fps");
    scene.setup.seed = static_cast<std::uint64_t>(top.integer("seed"));
}

void readPhysics(const Section& physics, engine::Setup& setup) {
    setup.gravity = physics.vector("gravity");
    setup.drag = physics.number("drag");
    setup.step = physics.number("step");
    for (const engine::StepperKind stepper : engine::kSteppers)
        if (engine::nameOf(stepper) == physics.string("stepper")) setup.stepper = stepper;
    setup.error = physics.number("error");
    setup.solverTolerance = physics.number("solver_tolerance");
    setup.precision = physics.string("precision") == "float" ? engine::Precision::singles : engine::Precision::doubles;
    setup.forces = physics.string("forces") == "reference" ? engine::ForceMethod::reference : engine::ForceMethod::grid;
    setup.obstacles.gravity = setup.gravity.norm();
}

std::optional<engine::BoundingBox> buildWorld(Section& section, BuildContext& context) {
    if (!section.has("minimum") && !section.has("maximum")) return std::nullopt;
    checkCorners(section, Flatness::forbidden, context);
    engine::BoundingBox world = engine::BoundingBox::unbounded();
    if (section.has("minimum")) world.low = section.vector("minimum");
    if (section.has("maximum")) world.high = section.vector("maximum");
    return world;
}

/// Reports the first particle or point of emission outside the world: it would be removed before it is ever drawn.
void checkWorld(const Section& section, const engine::Setup& setup, BuildContext& context) {
    if (!setup.world || !section.isValid()) return;
    const auto isInside = [&](const engine::Vec3& position, const char* what) {
        if (setup.world->contains(position)) return true;
        context.problems.add(section.position(),
                             fmt::format("{} at [{}, {}, {}] is outside the world", what, formatNumber(position.x()),
                                         formatNumber(position.y()), formatNumber(position.z())));
        return false;
    };
    for (const engine::Vec3& position : setup.initial.position)
        if (!isInside(position, "a body's particle")) return;
    for (const engine::Emitter& emitter : setup.emitters)
        for (const engine::Vec3& site : emitter.sites)
            if (!isInside(engine::launchAt(emitter, emitter.start, {site, engine::Vec3::Zero()}).position,
                          "an emitter's point of emission"))
                return;
}

/// Checks that the times of the strip increase and do not exceed the duration, and returns them.
std::vector<double> stripTimes(Sections& sections, BuildContext& context) {
    Section& still = sections.still;
    const double end = context.duration;
    if (!still.has("strip")) return {0.25 * end, 0.5 * end, 0.75 * end, end};
    const std::vector<double> times = still.numbers("strip");
    for (std::size_t k = 0; k < times.size(); ++k) {
        if (k > 0 && times[k] <= times[k - 1])
            report(still, "strip", context, "strip[{}] is {}, must be after the time before, {} (seconds)", k,
                   formatNumber(times[k]), formatNumber(times[k - 1]));
        if (times[k] > end && sections.top.has("duration"))
            report(still, "strip", context, "strip[{}] is {}, must be at most the duration, {} (seconds)", k,
                   formatNumber(times[k]), sections.top.canonical("duration"));
    }
    return times;
}

void readStill(Sections& sections, BuildContext& context, Scene& scene) {
    Section& still = sections.still;
    still.derive("time", TypedValue::ofNumber(0.5 * context.duration));
    if (still.has("time") && sections.top.has("duration") && still.number("time") > context.duration)
        report(still, "time", context, "time is {}, must be at most the duration, {} (seconds)",
               still.canonical("time"), sections.top.canonical("duration"));
    if (still.has("time")) scene.stillTime = still.number("time");
    scene.stripTimes = stripTimes(sections, context);
}

/// Records a problem if the scene has neither particles nor emitters.
void checkPopulation(const Sections& sections, const engine::Setup& setup, BuildContext& context) {
    if (sections.mayBeIncomplete || !sections.emitters.empty()) return;
    if (sections.bodies.empty())
        context.problems.add({}, "there is nothing to simulate: give a [[body]] or an [[emitter]]");
    else if (setup.initial.count() == 0 && context.problems.empty())
        context.problems.add({}, "there is nothing to simulate: the bodies have no particles");
}

/// Checks the number of frames and the size of a picture against the limits.
void checkSize(Sections& sections, BuildContext& context) {
    Section& top = sections.top;
    if (top.has("duration") && top.has("fps")) {
        const double frames = top.frameRate("fps").framesIn(top.number("duration"));
        if (frames > context.limits.frames)
            report(top, top.isGiven("duration") ? "duration" : "fps", context,
                   "the animation would have about {:.7g} frames, {}", frames,
                   allowedText("frames", context.limits.frames));
    }
    if (!sections.look.has("size")) return;
    const double pixels = sections.look.numbers("size")[0] * sections.look.numbers("size")[1];
    if (pixels > context.limits.pixels)
        report(sections.look, "size", context, "a picture would have about {:.7g} pixels, {}", pixels,
               allowedText("pixels", context.limits.pixels));
}

std::vector<EffectiveValue> effectiveValues(const Sections& sections) {
    std::vector<EffectiveValue> values;
    for (const Section* section : sections.all()) {
        for (const Key* key : keysOf(section->table().name)) {
            const std::string_view name = key->name;
            if (!section->has(name)) continue;
            values.push_back({section->path().empty() ? std::string(name) : fmt::format("{}.{}", section->path(), name),
                              section->canonical(name), std::string(key->unit), section->origin(name),
                              key->isSimulated});
        }
    }
    return values;
}

/// Adds the hashes of the values of all keys and of the files that the scene refers to. They are equal for scenes that
/// mean the same, however they are written.
void addHashes(Scene& scene, std::uint64_t contentHash) {
    std::uint64_t all = contentHash;
    std::uint64_t simulated = contentHash;
    for (const EffectiveValue& value : scene.values) {
        const std::string line = fmt::format("{} = {}\n", value.path, value.toml);
        all = engine::fnv1a(line, all);
        if (value.isSimulated) simulated = engine::fnv1a(line, simulated);
    }
    scene.sceneHash = engine::hexadecimal(all);
    scene.simulationHash = engine::hexadecimal(simulated);
}

BuildContext contextOf(const Sections& sections, const std::string& fileName, ProblemList& problems,
                       ProblemList& warnings) {
    BuildContext context{.problems = problems,
                         .warnings = warnings,
                         .folder = std::filesystem::path(fileName).parent_path().string(),
                         .contentHash = engine::fnv1a({}),
                         .files = {}};
    // Without a valid duration the scene is rejected in the end; the default serves to find the problems in the other
    // tables.
    if (sections.top.has("duration")) context.duration = sections.top.number("duration");
    if (sections.top.has("resolution")) context.resolution = sections.top.number("resolution");
    if (sections.physics.has("gravity")) context.gravity = sections.physics.vector("gravity");
    context.seed = static_cast<std::uint64_t>(sections.top.integer("seed"));
    return context;
}

std::vector<std::string> textsOf(const ProblemList& list) {
    std::vector<std::string> texts;
    for (const Problem& problem : list.sorted()) texts.push_back(formatProblem(problem));
    return texts;
}

/// Adds what to say of each key that blurs pictures where no picture is blurred.
void addBlurs(const std::vector<Section>& cameras, ProblemList& list) {
    for (const Section& camera : cameras)
        for (const std::string_view name : {"aperture", "shutter"})
            if (camera.isGiven(name) && camera.number(name) > 0.0)
                list.add(camera.position(name),
                         fmt::format("{} = {} blurs pictures of --quality final alone, these are sharp", name,
                                     camera.canonical(name)));
}

std::vector<SourcePosition> positionsOf(const std::vector<Section>& sections) {
    std::vector<SourcePosition> positions;
    for (const Section& section : sections) positions.push_back(section.position());
    return positions;
}

/// Builds the parts of a scene from its tables. They are complete only if no problem was recorded.
void build(Sections& sections, BuildContext& context, Scene& scene) {
    applyResolution(sections, context);
    readShapes(sections.bodies, context);
    readShapes(sections.obstacles, context);
    Materials materials = buildMaterials(sections.materials, sections.bodies, context);
    scene.setup.world = buildWorld(sections.world, context);
    buildBodies(sections.bodies, materials, scene, context);
    scene.setup.emitters = buildEmitters(sections.emitters, materials, context);
    scene.setup.fields = buildFields(sections.fields, context);
    scene.camera = buildCamera(sections.cameras, context);
    scene.look = buildLook(sections.look, scene.camera, context);
    scene.look.common.samplesPerAxis = samplesPerAxis(sections.cameras.front());
    buildObstacles(sections.obstacles, sections.physics, sections.look, materials, scene, context);
    buildHeat(sections, materials, scene, context);
    buildAgitation(sections, materials, scene.setup);
    buildOverlay(sections.overlay, sections.look, scene, context);
    readStill(sections, context, scene);
    checkSize(sections, context);
    if (sections.study) scene.study = buildStudy(*sections.study, context);
    checkPopulation(sections, scene.setup, context);
    checkWorld(sections.world, scene.setup, context);
    scene.setup.materials = std::move(materials.list);
    scene.materialColors = std::move(materials.colors);
    scene.materialNotes = std::move(materials.notes);
    scene.tables.bodies = positionsOf(sections.bodies);
    scene.tables.emitters = positionsOf(sections.emitters);
    for (const Section& section : sections.emitters)
        scene.tables.hasRate.push_back(section.isGiven("rate") || section.isGiven("interval"));
    scene.tables.obstacles = positionsOf(sections.obstacles);
    scene.tables.camera = sections.cameras.front().position();
    scene.tables.error = sections.physics.position("error");
}

}  // namespace

Scene readScene(std::string_view text, const std::string& fileName, const Overrides& overrides, const Limits& limits) {
    ProblemList problems(fileName, overrides);
    Document document = parseDocument(text, problems);
    applyOverrides(document.root, overrides, problems);
    Sections sections = readSections(document, problems);
    ProblemList warnings(fileName, overrides);
    BuildContext context = contextOf(sections, fileName, problems, warnings);
    context.hasOmissions = document.hasOmissions;
    context.limits = limits;
    Scene scene;
    build(sections, context, scene);
    problems.throwIfAny();

    readTop(sections.top, scene);
    readPhysics(sections.physics, scene.setup);
    scene.size = {static_cast<int>(sections.look.numbers("size")[0]),
                  static_cast<int>(sections.look.numbers("size")[1])};
    scene.sourceName = fileName;
    scene.files = std::move(context.files);
    scene.meshNotes = std::move(context.meshNotes);
    scene.values = effectiveValues(sections);
    addHashes(scene, context.contentHash);
    scene.warnings = textsOf(warnings);
    ProblemList blurs(fileName, overrides);
    addBlurs(sections.cameras, blurs);
    scene.blurWarnings = textsOf(blurs);
    return scene;
}

Scene loadScene(const std::string& path, const Overrides& overrides, const Limits& limits) {
    Scene scene = readScene(asText(readFile(path, kMaxSceneFileBytes)), path, overrides, limits);
    scene.files.emplace_back(path);
    return scene;
}

}  // namespace scenes
