// The shading model of view.h.
vec3 background(float y) { return mix(backgroundTop.xyz, backgroundBottom.xyz, y / picture.y); }

// No `if` and no loop of one turn around this: measured, llvmpipe's masks cost more than the work that they would save.
float lightOn(Point point) {
#ifdef SHADOWS
    bool facing = dot(point.normal, toLight.xyz) > 0.0;
    return facing ? visibility(point, facing) : 0.0;
#else
    return 1.0;
#endif
}

vec3 glint(Point point, vec3 toEye, float lit) {
    vec3 halfway = normalize(toLight.xyz + toEye);
    float away = 1.0 - max(0.0, dot(toEye, halfway));
    float fresnel = point.specular + (1.0 - point.specular) * (away * away) * (away * away) * away;
    float peak = max(0.0, dot(point.normal, halfway));
    float gloss = 1.0;
    for (int squaring = 0; squaring < counts.y; ++squaring) {
        peak *= peak;
        gloss *= 2.0;
    }
    bool facing = dot(point.normal, toLight.xyz) > 0.0;
    return facing && point.specular > 0.0 ? lightColor.xyz * (lit * fresnel * (gloss + 8.0) / 8.0 * peak) : vec3(0.0);
}

// Not clamped yet.
vec3 shade(Point point, vec3 toEye) {
    float lit = lightOn(point);
    vec3 ambient = mix(ambientGround.xyz, ambientSky.xyz, 0.5 + 0.5 * point.normal.y);
    vec3 diffuse = lightColor.xyz * (max(0.0, dot(point.normal, toLight.xyz)) * lit);
    vec3 color = point.albedo * (ambient + diffuse);
#ifdef SPECULAR
    color += glint(point, toEye, lit);
#endif
    return color;
}

// How much of the ground's colour is left at a point: 1 / (1 + (d / fadeDistance)^4) shows, the rest is background.
float groundFade(vec3 position) {
    vec3 off = (position - groundCenter.xyz) / groundCenter.w;
    float square = dot(off, off);
    float fade = square * square;
    return min(fade, 1.0e30) / (1.0 + min(fade, 1.0e30));
}
