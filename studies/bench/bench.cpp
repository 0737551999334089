// The benchmark of forces, neighbor lists and steps, on particles in jittered lattices, and of whole frames of scenes.
// Every time is the median of several rounds. See bench.h.
#include "studies/bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/neighbors/neighbor_list.h"
#include "engine/run/diagnostics.h"
#include "engine/stepping/take_step.h"
#include "render/renderer.h"
#include "scenes/view/frame_view.h"
#include "studies/bench/mesh_pictures.h"
#include "studies/bench/packings.h"
#include "studies/common/fcc_cube.h"
#include "studies/common/timing.h"

namespace studies {
namespace {

using engine::Precision;
using engine::StepperKind;
using engine::Vec3;

/// The largest number of particles in measurements of steps. Chosen: with a million, each would take minutes.
constexpr std::size_t kMostStepped = 100000;

/// Median time of a call of the work, s. The caller has called it once before, so that its memory is allocated.
double measured(const Work& work, const BenchSettings& settings) {
    const double once = secondsOf(work, 1);
    const auto repeats = static_cast<std::uint64_t>(std::max(1.0, std::ceil(settings.secondsPerRound / once)));
    std::vector<double> rounds;
    for (int round = 0; round < settings.rounds; ++round) rounds.push_back(secondsOf(work, repeats));
    return median(std::move(rounds));
}

std::string hashOf(const std::vector<Vec3>& vectors) {
    std::uint64_t hash = engine::fnv1a("");
    for (const Vec3& v : vectors)
        for (int axis = 0; axis < 3; ++axis) hash = engine::fnv1a(std::bit_cast<std::uint64_t>(v[axis]), hash);
    return engine::hexadecimal(hash);
}

/// A lattice of particles, and what all measurements on it have in common.
struct Subject {
    engine::Setup setup;
    BenchRow row;
    double rowBytes = 0.0;  ///< bytes of the neighbor list per particle
};

Subject subjectOf(const Packing& packing, std::size_t count) {
    Subject subject{packedCube(packing, count), {}};
    const engine::Particles& particles = subject.setup.initial;
    engine::PairTraversal pairs(forceFieldOf(subject.setup), Precision::doubles);
    pairs.prepare(forceFieldOf(subject.setup), particles, particles.velocity);
    subject.row.material = packing.name;
    subject.row.particles = particles.count();
    subject.row.neighbors = meanNeighbors(subject.setup, particles);
    subject.rowBytes = static_cast<double>(bytesOf(pairs.list.rows)) / static_cast<double>(particles.count());
    subject.row.bytesPerParticle = subject.rowBytes + sizeof(engine::PackedParticle);
    return subject;
}

std::string stepName(StepperKind stepper) {
    return "step " + std::string(engine::nameOf(stepper));
}

/// The names of all measurements on a lattice with this number of particles.
std::vector<std::string> rowNames(std::size_t count) {
    std::vector<std::string> names = {"forces", "list"};
    for (const StepperKind stepper : engine::kSteppers)
        if (count <= kMostStepped && stepper != StepperKind::automatic) names.push_back(stepName(stepper));
    return names;
}

BenchRow forcesRow(const Subject& subject, Precision precision, const BenchSettings& settings) {
    engine::ForceEvaluator evaluator(forceFieldOf(subject.setup), engine::ForceMethod::grid, precision);
    const engine::Particles& particles = subject.setup.initial;
    std::vector<Vec3> forces;
    const Work work = [&] { evaluator.evaluatePairs(particles, particles.velocity, forces); };
    work();  // builds the neighbor list
    BenchRow row = subject.row;
    row.name = "forces";
    row.precision = precision;
    if (precision == Precision::singles) row.bytesPerParticle = subject.rowBytes + sizeof(engine::PackedParticleFloat);
    row.seconds = measured(work, settings);
    row.stateHash = hashOf(forces);
    return row;
}

BenchRow listRow(const Subject& subject, const BenchSettings& settings) {
    const engine::Particles& particles = subject.setup.initial;
    const engine::ForceTerms terms = engine::termsFor(forceFieldOf(subject.setup), particles);
    const std::span<const double> radii = terms.oneRadius ? std::span<const double>{} : particles.radius;
    const double skin = engine::kDefaultSkin * terms.cutoff;
    engine::NeighborList list;
    const Work work = [&] { engine::build(list, particles.position, radii, terms.cutoff, skin); };
    work();  // allocates the memory of the list
    BenchRow row = subject.row;
    row.name = "list";
    row.seconds = measured(work, settings);
    std::uint64_t hash = engine::fnv1a("");
    for (const engine::RowBlock& block : list.rows.blocks)
        for (std::size_t at = 0; at < block.start.back() * engine::kClusterSize; ++at)
            hash = engine::fnv1a(static_cast<std::uint64_t>(block.entries[at]), hash);
    row.stateHash = engine::hexadecimal(hash);
    return row;
}

/// Number of steps of this length (s) that are measured. It is fixed, so that the hashes of the states at the end can
/// be compared. With heat, one exchange falls among them, as often as in a run.
int measuredSteps(const engine::Setup& setup, double step) {
    constexpr int kSteps = 20;
    return setup.heat ? static_cast<int>(std::ceil(setup.heat->interval / step)) : kSteps;
}

/// Measures steps from the lattice.
BenchRow stepsRow(const Subject& subject, StepperKind stepper, Precision precision, const BenchSettings& settings) {
    constexpr double kStep = 0.001;  // step, s; chosen: stable with all steppers
    const int steps = measuredSteps(subject.setup, kStep);
    engine::Setup setup = subject.setup;
    setup.stepper = stepper;
    setup.precision = precision;
    setup.step = kStep;
    BenchRow row = subject.row;
    row.name = stepName(stepper);
    row.precision = precision;
    std::vector<double> rounds;
    for (int round = 0; round < settings.rounds; ++round) {
        engine::Simulation simulation = engine::start(setup);
        engine::advance(simulation, kStep);  // builds the neighbor list
        rounds.push_back(secondsOf([&] { engine::advance(simulation, (steps + 1) * kStep); }) / steps);
        row.stateHash = engine::stateHash(simulation.particles);
    }
    row.seconds = median(std::move(rounds));
    return row;
}

BenchRow multiplyAddRow(const BenchSettings& settings) {
    constexpr std::size_t kRounds = 1U << 22;  // repetitions of the loop; chosen: they take some milliseconds
    const std::size_t threads = engine::threadCount();
    float sink = 0.0F;
    double operations = 0.0;
    BenchRow row;
    row.name = "multiply-add";
    row.precision = Precision::singles;
    row.seconds = measured([&] { operations = multiplyAdd(threads, kRounds, sink); }, settings);
    row.rate = operations / row.seconds;
    row.stateHash = engine::hexadecimal(std::bit_cast<std::uint32_t>(sink));
    return row;
}

BenchRow copyRow(const BenchSettings& settings) {
    constexpr std::size_t kNumbers = 1U << 24;  // length of each array: 128 MiB, far beyond any cache
    constexpr std::size_t kParts = 64;
    const std::vector<double> from(kNumbers, 1.0);
    std::vector<double> to(kNumbers, 0.0);
    const auto copyPart = [&](std::size_t part) {
        const auto first = static_cast<std::ptrdiff_t>(part * (kNumbers / kParts));
        std::copy_n(from.begin() + first, kNumbers / kParts, to.begin() + first);
    };
    BenchRow row;
    row.name = "copy";
    row.seconds = measured([&] { engine::inParallel(kParts, 1, copyPart); }, settings);
    row.rate = 2.0 * sizeof(double) * static_cast<double>(kNumbers) / row.seconds;
    return row;
}

/// Makes the wanted measurements on a lattice and calls add() with each of them.
void measureLattice(const Packing& packing, std::size_t count, const BenchSettings& settings,
                    const std::function<void(const BenchRow&)>& add) {
    const auto wants = [&](const std::string& name) { return settings.wants(name, packing.name); };
    if (std::ranges::none_of(rowNames(count), wants)) return;
    const Subject subject = subjectOf(packing, count);
    for (const Precision precision : {Precision::doubles, Precision::singles})
        if (wants("forces")) add(forcesRow(subject, precision, settings));
    if (wants("list")) add(listRow(subject, settings));
    if (count > kMostStepped) return;
    for (const StepperKind stepper : engine::kSteppers)
        if (stepper != StepperKind::automatic && wants(stepName(stepper)))
            add(stepsRow(subject, stepper, Precision::doubles, settings));
    for (const StepperKind stepper : {StepperKind::symplecticEuler, StepperKind::velocityVerlet})
        if (wants(stepName(stepper))) add(stepsRow(subject, stepper, Precision::singles, settings));
}

}  // namespace

std::string benchRowsText() {
    std::vector<std::string> names;
    for (const Packing& packing : packings()) names.emplace_back(packing.name);
    std::vector<std::string> pictures;
    for (const MeshPicture& picture : meshPictures()) pictures.push_back(nameOf(picture));
    return fmt::format("multiply-add, copy; {} of torus; {} of {}, steps up to {} particles", fmt::join(pictures, ", "),
                       fmt::join(rowNames(0), ", "), fmt::join(names, ", "), kMostStepped);
}

std::vector<BenchRow> runBench(const BenchSettings& settings, const std::function<void(const BenchRow&)>& listener) {
    std::vector<BenchRow> rows;
    const auto add = [&](const BenchRow& row) {
        listener(row);
        rows.push_back(row);
    };
    if (settings.wants("multiply-add", "")) add(multiplyAddRow(settings));
    if (settings.wants("copy", "")) add(copyRow(settings));
    for (const MeshPicture& picture : meshPictures())
        if (settings.wants(nameOf(picture), kMeshPicture)) add(meshPictureRow(picture, settings));
    for (const std::size_t count : settings.counts)
        for (const Packing& packing : packings()) measureLattice(packing, count, settings, add);
    return rows;
}

std::vector<BenchRow> benchFrames(const std::string& name, const scenes::Scene& scene, render::Renderer* renderer,
                                  int rounds) {
    engine::Simulation simulation = engine::start(scene.setup);
    int frame = scenes::stillFrame(scene);
    scenes::advanceToFrame(scene, simulation, frame);
    // Drawing the first frame allocates memory.
    if (renderer != nullptr) renderer->draw(scenes::frameView(scene, simulation));
    const std::uint64_t stepsBefore = simulation.steps.count;
    std::vector<double> simulated;
    std::vector<double> drawn;
    for (int round = 0; round < rounds; ++round) {
        ++frame;
        simulated.push_back(secondsOf([&] { scenes::advanceToFrame(scene, simulation, frame); }));
        if (renderer == nullptr) continue;
        const render::View view = scenes::frameView(scene, simulation);
        drawn.push_back(secondsOf([&] { renderer->draw(view); }));
    }
    BenchRow row;
    row.name = kSimulateFrame;
    row.material = name;
    row.particles = simulation.particles.count();
    row.neighbors = meanNeighbors(scene.setup, simulation.particles);
    row.precision = scene.setup.precision;
    row.seconds = median(simulated);
    row.steps = static_cast<double>(simulation.steps.count - stepsBefore) / rounds;
    row.stateHash = engine::stateHash(simulation.particles);
    if (renderer == nullptr) return {row};
    BenchRow drawing = row;
    drawing.name = kDrawFrame;
    drawing.neighbors = 0.0;
    drawing.steps = 1.0;
    drawing.seconds = median(drawn);
    return {row, drawing};
}

}  // namespace studies
