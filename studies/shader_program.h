// Shader programs from their sources. Used by quad_baseline.cpp.
#pragma once

#include <string>

#include "render/gl_objects.h"

namespace studies {

/// A linked program; throws SystemError with the compiler's or linker's words.
render::ProgramName buildProgram(const render::Gl& gl, const std::string& vertex, const std::string& fragment);

}  // namespace studies
