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

/// What is drawn together.
enum class Drawing {
    plain,    ///< tiles of background, or of ground that nothing dims
    picture,  ///< tiles whose pixels show one thing
    edges     ///< pixels that show several
};

/// What one drawing needs.
struct Features {
    Drawing drawing = Drawing::picture;
    bool perspective = true;
    bool spheres = false;
    bool obstacles = false;  ///< some sphere is none of the particles
    bool field = false;
    bool boxes = false;
    bool ground = false;
    bool single = false;  ///< all pixels show the same one of spheres, field, boxes and ground
    bool lines = false;
    bool shadows = false;
    bool specular = false;
    int gloss = 0;  ///< the highlight's exponent is 2 to the power of this
    bool metal = false;
    bool mirror = false;
    bool rough = false;
    bool translucent = false;
    bool absorbing = false;
    bool glow = false;
    bool open = false;  ///< some term looks at openness
    bool occlusion = false;
    bool tone = false;
    Output output = Output::bytes;

    auto operator<=>(const Features&) const = default;
};

/// Texture units, the same in every program.
enum TextureUnit : int {
    kBoxesUnit,
    kTileTableUnit,
    kPixelsUnit,
    kEdgePixelsUnit,
    kFragmentsUnit,
    kSpheresUnit,
    kSphereLooksUnit,
    kFieldSamplesUnit,
    kLinesUnit,
    kAccumulatedUnit
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
