// Shader programs by what a view contains: a feature that a view lacks is not compiled in. Owned by the picture pass.
#pragma once

#include <compare>
#include <map>
#include <string>
#include <string_view>

#include "render/gl_objects.h"

namespace render {

/// Text of a file of shaders/, embedded by the build.
std::string_view shaderSource(std::string_view name);

/// What a pixel of a drawing is.
enum class Output {
    bytes,   ///< sRGB encoded
    linear,  ///< colour, for averaging
    surface  ///< normal and view depth of what is seen; depth -1 for nothing
};

/// What one draw of tiles needs.
struct Features {
    int samples = 1;
    bool plain = false;  ///< nothing but background, or ground that nothing dims
    bool spheres = false;
    bool field = false;
    bool boxes = false;       ///< boxes are seen
    bool lightBoxes = false;  ///< boxes cast shadows
    bool ground = false;
    bool lines = false;
    bool shadows = false;
    bool lightSpheres = false;  ///< spheres cast shadows
    bool lightField = false;    ///< metaballs cast shadows
    bool soft = false;          ///< shadows
    bool specular = false;
    bool metal = false;
    bool mirror = false;
    bool rough = false;
    bool translucent = false;
    bool absorbing = false;
    bool glow = false;
    bool open = false;  ///< some term looks at openness
    bool occlusion = false;
    bool openObstacles = false;  ///< obstacles do
    bool tone = false;
    Output output = Output::bytes;

    auto operator<=>(const Features&) const = default;
};

/// Texture units, the same in every program.
enum TextureUnit : int {
    kBoxesUnit,
    kTileTableUnit,
    kTileSpheresUnit,
    kTileSphereIdsUnit,
    kSphereColorsUnit,
    kFieldSamplesUnit,
    kLightListsUnit,
    kLightSpheresUnit,
    kLightDepthsUnit,
    kLinesUnit,
    kLineListsUnit,
    kAccumulatedUnit,
    kSphereOpenUnit,
    kFieldOpenUnit,
    kGridOpenUnit,
    kGroundOpenUnit
};

/// A linked program; throws SystemError with the compiler's or linker's words.
ProgramName buildProgram(const Gl& gl, const std::string& vertex, const std::string& fragment);

class ProgramCache {
 public:
    explicit ProgramCache(const Gl& gl) : gl_(&gl) {}

    /// Compiled on first use; throws SystemError with the compiler's words.
    GLuint picture(const Features& features);
    GLuint resolve();
    void setInteger(GLuint program, const char* name, int value) const;

 private:
    GLuint keep(ProgramName& place, ProgramName program) const;

    const Gl* gl_;
    std::map<Features, ProgramName> pictures_;
    ProgramName resolve_;
};

}  // namespace render
