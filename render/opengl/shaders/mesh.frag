// What a sample shows of the mesh obstacles, as meshes.glsl reads it.
#include "frame_block.glsl"
#include "packing.glsl"

smooth in vec3 position;
smooth in vec3 normal;
flat in vec3 color;
flat in int mesh;

uniform vec2 depthRange;  // as in mesh.vert

out uvec4 hit;  // view depth (0 without a mesh), normal, color, number of the mesh

void main() {
    float depth = max(dot(position, frame.forward.xyz), 1.0e-30);
    vec3 plane = cross(dFdx(position), dFdy(position));
#ifdef PERSPECTIVE
    vec3 ray = position;
#else
    vec3 ray = frame.forward.xyz;
#endif
    // The rows of the picture run down, so that OpenGL takes the outer sides of triangles for their backs. From inside
    // of a solid the other side is seen. Normals that cancel each other, as those of a sheet's two sides, are no
    // direction.
    vec3 toward = gl_FrontFacing ? -normal : normal;
    vec3 seen = dot(normal, normal) > 1.0e-12 ? toward : dot(plane, ray) > 0.0 ? -plane : plane;
    hit = uvec4(floatBitsToUint(depth), packNormal(vec4(seen.x), vec4(seen.y), vec4(seen.z)).x,
                packColor(vec4(color.r), vec4(color.g), vec4(color.b)).x, uint(mesh));
    // Of depths this has all digits of single precision, near and far.
    float least = max(depthRange.x, 1.0e-30);
    gl_FragDepth = least / (least + depth);
}
