// Facades in geometry.
#pragma once

#include "content/street/facade_plan.h"
#include "content/street/materials.h"

namespace halfframe::content::street {

/// Where a facade stands in the builder's frame: x from 0 to `width_m` along it, +z out of it.
struct FacadePlace {
    float width_m = 12.0f;
    float foot_m = 4.4f;   ///< height at which its floors begin
    float floor_m = 3.3f;  ///< height of one
    bool fine = true;      ///< with the parts that only show from near
};

/// How far window panes lie behind the wall [m].
constexpr float kReveal_m = 0.28f;

/// Walls with openings, windows, shutters, balconies and what grew on them, for every tile of the plan.
void build_facade(Builder& builder, const Materials& of, const FacadePlan& plan, const FacadePlace& place,
                  Random random);

/// An iron balcony between two x before the wall: slab, brackets, railing on three sides; `y` is its floor.
void build_balcony(Builder& builder, const Materials& of, float x0, float x1, float y, float depth_m, bool left_side,
                   bool right_side);
/// Something that was bolted to the wall beside or under a window, between x0 and x1, over the sill at `y`.
void build_growth(Builder& builder, const Materials& of, Growth growth, float x0, float x1, float y, Random& random);
/// Pipes and cables down and along a facade `width_m` wide, from the ground to `top_m`.
void build_pipes(Builder& builder, const Materials& of, float width_m, float foot_m, float top_m, Random& random);

}  // namespace halfframe::content::street
