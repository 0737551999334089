// Keys of [[body]], [[emitter]] and [[obstacle]], and of the paths of the latter two.
#include "scenes/schema/keys.h"

namespace scenes {
namespace {

constexpr std::string_view kMinimumHelp = "corner with the smallest coordinates";
constexpr std::string_view kMaximumHelp = "corner with the largest coordinates";
constexpr std::string_view kRotationHelp =
    "angles by which the shape is turned about the x axis, then y, then z, around its center";
constexpr std::string_view kProfileHelp =
    "points [radius, height] of the profile that is turned around the y axis, in order";

constexpr Range kDegrees{.low = -36000.0, .high = 36000.0};

/// The shapes of bodies that are filled with a lattice.
const std::vector<std::string_view> kPacked = {"box",     "ball",  "grid",       "cylinder", "cone", "frustum",
                                               "capsule", "shell", "revolution", "mesh",     "text", "image"};

/// Angles of a path, degrees. Their sines are computed to the last bits up to far more.
constexpr Range kAngles{.low = -1e6, .high = 1e6};

/// Keys of a moment on the path of an object.
std::vector<Key> pathKeys(std::string_view positionHelp, std::string_view rotationHelp, std::string_view first) {
    return {
        key("time", Type::number, "s", "when; each time has to be after the one before")
            .required()
            .within(kNotNegative)
            .notInherited(),
        position("position", positionHelp).derivedAs(first),
        key("rotation", Type::vec3, "degrees", rotationHelp).derivedAs(first).within(kAngles),
    };
}

/// Turns a second. The sines of an hour's turns have all their bits.
constexpr Range kSpins{.low = -40.0, .high = 40.0};

// Keys that bodies and obstacles share.

Key topRadiusKey() {
    return key("top_radius", Type::number, "m", "radius of a frustum at its top; it may be 0")
        .required()
        .within({.low = 0.0, .high = engine::kWorldLimit})
        .onlyFor({"frustum"});
}

Key scaleKey() {
    return key("scale", Type::number, "", "factor on the coordinates of a mesh, which are in meters")
        .defaultsTo("1")
        .within({.low = 0.0, .high = 1e9, .isLowExcluded = true})
        .onlyFor({"mesh"});
}

Key profileKey() {
    return key("profile", Type::pairList, "m", kProfileHelp).required().within(kWithinWorld).onlyFor({"revolution"});
}

Key closedKey() {
    return key("closed", Type::boolean, "", "whether the last point of the profile is joined to the first")
        .derivedAs("true without a thickness, false with one")
        .onlyFor({"revolution"});
}

Key smoothKey() {
    return key("smooth", Type::boolean, "",
               "whether a curve goes through the points of the profile, not straight lines")
        .defaultsTo("false")
        .onlyFor({"revolution"});
}

Key filletKey() {
    return key("fillet", Type::number, "m", "radius with which inner corners of the profile are rounded")
        .derivedAs("the thickness of a wall, or a fiftieth of the size of a solid")
        .within({.low = 0.0, .high = engine::kWorldLimit})
        .onlyFor({"revolution"});
}

}  // namespace

std::vector<Key> bodyKeys() {
    return {
        key("shape", Type::choice, "", "what is filled with particles at the start")
            .required()
            .oneOf({"box", "ball", "grid", "cylinder", "cone", "frustum", "capsule", "shell", "revolution", "mesh",
                    "text", "image", "points", "file"}),
        key("material", Type::string, "", "name of a [[material]]")
            .derivedAs("the first; for a file, the materials in it"),
        temperature("temperature", "temperature of its particles at first, in scenes that have heat")
            .derivedAs("of the material"),
        velocity("velocity", "velocity of every particle, in addition to those of points and files")
            .defaultsTo("[0, 0, 0]"),
        position("center",
                 "center of the body; the origin of a profile, the middle of a mesh, text or image. Without it, a mesh "
                 "is where its file has it")
            .defaultsTo("[0, 0, 0]")
            .onlyFor({"ball", "grid", "cylinder", "cone", "frustum", "capsule", "shell", "revolution", "mesh", "text",
                      "image"}),
        key("rotation", Type::vec3, "degrees", kRotationHelp)
            .defaultsTo("[0, 0, 0]")
            .within(kDegrees)
            .onlyFor({"box", "cylinder", "cone", "frustum", "capsule", "revolution", "mesh", "text", "image"}),
        length("radius", "radius; of a cone or frustum, at its bottom")
            .required()
            .onlyFor({"ball", "cylinder", "cone", "frustum", "capsule", "shell"}),
        topRadiusKey(),
        length("height",
               "height, along y before the rotation; of a capsule, from end to end; of a text, of its "
               "capital letters; of an image, of the whole image")
            .derivedAs("of an image, from its width; otherwise it is required")
            .onlyFor({"cylinder", "cone", "frustum", "capsule", "text", "image"}),
        length("width", "width of the whole image").derivedAs("from its height").onlyFor({"image"}),
        length("depth", "depth of the letters or of the image, along z before the rotation")
            .required()
            .onlyFor({"text", "image"}),
        profileKey(),
        closedKey(),
        smoothKey(),
        filletKey(),
        length("thickness",
               "thickness of the wall along a profile; for other shapes, of what is filled below the "
               "surface of a body that is hollow")
            .derivedAs("the whole inside is filled; a shell needs it")
            .onlyFor({"box", "ball", "cylinder", "cone", "frustum", "capsule", "shell", "revolution", "mesh", "text",
                      "image"}),
        scaleKey(),
        key("text", Type::string, "", "letters to fill, in one or more lines").required().onlyFor({"text"}),
        key("font", Type::string, "", "TrueType or OpenType font file, relative to the scene file")
            .derivedAs("DejaVu Sans, which is built in")
            .onlyFor({"text"}),
        position("minimum", kMinimumHelp).required().onlyFor({"box"}),
        position("maximum", kMaximumHelp).required().onlyFor({"box"}),
        key("counts", Type::counts, "", "number of particles along x, y and z")
            .required()
            .within({1.0, 1e6})
            .onlyFor({"grid"}),
        length("spacing", "distance of nearest neighbors").derivedAs("two particle radii").onlyFor(kPacked),
        key("jitter", Type::number, "",
            "random displacement, as a share of the spacing; without any a splash is a star")
            .derivedAs("0.05; 0 for a grid")
            .within({0.0, 0.5})
            .onlyFor(kPacked),
        key("positions", Type::vec3List, "m", "position of each particle")
            .required()
            .within(kWithinWorld)
            .onlyFor({"points"}),
        key("velocities", Type::vec3List, "m/s", "velocity of each particle, in the order of positions")
            .derivedAs("at rest")
            .within(kWithinWorld)
            .onlyFor({"points"}),
        key("file", Type::string, "",
            "relative to the scene file: for a file, its particles, as PLY, VTP, extended XYZ or a LAMMPS dump, as "
            "`globular simulate` and other programs write them; for a mesh, a closed one in OBJ, STL, PLY or glTF; for "
            "an image, a PNG whose dark pixels are filled")
            .required()
            .onlyFor({"file", "mesh", "image"}),
        length("particle_radius",
               "radius of this body's particles; what their material leaves out of mass, b1 and bd follows from it")
            .derivedAs("of the material; for a file, the radii in it")
            .within(kRadii),
        key("particle_mass", Type::number, "kg", "mass of this body's particles")
            .derivedAs("of the material at this radius; for a file, the masses in it")
            .within(kMasses),
    };
}

std::vector<Key> emitterKeys() {
    return {
        key("shape", Type::choice, "",
            "what the points of emission fill: single points, a disc, a circle, a box or a line")
            .defaultsTo("\"point\"")
            .oneOf({"point", "disc", "ring", "box", "line"}),
        position("position", "point of emission, center of the disc, ring or box, or one end of the line")
            .derivedAs("none: this or positions is required"),
        key("positions", Type::vec3List, "m", "several points of emission")
            .derivedAs("none: this or position is required")
            .within(kWithinWorld)
            .onlyFor({"point"}),
        velocity("velocity", "velocity of emitted particles").defaultsTo("[0, 0, 0]"),
        velocity("travel", "velocity of the emitter itself, which its particles get, too").defaultsTo("[0, 0, 0]"),
        key("spin", Type::vec3, "turns/s",
            "turning of the emitter about its position, or the first of its positions: the axis, times turns a second")
            .defaultsTo("[0, 0, 0]")
            .within(kSpins),
        key("spread", Type::number, "degrees", "largest angle of a particle's velocity to `velocity`, random")
            .defaultsTo("0")
            .within({0.0, 90.0}),
        key("speed_spread", Type::number, "", "largest random change of the speed, as a share of it")
            .defaultsTo("0")
            .within({.low = 0.0, .high = 1.0, .isHighExcluded = true}),
        key("direction", Type::vec3, "", "normal of the disc or ring, of any length")
            .derivedAs("of the velocity")
            .onlyFor({"disc", "ring"}),
        length("radius", "radius of the disc or ring").required().onlyFor({"disc", "ring"}),
        key("size", Type::vec3, "m", "edge lengths of the box; 0 makes it flat, and twice 0 a line")
            .required()
            .within({.low = 0.0, .high = engine::kWorldLimit})
            .onlyFor({"box"}),
        position("end", "other end of the line").required().onlyFor({"line"}),
        length("spacing", "distance of the points of emission")
            .derivedAs("two particle radii, or the diameter of a cluster")
            .onlyFor({"disc", "ring", "box", "line"}),
        key("interval", Type::number, "s",
            "time between emissions of each point, or of the whole emitter if it picks points at random")
            .derivedAs("of the rate; without it, particles follow one another touching")
            .within({.low = 1e-9}),
        key("rate", Type::number, "1/s", "particles that the whole emitter emits per second")
            .derivedAs("of the interval")
            .within({0.0, 1e9, true}),
        key("cluster", Type::integer, "", "particles of one emission, which form a drop around its point")
            .defaultsTo("1")
            .within({1.0, 1000.0}),
        key("start", Type::number, "s", "time of the first emission").defaultsTo("0").within(kNotNegative),
        key("until", Type::number, "s", "nothing is emitted at or after this time")
            .derivedAs("no end")
            .within(kPositive),
        key("count", Type::integer, "", "total number of particles emitted").derivedAs("no limit").within({.low = 1.0}),
        key("pick", Type::choice, "",
            "which points emit: each in its turn, evenly over the interval; all at once; or one at random each time")
            .defaultsTo("\"staggered\"")
            .oneOf({"staggered", "all", "random"}),
        key("clearance", Type::number, "",
            "smallest distance to other particles at emission, in sums of radii; 0 lets them overlap")
            .derivedAs("1 less what the jitter may take away, at least 0.8")
            .within(kNotNegative),
        key("jitter", Type::number, "", "random displacement perpendicular to the velocity, in particle radii")
            .defaultsTo("0.1")
            .within({0.0, 10.0}),
        key("material", Type::string, "", "name of a [[material]]").derivedAs("the first"),
        temperature("temperature", "temperature of its particles when they are emitted, in scenes that have heat")
            .derivedAs("of the material"),
    };
}

std::vector<Key> emitterPathKeys() {
    return pathKeys("where the emitter's position is then, or the first of its positions",
                    "turns of the points of emission and of the velocity about that position, about x, then y, then z",
                    "of the key before; in the first, the emitter's own");
}

std::vector<Key> obstacleKeys() {
    const std::vector<std::string_view> kWithSurface = {"box",     "sphere",  "cylinder",   "cone",
                                                        "frustum", "capsule", "revolution", "mesh"};
    return {
        key("shape", Type::choice, "", "shape of the obstacle; a container is the inside of a box")
            .required()
            .oneOf({"plane", "box", "container", "sphere", "cylinder", "cone", "frustum", "capsule", "revolution",
                    "mesh"}),
        position("point", "any point of the plane").defaultsTo("[0, 0, 0]").onlyFor({"plane"}),
        key("normal", Type::vec3, "", "direction away from the solid side, of any length")
            .defaultsTo("[0, 1, 0]")
            .onlyFor({"plane"}),
        position("minimum", kMinimumHelp).derivedAs("from center and size").onlyFor({"box", "container"}),
        position("maximum", kMaximumHelp).derivedAs("from center and size").onlyFor({"box", "container"}),
        position(
            "center",
            "center, required for a sphere; of a revolution, the origin of the profile; without it, a mesh is where "
            "its file has it")
            .derivedAs("from minimum and maximum; of what is turned around an axis, [0, 0, 0]")
            .onlyFor({"box", "container", "sphere", "cylinder", "cone", "frustum", "capsule", "revolution", "mesh"}),
        key("size", Type::vec3, "m", "edge lengths")
            .derivedAs("from minimum and maximum")
            .within(kPositive)
            .onlyFor({"box", "container"}),
        length("radius", "radius; of a cone or frustum, at its bottom")
            .required()
            .onlyFor({"sphere", "cylinder", "cone", "frustum", "capsule"}),
        topRadiusKey(),
        length("height", "height, along y before the rotation; of a capsule, from end to end")
            .required()
            .onlyFor({"cylinder", "cone", "frustum", "capsule"}),
        profileKey(),
        closedKey(),
        smoothKey(),
        filletKey(),
        length("thickness", "thickness of the wall along a profile")
            .derivedAs("the inside of the profile is solid")
            .onlyFor({"revolution"}),
        key("file", Type::string, "", "closed mesh, relative to the scene file: OBJ, STL, PLY or glTF")
            .required()
            .onlyFor({"mesh"}),
        scaleKey(),
        key("repulsor", Type::choice, "",
            "what repels particles: a repulsor below the surface, or one as large as the sphere, for the paper's walls "
            "alone")
            .defaultsTo("\"surface\"")
            .oneOf({"surface", "literal"})
            .onlyFor({"sphere"}),
        key("rotation", Type::vec3, "degrees", "turns about the x axis, then y, then z, around the pivot")
            .defaultsTo("[0, 0, 0]")
            .within(kDegrees),
        velocity("velocity", "velocity of the obstacle").defaultsTo("[0, 0, 0]"),
        key("spin", Type::vec3, "turns/s", "turning of the obstacle about its pivot: the axis, times turns a second")
            .defaultsTo("[0, 0, 0]")
            .within(kSpins),
        position("pivot", "point that the obstacle turns about, where it is placed without motion")
            .derivedAs("the center; of a plane, its point"),
        key("until", Type::number, "s", "the obstacle is taken away at this time")
            .derivedAs("no end")
            .within(kPositive),
        key("record", Type::boolean, "",
            "whether its load (impulse, angular impulse and work) is recorded in run.json and loads.csv")
            .derivedAs("true for what moves"),
        key("restitution", Type::number, "", "speed after a rebound over the speed before; not of the paper's walls")
            .derivedAs("0.2, less for viscous materials")
            .within(kUnitInterval),
        key("friction", Type::number, "", "friction coefficient against particles; not of the paper's walls")
            .derivedAs("of the particle's material")
            .within(kNotNegative),
        key("adhesion", Type::number, "N/m^2",
            "stress with which the surface holds particles that touch it; not of the paper's walls")
            .defaultsTo("0")
            .within(kNotNegative),
        temperature("temperature", "temperature that it keeps, in scenes that have heat")
            .derivedAs("it takes no heat and gives none"),
        key("contact_angle", Type::number, "degrees",
            "angle, inside a drop, between the surface and that of a material with cohesion: 180 beads up, 0 wets; not "
            "of the paper's walls")
            .defaultsTo("180")
            .within({.low = 0.0, .high = 180.0}),
        key("visible", Type::boolean, "", "whether the obstacle is drawn; planes never are")
            .defaultsTo("true")
            .onlyFor({"box", "container", "sphere", "cylinder", "cone", "frustum", "capsule", "revolution", "mesh"})
            .notSimulated(),
        key("faces", Type::boolean, "", "whether the surface is drawn")
            .defaultsTo("true")
            .onlyFor({"box", "cylinder", "cone", "frustum", "capsule", "revolution", "mesh"})
            .notSimulated(),
        key("edges", Type::boolean, "", "whether edges are drawn as lines, and four lines along a profile")
            .derivedAs("true for a container, false for others")
            .onlyFor({"box", "container", "cylinder", "cone", "frustum", "capsule", "revolution", "mesh"})
            .notSimulated(),
        color("color", "color of the surface, or of the edges of a container")
            .derivedAs("gray; of what is transparent, that of glass; for a container look.edge_color")
            .onlyFor({"box", "container", "sphere", "cylinder", "cone", "frustum", "capsule", "revolution", "mesh"})
            .notSimulated(),
        share("transparency", "share of what is behind that shows through the surface, as through glass")
            .defaultsTo("0")
            .onlyFor(kWithSurface)
            .notSimulated(),
        refractiveIndexKey().defaultsTo("1.5").onlyFor(kWithSurface).notSimulated(),
        attenuationKey().onlyFor(kWithSurface).notSimulated(),
    };
}

std::vector<Key> obstaclePathKeys() {
    return pathKeys("where the obstacle's center is then, or a plane's point",
                    "turns of the obstacle about that position, about x, then y, then z",
                    "of the key before; in the first, the obstacle's own");
}

}  // namespace scenes
