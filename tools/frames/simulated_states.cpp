// What a state is of is said twice: by the manifest of its folder, with the checksum of its file, and by the file
// itself.
#include "tools/frames/simulated_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "scenes/text/read_file.h"
#include "tools/frames/frame_names.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// The entries of an identity that say which simulation it is. The version is not among them: states of an earlier one
/// can be drawn.
Json simulationOf(const Json& identity) {
    Json simulation = Json::object();
    for (const char* key : {"simulation_hash", "seed", "fps"})
        if (identity.contains(key)) simulation[key] = identity[key];
    return simulation;
}

}  // namespace

SimulatedStates::SimulatedStates(fs::path folder, const scenes::Scene& scene, const Json& identity,
                                 const FrameList& frames)
    : folder_(std::move(folder)), scene_(scene) {
    const fs::path path = folder_ / "manifest.json";
    if (!fs::exists(path))
        throw render::SystemError(
            fmt::format("{} holds no states: it has no manifest.json; `globular simulate SCENE -o "
                        "{}` writes them",
                        folder_.string(), folder_.string()));
    manifest_ = decodeManifest(readFile(path), path.string());
    if (manifest_.identity.contains("size") || manifest_.identity.contains("mesh"))
        throw scenes::InputError(folder_.string(),
                                 "it holds pictures or meshes; states are what `globular simulate` writes");
    requireScene(identity);
    requireFrames(frames);
}

void SimulatedStates::requireScene(const Json& identity) const {
    if (!manifest_.identity.contains("simulation_hash"))
        throw scenes::InputError(folder_.string(),
                                 "its states are of an earlier version, which did not record what they are of");
    const std::string different = differences(simulationOf(manifest_.identity), simulationOf(identity));
    if (!different.empty())
        throw scenes::InputError(
            folder_.string(),
            fmt::format(
                "its states are of another scene ({}); only title, duration, colors, what is drawn of obstacles, "
                "and the tables [camera], [look], [overlay] and [still] may differ",
                different));
}

void SimulatedStates::requireFrames(const FrameList& frames) const {
    std::vector<int> missing;
    std::ranges::copy_if(frames.numbers, std::back_inserter(missing),
                         [&](int frame) { return manifest_.frames.count(frame) == 0 || !fs::exists(pathOf(frame)); });
    if (missing.empty()) return;
    throw render::SystemError(
        fmt::format("{} has no states of frames {}; `globular simulate` writes them with --frames, "
                    "or with --resume if it ended early",
                    folder_.string(), listText(missing)));
}

fs::path SimulatedStates::pathOf(int frame) const {
    return folder_ / kStateNames.fileName(frame);
}

std::vector<fs::path> SimulatedStates::files() const {
    std::vector<fs::path> files = filesIn(folder_);
    std::erase_if(files, [](const fs::path& file) { return !isRunFile(file); });
    return files;
}

std::string SimulatedStates::version() const {
    const auto found = manifest_.identity.find("version");
    return found != manifest_.identity.end() && found->is_string() ? found->get<std::string>() : "";
}

engine::Particles SimulatedStates::read(int frame) const {
    const fs::path path = pathOf(frame);
    const std::vector<std::uint8_t> bytes = readFile(path);
    if (checksumOf(bytes) != manifest_.frames.at(frame).checksum)
        throw render::SystemError(fmt::format("{} is damaged: it is not the file that {} lists", path.string(),
                                              (folder_ / "manifest.json").string()));
    try {
        scenes::ParticleState state = scenes::decodeState(scenes::asText(bytes), path.string());
        const scenes::StateStamp expected{frame, scenes::frameTime(scene_, frame), scene_.simulationHash};
        if (state.stamp != expected)
            throw render::SystemError(
                fmt::format("{} is of frame {}, {} s, of scene {}; expected is frame {}, {} s, of "
                            "scene {}",
                            path.string(), state.stamp.frame, state.stamp.time, state.stamp.simulationHash,
                            expected.frame, expected.time, expected.simulationHash));
        const auto& materials = state.particles.material;
        if (!materials.empty() && *std::ranges::max_element(materials) >= scene_.setup.materials.size())
            throw render::SystemError(fmt::format("{} has particles of material {}, the scene has {} materials",
                                                  path.string(), *std::ranges::max_element(materials),
                                                  scene_.setup.materials.size()));
        if (state.particles.enthalpy.empty() && scene_.setup.heat && state.particles.count() > 0)
            throw render::SystemError(fmt::format("{}: property \"enthalpy\" is missing", path.string()));
        return std::move(state.particles);
    } catch (const scenes::InputError& error) {
        throw render::SystemError(error.what());
    }
}

}  // namespace tools
