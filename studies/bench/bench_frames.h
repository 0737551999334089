// Whole frames of scenes for the benchmark: what simulating one takes, and what drawing it takes.
#pragma once

#include <string>
#include <vector>

#include "render/opengl/context.h"
#include "scenes/model/scene.h"
#include "studies/bench/bench.h"

namespace studies {

inline constexpr const char* kSimulateFrame = "simulate frame";
inline constexpr const char* kDrawFrame = "draw frame";

/// A scene by its name in the library.
struct NamedScene {
    std::string name;
    scenes::Scene scene;
};

/// Two rows: medians over the frames that follow the scene's still, as many as rounds, drawn with the scene's own look
/// at its own size in normal quality. The hash is of the last state. Throws: engine::InstabilityError,
/// render::SystemError.
/// Without a context nothing is drawn, and the first row is all.
std::vector<BenchRow> benchFrames(const NamedScene& subject, render::Context* context, int rounds);

}  // namespace studies
