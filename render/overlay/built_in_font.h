// The font that is built into the program, DejaVu Sans. Plain bytes: overlays draw with it, and scenes/ fills its
// letters with particles.
#pragma once

namespace render {

/// The bytes of a TrueType font.
const unsigned char* builtInFont();

}  // namespace render
