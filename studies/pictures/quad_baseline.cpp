// One instanced draw of four vertices a particle.
#include "studies/pictures/quad_baseline.h"

#include <utility>
#include <vector>

#include "render/opengl/gl.h"
#include "render/picture/camera_frame.h"
#include "studies/pictures/gl_drawing.h"

namespace studies {
namespace {

// In view coordinates x right, y up, z forward. A quad through the center, across the line of sight, as wide as the
// cone of rays that touch the sphere is there.
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

struct Block {
    glm::vec4 right, up, forward, eye, toLight;
};

BufferName buffer(const render::Gl& gl) {
    GLuint name = 0;
    gl.GenBuffers(1, &name);
    return {gl, name};
}

/// What shaders read of a buffer by texelFetch.
render::TextureName fourFloats(const render::Gl& gl, GLuint items) {
    GLuint name = 0;
    gl.GenTextures(1, &name);
    gl.BindBuffer(GL_TEXTURE_BUFFER, items);
    gl.BindTexture(GL_TEXTURE_BUFFER, name);
    gl.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, items);
    return {gl, name};
}

VertexArrayName vertexArray(const render::Gl& gl) {
    GLuint name = 0;
    gl.GenVertexArrays(1, &name);
    return {gl, name};
}

render::TextureName texture(const render::Gl& gl, render::PictureSize size, GLint stored, GLenum format, GLenum type) {
    GLuint name = 0;
    gl.GenTextures(1, &name);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, name);
    gl.TexImage2D(GL_TEXTURE_2D, 0, stored, size.width, size.height, 0, format, type, nullptr);
    return {gl, name};
}

render::FramebufferName framebuffer(const render::Gl& gl) {
    GLuint name = 0;
    gl.GenFramebuffers(1, &name);
    return {gl, name};
}

}  // namespace

struct QuadBaseline::Parts {
    Parts(render::Context& context_, render::PictureSize size_)
        : context(context_),
          size(size_),
          color(texture(context_.gl(), size_, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE)),
          depth(texture(context_.gl(), size_, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT)),
          target(framebuffer(context_.gl())),
          vertices(vertexArray(context_.gl())),
          spheres(buffer(context_.gl())),
          sphereTexels(fourFloats(context_.gl(), spheres.get())),
          block(buffer(context_.gl())),
          program(buildProgram(context_.gl(), kVertex, kFragment)) {
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
        const Block values{glm::vec4(frame.right, frame.halfWidth), glm::vec4(frame.up, frame.halfHeight),
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
    parts_ = std::make_unique<Parts>(context, size);
    render::checkGl(context.gl(), "setting the baseline up");
}

QuadBaseline::~QuadBaseline() {
    const render::CurrentContext current(parts_->context);
    parts_.reset();
}

render::Image QuadBaseline::draw(const render::View& view, render::Image old) {
    const render::CurrentContext current(parts_->context);
    return parts_->draw(view, std::move(old));
}

}  // namespace studies
