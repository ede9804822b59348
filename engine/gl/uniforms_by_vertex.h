// Hands a fragment shader's uniforms on from the vertex stage. Workaround llvmpipe_gathers_uniforms: Mesa 22.3's llvmpipe
// reads each component of a uniform as a gather with bounds of its own, some twenty instructions for eight fragments; what
// is interpolated flat comes with one. A frame of 35 spheres under a sun, two points and an environment takes 0.85 of the
// processor time so, a textured globe 0.82.
#pragma once

#include "engine/gl/program.h"

namespace halfframe::gl {

/// Appends to a vertex stage what hands on every `FRAGMENT_UNIFORM` line of its fragment stage, under the conditions that
/// stand there: a uniform named kHandedOn + name, an output `name`, and the assignment at the end of main(). In ES 3.00 it
/// is flat, so that pictures stay the same to the bit; ES 1.00 knows only interpolation, which returns equal values within
/// their last bits. Both texts are assembled with ProgramDescription::uniforms_by_vertex; a fragment stage without such a
/// line leaves `vertex` as it is. Mistake: `vertex` has no line "void main() {".
void hand_on_uniforms(StageText& vertex, const StageText& fragment, Dialect dialect);

/// Before the name of a uniform that is handed on; Program::uniform() is asked without it.
inline constexpr std::string_view kHandedOn = "handed_on_";

}  // namespace halfframe::gl
