#version 330 core
// A rectangle over the whole target, and where its corners lie in the texture.
out vec2 place;

void main() {
    const vec2 corners[6] = vec2[](vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1.0), vec2(0.0, 0.0), vec2(1.0, 1.0), vec2(0.0, 1.0));
    place = corners[gl_VertexID];
    gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
