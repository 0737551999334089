// Checked sections to the parts of a scene, one builder for each table. Each reports what the schema alone cannot tell
// (keys that contradict each other, names that are not defined, files) and builds a part only from a sound section.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/model/camera_path.h"
#include "scenes/model/limits.h"
#include "scenes/model/look.h"
#include "scenes/schema/read_sections.h"
#include "scenes/schema/study.h"

namespace scenes {

/// Materials by index, with what the engine does not need to know.
struct Materials {
    std::vector<engine::Material> list;
    std::vector<engine::Vec3> colors;  ///< linear RGB
};

/// What the builders share.
struct BuildContext {
    ProblemList& problems;
    std::string folder;     ///< that file names are relative to
    double duration = 1.0;  ///< s
    std::uint64_t seed = 1;
    bool damaged = false;       ///< something of the file could not be read, perhaps what is missing
    std::uint64_t contentHash;  ///< of the files that the scene names
    Limits limits = {};
    double expected = 0.0;  ///< particles of the bodies and births seen so far
};

Materials buildMaterials(std::vector<Section>& sections, BuildContext& context);
engine::Particles buildBodies(std::vector<Section>& sections, const Materials& materials, BuildContext& context);
std::vector<engine::Emitter> buildEmitters(std::vector<Section>& sections, const Materials& materials,
                                           BuildContext& context);

struct Obstacles {
    std::vector<engine::Obstacle> shapes;
    std::vector<ObstacleLook> looks;
};

Obstacles buildObstacles(std::vector<Section>& sections, const Section& look, BuildContext& context);
CameraPath buildCamera(std::vector<Section>& sections, BuildContext& context);
Look buildLook(Section& section, BuildContext& context);
Overlay buildOverlay(Section& section, const Section& look, const CameraPath& camera, BuildContext& context);
Study buildStudy(Section& section, BuildContext& context);

// What several builders need.

/// Records a problem at a key of a section, and that the section is unsound.
void report(Section& section, std::string_view name, const std::string& message, BuildContext& context);

/// Records that a section needs a key.
void reportMissing(Section& section, std::string_view name, BuildContext& context);

/// Records that two keys that exclude each other were both written. True if they were.
bool reportBoth(Section& section, std::string_view one, std::string_view other, BuildContext& context);

/// Counts particles that a body or an emitter would make in `expected`, and records a problem at the key where that are
/// too many. False then. Shape: what as in "the body would have".
bool expect(Section& section, std::string_view name, double particles, std::string_view what, BuildContext& context);

/// "at most 2e+06 are allowed; --limit particles=N allows more"
std::string allowedText(std::string_view limit, double most);

/// Records a problem where maximum is not above minimum along every axis; one that is not there is not looked at.
void checkCorners(Section& section, BuildContext& context);

/// Index of the material that a section names, the first if it names none; nothing if there is no such material.
std::optional<std::uint32_t> materialOf(Section& section, const Materials& materials, BuildContext& context);

/// The same direction with length 1; nothing for the zero vector.
std::optional<engine::Vec3> unitVector(const engine::Vec3& vector);

}  // namespace scenes
