// Compiles and links, and hands on the words of whoever refuses.
#include "studies/pictures/gl_drawing.h"

#include <array>

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace studies {

namespace {

GLuint compile(const render::Gl& gl, GLenum stage, const std::string& source) {
    const GLuint shader = gl.CreateShader(stage);
    const char* text = source.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint good = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good == GL_TRUE) return shader;
    std::array<char, 2000> words{};
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(words.size()), nullptr, words.data());
    gl.DeleteShader(shader);
    throw render::SystemError(fmt::format("OpenGL cannot compile the study's shaders: {}", words.data()));
}

}  // namespace

ProgramName buildProgram(const render::Gl& gl, const std::string& vertex, const std::string& fragment) {
    ProgramName program(gl, gl.CreateProgram());
    const GLuint vertexShader = compile(gl, GL_VERTEX_SHADER, vertex);
    const GLuint fragmentShader = compile(gl, GL_FRAGMENT_SHADER, fragment);
    gl.AttachShader(program.get(), vertexShader);
    gl.AttachShader(program.get(), fragmentShader);
    gl.LinkProgram(program.get());
    gl.DeleteShader(vertexShader);
    gl.DeleteShader(fragmentShader);
    GLint good = GL_FALSE;
    gl.GetProgramiv(program.get(), GL_LINK_STATUS, &good);
    if (good != GL_TRUE) {
        std::array<char, 2000> words{};
        gl.GetProgramInfoLog(program.get(), static_cast<GLsizei>(words.size()), nullptr, words.data());
        throw render::SystemError(fmt::format("OpenGL cannot link the study's shaders: {}", words.data()));
    }
    return program;
}

}  // namespace studies
