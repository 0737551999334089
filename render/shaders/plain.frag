// Tiles of background, or of ground that nothing dims: one ray a pixel, because nothing in them has an outline, and the
// ground is lit once for the tile.
out vec4 pixel;
#ifdef GROUND
flat in vec3 groundLit;
#endif

void main() {
    vec2 at = floor(gl_FragCoord.xy) + 0.5 + frame.picture.zw;
    vec3 color = background(at.y);
#ifdef GROUND
    Ray ray = rayThrough(at);
    float depth = (frame.groundColor.w - ray.origin.y) / ray.direction.y;
    color = mix(groundLit, color, groundFade(ray.origin + depth * ray.direction));
#endif
    color = clamp(color, 0.0, 1.0);
#ifdef ENCODE
    color = encodeBytes(color);
#endif
    pixel = vec4(color, 1.0);
}
