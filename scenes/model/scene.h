// A scene: everything that a scene file says, checked, in the form that the engine and the renderer take. Plain data;
// build/read_scene.h makes it from a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/force_law/compression.h"
#include "engine/state/setup.h"
#include "scenes/model/camera_path.h"
#include "scenes/model/look.h"
#include "scenes/model/study.h"
#include "scenes/text/value.h"

namespace scenes {

/// The value of a key of a scene after overrides and defaults, for reports and for the hash of the scene.
struct EffectiveValue {
    std::string path;  ///< "body[0].radius"
    std::string toml;  ///< the value as TOML text
    std::string unit;
    ValueOrigin origin = ValueOrigin::given;
    bool isSimulated = true;  ///< whether the states of the particles may depend on it
};

/// Where the tables of a scene are in its file, in their order, for messages about what was made of them.
struct SourceTables {
    std::vector<SourcePosition> bodies, emitters, obstacles;
    SourcePosition camera;              ///< of the first camera
    SourcePosition error;               ///< of the wanted error
    std::vector<std::size_t> bodyEnds;  ///< for each body, the number of initial particles up to its last one
    std::vector<bool> hasRate;          ///< for each emitter, whether its rate or interval was given
};

/// A body of a scene as a column, whose weight compresses it.
struct BodyColumn {
    engine::Column shape;       ///< its height is 0 where there is no gravity or no more than one particle
    engine::Material material;  ///< with the radius and the mass of the body's particles
};

struct Scene {
    std::string title;
    std::string description;
    double duration = 1.0;  ///< s
    render::FrameRate fps;
    engine::Setup setup;
    std::vector<engine::Vec3> materialColors;  ///< linear RGB of the particles, one for each of the setup's materials
    std::vector<std::string> materialNotes;    ///< for each material why mass, b1 and bd are what they are, or empty
    std::vector<std::string> obstacleShapes;   ///< for each obstacle its shape, as the scene file names it
    std::vector<BodyColumn> bodyColumns;       ///< one for each body
    std::vector<std::string> meshNotes;        ///< one for each body of a mesh: its volume, voxels and memory
    CameraPath camera;
    Look look;
    render::PictureSize size;
    double stillTime = 0.5;          ///< s
    std::vector<double> stripTimes;  ///< s, increasing
    std::optional<Study> study;      ///< the [study] table, which only scenes of `globular study stability` have
    std::string sourceName;          ///< the file it was read from, as messages name it
    std::vector<std::filesystem::path> files;  ///< all files that it was read from, those that it names included
    std::string sceneHash;  ///< 16 hexadecimal digits: hash over the values of all keys and the files that they name
    /// Hash as above, but over those values alone that the states of the particles may depend on. Scenes that have the
    /// same may differ in duration, cameras, look and overlay, but have the same particles at the same frame.
    std::string simulationHash;
    std::vector<EffectiveValue> values;
    SourceTables tables;
    std::vector<std::string> warnings;  ///< messages on what is valid but may not be meant
    /// Messages for pictures of less than final quality, on what would blur them; empty where nothing does.
    std::vector<std::string> blurWarnings;
};

/// Number of frames of the animation: round(duration * fps), at least 1.
int frameCount(const Scene& scene);

/// The time that a frame shows, in seconds: frame / fps, never accumulated. Frame 0 is the start.
double frameTime(const Scene& scene, int frame);

/// The frame of the animation whose time is closest to the time of the still, the picture that represents the scene.
int stillFrame(const Scene& scene);

/// The frames of the animation closest to the times of the strip, a row of pictures that represents the scene. None is
/// repeated.
std::vector<int> stripFrames(const Scene& scene);

}  // namespace scenes
