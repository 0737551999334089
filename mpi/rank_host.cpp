// Orders are JSON objects with a key "do". Each function of the host on rank 0 sends one, and then calls the same
// function of the engine as the other ranks do when they have got it.
#include "mpi/rank_host.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

#include "engine/run/redistribution.h"
#include "scenes/text/input_error.h"
#include "tools/system/process.h"
#include "tools/system/threads.h"

namespace mpi {
namespace {

using engine::Simulation;
using tools::Json;

/// The division is renewed where the busiest rank has more than the mean number of particles by this factor. Chosen: a
/// new division costs about as much as a step.
constexpr double kUneven = 1.1;

/// Particles are sent to the ranks whose places they are in when more than this share of them is elsewhere. Chosen:
/// they make ghosts of others before.
constexpr double kAstray = 0.02;

/// The part of some particles that a rank gives to a division that all of them are known for on every rank.
std::vector<engine::Vec3> shareOf(const engine::Ranks& ranks, const std::vector<engine::Vec3>& positions) {
    std::vector<engine::Vec3> share;
    const auto stride = static_cast<std::size_t>(ranks.count());
    for (auto p = static_cast<std::size_t>(ranks.own()); p < positions.size(); p += stride)
        share.push_back(positions[p]);
    return share;
}

/// Starts the simulation on all ranks.
Simulation startOn(MpiRanks& ranks, const scenes::Scene& scene) {
    const auto& positions = scene.setup.initial.position;
    if (positions.size() >= static_cast<std::size_t>(ranks.count())) ranks.divide(shareOf(ranks, positions));
    Simulation simulation = engine::start(scene.setup, ranks);
    simulation.setup.initial = {};  // rank 0 has them in the scene
    return simulation;
}

/// Divides a simulation that rank 0 has as a whole.
void divideOn(MpiRanks& ranks, Simulation& simulation) {
    const bool isFirst = ranks.own() == 0;
    ranks.divide(isFirst ? simulation.particles.position : std::vector<engine::Vec3>());
    engine::divide(simulation, ranks);
    simulation.setup.initial = {};
}

/// Sends particles to where they belong, if that is worth its while.
void rebalance(MpiRanks& ranks, Simulation& simulation, bool isBalanced) {
    const auto& positions = simulation.particles.position;
    const auto own = static_cast<double>(positions.size());
    const double most = engine::largestOfAll(ranks, own);
    const auto all = static_cast<double>(engine::sumOfAll(ranks, positions.size()));
    if (all < static_cast<double>(ranks.count())) return;
    const bool isUneven = most > kUneven * std::max(1.0, all / ranks.count());
    if (!ranks.isDivided() || (isBalanced && isUneven)) ranks.divide(positions);
    const auto astray = static_cast<std::uint64_t>(std::ranges::count_if(
        positions, [&](const engine::Vec3& position) { return ranks.ownerOf(position) != ranks.own(); }));
    if (static_cast<double>(engine::sumOfAll(ranks, astray)) > kAstray * all) engine::redistribute(simulation);
}

/// Advances the part of this rank to a frame, and balances the ranks.
/// @param mustStop  asked before every step, on rank 0 only
void advanceOn(MpiRanks& ranks, const scenes::Scene& scene, Simulation& simulation, int frame, bool isBalanced,
               const std::function<bool(const Simulation&)>& mustStop) {
    simulation.beforeStep = [&](const Simulation& at) {
        const bool isLast = mustStop && mustStop(at);
        if (!engine::holdsOnAll(ranks, !isLast)) throw engine::Stopped();
    };
    scenes::advanceToFrame(scene, simulation, frame);
    simulation.beforeStep = nullptr;
    rebalance(ranks, simulation, isBalanced);
}

/// Brings the particles together on rank 0 after some work, also where all ranks have thrown: the report of a run that
/// became unstable, or was stopped, counts its steps up to there.
template <class Work>
void thenGather(const Simulation& simulation, Simulation& whole, const Work& work) {
    try {
        work();
    } catch (const engine::InstabilityError&) {
        engine::gather(simulation, whole);
        throw;
    } catch (const engine::Stopped&) {
        engine::gather(simulation, whole);
        throw;
    }
    engine::gather(simulation, whole);
}

Json encode(const engine::ErrorSamples& samples) {
    return {
        {"count", samples.count}, {"sum", samples.sum}, {"largest", samples.largest}, {"cost", samples.evaluationCost}};
}

engine::ErrorSamples decode(const Json& json) {
    return {json.at("count"), json.at("sum"), json.at("largest"), json.at("cost")};
}

/// The scene that rank 0 has loaded; its warnings are left to rank 0.
scenes::Scene loadAs(const Json& order) {
    constexpr bool kIsStrict = true;  // prints no warnings
    return tools::load({order.at("scene"), order.at("changes"), order.at("limits"), kIsStrict});
}

/// What an order begins a run of a scene with: how it is computed, and which scene it is.
Json beginning(const char* what, const scenes::Scene& scene) {
    return {{"do", what}, {"threads", engine::threadCount()}, {"simulation", scene.simulationHash}};
}

/// Each rank reads the scene's files itself, and those of another machine may be others.
void requireSame(const scenes::Scene& scene, const Json& order) {
    if (order.at("simulation") != scene.simulationHash)
        throw std::runtime_error("the scene differs from that of rank 0; every process must read the same files");
}

/// Does what all ranks do at the same time. What fails on one of them ends the run, because the others would wait.
template <class Work>
void together(const MpiRanks& ranks, const Work& work) {
    try {
        work();
    } catch (const engine::InstabilityError&) {
        throw;  // by all of them
    } catch (const engine::Stopped&) {
        throw;  // by all of them
    } catch (const std::exception& error) {
        tools::printToStderr(fmt::format("error: rank {}: {}\n", ranks.own(), error.what()));
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
}

}  // namespace

RankHost::~RankHost() {
    order({{"do", "end"}});
}

void RankHost::load(const tools::SceneOptions& options, const scenes::Scene& scene) {
    if (options.scene == tools::kStandardStream)
        throw scenes::InputError("SCENE", "standard input reaches only one of the processes; give a file");
    if (scene.setup.forces == engine::ForceMethod::reference && ranks_.areMany())
        throw scenes::InputError(scene.sourceName,
                                 "physics.forces is \"reference\", which visits every pair of particles "
                                 "in one process; give \"grid\", or run it without MPI");
    order({{"do", "load"}, {"scene", options.scene}, {"changes", options.changes}, {"limits", options.limits}});
}

Simulation RankHost::start(const scenes::Scene& scene) {
    order(beginning("start", scene));
    together(ranks_, [&] { simulation_ = startOn(ranks_, scene); });
    return engine::start(scene.setup);
}

void RankHost::resume(const scenes::Scene& scene, Simulation& whole) {
    order(beginning("resume", scene));
    simulation_ = whole;
    together(ranks_, [&] { divideOn(ranks_, simulation_); });
}

void RankHost::advanceToFrame(const scenes::Scene& scene, Simulation& whole, int frame) {
    order({{"do", "advance"}, {"frame", frame}, {"balance", options_.isBalanced}});
    const auto mustStop = [&](const Simulation& at) {
        try {
            if (whole.beforeStep) whole.beforeStep(at);
        } catch (const engine::Stopped&) {
            return true;
        }
        return false;
    };
    together(ranks_, [&] {
        thenGather(simulation_, whole,
                   [&] { advanceOn(ranks_, scene, simulation_, frame, options_.isBalanced, mustStop); });
    });
}

void RankHost::addSample(engine::ErrorSamples& samples, const Simulation& /*whole*/, double frameSeconds,
                         double evaluationsOfFrame) {
    order({{"do", "sample"}, {"samples", encode(samples)}, {"seconds", frameSeconds}, {"cost", evaluationsOfFrame}});
    together(ranks_, [&] { engine::addSample(samples, simulation_, frameSeconds, evaluationsOfFrame); });
}

std::vector<std::uint8_t> RankHost::checkpoint(const Simulation& /*whole*/) {
    order({{"do", "checkpoint"}});
    std::vector<std::uint8_t> bytes;
    together(ranks_, [&] { bytes = engine::gatherCheckpoint(simulation_); });
    return bytes;
}

engine::Energy RankHost::energy(Simulation& /*whole*/) {
    order({{"do", "energy"}});
    engine::Energy energy;
    together(ranks_, [&] { energy = engine::energy(simulation_); });
    return energy;
}

void serve(MpiRanks& ranks) {
    scenes::Scene scene;
    Simulation simulation;
    int threads = 1;
    const std::map<std::string, std::function<void(const Json&)>> orders = {
        {"load", [&](const Json& json) { scene = loadAs(json); }},
        {"start",
         [&](const Json& json) {
             requireSame(scene, json);
             threads = json.at("threads");
             simulation = startOn(ranks, scene);
         }},
        {"resume",
         [&](const Json& json) {
             requireSame(scene, json);
             threads = json.at("threads");
             simulation = engine::start(scene.setup);
             divideOn(ranks, simulation);
         }},
        {"advance",
         [&](const Json& json) {
             thenGather(simulation, simulation,
                        [&] { advanceOn(ranks, scene, simulation, json.at("frame"), json.at("balance"), nullptr); });
         }},
        {"sample",
         [&](const Json& json) {
             engine::ErrorSamples samples = decode(json.at("samples"));
             engine::addSample(samples, simulation, json.at("seconds"), json.at("cost"));
         }},
        {"energy", [&](const Json&) { engine::energy(simulation); }},
        {"checkpoint", [&](const Json&) { engine::gatherCheckpoint(simulation); }},
    };
    while (true) {
        const Json order = Json::parse(ranks.broadcast(""));
        if (order.at("do") == "end") return;
        try {
            together(ranks, [&] { tools::onThreads(threads, [&] { orders.at(order.at("do"))(order); }); });
        } catch (const engine::InstabilityError&) {
            // All ranks have thrown it; rank 0 reports it.
        } catch (const engine::Stopped&) {
            // Rank 0 has asked for it.
        }
    }
}

}  // namespace mpi
