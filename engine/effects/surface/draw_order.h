// In which order a frame draws its surfaces. Pure: no GL.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "engine/frame/scene.h"

namespace halfframe {

/// What ordering reads of a draw.
struct DrawPlace {
    glm::vec3 centre{0.0f};   ///< of its box [m], world
    glm::vec3 half{0.0f};     ///< half of the box's extent [m], >= 0
    std::uint32_t state = 0;  ///< rank among the states of all draws: equal ones need no change between
    /// From the eye to `centre` [m^2]: DrawOrder::far from there on.
    float far_squared = std::numeric_limits<float>::infinity();
};

/// Where a draw stands in a frame.
struct DrawOrder {
    std::uint64_t key = 0;  ///< smaller ones first
    std::uint32_t draw = 0;
    bool far = false;  ///< its place is as far as DrawPlace::far_squared
};

enum class OrderBy : std::uint8_t {
    state,        ///< fewest changes of state: a prepass has drawn the depth, nothing hidden is shaded
    large_first,  ///< what is large in the picture near before far (to 3 % of the distance, by state within), so that
                  ///< what it hides is not shaded; then the rest, which hides little, by state and near before far
    far_first,    ///< far before near: what blends
};

/// Large is a box whose half diagonal covers so much of half the picture's height. From a tenth on, the scenes that are
/// built in and perf/peers' engine shade what they would if all were ordered by distance, within 2 %, and ten thousand
/// small objects change their state no more often than in an order by state alone.
inline constexpr float kLargeShare = 0.1f;

/// Orders all of `places` as `view` sees them. Near is measured to the nearest point of a box: a hull goes before what
/// it holds, whose centre may be nearer; but no box is nearer than 0.6 of the way to its centre, so that a floor and a
/// room round the eye go after what stands there. Far before near goes by centres. Draws that nothing tells apart keep
/// their order, so that they never swap. `order` and `spare` are as long as `places`; allocates nothing.
void order_draws(std::span<const DrawPlace> places, const View& view, OrderBy by, std::vector<DrawOrder>& order,
                 std::vector<DrawOrder>& spare);

}  // namespace halfframe
