// Tiles of background, or of ground that nothing dims: one ray a pixel, because nothing in them has an outline.
out vec4 pixel;

#ifdef GROUND
// How much of the background shows through the ground: (d / fadeDistance)^4 / (1 + (d / fadeDistance)^4).
float groundFade(vec2 at) {
    vec2 plane = vec2(2.0, -2.0) * (at * frame.picture.xy) + vec2(-1.0, 1.0);
    vec3 across = plane.x * frame.right.xyz + plane.y * frame.up.xyz;
#ifdef PERSPECTIVE
    vec3 origin = vec3(0.0);
    vec3 direction = frame.forward.xyz + across;
#else
    vec3 origin = across;
    vec3 direction = frame.forward.xyz;
#endif
    float depth = (frame.ground.w - origin.y) / direction.y;
    vec3 off = (origin + depth * direction - frame.groundCenter.xyz) * frame.groundCenter.w;
    float square = dot(off, off);
    float fade = min(square * square, 1.0e30);
    return fade / (1.0 + fade);
}
#endif

void main() {
    vec2 at = floor(gl_FragCoord.xy) + 0.5;
    vec3 color = mix(frame.backgroundTop.xyz, frame.backgroundBottom.xyz, at.y * frame.picture.y);
#ifdef GROUND
    color = mix(frame.ground.xyz, color, groundFade(at));
#endif
    // Red and blue are swapped, see PixelTexture.
    pixel = vec4(encodeRoots(sqrt(clamp(color, 0.0, 1.0))).bgr, 1.0);
}
