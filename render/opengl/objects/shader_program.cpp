// Compiles, links and binds. A failure comes with the compiler's own words.
#include "render/opengl/objects/shader_program.h"

#include <fmt/format.h>

#include "render/opengl/objects/shader_text.h"
#include "render/picture/system_error.h"

namespace render {

namespace {

constexpr GLuint kFrameBinding = 0;  // binding point of the uniform block Frame

template <typename GetInteger, typename GetLog>
std::string logOf(GLuint name, const GetInteger& getInteger, const GetLog& getLog) {
    GLint length = 0;
    getInteger(name, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    getLog(name, length, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    while (!log.empty() && log.back() == '\n') log.pop_back();
    return log;
}

/// Attaches a compiled shader to a program, which keeps it.
void attach(const Gl& gl, GLuint program, GLenum kind, std::string_view name, const Defines& defines) {
    const ShaderSource source = shaderSource(name, defines);
    const GLuint shader = gl.CreateShader(kind);
    const char* text = source.text.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint isCompiled = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &isCompiled);
    const std::string log =
        isCompiled != 0 ? "" : withFileNames(logOf(shader, gl.GetShaderiv, gl.GetShaderInfoLog), source);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);
    if (isCompiled == 0) throw OpenGlError(fmt::format("OpenGL cannot compile the shader {}: {}", name, log));
}

}  // namespace

ShaderProgram::ShaderProgram(const Gl& gl, std::string_view vertex, std::string_view fragment, const Defines& defines)
    : gl_(gl), program_(gl.CreateProgram()) {
    try {
        attach(gl, program_, GL_VERTEX_SHADER, vertex, defines);
        attach(gl, program_, GL_FRAGMENT_SHADER, fragment, defines);
        gl.LinkProgram(program_);
        GLint isLinked = 0;
        gl.GetProgramiv(program_, GL_LINK_STATUS, &isLinked);
        if (isLinked == 0)
            throw OpenGlError(fmt::format("OpenGL cannot link the shaders {} and {}: {}", vertex, fragment,
                                          logOf(program_, gl.GetProgramiv, gl.GetProgramInfoLog)));
    } catch (...) {
        gl.DeleteProgram(program_);
        throw;
    }
    const GLuint frame = gl.GetUniformBlockIndex(program_, "Frame");
    if (frame != GL_INVALID_INDEX) gl.UniformBlockBinding(program_, frame, kFrameBinding);
}

ShaderProgram::~ShaderProgram() {
    gl_.DeleteProgram(program_);
}

void ShaderProgram::use(std::span<const TextureBinding> textures) const {
    gl_.UseProgram(program_);
    GLint unit = 0;
    for (const TextureBinding& binding : textures) {
        const GLint sampler = gl_.GetUniformLocation(program_, binding.sampler);
        if (sampler < 0) continue;
        gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        gl_.BindTexture(binding.target, binding.texture);
        gl_.Uniform1i(sampler, unit++);
    }
}

void ShaderProgram::set(const char* name, float x, float y) const {
    gl_.Uniform2f(gl_.GetUniformLocation(program_, name), x, y);
}

void ShaderProgram::set(const char* name, glm::vec4 value) const {
    gl_.Uniform4f(gl_.GetUniformLocation(program_, name), value.x, value.y, value.z, value.w);
}

const ShaderProgram& ShaderPrograms::get(std::string_view vertex, std::string_view fragment, const Defines& defines) {
    std::string key = fmt::format("{} {}", vertex, fragment);
    for (const std::string& define : defines) key += ' ' + define;
    const auto found = programs_.find(key);
    if (found != programs_.end()) return found->second;
    return programs_.try_emplace(std::move(key), gl_, vertex, fragment, defines).first->second;
}

}  // namespace render
