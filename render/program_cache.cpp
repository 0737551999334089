// Puts shaders together from the embedded files, a #define per feature.
#include "render/program_cache.h"

#include <array>

#include <fmt/format.h>

#include "render/system_error.h"

namespace render {

namespace {

std::string definesOf(const Features& features) {
    std::string text = "#version 330 core\n";
    const auto define = [&text](const char* name, bool wanted) {
        if (wanted) text += fmt::format("#define {}\n", name);
    };
    define("GROUND", features.tiles == TileClass::ground);
    define("PERSPECTIVE", features.perspective);
    return text;
}

std::string joined(std::string text, std::initializer_list<const char*> names) {
    for (const char* name : names) text += shaderSource(name);
    return text;
}

GLuint compile(const Gl& gl, GLenum stage, const std::string& source) {
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
    throw SystemError(fmt::format("OpenGL cannot compile globular's shaders: {}", words.data()));
}

}  // namespace

ProgramName buildProgram(const Gl& gl, const std::string& vertex, const std::string& fragment) {
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
        throw SystemError(fmt::format("OpenGL cannot link globular's shaders: {}", words.data()));
    }
    return program;
}

ProgramName ProgramCache::build(const Features& features) const {
    const std::string defines = definesOf(features);
    if (features.tiles == TileClass::picture)
        return buildProgram(*gl_, joined(defines, {"copy.vert"}), joined(defines, {"copy.frag"}));
    return buildProgram(*gl_, joined(defines + "#define VERTEX\n", {"frame.glsl", "tile.vert"}),
                        joined(defines, {"encode.glsl", "frame.glsl", "plain.frag"}));
}

GLuint ProgramCache::tiles(const Features& features) {
    ProgramName& program = programs_[features];
    if (program.get() != 0) return program.get();
    program = build(features);
    const GLuint name = program.get();
    gl_->UseProgram(name);
    setInteger(name, "tileTable", kTileTableUnit);
    setInteger(name, "pixels", kPixelsUnit);
    const GLuint block = gl_->GetUniformBlockIndex(name, "FrameBlock");
    if (block != GL_INVALID_INDEX) gl_->UniformBlockBinding(name, block, 0);
    return name;
}

void ProgramCache::setInteger(GLuint program, const char* name, int value) const {
    const GLint location = gl_->GetUniformLocation(program, name);
    if (location >= 0) gl_->Uniform1i(location, value);
}

}  // namespace render
