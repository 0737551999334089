// Shader programs from their sources.
#pragma once

#include <string>
#include <string_view>

#include "render/gl_objects.h"

namespace render {

/// Text of a file of shaders/, embedded by the build.
std::string_view shaderSource(std::string_view name);

/// A linked program; throws SystemError with the compiler's or linker's words.
ProgramName buildProgram(const Gl& gl, const std::string& vertex, const std::string& fragment);

}  // namespace render
