// Poses of a scene: what its animations say at a time, and where everything that hangs on nodes then stands. Works in
// double: a character 10 km from the origin moves as smoothly as one at the origin.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "engine/frame/scene.h"

namespace halfframe {

/// Value of a channel at `time_s`: the first key's before it, the last one's after it (glTF 2.0, appendix C). Rotations
/// are unit, x y z w. `value` has as many components as one key.
void sample(const AnimationChannel& channel, double time_s, std::span<double> value);

/// Components of one key's value: 3, 4, or one a morph target.
[[nodiscard]] std::size_t components_of(const AnimationChannel& channel);

/// The time inside 0..duration that an animation played round and round shows at `time_s`; the duration itself once,
/// so that the end can be asked for.
[[nodiscard]] double looped(double time_s, double duration_s);

/// World places of Scene::nodes, in their order; `world_from_node` is as long as they are.
void world_from_nodes(const Scene& scene, std::span<glm::dmat4> world_from_node);

/// Moves surfaces, lights and cameras to where the nodes that carry them stand. A skinned surface goes to its first
/// joint, turned and scaled as the world: its vertices are kept relative to that place.
void place(Scene& scene, std::span<const glm::dmat4> world_from_node);
/// The same with matrices of its own, which it allocates.
void place(Scene& scene);

/// Plays the animations of one scene, which it changes in place. A frame of it, for a renderer that was prepared with
/// that scene:
///
///     Animator animator(scene);
///     renderer.prepare(scene, plan);
///     animator.pose(scene, animation, seconds);
///     renderer.draw(view);
///
/// Nodes that the animation does not name stand as they did when the animator was made. To move a node by hand, change
/// it in Scene::nodes after pose(), then call place().
class Animator {
public:
    /// Keeps the rest pose of `scene`. Nodes, skins and animations must stay as many as they are.
    explicit Animator(const Scene& scene);
    /// Animation `animation` (index in Scene::animations; -1: the rest pose) at `time_s`, looped. Allocates nothing.
    void pose(Scene& scene, int animation, double time_s);

private:
    struct Rest {
        glm::vec3 translation;
        glm::quat rotation;
        glm::vec3 scale;
        std::vector<float> morph_weights;
    };
    void apply(const AnimationChannel& channel, double time_s, Node& node);

    std::vector<Rest> rest_;
    std::vector<glm::dmat4> world_from_node_;
    std::vector<double> value_;  ///< of the channel at hand; as long as the longest
};

}  // namespace halfframe
