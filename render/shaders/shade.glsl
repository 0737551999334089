// The shading model of view.h.
vec3 background(float y) { return mix(frame.backgroundTop.xyz, frame.backgroundBottom.xyz, y * frame.picture.y); }

#if defined(SPECULAR) || defined(MIRROR)
vec3 fresnel(Point point, float cosine) {
    vec3 headOn = vec3(frame.toLight.w);
#ifdef METAL
    headOn = mix(headOn, point.albedo, frame.material.y);
#endif
    float away = 1.0 - max(0.0, cosine);
    return headOn + (1.0 - headOn) * ((away * away) * (away * away) * away);
}
#endif

#ifdef SPECULAR
vec3 glint(Point point, vec3 toEye, float lit) {
    vec3 halfway = normalize(frame.toLight.xyz + toEye);
    float peak = max(0.0, dot(point.normal, halfway));
    float gloss = 1.0;
    for (int squaring = 0; squaring < GLOSS; ++squaring) {
        peak *= peak;
        gloss *= 2.0;
    }
    bool facing = dot(point.normal, frame.toLight.xyz) > 0.0 && point.particle > 0.0;
    return facing ? frame.lightColor.xyz * fresnel(point, dot(toEye, halfway)) * (lit * (gloss + 8.0) / 8.0 * peak) : vec3(0.0);
}
#endif

vec3 sky(float up) { return mix(frame.ambientGround.xyz, frame.ambientSky.xyz, 0.5 + 0.5 * up); }

vec3 surroundings(vec3 direction) {
    float up = direction.y;
    vec3 above = mix(frame.mirrorHorizon.xyz, frame.mirrorTop.xyz, up * (2.0 - up));
    return up > 0.0 ? above : mix(frame.mirrorHorizon.xyz, frame.mirrorBottom.xyz, min(1.0, -4.0 * up));
}

// A smooth shoulder for what is brighter than 0.7; below 1, and whiter the brighter it was.
vec3 shoulder(vec3 color) {
    float peak = max(color.x, max(color.y, color.z));
    float kept = 1.0 - 0.09 / max(peak - 0.4, 0.3);
    vec3 bent = mix(color * (kept / max(peak, 0.7)), vec3(kept), 1.0 - 1.0 / (1.0 + 0.06 * (peak - kept)));
    return peak > 0.7 ? bent : color;
}

// Not clamped yet.
vec3 shade(Point point, vec3 toEye) {
#ifdef SHADOWS
    float lit = point.lit;
#else
    float lit = 1.0;
#endif
    float cosine = max(0.0, dot(point.normal, frame.toLight.xyz));
#ifdef ROUGH
    float dust = 2.2 / (cosine + max(0.0, dot(point.normal, toEye)) + 0.2);
    cosine *= 1.0 + point.particle * frame.material.z * (dust - 1.0);
#endif
    vec3 ambient = sky(point.normal.y);
#ifdef OCCLUSION
    ambient *= 1.0 - frame.tone.z * (1.0 - point.open.x);
#endif
    vec3 light = ambient + frame.lightColor.xyz * (cosine * lit);
#ifdef TRANSLUCENT
    float behind = 0.25 + max(0.0, -dot(point.normal, frame.toLight.xyz));
    light += (sky(-point.normal.y) + frame.lightColor.xyz * behind) * (point.particle * frame.material.w * point.open.y);
#endif
    vec3 body = point.albedo;
#ifdef ABSORBING
    body = mix(body, body * body, point.particle * frame.tone.x * (1.0 - point.open.y));
#endif
    vec3 color = body * light;
#ifdef METAL
    color *= 1.0 - point.particle * frame.material.y;
#endif
#ifdef SPECULAR
    color += glint(point, toEye, lit);
#endif
#ifdef MIRROR
    vec3 mirrored = reflect(-toEye, point.normal);
    color += fresnel(point, dot(point.normal, toEye)) * surroundings(mirrored) * (point.particle * frame.material.x * point.open.z);
#endif
#ifdef GLOW
    color += point.albedo * point.albedo * (point.particle * frame.tone.y);
#endif
#ifdef TONE
    color = shoulder(frame.tone.w * color);
#endif
    return color;
}

// How much of the ground's colour is left at a point: 1 / (1 + (d / fadeDistance)^4) shows, the rest is background.
float groundFade(vec3 position) {
    vec3 off = (position - frame.groundCenter.xyz) * frame.groundCenter.w;
    float square = dot(off, off);
    float fade = square * square;
    return min(fade, 1.0e30) / (1.0 + min(fade, 1.0e30));
}
