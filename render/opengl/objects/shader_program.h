// Shader programs: compiled from the sources in shaders/, which the build embeds, with the terms that a look uses.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "render/opengl/context/gl.h"

namespace render {

/// A texture that a program reads through the sampler of this name.
struct TextureBinding {
    const char* sampler = "";
    GLenum target = 0;  ///< GL_TEXTURE_BUFFER, for example
    GLuint texture = 0;
};

/// Preprocessor definitions, such as "SAMPLES 4".
using Defines = std::vector<std::string>;

class ShaderProgram {
 public:
    /// Compiles and links a program.
    /// @param vertex, fragment  file names in shaders/
    /// @throws OpenGlError with the compiler's log, in which file names and line numbers are those of shaders/
    ShaderProgram(const Gl& gl, std::string_view vertex, std::string_view fragment, const Defines& defines);
    ~ShaderProgram();
    ShaderProgram(const ShaderProgram&) = delete;
    ShaderProgram& operator=(const ShaderProgram&) = delete;

    /// Makes it the program of the next draws, which read these textures; those that it does not read are left out.
    void use(std::span<const TextureBinding> textures) const;
    /// Sets a uniform of the program in use; nothing happens if it has none of this name.
    void set(const char* name, float x, float y) const;
    void set(const char* name, glm::vec4 value) const;

 private:
    const Gl& gl_;
    GLuint program_;
};

/// The programs of a context, each compiled when it is asked for first.
class ShaderPrograms {
 public:
    explicit ShaderPrograms(const Gl& gl) : gl_(gl) {}
    /// @throws as ShaderProgram does
    const ShaderProgram& get(std::string_view vertex, std::string_view fragment, const Defines& defines);

 private:
    const Gl& gl_;
    std::map<std::string, ShaderProgram> programs_;
};

}  // namespace render
