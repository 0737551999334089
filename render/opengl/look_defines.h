// Which terms of the shading model a view uses, as definitions for the shaders: no other term is compiled.
#pragma once

#include "render/opengl/objects/shader_program.h"
#include "render/opengl/view_buffers.h"
#include "render/prepare/prepared_view.h"

namespace render {

/// @param kind  of the tiles that the program draws
Defines lookDefines(const PreparedView& view, TileClass kind);

}  // namespace render
