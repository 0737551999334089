// Keys above the first table, and those of [physics], [world], [material], [still] and [study].
#include "engine/force_law/material.h"
#include "scenes/model/study.h"
#include "scenes/schema/keys.h"

namespace scenes {

std::vector<Key> topKeys() {
    return {
        key("title", Type::string, "", "what the scene shows").required().notSimulated(),
        key("description", Type::string, "", "more about the scene").defaultsTo("\"\"").notSimulated(),
        // A duration of at most a million seconds keeps every frame number within 32 bits.
        key("duration", Type::number, "s", "length of the animation")
            .required()
            .within({0.0, 1e6, true})
            .notSimulated(),
        key("fps", Type::frameRate, "1/s",
            "frames per second, also as a fraction such as \"30000/1001\"; frame k shows the time k / fps")
            .defaultsTo("30")
            .within({1.0, 240.0}),
        key("seed", Type::integer, "", "seed of all random numbers").defaultsTo("1").within(kNotNegative),
        key("resolution", Type::number, "",
            "divides all radii and spacings of particles, also those given, and physics.step; the same substances and "
            "volumes, of this number to the third power times as many particles")
            .defaultsTo("1")
            .within({0.01, 100.0}),
    };
}

std::vector<Key> physicsKeys() {
    return {
        key("gravity", Type::vec3, "m/s^2", "acceleration of every particle").defaultsTo("[0, -9.8, 0]"),
        key("drag", Type::number, "1/s", "rate k at which free motion decays, like exp(-k t)")
            .defaultsTo("0")
            .within(kNotNegative),
        key("stepper", Type::choice, "",
            "time integrator; symplectic-euler is the paper's, auto the cheapest one that meets the wanted error")
            .defaultsTo("\"auto\"")
            .oneOf(
                {"symplectic-euler", "velocity-verlet", "leapfrog", "implicit-damping", "linearly-implicit", "auto"}),
        key("error", Type::number, "",
            "wanted position error in particle radii per second of motion; for the auto stepper")
            .defaultsTo("0.01")
            .within(kPositive),
        key("step", Type::number, "s", "longest time step of a fixed stepper; a frame is divided into equal steps")
            .defaultsTo("0.002")
            .within({.low = 1e-9}),
        key("solver_tolerance", Type::number, "",
            "residual relative to the right-hand side at which the solver of an implicit stepper stops; the auto "
            "stepper may stop it earlier where the wanted error allows it")
            .defaultsTo("0.0001")
            .within(kOpenUnitInterval),
        key("precision", Type::choice, "",
            "arithmetic of the pair forces, unless more than 64 materials have different laws; the state is always "
            "double")
            .defaultsTo("\"double\"")
            .oneOf({"double", "float"}),
        key("forces", Type::choice, "",
            "how pairs are found: with a cell grid, or by testing every pair as in the paper")
            .defaultsTo("\"grid\"")
            .oneOf({"grid", "reference"}),
        key("heat_step", Type::number, "s", "longest time between two exchanges of heat, in scenes that have heat")
            .defaultsTo("0.034")
            .within(kPositive),
        key("wall", Type::choice, "",
            "how obstacles answer: scaled to the mass, stiffness and radius of what hits them, and passed by nothing; "
            "or as in the paper, alike for all")
            .defaultsTo("\"scaled\"")
            .oneOf({"scaled", "paper"}),
    };
}

std::vector<Key> worldKeys() {
    return {
        position("minimum", "corner with the smallest coordinates").derivedAs("no bound"),
        position("maximum", "corner with the largest coordinates").derivedAs("no bound"),
    };
}

std::vector<Key> materialKeys() {
    const std::string_view preset = "of the preset";
    std::vector<std::string_view> presets;
    for (const engine::Material& material : engine::materialPresets()) presets.push_back(material.name);
    return {
        key("name", Type::string, "", "name that bodies and emitters refer to").derivedAs("the preset's name"),
        key("preset", Type::choice, "",
            "row of Table 1 of the paper, or a named substance, that the other keys take their defaults from")
            .defaultsTo("\"liquid\"")
            .oneOf(presets),
        length("radius", "radius of a particle; what is left out of mass, b1 and bd follows from it")
            .derivedAs(preset)
            .within(kRadii),
        key("mass", Type::number, "kg", "mass of a particle")
            .derivedAs("of the preset, times the third power of radius over the preset's radius")
            .within(kMasses),
        key("b1", Type::number, "N m^4", "strength of repulsion and attraction")
            .derivedAs("of the preset, times the sixth power of radius over the preset's radius; or from compression")
            .within(kNotNegative),
        key("bd", Type::number, "kg/s", "strength of damping: viscosity")
            .derivedAs("of the preset, times radius over the preset's radius")
            .within(kNotNegative),
        key("compression", Type::number, "",
            "share of its height by which a column of the material sinks under its own weight; chooses b1")
            .derivedAs("as b1 has it")
            .within(kOpenUnitInterval),
        length("depth", "height of the column of which compression is a share")
            .derivedAs("of the tallest body of the material"),
        key("cr", Type::number, "",
            "cutoff of repulsion and attraction in rest lengths; particles attract only above 1")
            .derivedAs(preset)
            .within({.low = 1.0}),
        key("cd", Type::number, "", "cutoff of damping in rest lengths").derivedAs(preset).within(kPositive),
        key("cohesion", Type::number, "N/m",
            "surface tension, which makes drops and holds threads together; raises b1 where that is too small for the "
            "density to stay; 0: none, as in the paper")
            .defaultsTo("0")
            .within(kNotNegative),
        key("agitation", Type::number, "",
            "energy of the particles' random motion, in units of cohesion times the square of their diameter: "
            "from 0.03 on, drops are liquid and round off; 0: none, as in the paper, and they set like a soft solid")
            .defaultsTo("0")
            .within(kUnitInterval),
        key("friction", Type::number, "",
            "friction coefficient, between particles and against obstacles; 0: none, as in the paper")
            .derivedAs(preset)
            .within(kNotNegative),
        key("core", Type::number, "", "share of the rest length below which the force grows no further")
            .derivedAs(preset)
            .within(kOpenUnitInterval),
        color("color", "color of the particles").derivedAs("by preset").notSimulated(),
        key("capacity", Type::number, "J/(kg K)", "specific heat capacity; gives the scene heat")
            .derivedAs("no heat")
            .within(kPositive),
        key("conductivity", Type::number, "W/(m K)", "thermal conductivity").derivedAs("0").within(kNotNegative),
        temperature("melting", "temperature at which it begins to melt").derivedAs("it does not melt"),
        key("melting_range", Type::number, "K", "by how much warmer it is when all of it has melted")
            .derivedAs("0")
            .within(kNotNegative),
        key("latent", Type::number, "J/kg", "heat that melting takes").derivedAs("0").within(kNotNegative),
        key("melts_to", Type::string, "",
            "name of the [[material]] with the constants and the color of the melt, taken at the radius of the solid")
            .derivedAs("it keeps its constants"),
        temperature("temperature", "temperature of its particles at first").derivedAs("293.15"),
    };
}

std::vector<Key> airKeys() {
    return {
        temperature("temperature", "temperature of the air and of what is far away").defaultsTo("293.15"),
        key("exchange", Type::number, "W/(m^2 K)", "heat transfer coefficient of the free surface")
            .defaultsTo("0")
            .within(kNotNegative),
        share("emissivity", "share of a black body's heat radiation that the free surface gives and takes")
            .defaultsTo("0"),
    };
}

std::vector<Key> stillKeys() {
    return {
        key("time", Type::number, "s", "time of the picture").derivedAs("half the duration").within(kNotNegative),
        key("strip", Type::numberList, "s", "times of the pictures in the scene's strip, side by side")
            .derivedAs("the four quarters of the duration")
            .within(kNotNegative),
    };
}

std::vector<Key> studyKeys() {
    std::vector<std::string_view> names;
    for (const ObservableInfo& info : observables()) names.push_back(info.name);
    return {
        key("number", Type::integer, "", "row in the table of the study").required().within({1.0, 1e3}),
        key("observable", Type::choice, "", "what is measured; `globular study stability --help` explains each")
            .required()
            .oneOf(names),
        key("limit", Type::number, "", "largest value of the observable that passes").required().within(kNotNegative),
        key("at_least", Type::number, "", "smallest value of the observable that passes")
            .derivedAs("no lower limit")
            .within(kNotNegative),
        key("paper_must_fail", Type::boolean, "", "whether the paper's stepper is expected to fail")
            .defaultsTo("false"),
        key("paper_step", Type::number, "s", "time step of the paper's stepper").defaultsTo("0.01").within(kPositive),
        key("reference_step", Type::number, "s", "time step of the run that errors are measured against")
            .derivedAs("no reference")
            .within(kPositive),
        key("reference_stepper", Type::choice, "", "stepper of the run that errors are measured against")
            .defaultsTo("\"velocity-verlet\"")
            .oneOf({"symplectic-euler", "velocity-verlet", "leapfrog", "implicit-damping", "linearly-implicit"}),
        key("vary", Type::stringList, "",
            "variants of the scene, each written KEY=VALUE; KEY=VALUE as for --set; none: the scene as it is")
            .defaultsTo("[]"),
        key("quick", Type::stringList, "", "the variants that a quick run goes through").derivedAs("those of vary"),
    };
}

}  // namespace scenes
