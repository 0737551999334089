// The assembler copies the font from RENDER_FONT_FILE (a macro that CMake sets) into the program, so that the program
// needs no font file when it runs. As an array of numbers it would take the compiler seconds.
#include "render/overlay/built_in_font.h"

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

const unsigned char* builtInFont() {
    return globularFont;
}

}  // namespace render
