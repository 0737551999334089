// Builders: one for each kind of table, which turns a validated section into a part of the scene. Each reports what the
// schema alone cannot tell (keys that contradict each other, undefined names, files that cannot be read), and builds
// its part only if the section is valid. Called by read_scene.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scenes/build/read_scene.h"
#include "scenes/schema/read_sections.h"

namespace scenes {

/// Materials by index, with the colors that the engine does not need.
struct Materials {
    std::vector<engine::Material> list;
    std::vector<engine::Vec3> colors;  ///< linear RGB
};

/// What the builders share.
struct BuildContext {
    ProblemList& problems;
    std::string folder;     ///< the folder that file names are relative to
    double duration = 1.0;  ///< s
    std::uint64_t seed = 1;
    bool hasOmissions = false;  ///< part of the file could not be read, so what seems to be missing may be in it
    std::uint64_t contentHash;  ///< of the files that the scene refers to
    Limits limits = {};
    double expectedParticles = 0.0;  ///< of the bodies and emitters so far
};

Materials buildMaterials(std::vector<Section>& sections, BuildContext& context);
engine::Particles buildBodies(std::vector<Section>& sections, const Materials& materials, BuildContext& context);
std::vector<engine::Emitter> buildEmitters(std::vector<Section>& sections, const Materials& materials,
                                           BuildContext& context);

CameraPath buildCamera(std::vector<Section>& sections, BuildContext& context);
Look buildLook(Section& section, BuildContext& context);
/// Adds the obstacles to the simulation and to the look of the scene.
void buildObstacles(std::vector<Section>& sections, const Section& look, Scene& scene, BuildContext& context);
/// Adds the overlay to the look of the scene, which already has its cameras.
void buildOverlay(Section& section, const Section& look, Scene& scene, BuildContext& context);
Study buildStudy(Section& section, BuildContext& context);

// What several builders need (build_shared.cpp).

/// Records a problem with a key of a section, and marks the section as invalid.
/// @param message  a format string for the values
template <class... Values>
void report(Section& section, std::string_view name, BuildContext& context,
            fmt::format_string<const Values&...> message, const Values&... values) {
    section.markInvalid();
    context.problems.add(section.position(name), fmt::format(message, values...));
}

/// Records that a key is missing from a section, and marks the section as invalid.
void reportMissing(Section& section, std::string_view name, BuildContext& context);

/// Records a problem if two keys that exclude each other were both written. Returns whether they were.
bool reportConflict(Section& section, std::string_view one, std::string_view other, BuildContext& context);

/// Adds to the number of particles that the scene will have, and records a problem with a key if it becomes too large.
/// @param what  "the body would have", for the message
void addExpectedParticles(Section& section, std::string_view name, double particles, std::string_view what,
                          BuildContext& context);

/// "at most 2e+06 are allowed; --limit particles=N allows more"
std::string allowedText(std::string_view limit, double most);

/// Whether a box may have an extent of zero.
enum class Flatness { allowed, forbidden };

/// Records a problem if maximum is below minimum along any axis, or, for a box that must not be flat, equal to it. Does
/// nothing unless the section has both.
void checkCorners(Section& section, Flatness flatness, BuildContext& context);

/// Index of the material that a section refers to, 0 if it refers to none; nothing, with the problem recorded, if it is
/// not defined.
std::optional<std::uint32_t> materialOf(Section& section, const Materials& materials, BuildContext& context);

/// The vector scaled to length 1; nothing for the zero vector.
std::optional<engine::Vec3> unitVector(const engine::Vec3& vector);

/// The direction that a key gives, with length 1; nothing, with the problem recorded, if it is the zero vector.
std::optional<engine::Vec3> directionFrom(Section& section, std::string_view name, BuildContext& context);

}  // namespace scenes
