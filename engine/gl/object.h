// Owns one GL name. Move-only, legal when empty, deletes itself.
#pragma once

#include <cstdint>
#include <utility>

namespace halfframe::gl {

class EntryPoints;

enum class Kind : std::uint8_t { buffer, texture, framebuffer, renderbuffer, vertex_array, query, shader, program };

template <Kind kind>
class Object {
public:
    Object() = default;
    Object(EntryPoints& gl, std::uint32_t name) : gl_(&gl), name_(name) {}
    Object(Object&& other) noexcept : gl_(std::exchange(other.gl_, nullptr)), name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        if (this != &other) {
            reset();
            gl_ = std::exchange(other.gl_, nullptr);
            name_ = std::exchange(other.name_, 0);
        }
        return *this;
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    ~Object() { reset(); }

    [[nodiscard]] std::uint32_t name() const { return name_; }
    [[nodiscard]] explicit operator bool() const { return name_ != 0; }
    void reset() noexcept;  ///< deletes the GL object now

private:
    EntryPoints* gl_ = nullptr;
    std::uint32_t name_ = 0;
};

using Buffer = Object<Kind::buffer>;
using Texture = Object<Kind::texture>;
using Framebuffer = Object<Kind::framebuffer>;
using Renderbuffer = Object<Kind::renderbuffer>;
using VertexArray = Object<Kind::vertex_array>;
using Query = Object<Kind::query>;
using Shader = Object<Kind::shader>;
using ProgramName = Object<Kind::program>;

/// Generates one name. `label` (a literal or a string that outlives the call) shows in RenderDoc and apitrace where
/// KHR_debug exists. The label is applied at first bind for kinds GL creates lazily: call label() after binding.
template <Kind kind>
[[nodiscard]] Object<kind> create(EntryPoints& gl);

/// Names a live, once-bound object for debuggers; does nothing without KHR_debug.
template <Kind kind>
void label(EntryPoints& gl, const Object<kind>& object, const char* text);

}  // namespace halfframe::gl
