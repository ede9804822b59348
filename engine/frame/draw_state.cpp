// The state of GL as it was last set.
#include "engine/frame/draw_state.h"

#include "engine/frame/vertex_layout.h"

namespace halfframe {

namespace {

constexpr int kTextureUnits = 8;  // the ES 2.0 minimum: no effect may use more

/// Everything a pass relies on and never sets: a host that draws between our frames may have left it otherwise. State
/// of ES 3.0 is touched only where the device has it; under an ES 2.0 mask the host has no business with it either.
void set_known_state(gl::EntryPoints& gl, const gl::Caps& caps) {
    for (const GLenum capability :
         {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_POLYGON_OFFSET_FILL, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_COVERAGE}) {
        gl.Disable(capability);
    }
    gl.CullFace(GL_BACK);
    gl.FrontFace(GL_CCW);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.DepthRangef(0.0f, 1.0f);
    if (caps.es_version < 30) return;
    gl.Disable(GL_RASTERIZER_DISCARD);
    for (GLuint unit = 0; unit < kTextureUnits; ++unit) gl.BindSampler(unit, 0);
}

void set_capability(gl::EntryPoints& gl, std::uint32_t capability, bool on) {
    on ? gl.Enable(capability) : gl.Disable(capability);
}

}  // namespace

void set_known_transfer_state(gl::EntryPoints& gl, const gl::Caps& caps) {
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    if (caps.es_version < 30) return;
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (const GLenum parameter : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS, GL_UNPACK_ROW_LENGTH,
                                   GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS}) {
        gl.PixelStorei(parameter, 0);
    }
}

void DrawState::forget() { now_ = {}; }

void DrawState::begin_frame(const gl::Caps& caps) {
    forget();
    set_known_state(gl_, caps);
}

bool DrawState::use(std::uint32_t program) {
    if (now_.program == program) return false;
    now_.program = program;
    gl_.UseProgram(program);
    return true;
}

void DrawState::bind_texture(std::uint32_t target, int unit, std::uint32_t texture) {
    std::uint32_t& bound = now_.textures[static_cast<std::size_t>(unit)];
    if (bound == texture && texture != 0) return;
    bound = texture;
    if (now_.active_unit != unit) gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    now_.active_unit = unit;
    gl_.BindTexture(target, texture);
}

void DrawState::bind_array(std::uint32_t array) {
    if (array == 0 || now_.array == array) return;
    now_.array = array;
    gl_.BindVertexArray(array);
}

bool DrawState::bind_vertices(std::uint32_t buffer) {
    if (now_.vertex_buffer == buffer) return false;
    now_.vertex_buffer = buffer;
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffer);
    return true;
}

// An array left on from another mesh would be read past the end of its buffer.
void DrawState::enable_attributes(unsigned wanted) {
    for (int attribute = 0; attribute < kVertexAttributes; ++attribute) {
        const unsigned bit = 1u << attribute;
        if ((now_.attributes & bit) == (wanted & bit) && now_.attributes_known) continue;
        if ((wanted & bit) != 0) gl_.EnableVertexAttribArray(static_cast<GLuint>(attribute));
        else gl_.DisableVertexAttribArray(static_cast<GLuint>(attribute));
    }
    now_.attributes = wanted;
    now_.attributes_known = true;
}

void DrawState::set_depth(bool test, bool write, std::uint32_t function) {
    if (now_.depth_test != int{test}) set_capability(gl_, GL_DEPTH_TEST, test);
    if (now_.depth_write != int{write}) gl_.DepthMask(write ? GL_TRUE : GL_FALSE);
    if (now_.depth_function != function) gl_.DepthFunc(function);
    now_.depth_test = test;
    now_.depth_write = write;
    now_.depth_function = function;
}

void DrawState::set_cull(bool on) {
    if (now_.cull != int{on}) set_capability(gl_, GL_CULL_FACE, on);
    now_.cull = on;
}

void DrawState::set_blend(Blend blend) {
    const bool on = blend != Blend::none;
    if (now_.blend != int{on}) set_capability(gl_, GL_BLEND, on);
    now_.blend = on;
    if (!on || now_.blend_kind == static_cast<int>(blend)) return;
    now_.blend_kind = static_cast<int>(blend);
    switch (blend) {
        case Blend::none: break;
        case Blend::alpha:
            gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
            break;
        case Blend::add: gl_.BlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE); break;
        case Blend::screen: gl_.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_COLOR, GL_ZERO, GL_ONE); break;
        case Blend::multiply: gl_.BlendFuncSeparate(GL_DST_COLOR, GL_ZERO, GL_ZERO, GL_ONE); break;
    }
}

void DrawState::set_color_mask(bool on) {
    const GLboolean mask = on ? GL_TRUE : GL_FALSE;
    if (now_.color_mask != int{on}) gl_.ColorMask(mask, mask, mask, mask);
    now_.color_mask = on;
}

}  // namespace halfframe
