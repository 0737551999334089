// The assembler copies the font file as it is; as an array of numbers it would take the compiler seconds.
// RENDER_FONT_FILE comes from the build.
#include "render/overlay/font_data.h"

asm(".section .rodata\n"
    ".balign 16\n"
    ".global globularFont\n"
    ".hidden globularFont\n"
    "globularFont:\n"
    ".incbin \"" RENDER_FONT_FILE
    "\"\n"
    ".previous\n");

extern "C" __attribute__((visibility("hidden"))) const unsigned char globularFont[];

namespace render {

const unsigned char* fontData() {
    return globularFont;
}

}  // namespace render
