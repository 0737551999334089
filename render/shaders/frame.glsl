// What every shader knows of the frame; mirrors FrameBlock in picture_pass.h. All positions are relative to the eye, which keeps
// single precision where the picture is.
layout(std140) uniform FrameBlock {
    vec4 right;             // half the picture's width, on the plane at view depth 1; w: 1 perspective, 0 orthographic
    vec4 up;                // half its height, likewise
    vec4 forward;           // unit; w: width of a pixel at view depth 1 (perspective), or anywhere (orthographic)
    vec4 picture;           // width, height, offset of the sample in the pixel x, y
    vec4 toLight;           // unit; w: specular
    vec4 lightColor;
    vec4 ambientSky;
    vec4 ambientGround;
    vec4 groundColor;       // w: height
    vec4 groundCenter;      // w: fade distance
    vec4 backgroundTop;
    vec4 backgroundBottom;
    vec4 lightU;            // unit vectors that span the light's plane
    vec4 lightV;
    vec4 lightGrid;         // origin u, v, 1 / cell size, unused
    ivec4 lightCells;       // cells in u, v; texels of the depth map in u, v
    vec4 depthMap;          // origin u, v, 1 / texel size, texel size
    ivec4 counts;           // boxes, gloss exponent, unused, unused
    vec4 material;          // reflection, metal, roughness, translucency
    vec4 tone;              // absorption, glow, occlusion, exposure
    vec4 mirrorTop;
    vec4 mirrorHorizon;
    vec4 mirrorBottom;
    vec4 openGrid;          // middle of the first cube, 1 / side
    ivec4 openCells;        // cubes along x, y, z, columns of the ground's map
    vec4 openMap;           // middle of its first cell x, z, 1 / side, rows
    vec4 soft;              // softness of shadows, mean radius of the particles
};

uniform samplerBuffer boxes;         // minimum, maximum, color per box

struct Ray {
    vec3 origin;
    vec3 direction;         // its component along `forward` is 1, so that the parameter is the view depth
    float inverseSquare;    // 1 / dot(direction, direction)
};

// at: pixels from the top left corner of the picture.
Ray rayThrough(vec2 at) {
    vec2 plane = vec2(2.0 * at.x / picture.x - 1.0, 1.0 - 2.0 * at.y / picture.y);
    vec3 across = plane.x * right.xyz + plane.y * up.xyz;
    Ray ray;
    ray.origin = (1.0 - right.w) * across;
    ray.direction = forward.xyz + right.w * across;
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
    float pixelWidth;       // m, at this depth
};

const float kFar = 3.0e38;
