// Puts shaders together from the embedded files, a #define per feature.
#include "render/program_cache.h"

#include <array>

#include <fmt/format.h>

#include "render/system_error.h"

namespace render {

namespace {

struct Unit {
    const char* name;
    TextureUnit unit;
};

constexpr std::array<Unit, 10> kUnits = {{{"boxes", kBoxesUnit},
                                          {"tileTable", kTileTableUnit},
                                          {"pixels", kPixelsUnit},
                                          {"edgePixels", kEdgePixelsUnit},
                                          {"fragments", kFragmentsUnit},
                                          {"spheres", kSpheresUnit},
                                          {"sphereLooks", kSphereLooksUnit},
                                          {"fieldSamples", kFieldSamplesUnit},
                                          {"lines", kLinesUnit},
                                          {"accumulated", kAccumulatedUnit}}};

std::string definesOf(const Features& features) {
    std::string text = "#version 330 core\n";
    const auto define = [&text](const char* name, bool wanted) {
        if (wanted) text += fmt::format("#define {}\n", name);
    };
    define("PLAIN", features.drawing == Drawing::plain);
    define("PERSPECTIVE", features.perspective);
    define("SPHERES", features.spheres);
    define("OBSTACLES", features.obstacles);
    define("FIELD", features.field);
    define("BOXES", features.boxes);
    define("GROUND", features.ground);
    define("SINGLE", features.single);
    define("LINES", features.lines);
    define("SHADOWS", features.shadows);
    define("SPECULAR", features.specular);
    if (features.specular) text += fmt::format("#define GLOSS {}\n", features.gloss);
    define("METAL", features.metal);
    define("MIRROR", features.mirror);
    define("ROUGH", features.rough);
    define("TRANSLUCENT", features.translucent);
    define("ABSORBING", features.absorbing);
    define("GLOW", features.glow);
    define("OPEN", features.open);
    define("OCCLUSION", features.occlusion);
    define("TONE", features.tone);
    define("ENCODE", features.output == Output::bytes);
    define("SURFACE", features.output == Output::surface);
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

GLuint ProgramCache::keep(ProgramName& place, ProgramName program) const {
    gl_->UseProgram(program.get());
    for (const Unit& unit : kUnits) setInteger(program.get(), unit.name, unit.unit);
    const GLuint block = gl_->GetUniformBlockIndex(program.get(), "FrameBlock");
    if (block != GL_INVALID_INDEX) gl_->UniformBlockBinding(program.get(), block, 0);
    place = std::move(program);
    return place.get();
}

GLuint ProgramCache::picture(const Features& features) {
    ProgramName& place = pictures_[features];
    if (place.get() != 0) return place.get();
    const std::string forVertices = joined(definesOf(features) + "#define VERTEX\n", {"frame.glsl"});
    const std::string forPixels = joined(definesOf(features), {"frame.glsl", "encode.glsl", "shade.glsl"});
    if (features.drawing == Drawing::plain)
        return keep(place, buildProgram(*gl_, joined(forVertices, {"shade.glsl", "tile.vert"}),
                                        joined(forPixels, {"plain.frag"})));
    const std::string forSurfaces = joined(forPixels, {"surface.glsl"});
    if (features.drawing == Drawing::edges)
        return keep(place,
                    buildProgram(*gl_, joined(forVertices, {"full_screen.vert"}), joined(forSurfaces, {"edges.frag"})));
    return keep(place, buildProgram(*gl_, joined(forVertices, {"tile.vert"}), joined(forSurfaces, {"picture.frag"})));
}

GLuint ProgramCache::resolve() {
    if (resolve_.get() != 0) return resolve_.get();
    return keep(resolve_, buildProgram(*gl_, joined("#version 330 core\n", {"full_screen.vert"}),
                                       joined("#version 330 core\n", {"encode.glsl", "resolve.frag"})));
}

void ProgramCache::setInteger(GLuint program, const char* name, int value) const {
    const GLint location = gl_->GetUniformLocation(program, name);
    if (location >= 0) gl_->Uniform1i(location, value);
}

}  // namespace render
