// What all passes over the picture share: the view's numbers, and the rays through points of the picture. Coordinates
// are as on the CPU: pixel (0, 0) is at the top left, positions are relative to the eye along the world's axes, and the
// parameter of a ray is the view depth.
#include "frame_block.glsl"

// Shaders read the fields of the block under their own names. The vertex shader hands them over, because llvmpipe takes
// longer to read them from the block in each fragment. Where OpenGL has too few varyings they come from the block.
#ifdef MANY_VARYINGS
#define FLAT_FIELD(name) flat in vec4 name;
FRAME_FIELDS(FLAT_FIELD)
void loadFrame() {}
#else
#define GLOBAL_FIELD(name) vec4 name;
FRAME_FIELDS(GLOBAL_FIELD)
#define LOAD_FIELD(name) name = frame.name;
void loadFrame() {
    FRAME_FIELDS(LOAD_FIELD)
}
#endif

const float kFarDepth = 3.0e38;

// What a ray hits, as one number: the index of a sphere, or one of these.
const int kHitBackground = -1;
const int kHitGround = -2;
const int kHitMesh = 1 << 27;       // + index of the sample
const int kHitBox = 1 << 28;        // + 16 * index of the box + face (0 +x, 1 -x, 2 +y, ..., 5 -z) + 8 inside the box
const int kHitMetaballs = 1 << 29;  // + index of the sample

// Where the ray through the middle of the picture crosses the plane at view depth 1, m.
vec2 imageMiddle() {
#ifdef SHIFTED
    return vec2(skyBelow.w, lightV.w);
#else
    return vec2(0.0);
#endif
}

// Where the ray through a point of the picture crosses the plane at view depth 1 (any depth in parallel projection), m.
vec2 imagePoint(vec2 pixel) {
    return vec2(pixel.x * image.x - 1.0, 1.0 - pixel.y * image.y) * image.zw + imageMiddle();
}

struct Ray {
    vec3 origin;
    vec3 direction;
};

Ray worldRay(vec2 at) {
    vec3 off = right.xyz * at.x + up.xyz * at.y;
#ifdef PERSPECTIVE
    return Ray(vec3(0.0), forward.xyz + off);
#else
    return Ray(off, forward.xyz);
#endif
}

float pixelWidthAt(float depth) {
#ifdef PERSPECTIVE
    return right.w * depth;
#else
    return right.w;
#endif
}
