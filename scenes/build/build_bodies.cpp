// Makes the particles that exist from the start, from the [[body]] tables of a scene.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/core/hash.h"
#include "engine/core/random.h"
#include "engine/state/bodies.h"
#include "scenes/build/build_shapes.h"
#include "scenes/build/builders.h"
#include "scenes/build/columns.h"
#include "scenes/particles/particle_file.h"
#include "scenes/text/read_file.h"

namespace scenes {
namespace {

using engine::Vec3;

/// A [[body]] table of a scene, from which particles are being made.
struct Body {
    Section& section;
    std::size_t index = 0;
    std::uint32_t material = 0;
    Materials& materials;
};

engine::Packing packingOf(const Section& section, const BuildContext& context) {
    engine::Packing packing;
    packing.spacing = section.number("spacing");
    packing.jitter = section.number("jitter");
    packing.refinement = context.resolution;
    return packing;
}

/// Random displacement in a ball or box whose table gives none, as a share of the spacing. Chosen: it weakens the
/// regular rays in which a lattice splashes, and neighbors stay 0.8 spacings apart.
constexpr double kDefaultJitter = 0.05;

/// Particles of a lattice in a volume (m^3): two in a cube whose face has a diagonal of two spacings.
double particlesIn(double volume, double spacing) {
    return volume * std::sqrt(2.0) / (spacing * spacing * spacing);
}

/// Upper bound of the number of particles in a body of shape box, ball or grid.
double maxParticleCount(const Section& section, const BuildContext& context) {
    const std::string& shape = section.string("shape");
    if (shape == "grid") return section.vector("counts").prod();
    // A ball is cut out of the lattice of its bounding box.
    const Vec3 radius = Vec3::Constant(shape == "ball" ? section.number("radius") : 0.0);
    engine::Packing packing = packingOf(section, context);
    if (shape == "box")
        return 0.5 * engine::boxLayers(section.vector("minimum"), section.vector("maximum"), packing).prod();
    packing.refinement = 1.0;
    return 0.5 * engine::boxLayers(-radius, radius, packing).prod();
}

void checkPoints(Section& section, BuildContext& context) {
    if (!section.has("positions") || !section.has("velocities")) return;
    const std::size_t expected = section.vectors("positions").size();
    const std::size_t found = section.vectors("velocities").size();
    if (found != expected)
        report(section, "velocities", context, "velocities has {} entries, must have {} like positions", found,
               expected);
}

std::vector<Vec3> packedPositions(const Body& body, const BuildContext& context) {
    const Section& section = body.section;
    engine::Packing packing = packingOf(section, context);
    packing.seed = engine::scatter(context.seed ^ engine::scatter(body.index));
    const std::string& shape = section.string("shape");
    if (shape == "ball") return engine::ballPositions(section.vector("center"), section.number("radius"), packing);
    if (shape == "box") return engine::boxPositions(section.vector("minimum"), section.vector("maximum"), packing);
    const Vec3& counts = section.vector("counts");
    const auto count = [&](int axis) { return static_cast<std::uint32_t>(counts[axis]); };
    return engine::gridPositions(section.vector("center"), {count(0), count(1), count(2)}, packing);
}

/// A particle of the body's material, with the velocity, radius and mass that are given for the body.
engine::NewParticle prototypeOf(const Body& body) {
    const engine::Material& material = body.materials.list[body.material];
    body.section.derive("particle_radius", TypedValue::ofNumber(material.radius));
    body.section.derive("particle_mass", TypedValue::ofNumber(material.mass));
    engine::NewParticle particle;
    particle.velocity = body.section.vector("velocity");
    particle.radius = body.section.number("particle_radius");
    particle.mass = body.section.number("particle_mass");
    particle.material = body.material;
    particle.enthalpy = enthalpyOf(body.section, body.materials, body.material, particle.mass);
    return particle;
}

/// The positions in a solid of any form. Empty, with the problem recorded, if it would have too many of them or none,
/// or if its mesh does not do.
std::vector<Vec3> solidPositions(const Body& body, BuildContext& context) {
    Section& section = body.section;
    engine::Packing packing = packingOf(section, context);
    packing.seed = engine::scatter(context.seed ^ engine::scatter(body.index));
    try {
        // Voxels are half a particle's radius wide.
        const Solid solid = solidFrom(section, 0.25 * packing.spacing, context);
        const double expected = particlesIn(estimatedVolume(solid), packing.spacing);
        if (expected > context.limits.particles) {
            addExpectedParticles(section, "shape", expected, "the body would have", context);
            return {};
        }
        std::vector<Vec3> positions = engine::positionsInside(
            solid.bounds(), [&](const Vec3& point) { return solid.distance(point); }, packing,
            static_cast<std::size_t>(context.limits.particles) + 1);
        if (positions.empty()) {
            report(section, "shape", context,
                   "no particle fits into the body: it is thinner than the spacing, {:.6g} m; make it larger, or its "
                   "particles smaller",
                   packing.spacing);
            return {};
        }
        addExpectedParticles(section, "shape", static_cast<double>(positions.size()), "the body has", context);
        return positions;
    } catch (const InputError& error) {
        section.markInvalid();
        context.problems.add(section.position("file"), error);
        return {};
    }
}

void appendPacked(const Body& body, BuildContext& context, engine::Particles& particles) {
    engine::NewParticle particle = prototypeOf(body);
    const std::vector<Vec3> positions =
        isFilledSolid(body.section) ? solidPositions(body, context) : packedPositions(body, context);
    if (!body.section.isValid()) return;
    for (const Vec3& position : positions) {
        particle.position = position;
        append(particles, particle);
    }
}

void appendPoints(const Body& body, engine::Particles& particles) {
    engine::NewParticle particle = prototypeOf(body);
    const std::vector<Vec3>& positions = body.section.vectors("positions");
    for (std::size_t index = 0; index < positions.size(); ++index) {
        particle.position = positions[index];
        if (body.section.has("velocities"))
            particle.velocity = body.section.vector("velocity") + body.section.vectors("velocities")[index];
        append(particles, particle);
    }
}

/// Gives the particles of a file the materials that its species are called like, if every species is called like one.
/// Otherwise the species count as skipped: they may be the elements of a chemist's file.
void findMaterials(const Body& body, ParticleFile& file) {
    if (file.hasMaterial || file.species.empty()) return;
    std::vector<std::uint32_t> materials;
    for (const std::string& name : file.speciesNames) {
        const auto found = std::ranges::find(body.materials.list, name, &engine::Material::name);
        if (found == body.materials.list.end())
            return file.skipped.push_back(fmt::format("species (no material is called \"{}\")", name.substr(0, 40)));
        materials.push_back(static_cast<std::uint32_t>(found - body.materials.list.begin()));
    }
    for (std::size_t index = 0; index < file.species.size(); ++index)
        file.particles.material[index] = materials[file.species[index]];
    file.hasMaterial = true;
}

/// Appends one particle of a file. Where radius, mass or material of a particle are given more than once, the keys of
/// the [[body]] take precedence over the file, and the file over the material.
void appendFileParticle(const Body& body, const ParticleFile& file, std::size_t index, engine::Particles& particles) {
    const Section& section = body.section;
    const bool usesFileMaterial = file.hasMaterial && !section.has("material");
    engine::NewParticle particle;
    particle.material = usesFileMaterial ? file.particles.material[index] : body.material;
    const engine::Material& material = body.materials.list[particle.material];
    particle.position = file.particles.position[index];
    particle.velocity = file.particles.velocity[index] + section.vector("velocity");
    particle.radius = section.has("particle_radius") ? section.number("particle_radius")
                      : file.hasRadius               ? file.particles.radius[index]
                                                     : material.radius;
    particle.mass = section.has("particle_mass") ? section.number("particle_mass")
                    : file.hasMass               ? file.particles.mass[index]
                                                 : material.mass;
    particle.enthalpy = enthalpyOf(section, body.materials, particle.material, particle.mass);
    const bool usesFileHeat = material.thermal.exists() && !section.has("temperature");
    if (usesFileHeat && !file.particles.enthalpy.empty())
        particle.enthalpy = file.particles.enthalpy[index];
    else if (usesFileHeat && !file.temperature.empty())
        particle.enthalpy = particle.mass * engine::enthalpyAt(material.thermal, file.temperature[index]);
    append(particles, particle);
}

void appendFile(const Body& body, BuildContext& context, engine::Particles& particles) {
    Section& section = body.section;
    const std::string path = (std::filesystem::path(context.folder) / section.string("file")).string();
    context.files.emplace_back(path);
    try {
        const std::vector<std::uint8_t> bytes = readFile(path, kMaxParticleFileBytes);
        context.contentHash = engine::fnv1a(asText(bytes), context.contentHash);
        ParticleFile file = decodeParticles(asText(bytes), path);
        if (!section.has("material")) findMaterials(body, file);
        if (!file.skipped.empty())
            context.warnings.add(section.position("file"),
                                 fmt::format("{}: not read: {}", path, fmt::join(file.skipped, ", ")));
        for (std::size_t index = 0; index < file.particles.count(); ++index) {
            if (file.hasMaterial && !section.has("material") &&
                file.particles.material[index] >= body.materials.list.size())
                return report(
                    section, "file", context,
                    "{}: particle {} is of material {}, the scene has {} (counted from 0); name one with material",
                    path, index, file.particles.material[index], body.materials.list.size());
            appendFileParticle(body, file, index, particles);
            if (!particles.enthalpy.empty() && !(particles.enthalpy.back() >= 0.0))
                return report(section, "file", context,
                              "{}: particle {} is colder than 0 K; give the body a temperature", path, index);
        }
    } catch (const InputError& error) {
        section.markInvalid();
        context.problems.add(section.position("file"), error);
    }
}

/// Appends the particles of a body.
void appendBody(const Body& body, BuildContext& context, engine::Particles& particles) {
    const std::string& shape = body.section.string("shape");
    if (shape == "file")
        appendFile(body, context, particles);
    else if (shape == "points")
        appendPoints(body, particles);
    else
        appendPacked(body, context, particles);
}

void buildBody(Body body, BuildContext& context, engine::Particles& particles) {
    Section& section = body.section;
    if (!section.has("shape")) return;
    const std::string& shape = section.string("shape");
    const bool isPacked = shape != "points" && shape != "file";
    // The particles of a file keep their material with its constants, whatever their radii are.
    if (shape != "file" && section.has("particle_radius"))
        body.material = materialAtRadius(body.materials, body.material, section.number("particle_radius"));
    if (isPacked) section.derive("spacing", TypedValue::ofNumber(2.0 * body.materials.list[body.material].radius));
    if (isPacked) section.derive("jitter", TypedValue::ofNumber(shape == "grid" ? 0.0 : kDefaultJitter));
    checkCorners(section, Flatness::allowed, context);
    checkPoints(section, context);
    if (isPacked && section.isValid() && !isFilledSolid(section))
        addExpectedParticles(section, "shape", maxParticleCount(section, context), "the body would have", context);
    if (!section.isValid()) return;
    const std::size_t countBefore = particles.count();
    appendBody(body, context, particles);
    if (!isPacked)
        addExpectedParticles(section, "shape", static_cast<double>(particles.count() - countBefore), "the body has",
                             context);
}

/// The column that a body is, and the material of its particles; without height if the body is empty or has problems.
BodyColumn bodyColumn(const Section& section, const Scene& scene, const Materials& materials, std::size_t first,
                      const BuildContext& context) {
    const engine::Particles& particles = scene.setup.initial;
    BodyColumn column;
    column.shape.height = 0.0;
    if (first == particles.count()) return column;
    column.material = materials.list[particles.material[first]];
    column.material.radius = particles.radius[first];
    column.material.mass = particles.mass[first];
    const auto packed = columnOf(section, column.material, context);
    column.shape = packed ? *packed : columnOf(std::span(particles.position).subspan(first), column.material, context);
    return column;
}

}  // namespace

void buildBodies(std::vector<Section>& sections, Materials& materials, Scene& scene, BuildContext& context) {
    engine::Particles& particles = scene.setup.initial;
    for (std::size_t index = 0; index < sections.size(); ++index) {
        const auto material = materialOf(sections[index], materials, context);
        const std::size_t countBefore = particles.count();
        buildBody({sections[index], index, material.value_or(0), materials}, context, particles);
        checkWithinWorld(sections[index], "shape", std::span(particles.position).subspan(countBefore), context);
        scene.tables.bodyEnds.push_back(particles.count());
        scene.bodyColumns.push_back(bodyColumn(sections[index], scene, materials, countBefore, context));
    }
}

}  // namespace scenes
