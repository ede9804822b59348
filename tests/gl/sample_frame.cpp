// Draws the sample frame.
#include "tests/gl/sample_frame.h"

namespace halfframe::gl {
namespace {

constexpr ShaderFile kFiles[] = {
    {"dialect/es100.glsl",
     "#ifdef STAGE_VERTEX\n#define IN attribute\n#else\n#define IN varying\n#define color gl_FragColor\n"
     "#define texture texture2D\n#endif\n#define OUT varying\n"},
    {"dialect/es300.glsl",
     "#define IN in\n#define OUT out\n#ifdef STAGE_FRAGMENT\nlayout(location = 0) out mediump vec4 color;\n#endif\n"},
    {"sample/sample.frag",
     "IN mediump vec2 uv;\nuniform mediump sampler2D image;\nuniform mediump vec4 tint;\n"
     "void main() { color = texture(image, uv) * tint; }\n"},
    {"sample/sample.vert",
     "IN vec2 position;\nOUT mediump vec2 uv;\nuniform mat4 clip_from_local;\n"
     "void main() { uv = position * 0.5 + 0.5; gl_Position = clip_from_local * vec4(position, 0.0, 1.0); }\n"},
};

constexpr float kTriangle[] = {-1.0F, -1.0F, 3.0F, -1.0F, -1.0F, 3.0F};
constexpr std::uint16_t kIndices[] = {0, 1, 2};
constexpr float kIdentity[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
constexpr std::uint8_t kWhite[] = {255, 255, 255, 255};
constexpr float kTint[] = {0.2F, 0.4F, 0.6F, 1.0F};

void upload(EntryPoints& gl, const Buffer& vertices, const Buffer& indices, const Texture& image) {
    const PassScope pass(gl, "upload");
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices.name());
    gl.BufferData(GL_ARRAY_BUFFER, sizeof kTriangle, kTriangle, GL_STATIC_DRAW);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof kIndices, nullptr, GL_STATIC_DRAW);
    gl.BufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, sizeof kIndices, kIndices);
    gl.BindTexture(GL_TEXTURE_2D, image.name());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, kWhite);
}

}  // namespace

std::span<const ShaderFile> sample_files() { return kFiles; }

ProgramDescription sample_program(Dialect dialect) {
    ProgramDescription description;
    description.name = "sample";
    description.vertex = "sample/sample.vert";
    description.fragment = "sample/sample.frag";
    description.dialect = dialect;
    description.arithmetic = Arithmetic::half;
    description.attributes = {{"position", 0}};
    return description;
}

std::array<std::uint8_t, 4> draw_sample_frame(EntryPoints& gl, const Caps& caps) {
    ProgramCache cache(gl, caps, {}, sample_files());
    Program& program = cache.get(sample_program(caps.es_version >= 30 ? Dialect::es300 : Dialect::es100));
    VertexArray vertex_array;
    if (caps.core_profile) {
        vertex_array = create<Kind::vertex_array>(gl);
        gl.BindVertexArray(vertex_array.name());
    }
    const Buffer vertices = create<Kind::buffer>(gl);
    const Buffer indices = create<Kind::buffer>(gl);
    const Texture image = create<Kind::texture>(gl);
    const Texture target = create<Kind::texture>(gl);
    const Framebuffer framebuffer = create<Kind::framebuffer>(gl);
    upload(gl, vertices, indices, image);
    {
        const PassScope pass(gl, "draw");
        gl.BindTexture(GL_TEXTURE_2D, target.name());
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, kSampleSize, kSampleSize, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.name(), 0);
        gl.Viewport(0, 0, kSampleSize, kSampleSize);
        gl.ClearColor(1.0F, 0.0F, 0.0F, 1.0F);
        gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl.UseProgram(program.name());
        gl.UniformMatrix4fv(program.uniform("clip_from_local"), 1, GL_FALSE, kIdentity);
        gl.Uniform4fv(program.uniform("tint"), 1, kTint);
        gl.Uniform1i(program.uniform("image"), 2);
        gl.ActiveTexture(GL_TEXTURE0 + 2);
        gl.BindTexture(GL_TEXTURE_2D, image.name());
        gl.EnableVertexAttribArray(0);
        gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
        gl.DrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, nullptr);
        gl.DisableVertexAttribArray(0);
    }
    std::array<std::uint8_t, 4> pixel{};
    {
        const PassScope pass(gl, "read");
        gl.ReadPixels(kSampleSize / 2, kSampleSize / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    }
    gl.UseProgram(0);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    return pixel;
}

}  // namespace halfframe::gl
