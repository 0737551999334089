// The input of the renderer as plain data: what is in the picture, where the camera is and how the scene is lit. Filled
// in by scenes/view/frame_view.cpp and drawn by renderer.cpp; free of OpenGL, so that scenes may include it.
//
// Lengths are in meters, angles in radians, colors in linear RGB from 0 to 1. Axes are right-handed, y points up.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/overlay.h"
#include "render/picture/shading_model.h"
#include "render/picture/solid_mesh.h"

namespace render {

/// A particle, drawn as a lit sphere or as one ball of the metaball field.
struct Sphere {
    glm::vec3 center{0.0F};
    float radius = 0.1F;
    glm::vec3 color{0.8F};
};

enum class Style { spheres, metaballs };

/// Quality of a picture. draft takes one sample per pixel. normal antialiases silhouettes. final takes 3 x 3 samples
/// per pixel, or as many as View::samplesPerAxis says, and averages them in linear light; it alone shows what an open
/// shutter and a wide lens blur. In draft and normal quality, rays find the surface of metaballs at every second pixel
/// of every second row, and between these only where the surface is not smooth; in final quality at every pixel.
enum class Quality { draft, normal, final };

enum class Projection { perspective, orthographic };

struct Camera {
    Projection projection = Projection::perspective;
    glm::vec3 eye{0.0F, 2.0F, 10.0F};
    glm::vec3 target{0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    float verticalFov = 0.7F;  ///< full vertical angle of view, radians; perspective only
    float halfHeight = 5.0F;   ///< half the height of what the picture shows, m; orthographic only
    float aperture = 0.0F;     ///< diameter of the lens, m; 0: a pinhole; perspective only
    float focus = 0.0F;        ///< view depth of the plane in focus, m; 0: the target's
    /// Where the middle of the picture lies beside the camera's axis, to the right and up, m at view depth 1. Other
    /// than 0 for a point of a lens beside its middle; perspective only.
    glm::vec2 shift{0.0F};
};

struct SphereObstacle {
    glm::vec3 center{0.0F};
    float radius = 0.5F;
    glm::vec3 color{0.5F};
};

struct BoxObstacle {
    glm::vec3 minimum{0.0F};
    glm::vec3 maximum{0.0F};
    glm::vec3 color{0.5F};
};

/// A line of constant width in pixels, an edge of a box, hidden by what is in front of it.
struct Edge {
    glm::vec3 from{0.0F};
    glm::vec3 to{0.0F};
    glm::vec3 color{1.0F, 0.9F, 0.0F};
    float width = 1.5F;  ///< width of the line, pixels, at any quality
};

/// How particles become the balls of the metaball field.
enum class Skin {
    plain,       ///< balls at the particles, with weight 1: particles stay visible as bumps
    smooth,      ///< balls moved and weighted by their neighbors: a smooth surface, as of a liquid
    anisotropic  ///< balls of a smooth skin stretched along the surface and flattened across it: smoother still
};

/// How far a ball of a smooth skin is moved from its particle toward the weighted mean position of the neighbors, as a
/// share of the distance.
inline constexpr float kSkinPull = 0.85F;

/// Smallest radius that a neighbor counts as where it ends the kernel of a ball of a smooth skin, as a share of that
/// ball's radius. Chosen: rays find the surface of so steep a kernel in single precision.
inline constexpr float kSkinLeastSize = 0.01F;

/// How much of the shape of an anisotropic skin's ball is that of its neighbors' covariance; the rest is round. Chosen:
/// with more, balls in sheets of one layer get thinner than the sheet is.
inline constexpr float kSkinStretch = 0.9F;

/// How many neighbors it takes to stretch a ball of an anisotropic skin: the weight of a round covariance that is added
/// to theirs. Chosen: particles that come or go change a ball gradually, and a ball with few neighbors is nearly round.
inline constexpr float kSkinRoundness = 2.0F;

/// The surface of metaballs is where the field, the sum over all balls of w (1 - d^2/R^2)^2 for d < R, has the value
/// (1 - 1/reach^2)^2. d is the distance from the ball's center, w its weight and R the radius of its kernel. In a plain
/// skin w is 1 and R is reach * radius. In both skins a ball alone thus has its particle's radius. The normal is the
/// negative gradient, the color the mean of the balls' colors weighted by their terms of the sum. Particles whose
/// radius is 0 have no ball and influence none.
///
/// Smooth skin: let Q be reach times the mean of two particles' radii r and s. For particles at distances d < Q, of
/// which neither is more than twice as large as the other, let k = (1 - d^2/Q^2)^2 (1 - 9 (r - s)^2/(r + s)^2). A ball
/// is moved from its particle by kSkinPull times the vector to the mean position of all particles weighted by k, itself
/// included with k = 1.
///
/// The kernel of a large ball must not swallow small particles at its surface. For a particle of radius r, R is
/// therefore the least of reach r and, for each particle of radius s < r/2 at a distance d,
/// max(r + (reach - 1) (1 + 2 s/r) s, d - s), where s is no less than kSkinLeastSize r. So the kernel ends before the
/// small particle until that is about as near as its own kernel reaches. The ball's weight is (sum of k)^(-3/4), times
/// ((1 - 1/reach^2) / (1 - r^2/R^2))^2, which keeps the surface of a ball alone at r however short its kernel is.
///
/// Anisotropic skin, after Yu and Turk 2013: the balls are ellipsoids. The term of a ball is w (1 - d^T M d)^2 where
/// d^T M d < 1, with d the vector from its center and the weight w of the smooth skin. Let K be k with 2 Q in place of
/// Q, and m of a particle the vector to the mean position of all particles weighted by K, itself included. A ball is
/// moved from its particle by its m less the mean of the m of all particles weighted by k. The mean over twice the
/// distance evens out what is narrower than that; what is taken off is what a bulge of the liquid would sink in by.
///
/// The ball's shape follows the covariance of the neighbors: let C be the sum of K e e^T, with e the vector to a
/// particle less m, plus kSkinRoundness (2 reach r)^2/9 times the identity I, all divided by a third of its trace. (A
/// ninth is the covariance in a body of liquid. The surface around a particle makes C flat along its normal.) With the
/// kernel's radius R of the smooth skin and u = (R - r)/((reach - 1) r), which is 1 unless small particles shorten the
/// kernel, let s = kSkinStretch u^2 and D = (1 - s) I + s C. Then the inverse of M is R^2 D^2 / det(D)^(2/3): an
/// ellipsoid as large as the ball of radius R, with the axes of the covariance, and round for a particle alone.
struct MetaballField {
    float reach = 2.5F;  ///< radius of a ball's field in particle radii, from 1.2 to 4
    Skin skin = Skin::plain;
};

/// The moment of a sample of the pixels, from -1/2, when the shutter opens, to 1/2, when it closes. The time in between
/// is divided into n^2 equal parts for n samples along each axis of a pixel, which are numbered row by row. Sample
/// n i + j takes the middle of part n ((i + j) mod n) + (i + 2 j) mod n: each n-th of the time occurs once in every row
/// and once in every column, so that no side of the pixel sees an earlier moment than the other.
inline double sampleTime(int index, int samplesPerAxis) {
    const int row = index / samplesPerAxis;
    const int column = index % samplesPerAxis;
    const int part = samplesPerAxis * ((row + column) % samplesPerAxis) + (row + 2 * column) % samplesPerAxis;
    return (part + 0.5) / (samplesPerAxis * samplesPerAxis) - 0.5;
}

/// Where everything but the particles is at the moment of one sample of the pixels.
struct Moment {
    float time = 0.0F;  ///< of the moment, counted from the picture's own, s
    Camera camera;
    std::vector<SphereObstacle> sphereObstacles;
    std::vector<BoxObstacle> boxObstacles;
    std::vector<MeshObstacle> meshObstacles;
    std::vector<Edge> edges;
};

/// The motion that blurs a picture of final quality while the shutter is open. Each sample of the pixels shows the
/// scene at a moment of its own (pixel_samples.h): particles where they are if they keep their velocities, and
/// everything else as the moment has it. Colors, light and overlay are those of the view.
struct Shutter {
    std::vector<glm::vec3> velocities;  ///< of each particle, m/s; empty: all are at rest
    std::vector<Moment> moments;        ///< one for each sample, at sampleTime() times the time it is open
};

/// Everything that a picture shows.
struct View {
    std::vector<Sphere> particles;
    Style style = Style::spheres;
    MetaballField field;  ///< for Style::metaballs only
    Camera camera;
    Light light;
    Ambient ambient;
    Surface surface;
    Surroundings surroundings;
    float exposure = 0.0F;  ///< factor on all light before the shading model's shoulder; 0: neither
    Background background;
    std::optional<Ground> ground;
    std::vector<SphereObstacle> sphereObstacles;
    std::vector<BoxObstacle> boxObstacles;
    std::vector<MeshObstacle> meshObstacles;
    std::vector<Edge> edges;
    Overlay overlay;                         ///< text and scales, drawn last over the finished picture
    std::vector<std::uint32_t> particleIds;  ///< number of each particle, for Layers::ids; empty if that is not drawn
    int samplesPerAxis = 3;                  ///< a pixel of final quality has the square of this number of samples
    std::optional<Shutter> shutter;          ///< absent: all samples show the same moment
};

struct PictureSize {
    int width = 1280;
    int height = 720;

    bool operator==(const PictureSize&) const = default;
};

/// Frames per second as a fraction in lowest terms, such as 30000/1001, with which frames are never rounded to others.
struct FrameRate {
    int numerator = 30;
    int denominator = 1;

    bool operator==(const FrameRate&) const = default;

    /// The time of a frame that is counted from 0, in seconds: exact but for one rounding.
    double timeOf(int frame) const { return static_cast<double>(frame) * denominator / numerator; }
    /// How many frames there are in a time (s).
    double framesIn(double seconds) const { return seconds * numerator / denominator; }
    /// "30" or "30000/1001", as ffmpeg takes it.
    std::string text() const {
        const std::string whole = std::to_string(numerator);
        return denominator == 1 ? whole : whole + '/' + std::to_string(denominator);
    }
};

}  // namespace render
