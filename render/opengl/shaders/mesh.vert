// A corner of a mesh obstacle as the camera sees it. The picture is moved so that the middles of the target's pixels lie
// at one sample of the pixels.
#include "frame_block.glsl"

uniform samplerBuffer meshCorners;  // relative to the eye along the world's axes (m); w: number of the mesh
uniform samplerBuffer meshNormals;
uniform samplerBuffer meshColors;   // of each mesh
uniform vec4 target;                // 2 / width and 2 / height of the target, offset of the sample (pixels)
uniform vec2 depthRange;            // least depth that is seen in perspective, and a depth beyond all corners (m)

smooth out vec3 position;
smooth out vec3 normal;
flat out vec3 color;
flat out int mesh;

void main() {
    vec4 corner = texelFetch(meshCorners, gl_VertexID);
    position = corner.xyz;
    normal = texelFetch(meshNormals, gl_VertexID).xyz;
    mesh = int(corner.w);
    color = texelFetch(meshColors, mesh).rgb;
    float depth = dot(position, frame.forward.xyz);
    // The third coordinate only clips what lies before the eye: mesh.frag sets the depth.
#ifdef PERSPECTIVE
    float w = depth;
    float clip = depth - 2.0 * depthRange.x;
#else
    float w = 1.0;
    float clip = 1.9 * depth / max(depthRange.y, 1.0e-30) - 1.0;
#endif
    vec2 beside = vec2(dot(position, frame.right.xyz), dot(position, frame.up.xyz));
#ifdef SHIFTED
    beside -= w * vec2(frame.skyBelow.w, frame.lightV.w);
#endif
    vec2 at = vec2(beside.x / frame.image.z + w, w - beside.y / frame.image.w);
    gl_Position = vec4((at / frame.image.xy - target.zw * w) * target.xy - w, clip, w);
}
