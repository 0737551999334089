#include "tools/mesh/frame_field.h"

#include <fmt/format.h>

#include "render/mesh/isosurface.h"
#include "render/mesh/sampled_field.h"
#include "tools/mesh/scene_metaballs.h"
#include "tools/system/memory.h"

namespace tools {

std::string encodeFrameField(const scenes::Scene& scene, const engine::Simulation& simulation, int frame) {
    const auto purpose = [&] { return fmt::format("the field of {} particles", simulation.particles.count()); };
    return withMemoryFor(purpose, "leave vdb out of --format, or simulate fewer particles", [&] {
        const Lattice lattice = latticeOf(scene, kDefaultCell);
        const render::View view = metaballsOf(scene, simulation, lattice);
        const render::BallBlocks balls(view, lattice.cell);
        return render::encodeField(render::sampleWhole(balls), render::surfaceThreshold(view.field),
                                   {lattice.cell, lattice.origin, simulation.time, frame, scene.sceneHash});
    });
}

}  // namespace tools
