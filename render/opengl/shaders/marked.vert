// A triangle that covers the target of marked fragments.
#include "frame_block.glsl"

#ifdef MANY_VARYINGS
#define FLAT_FIELD(name) flat out vec4 name;
FRAME_FIELDS(FLAT_FIELD)
#endif

void main() {
#ifdef MANY_VARYINGS
#define HAND_OVER(name) name = frame.name;
    FRAME_FIELDS(HAND_OVER)
#endif
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
