// A scene: everything a scene file says, checked, in the form the engine and the renderer take. Made by readScene and
// loadScene, which report all mistakes of a file at once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/model/camera_path.h"
#include "scenes/model/limits.h"
#include "scenes/model/look.h"
#include "scenes/schema/section.h"
#include "scenes/schema/study.h"
#include "scenes/text/input_error.h"
#include "scenes/text/override.h"

namespace scenes {

/// What a key of the scene amounts to after overrides and defaults.
struct EffectiveValue {
    std::string path;  ///< "body[0].radius"
    std::string text;  ///< in TOML
    std::string unit;
    Origin origin = Origin::given;
};

struct Scene {
    std::string title;
    std::string description;
    double duration = 1.0;  ///< s
    int fps = 30;
    std::uint64_t seed = 1;
    engine::Setup setup;
    std::vector<engine::Vec3> materialColors;  ///< linear RGB, one for each material of the set-up
    std::vector<ObstacleLook> obstacleLooks;   ///< one for each obstacle of the set-up
    CameraPath camera;
    Look look;
    Overlay overlay;
    render::PictureSize size;
    double stillTime = 0.5;          ///< s
    std::vector<double> stripTimes;  ///< s, increasing
    std::optional<Study> study;      ///< of the hard cases
    std::string sourceName;          ///< the file it was read from
    std::string sceneHash;           ///< 16 hexadecimal digits over all effective values and the files they name
    std::vector<EffectiveValue> values;
};

/// Frames of the animation: round(duration * fps), at least 1.
int frameCount(const Scene& scene);

/// The moment a frame shows, in seconds: frame / fps, not accumulated. Frame 0 is the start.
double frameTime(const Scene& scene, int frame);

/// The frame nearest to the scene's still, within the animation.
int stillFrame(const Scene& scene);

/// The frames nearest to the moments of the scene's strip, within the animation, each once.
std::vector<int> stripFrames(const Scene& scene);

/// The scene that a text describes. Files it names are sought in the folder of fileName, which also opens each message.
/// Throws: InputError with all mistakes, by position, then those of the overrides ("physics.step=0.005").
Scene readScene(std::string_view text, const std::string& fileName, const Overrides& overrides,
                const Limits& limits = {});

/// The scene in a file. Throws: InputError, also for a file that cannot be read.
Scene loadScene(const std::string& path, const Overrides& overrides, const Limits& limits = {});

}  // namespace scenes
