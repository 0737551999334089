// The color of a point of a surface by section 1 of shading_model.h. A term that the look does not use is not compiled.

struct Point {
    vec3 position;
    vec3 normal;
    vec3 albedo;
    vec3 toEye;       // unit vector
    float depth;      // view depth
    float isParticle; // 1 on particles, which alone have the terms of the surface; 0 on obstacles and the ground
    float light;      // share of the light that reaches the point
    vec3 sky;         // sky visibility along the normal, against it and along the mirrored ray
    vec3 glow;        // light of glowing particles
#ifdef LIGHT_TINT
    vec3 tint;        // of the light that reaches the point
#endif
#ifdef TRANSPARENCY
    int mesh;         // number of the mesh; -1 for other things
    float bodyShare;  // share of the body's color that is seen
    vec3 added;       // light that a transparent body mirrors in addition
#endif
};

// The color of the light that reaches a point.
vec3 reachingColor(Point at) {
#ifdef LIGHT_TINT
    return lightColor.rgb * at.tint;
#else
    return lightColor.rgb;
#endif
}

vec3 skyLight(float up) {
    return mix(skyBelow.rgb, sky.rgb, 0.5 + 0.5 * up);
}

vec3 fresnel(vec3 albedo, float cosine) {
    vec3 headOn = vec3(surface.x);
#ifdef METAL
    headOn = mix(headOn, albedo, surface.z);
#endif
    float away = 1.0 - max(cosine, 0.0);
    float square = away * away;
    return headOn + (1.0 - headOn) * (square * square * away);
}

#ifdef HIGHLIGHT
vec3 highlight(Point at) {
    vec3 halfway = normalize(toLight.xyz + at.toEye);
    float peak = max(dot(at.normal, halfway), 0.0);
    for (int squaring = 0; squaring < int(counts.y); ++squaring) peak *= peak;
    float share = dot(at.normal, toLight.xyz) > 0.0 ? at.isParticle * at.light : 0.0;
#ifdef OCCLUSION
    share *= 1.0 - sky.w * (1.0 - at.sky.z);
#endif
    return reachingColor(at) * fresnel(at.albedo, dot(at.toEye, halfway)) * (body.w * peak * share);
}
#endif

#ifdef REFLECTION
vec3 surroundings(float up) {
    return up > 0.0 ? mix(surroundingsHorizon.rgb, surroundingsTop.rgb, up * (2.0 - up))
                    : mix(surroundingsHorizon.rgb, surroundingsBottom.rgb, min(1.0, -4.0 * up));
}

vec3 mirrored(Point at) {
    float cosine = dot(at.normal, at.toEye);
    float up = 2.0 * cosine * at.normal.y - at.toEye.y;
    return fresnel(at.albedo, cosine) * surroundings(up) * (surface.y * at.sky.z * at.isParticle);
}
#endif

#ifdef RIM
vec3 rim(Point at) {
    float away = 1.0 - max(dot(at.normal, at.toEye), 0.0);
    float square = away * away;
    float strength = at.isParticle * square * square * (0.5 + 0.5 * at.normal.y);
#ifdef OCCLUSION
    strength *= 1.0 - sky.w * (1.0 - at.sky.x);
#endif
    return strength * vec3(surroundingsTop.w, surroundingsHorizon.w, surroundingsBottom.w);
}
#endif

vec3 bodyColor(Point at) {
    float facing = dot(at.normal, toLight.xyz);
    float cosine = max(facing, 0.0);
#ifdef ROUGHNESS
    float dust = 2.2 / (cosine + max(dot(at.normal, at.toEye), 0.0) + 0.2) - 1.0;
    cosine *= 1.0 + at.isParticle * surface.w * dust;
#endif
    vec3 light = skyLight(at.normal.y);
#ifdef OCCLUSION
    light *= 1.0 - sky.w * (1.0 - at.sky.x);
#endif
    light += reachingColor(at) * (cosine * at.light);
#ifdef TRANSLUCENCY
    vec3 through = skyLight(-at.normal.y) + lightColor.rgb * (0.25 + max(-facing, 0.0));
    light += through * (at.isParticle * body.x * at.sky.y);
#endif
#ifdef GLOW_LIGHT
    light += at.glow;
#endif
    vec3 color = at.albedo;
#ifdef ABSORPTION
    color = mix(color, color * color, at.isParticle * body.y * (1.0 - at.sky.y));
#endif
    color *= light;
#ifdef METAL
    color *= 1.0 - at.isParticle * surface.z;
#endif
    return color;
}

vec3 shoulder(vec3 color) {
    float peak = max(color.x, max(color.y, color.z));
    float bent = 1.0 - 0.09 / max(peak - 0.4, 0.3);
    float white = 1.0 - 1.0 / (1.0 + 0.06 * (peak - bent));
    vec3 compressed = mix(color * (bent / max(peak, 0.7)), vec3(bent), white);
    return peak > 0.7 ? compressed : color;
}

vec3 surfaceColor(Point at) {
    vec3 color = bodyColor(at);
#ifdef TRANSPARENCY
    color = color * at.bodyShare + at.added;
#endif
#ifdef HIGHLIGHT
    color += highlight(at);
#endif
#ifdef RIM
    color += rim(at);
#endif
#ifdef REFLECTION
    color += mirrored(at);
#endif
#ifdef GLOW
    color += at.albedo * at.albedo * (at.isParticle * body.z);
#endif
#ifdef EXPOSURE
    color = shoulder(color * lightColor.w);
#endif
    return color;
}

vec3 background(float y) {
    return mix(backgroundTop.rgb, backgroundBottom.rgb, y * up.w);
}

// The ground fades into the background with the distance from its center.
vec3 fadedGround(vec3 color, vec3 position, float y) {
    vec3 offset = (position - groundCenter.xyz) * groundCenter.w;
    float square = dot(offset, offset);
    float fade = min(square * square, 1.0e30);
    return mix(color, background(y), fade / (1.0 + fade));
}
