// Shader programs by what is drawn: what a drawing does not need is not compiled in. Owned by the picture pass.
#pragma once

#include <compare>
#include <map>
#include <string>
#include <string_view>

#include "render/gl_objects.h"
#include "render/tile_class.h"

namespace render {

/// Text of a file of shaders/, embedded by the build.
std::string_view shaderSource(std::string_view name);

/// What one drawing needs.
struct Features {
    TileClass tiles = TileClass::picture;
    bool perspective = true;

    auto operator<=>(const Features&) const = default;
};

/// Texture units, the same in every program.
enum TextureUnit : int { kTileTableUnit, kPixelsUnit };

/// A linked program; throws SystemError with the compiler's or linker's words.
ProgramName buildProgram(const Gl& gl, const std::string& vertex, const std::string& fragment);

class ProgramCache {
 public:
    explicit ProgramCache(const Gl& gl) : gl_(&gl) {}

    /// Compiled on first use; throws SystemError with the compiler's words.
    GLuint tiles(const Features& features);
    void setInteger(GLuint program, const char* name, int value) const;

 private:
    ProgramName build(const Features& features) const;

    const Gl* gl_;
    std::map<Features, ProgramName> programs_;
};

}  // namespace render
