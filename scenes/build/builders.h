// One function for each kind of table in a scene file, which turns the validated keys and values of a table (its
// Section) into a part of the scene. Each records the problems that the schema alone cannot tell (keys that contradict
// each other, undefined names, files that cannot be read), and makes its part only if there are none. Called by
// read_scene.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/obstacles/motion.h"
#include "scenes/build/read_scene.h"
#include "scenes/schema/read_sections.h"
#include "scenes/shapes/mesh.h"

namespace scenes {

/// The materials of a scene in the order of its [[material]] tables, then those of bodies whose particles have another
/// radius than their material's.
struct Materials {
    std::vector<engine::Material> list;
    std::vector<engine::Vec3> colors;  ///< of the particles, linear RGB
    std::vector<Section*> sections;    ///< the table that each material comes from
    std::vector<std::string> notes;    ///< why mass, b1 and bd are what they are; empty: those of the preset
};

/// What the builders share.
struct BuildContext {
    ProblemList& problems;
    ProblemList& warnings;                        ///< messages on what is valid but may not be meant
    std::string folder;                           ///< the scene file's folder, which file names in it are relative to
    double duration = 1.0;                        ///< s
    engine::Vec3 gravity = engine::Vec3::Zero();  ///< m/s^2
    std::uint64_t seed = 1;
    double resolution = 1.0;  ///< factor by which radii and spacings are divided
    bool hasOmissions =
        false;  ///< a part of the scene file could not be read, so keys that seem to be missing may be in it
    std::uint64_t contentHash;                      ///< hash over the contents of the files that the scene refers to
    std::vector<std::filesystem::path> files = {};  ///< these files
    std::map<std::string, Mesh> meshes = {};        ///< the meshes among them that have been read, by path
    std::vector<std::string> meshNotes = {};        ///< what was made of the meshes, for `globular check`
    std::map<std::string, std::vector<std::uint8_t>> contents = {};  ///< likewise the contents of fonts and images
    Limits limits = {};
    double expectedParticles = 0.0;  ///< number of particles of the bodies and emitters built so far
};

/// Refines bodies, emitters and the time step for the key resolution: spacings, counts and schedules. Materials are
/// refined when they are built. Records a problem for what cannot be refined.
void applyResolution(Sections& sections, BuildContext& context);

/// @param bodies  of which the tallest tells the depth of a material that gives its compression without one
Materials buildMaterials(std::vector<Section>& sections, const std::vector<Section>& bodies, BuildContext& context);

/// Index of the material that acts like the given one and has particles of another radius (m): what its table leaves
/// out of mass, b1 and bd follows from the radius. It is added unless it is there.
std::uint32_t materialAtRadius(Materials& materials, std::uint32_t index, double radius);

/// Adds the particles of the bodies to the scene, and which of them are of which body.
void buildBodies(std::vector<Section>& sections, Materials& materials, Scene& scene, BuildContext& context);
std::vector<engine::Emitter> buildEmitters(std::vector<Section>& sections, const Materials& materials,
                                           BuildContext& context);

std::vector<engine::Field> buildFields(std::vector<Section>& sections, BuildContext& context);

CameraPath buildCamera(std::vector<Section>& sections, BuildContext& context);
/// The square root of a camera's number of samples, rounded down.
int samplesPerAxis(const Section& camera);
/// @param camera  gives the ground's default distance of fading a scale
Look buildLook(Section& section, const CameraPath& camera, BuildContext& context);
/// Adds the obstacles to the simulation and to the look of the scene, after the bodies.
void buildObstacles(std::vector<Section>& sections, const Section& physics, const Section& look,
                    const Materials& materials, Scene& scene, BuildContext& context);
/// Adds the overlay to the look of the scene. The cameras have to be built before, because a scale bar must fit into
/// the picture of each of them.
void buildOverlay(Section& section, const Section& look, Scene& scene, BuildContext& context);
/// Enthalpy of a particle of a material (J) at the temperature of its [[body]] or else of its material; NaN in a scene
/// without heat.
double enthalpyOf(const Section& section, const Materials& materials, std::uint32_t material, double mass);

/// Adds heat to a scene that has any, after the particles, emitters and obstacles: the stages of what melts, and what
/// exchanges heat. Records problems with keys of heat.
void buildHeat(Sections& sections, Materials& materials, Scene& scene, BuildContext& context);
/// Chooses how often particles get random impulses, once all materials are known.
void buildAgitation(const Sections& sections, const Materials& materials, engine::Setup& setup);

Study buildStudy(Section& section, BuildContext& context);

// The functions below are in build_shared.cpp and used by several of the functions above.

/// Records a problem with a key of a section, and marks the section as invalid.
/// @param message  a format string for the values
template <class... Values>
void report(Section& section, std::string_view name, BuildContext& context,
            fmt::format_string<const Values&...> message, const Values&... values) {
    section.markInvalid();
    context.problems.add(section.position(name), fmt::format(message, values...));
}

/// Records a problem with a key of a section if one of these positions of particles is outside of the world.
void checkWithinWorld(Section& section, std::string_view name, std::span<const engine::Vec3> positions,
                      BuildContext& context);

/// Records that a key is missing from a section, and marks the section as invalid.
void reportMissing(Section& section, std::string_view name, BuildContext& context);

/// Settles the matter if two keys that exclude each other were both written: one of the command line takes precedence
/// over one of the scene file, which is erased; otherwise a problem is recorded. Returns whether there is a problem.
bool settleConflict(Section& section, std::string_view one, std::string_view other, BuildContext& context);

/// Adds to the number of particles that the scene will have, and records a problem with a key of the section if that
/// number exceeds the limit.
/// @param what  beginning of the message, "the body would have"
void addExpectedParticles(Section& section, std::string_view name, double particles, std::string_view what,
                          BuildContext& context);

/// End of a message about a limit that is exceeded: "at most 2e+06 are allowed; --limit particles=N allows more".
std::string allowedText(std::string_view limit, double most);

/// Whether a box may have the same minimum and maximum along an axis.
enum class Flatness { allowed, forbidden };

/// Records a problem if the key maximum is below the key minimum along any axis, or equal to it where the box must not
/// be flat. Does nothing unless the section has both keys.
void checkCorners(Section& section, Flatness flatness, BuildContext& context);

/// Index of the material that a body or emitter names, 0 if it names none; nothing, with the problem recorded, if there
/// is no material of that name.
std::optional<std::uint32_t> materialOf(Section& section, const Materials& materials, BuildContext& context);

/// How an object moves: with the constant velocity and the spin of its table, or along the path of the tables "key"
/// within it. Records a problem if both are given. In build_motion.cpp.
/// @param velocity  name of the key that gives the velocity of the object itself
/// @param pivot     the point of the object that the keys place, about which it turns, m
engine::Motion motionFrom(Section& section, std::string_view velocity, const engine::Vec3& pivot,
                          BuildContext& context);

/// The inside of a transparent body, by the keys of a table that has them all.
render::Medium mediumFrom(const Section& section);

/// The vector scaled to length 1; nothing for the zero vector.
std::optional<engine::Vec3> unitVector(const engine::Vec3& vector);

/// The vector that a key gives, scaled to length 1; nothing, with the problem recorded, for the zero vector.
std::optional<engine::Vec3> directionFrom(Section& section, std::string_view name, BuildContext& context);

}  // namespace scenes
