// Generates, deletes and labels GL names.
#include "engine/gl/object.h"

#include "engine/error.h"
#include "engine/gl/entry_points.h"

namespace halfframe::gl {
namespace {

/// The KHR_debug identifier of a kind.
constexpr GLenum identifier(Kind kind) {
    switch (kind) {
        case Kind::buffer: return GL_BUFFER_KHR;
        case Kind::texture: return GL_TEXTURE;
        case Kind::framebuffer: return GL_FRAMEBUFFER;
        case Kind::renderbuffer: return GL_RENDERBUFFER;
        case Kind::vertex_array: return GL_VERTEX_ARRAY_KHR;
        case Kind::query: return GL_QUERY_KHR;
        case Kind::shader: return GL_SHADER_KHR;
        case Kind::program: return GL_PROGRAM_KHR;
    }
    return GL_NONE;
}

}  // namespace

template <Kind kind>
void Object<kind>::reset() noexcept {
    if (name_ == 0) return;
    const GLuint name = std::exchange(name_, 0);
    EntryPoints& gl = *std::exchange(gl_, nullptr);
    if constexpr (kind == Kind::buffer) gl.DeleteBuffers(1, &name);
    if constexpr (kind == Kind::texture) gl.DeleteTextures(1, &name);
    if constexpr (kind == Kind::framebuffer) gl.DeleteFramebuffers(1, &name);
    if constexpr (kind == Kind::renderbuffer) gl.DeleteRenderbuffers(1, &name);
    if constexpr (kind == Kind::vertex_array) gl.DeleteVertexArrays(1, &name);
    if constexpr (kind == Kind::query) gl.DeleteQueries(1, &name);
    if constexpr (kind == Kind::shader) gl.DeleteShader(name);
    if constexpr (kind == Kind::program) gl.DeleteProgram(name);
}

template <Kind kind>
Object<kind> create(EntryPoints& gl) {
    GLuint name = 0;
    if constexpr (kind == Kind::buffer) gl.GenBuffers(1, &name);
    if constexpr (kind == Kind::texture) gl.GenTextures(1, &name);
    if constexpr (kind == Kind::framebuffer) gl.GenFramebuffers(1, &name);
    if constexpr (kind == Kind::renderbuffer) gl.GenRenderbuffers(1, &name);
    if constexpr (kind == Kind::vertex_array) gl.GenVertexArrays(1, &name);
    if constexpr (kind == Kind::query) gl.GenQueries(1, &name);
    if constexpr (kind == Kind::program) name = gl.CreateProgram();
    if constexpr (kind == Kind::shader) {
        throw Mistake("a shader needs its stage: call EntryPoints::CreateShader and wrap the name in gl::Shader");
    }
    if (name == 0) throw Error(Fault::context, "the driver made no GL object: the context is lost or out of memory");
    return Object<kind>(gl, name);
}

template <Kind kind>
void label(EntryPoints& gl, const Object<kind>& object, const char* text) {
    if (object && gl.debug_labels()) gl.ObjectLabel(identifier(kind), object.name(), -1, text);
}

#define HALFFRAME_INSTANTIATE(kind)                       \
    template class Object<kind>;                          \
    template Object<kind> create<kind>(EntryPoints & gl); \
    template void label<kind>(EntryPoints&, const Object<kind>&, const char*);
HALFFRAME_INSTANTIATE(Kind::buffer)
HALFFRAME_INSTANTIATE(Kind::texture)
HALFFRAME_INSTANTIATE(Kind::framebuffer)
HALFFRAME_INSTANTIATE(Kind::renderbuffer)
HALFFRAME_INSTANTIATE(Kind::vertex_array)
HALFFRAME_INSTANTIATE(Kind::query)
HALFFRAME_INSTANTIATE(Kind::shader)
HALFFRAME_INSTANTIATE(Kind::program)
#undef HALFFRAME_INSTANTIATE

}  // namespace halfframe::gl
