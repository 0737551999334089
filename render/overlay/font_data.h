// The font of the overlays, put into the program by the build so that it needs no file when it runs.
#pragma once

namespace render {

/// A TrueType file in memory.
const unsigned char* fontData();

}  // namespace render
