// GL state of the frame being drawn, as it was last set, so that nothing is set twice.
#pragma once

#include <array>
#include <cstdint>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"

namespace halfframe {

/// What drawing does with the colour that is there already.
enum class Blend : std::uint8_t {
    none,      ///< replaces it
    alpha,     ///< source alpha over destination
    add,       ///< source + destination
    multiply,  ///< source * destination
    screen,    ///< source + destination * (1 - source), for display values
};

/// Texture units, told apart so that neighbours in a list of draws share bindings. 8 is the minimum of ES 2.0.
enum TextureUnit : int {
    kBaseColorUnit = 0,  ///< surface's; also the first source of a full-screen pass
    kMetallicRoughnessUnit = 1,
    kNormalUnit = 2,
    kEmissiveUnit = 3,
    kReflectionUnit = 4,  ///< environment
    kRoughReflectionUnit = 5,
    kShadowUnit = 6,
    kBloomUnit = 7,
    kJointUnit = 15,  ///< joint palettes of the vertex stage; ES 3.0 only, which has 32
};

/// How pixels travel between us and GL, both ways.
void set_known_transfer_state(gl::EntryPoints& gl, const gl::Caps& caps);

class DrawState {
public:
    explicit DrawState(gl::EntryPoints& gl) : gl_(gl) {}

    /// Somebody else may have used the context: every state is set again when it is next asked for.
    void forget();
    /// forget(), and sets everything that a pass relies on and never sets.
    void begin_frame(const gl::Caps& caps);

    bool use(std::uint32_t program);  ///< false: it was current already
    void bind_texture(std::uint32_t target, int unit, std::uint32_t texture);
    /// Where there are vertex array objects; 0 leaves the one that is bound.
    void bind_array(std::uint32_t array);
    /// Where there are none. True: it was another, and the caller says how its vertices lie.
    bool bind_vertices(std::uint32_t buffer);
    /// Other vertices are bound already, by a host or by buffers that change from frame to frame.
    void forget_vertices() { now_.vertex_buffer = kUnknown; }
    void enable_attributes(unsigned wanted);  ///< bits by location; all others go off
    void set_depth(bool test, bool write, std::uint32_t function);
    void set_cull(bool on);
    [[nodiscard]] bool culls() const { return now_.cull == 1; }  ///< as it was last set
    void set_blend(Blend blend);
    void set_color_mask(bool on);

private:
    static constexpr int kTrackedUnits =
        kJointUnit + 1;  // above the eight of ES 2.0, ES 3.0 has one for joint palettes
    static constexpr std::uint32_t kUnknown = ~0u;
    struct Now {
        std::uint32_t program = 0;
        std::array<std::uint32_t, kTrackedUnits> textures{};
        int active_unit = -1;
        int depth_test = -1, depth_write = -1, cull = -1, blend = -1, color_mask = -1;
        int blend_kind = -1;
        std::uint32_t depth_function = 0;
        std::uint32_t array = kUnknown;
        std::uint32_t vertex_buffer = kUnknown;
        unsigned attributes = 0;  ///< bits of the arrays that are on
        bool attributes_known = false;
    };
    gl::EntryPoints& gl_;
    Now now_;
};

}  // namespace halfframe
