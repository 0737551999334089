// Comparisons and choices with the same names for one number and for four: hits.glsl is written once for both.

bool less(float a, float b) { return a < b; }
bvec4 less(vec4 a, vec4 b) { return lessThan(a, b); }
bool less(int a, int b) { return a < b; }
bvec4 less(ivec4 a, ivec4 b) { return lessThan(a, b); }
bool lessEqual(float a, float b) { return a <= b; }
bvec4 lessEqual(vec4 a, vec4 b) { return lessThanEqual(a, b); }
bool both(bool a, bool b) { return a && b; }
bvec4 both(bvec4 a, bvec4 b) { return bvec4(a.x && b.x, a.y && b.y, a.z && b.z, a.w && b.w); }
bool either(bool a, bool b) { return a || b; }
bvec4 either(bvec4 a, bvec4 b) { return bvec4(a.x || b.x, a.y || b.y, a.z || b.z, a.w || b.w); }
float choose(bool c, float yes, float no) { return c ? yes : no; }
vec4 choose(bvec4 c, vec4 yes, vec4 no) { return mix(no, yes, c); }
int choose(bool c, int yes, int no) { return c ? yes : no; }
ivec4 choose(bvec4 c, ivec4 yes, ivec4 no) {
    return ivec4(c.x ? yes.x : no.x, c.y ? yes.y : no.y, c.z ? yes.z : no.z, c.w ? yes.w : no.w);
}
float largest(float a) { return a; }
float largest(vec4 a) { return max(max(a.x, a.y), max(a.z, a.w)); }
