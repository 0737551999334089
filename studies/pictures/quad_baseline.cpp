// Draws spheres with OpenGL by one instanced draw call with four vertices for each particle. See quad_baseline.h.
#include "studies/pictures/quad_baseline.h"

#ifdef RENDER_HAS_OPENGL

#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "render/opengl/gl.h"
#include "render/picture/camera_frame.h"
#include "render/picture/system_error.h"

namespace studies {

// Not in the unnamed namespace, because these functions are in the types of a class with external linkage.
inline void deleteBuffer(const render::Gl& gl, GLuint name) {
    gl.DeleteBuffers(1, &name);
}
inline void deleteVertexArray(const render::Gl& gl, GLuint name) {
    gl.DeleteVertexArrays(1, &name);
}
inline void deleteProgram(const render::Gl& gl, GLuint name) {
    gl.DeleteProgram(name);
}

using BufferName = render::GlName<deleteBuffer>;
using VertexArrayName = render::GlName<deleteVertexArray>;
using ProgramName = render::GlName<deleteProgram>;

namespace {

// The shaders work in view coordinates: x right, y up, z forward. The quad passes through the sphere's center across
// the line of sight, and is as wide there as the cone of rays that touch the sphere.
constexpr const char* kVertex = R"(#version 330 core
uniform samplerBuffer spheres;   // center, radius | color
layout(std140) uniform Picture {
    vec4 right, up, forward, eye, toLight;   // right.w, up.w: half width and height of the picture at depth 1
};
out vec3 corner;
flat out vec4 sphere;
flat out vec3 color;

void main() {
    vec4 item = texelFetch(spheres, 2 * gl_InstanceID);
    color = texelFetch(spheres, 2 * gl_InstanceID + 1).rgb;
    vec3 off = item.xyz - eye.xyz;
    sphere = vec4(dot(off, right.xyz), dot(off, up.xyz), dot(off, forward.xyz), item.w);
    float square = dot(sphere.xyz, sphere.xyz);
    float width = sphere.w * sqrt(square / max(square - sphere.w * sphere.w, 1.0e-6));
    vec3 across = normalize(cross(sphere.xyz, vec3(0.0, 1.0, 0.0)));
    vec3 above = normalize(cross(across, sphere.xyz));
    vec2 at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    corner = sphere.xyz + width * (at.x * across + at.y * above);
    gl_Position = vec4(corner.x / right.w, -corner.y / up.w, corner.z - 0.02, corner.z);
}
)";

constexpr const char* kFragment = R"(#version 330 core
layout(std140) uniform Picture { vec4 right, up, forward, eye, toLight; };
in vec3 corner;
flat in vec4 sphere;
flat in vec3 color;
out vec4 pixel;

void main() {
    vec3 ray = normalize(corner);
    float closest = dot(ray, sphere.xyz);
    vec3 away = closest * ray - sphere.xyz;
    float inside = sphere.w * sphere.w - dot(away, away);
    if (inside < 0.0) discard;
    vec3 point = (closest - sqrt(inside)) * ray;
    vec3 normal = (point - sphere.xyz) / sphere.w;
    vec3 light = vec3(dot(toLight.xyz, right.xyz), dot(toLight.xyz, up.xyz), dot(toLight.xyz, forward.xyz));
    gl_FragDepth = 1.0 - 0.01 / point.z;
    vec3 lit = color * (0.3 + 0.9 * max(0.0, dot(normal, light)));
    pixel = vec4(sqrt(clamp(lit, 0.0, 1.0)), 1.0);
}
)";

/// The uniform block "Picture" of the shaders.
struct PictureBlock {
    glm::vec4 right, up, forward, eye, toLight;
};

/// A name from one of OpenGL's functions glGenBuffers, glGenTextures and the like, which have the same signature.
GLuint newName(PFNGLGENBUFFERSPROC generate) {
    GLuint name = 0;
    generate(1, &name);
    return name;
}

/// Compiles a shader and attaches it to a program, which keeps it alive.
void attach(const render::Gl& gl, const ProgramName& program, GLenum stage, const char* source) {
    const GLuint shader = gl.CreateShader(stage);
    gl.ShaderSource(shader, 1, &source, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(program.get(), shader);
    GLint isCompiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &isCompiled);
    std::array<char, 2000> log{};
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    gl.DeleteShader(shader);
    if (isCompiled != GL_TRUE)
        throw render::SystemError(fmt::format("OpenGL cannot compile the study's shaders: {}", log.data()));
}

ProgramName buildProgram(const render::Gl& gl) {
    ProgramName program(gl, gl.CreateProgram());
    attach(gl, program, GL_VERTEX_SHADER, kVertex);
    attach(gl, program, GL_FRAGMENT_SHADER, kFragment);
    gl.LinkProgram(program.get());
    GLint isLinked = GL_FALSE;
    gl.GetProgramiv(program.get(), GL_LINK_STATUS, &isLinked);
    std::array<char, 2000> log{};
    gl.GetProgramInfoLog(program.get(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    if (isLinked != GL_TRUE)
        throw render::SystemError(fmt::format("OpenGL cannot link the study's shaders: {}", log.data()));
    return program;
}

/// A texture through which shaders read a buffer of four floats per texel.
render::TextureName bufferTexture(const render::Gl& gl, GLuint buffer) {
    const GLuint name = newName(gl.GenTextures);
    gl.BindBuffer(GL_TEXTURE_BUFFER, buffer);
    gl.BindTexture(GL_TEXTURE_BUFFER, name);
    gl.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer);
    return {gl, name};
}

render::TextureName texture(const render::Gl& gl, render::PictureSize size, GLint stored, GLenum format, GLenum type) {
    const GLuint name = newName(gl.GenTextures);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, name);
    gl.TexImage2D(GL_TEXTURE_2D, 0, stored, size.width, size.height, 0, format, type, nullptr);
    return {gl, name};
}

}  // namespace

struct QuadBaseline::Resources {
    Resources(render::Context& context_, render::PictureSize size_)
        : context(context_),
          size(size_),
          color(texture(context_.gl(), size_, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE)),
          depth(texture(context_.gl(), size_, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT)),
          target(context_.gl(), newName(context_.gl().GenFramebuffers)),
          vertices(context_.gl(), newName(context_.gl().GenVertexArrays)),
          spheres(context_.gl(), newName(context_.gl().GenBuffers)),
          sphereTexels(bufferTexture(context_.gl(), spheres.get())),
          block(context_.gl(), newName(context_.gl().GenBuffers)),
          program(buildProgram(context_.gl())) {
        const render::Gl& gl = context.gl();
        gl.BindFramebuffer(GL_FRAMEBUFFER, target.get());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color.get(), 0);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth.get(), 0);
        gl.UniformBlockBinding(program.get(), gl.GetUniformBlockIndex(program.get(), "Picture"), 0);
    }

    void upload(const render::View& view) {
        const render::Gl& gl = context.gl();
        std::vector<glm::vec4> texels;
        texels.reserve(2 * view.particles.size());
        for (const render::Sphere& particle : view.particles) {
            texels.emplace_back(particle.center, particle.radius);
            texels.emplace_back(particle.color, 0.0F);
        }
        gl.BindBuffer(GL_TEXTURE_BUFFER, spheres.get());
        gl.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(texels.size() * sizeof(glm::vec4)), texels.data(),
                      GL_STREAM_DRAW);
        const render::CameraFrame frame = render::cameraFrame(view.camera, size);
        const PictureBlock values{glm::vec4(frame.right, frame.halfWidth), glm::vec4(frame.up, frame.halfHeight),
                                  glm::vec4(frame.forward, 0.0F), glm::vec4(frame.eye, 0.0F),
                                  glm::vec4(view.light.toLight, 0.0F)};
        gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, block.get());
        gl.BufferData(GL_UNIFORM_BUFFER, sizeof(values), &values, GL_STREAM_DRAW);
    }

    render::Image draw(const render::View& view, render::Image image) {
        const render::Gl& gl = context.gl();
        gl.BindVertexArray(vertices.get());
        upload(view);
        gl.BindFramebuffer(GL_FRAMEBUFFER, target.get());
        gl.Viewport(0, 0, size.width, size.height);
        gl.Enable(GL_DEPTH_TEST);
        gl.DepthFunc(GL_LESS);
        gl.ClearColor(0.8F, 0.82F, 0.84F, 1.0F);
        gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl.UseProgram(program.get());
        gl.ActiveTexture(GL_TEXTURE0);
        gl.BindTexture(GL_TEXTURE_BUFFER, sphereTexels.get());
        gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(view.particles.size()));
        gl.Disable(GL_DEPTH_TEST);
        image.width = size.width;
        image.height = size.height;
        image.rgb.resize(image.byteCount());
        gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
        gl.ReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
        render::checkGl(gl, "drawing the baseline");
        return image;
    }

    render::Context& context;
    render::PictureSize size;
    render::TextureName color, depth;
    render::FramebufferName target;
    VertexArrayName vertices;
    BufferName spheres;
    render::TextureName sphereTexels;
    BufferName block;
    ProgramName program;
};

QuadBaseline::QuadBaseline(render::Context& context, render::PictureSize size) {
    const render::CurrentContext current(context);
    resources_ = std::make_unique<Resources>(context, size);
    render::checkGl(context.gl(), "setting the baseline up");
}

QuadBaseline::~QuadBaseline() {
    const render::CurrentContext current(resources_->context);
    resources_.reset();
}

render::Image QuadBaseline::draw(const render::View& view, render::Image old) {
    const render::CurrentContext current(resources_->context);
    return resources_->draw(view, std::move(old));
}

}  // namespace studies

#else

namespace studies {

struct QuadBaseline::Resources {};

// Never called: there is no context to call it with.
QuadBaseline::QuadBaseline(render::Context&, render::PictureSize) {}
QuadBaseline::~QuadBaseline() = default;
render::Image QuadBaseline::draw(const render::View&, render::Image old) {
    return old;
}

}  // namespace studies

#endif
