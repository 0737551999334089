// A corner of a mesh obstacle as the light sees it.
#include "frame_block.glsl"

uniform samplerBuffer meshCorners;  // relative to the eye along the world's axes (m)
uniform vec4 meshMapGrid;           // as in light.glsl
uniform vec4 meshMapSize;

void main() {
    vec3 corner = texelFetch(meshCorners, gl_VertexID).xyz;
    vec2 at = (vec2(dot(corner, frame.lightU.xyz), dot(corner, frame.lightV.xyz)) - meshMapGrid.xy) / meshMapGrid.z;
    float depth = (meshMapGrid.w - dot(corner, frame.toLight.xyz)) * meshMapSize.z;
    // The map begins and ends at corners: rounding is not to clip them.
    gl_Position = vec4(2.0 * at / meshMapSize.xy - 1.0, clamp(2.0 * depth - 1.0, -1.0, 1.0), 1.0);
}
