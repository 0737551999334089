// What every shader knows of the frame; mirrors FrameBlock in picture_pass.h. All positions are relative to the eye, which keeps
// single precision where the picture is.
struct Frame {
    vec4 right;             // half the picture's width, on the plane at view depth 1; w: 1 perspective, 0 orthographic
    vec4 up;                // half its height, likewise
    vec4 forward;           // unit; w: width of a pixel at view depth 1 (perspective), or anywhere (orthographic)
    vec4 picture;           // one over the width and the height, offset of the sample in the pixel x, y
    vec4 toLight;           // unit; w: specular
    vec4 lightColor;
    vec4 ambientSky;
    vec4 ambientGround;
    vec4 groundColor;       // w: height
    vec4 groundCenter;      // w: one over the fade distance
    vec4 backgroundTop;
    vec4 backgroundBottom;
    vec4 material;          // reflection, metal, roughness, translucency
    vec4 tone;              // absorption, glow, occlusion, exposure
    vec4 mirrorTop;
    vec4 mirrorHorizon;
    vec4 mirrorBottom;
};

// Vertex shaders hand the frame over: a software renderer gathers a uniform lane by lane for each few pixels, but keeps a flat
// input ready for all of them.
#ifdef VERTEX
layout(std140) uniform FrameBlock { Frame block; };
uniform int targetWidth;    // pixels of the target, a whole number of tiles
flat out Frame frame;
flat out int rowLength;

void handOver() {
    frame = block;
    rowLength = targetWidth;
}
#else
flat in Frame frame;
flat in int rowLength;      // pixels of the target, a whole number of tiles
#endif

struct Ray {
    vec3 origin;
    vec3 direction;         // its component along `forward` is 1, so that the parameter is the view depth
    float inverseSquare;    // 1 / dot(direction, direction)
};

// at: pixels from the top left corner of the picture.
Ray rayThrough(vec2 at) {
    vec2 plane = vec2(2.0, -2.0) * (at * frame.picture.xy) + vec2(-1.0, 1.0);
    vec3 across = plane.x * frame.right.xyz + plane.y * frame.up.xyz;
    Ray ray;
#ifdef PERSPECTIVE
    ray.origin = vec3(0.0);
    ray.direction = frame.forward.xyz + across;
#else
    ray.origin = across;
    ray.direction = frame.forward.xyz;
#endif
    ray.inverseSquare = 1.0 / dot(ray.direction, ray.direction);
    return ray;
}

// A point of a surface, as it is shaded.
struct Point {
    vec3 position;
    vec3 normal;
    vec3 albedo;
    float particle;         // 1 on particles, 0 on obstacles and ground
    vec3 open;              // along the normal, against it, along the mirrored ray
    float lit;              // share of the light that reaches it
    float depth;            // view depth, -1 of the background
};
