// A folder of particle states that `globular simulate` has written, from which pictures are drawn without simulating.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/model/scene.h"
#include "scenes/particles/particle_file.h"
#include "tools/frames/frame_list.h"
#include "tools/frames/manifest.h"
#include "tools/system/json.h"

namespace tools {

class SimulatedStates {
 public:
    /// Makes sure that the folder has states of some frames of a scene. Only their files' names are looked at; read()
    /// looks into them.
    /// @param scene  has to be the one that was simulated, except for keys that do not move particles: it must have the
    /// same simulationHash. Must outlive the object
    /// @param identity  of the scene, as manifests have it
    /// @throws scenes::InputError if the folder has states of another scene, or of a version without such hashes
    /// @throws render::SystemError if the folder has no states, or not those of all frames, which are then named
    SimulatedStates(std::filesystem::path folder, const scenes::Scene& scene, const Json& identity,
                    const FrameList& frames);

    /// Reads the state of one of the frames, bit for bit as it was.
    /// @throws render::SystemError if the file is not there or not the one that the manifest lists
    engine::Particles read(int frame) const;

    /// Hash of the particles of one of the frames, as the simulation recorded it.
    const std::string& stateHash(int frame) const { return manifest_.frames.at(frame).stateHash; }

    const std::filesystem::path& path() const { return folder_; }
    /// All files in the folder that have the name of a run's file.
    std::vector<std::filesystem::path> files() const;
    std::filesystem::path pathOf(int frame) const;

    /// Version of the program that has simulated the states.
    std::string version() const;

 private:
    void requireScene(const Json& identity) const;
    void requireFrames(const FrameList& frames) const;

    std::filesystem::path folder_;
    const scenes::Scene& scene_;
    Manifest manifest_;
};

}  // namespace tools
