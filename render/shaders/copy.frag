#version 330 core
// Pixels whose colours are known. With nothing but this in it, llvmpipe does not run the shader, but copies rows of pixels.
uniform sampler2D pixels;

in vec2 place;
out vec4 pixel;

void main() {
    pixel = texture(pixels, place);
}
