// Where blobs lie, and drawing them.
#include "engine/effects/shadow/shadow_blob.h"

#include <algorithm>

#include "engine/effects/shadow/shadow.h"
#include "engine/frame/camera_space.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/uploads.h"

namespace halfframe {

namespace {

// Our own figures, chosen by eye in the test room beside the console tier.
constexpr float kStrength = 0.7f;     ///< of an object that touches the ground; the room's ambient is what is left
constexpr float kSpread = 1.3f;       ///< radius over the object's half width: the dark outgrows what throws it
constexpr float kFadeHeights = 2.0f;  ///< gone at this height above ground, in half widths of the object
constexpr float kSunk = 0.05f;        ///< share of its height that an object may stand inside its ground
// One slope and four depth steps towards the eye: the blob lies in the ground's own plane and has other triangles.
constexpr float kSlopeOffset = -1.0f;
constexpr float kStepOffset = -4.0f;

bool above(const Box& object, const Box& ground) {
    const glm::vec3 centre = 0.5f * (object.low + object.high);
    return centre.x >= ground.low.x && centre.x <= ground.high.x && centre.z >= ground.low.z &&
           centre.z <= ground.high.z;
}

/// The box whose top the object is over, or the one that encloses it.
const Box* ground_below(const Box& object, std::span<const Box> grounds) {
    const float sunk = kSunk * (object.high.y - object.low.y);
    const Box* highest = nullptr;
    const Box* around = nullptr;
    for (const Box& ground : grounds) {
        if (!above(object, ground)) continue;
        if (ground.high.y <= object.low.y + sunk) {
            if (highest == nullptr || ground.high.y > highest->high.y) highest = &ground;
        } else if (ground.low.y <= object.low.y + sunk) {
            around = &ground;
        }
    }
    return highest != nullptr ? highest : around;
}

}  // namespace

std::optional<Blob> blob_under(const Box& object, std::span<const Box> grounds) {
    if (object.empty()) return std::nullopt;
    const glm::vec2 half = 0.5f * glm::vec2(object.high.x - object.low.x, object.high.z - object.low.z);
    const float width = std::max(half.x, half.y);
    const Box* ground = ground_below(object, grounds);
    if (ground == nullptr || !(width > 0.0f)) return std::nullopt;
    Blob blob;
    blob.centre = 0.5f * (object.low + object.high);
    blob.centre.y = std::min(ground->high.y, object.low.y);
    const float height = std::max(object.low.y - blob.centre.y, 0.0f) / (kFadeHeights * width);
    if (height >= 1.0f) return std::nullopt;
    blob.strength = kStrength * (1.0f - height);
    // A door is thin: its blob is at least a quarter as wide as it is long.
    blob.radius = kSpread * (1.0f + height) * glm::max(half, glm::vec2(0.25f * width));
    const glm::vec2 middle(blob.centre.x, blob.centre.z);
    const glm::vec2 low = (glm::vec2(ground->low.x, ground->low.z) - middle) / blob.radius;
    const glm::vec2 high = (glm::vec2(ground->high.x, ground->high.z) - middle) / blob.radius;
    blob.span = glm::vec4(glm::max(low, glm::vec2(-1.0f)), glm::min(high, glm::vec2(1.0f)));
    return blob;
}

std::vector<Box> grounds_of(const Scene& scene) {
    std::vector<Box> grounds;
    for (const Surface& surface : scene.surfaces) {
        if (surface.dynamic) continue;
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(surface.mesh)];
        const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
        if (mesh.primitive < Primitive::triangles || material.alpha_mode == AlphaMode::blend) continue;
        const Box box = world_box(local_box(mesh), surface.world_from_local);
        if (!box.empty()) grounds.push_back(box);
    }
    return grounds;
}

ShadowBlobs::ShadowBlobs(Renderer& renderer) : grounds_(grounds_of(renderer.scene())) {
    std::vector<std::string_view> defines;
    const gl::PixelFormat storage = renderer.plan().storage;
    // Packed light is a square root already.
    if (!holds_display_values(storage) && storage != gl::PixelFormat::rgb10_a2) defines.push_back("SCENE_COLOR_LINEAR");
    program_ = &renderer.program(kShadow, 0, defines);
    clip_from_local_ = program_->uniform("clip_from_local");
    span_ = program_->uniform("span");
    blob_ = program_->uniform("blob");
    program_->expect_all_uniforms_claimed();
    Mesh square;
    square.positions = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}};
    square.indices = {0, 1, 2, 0, 2, 3};  // its front is up: from below there is ground in the way
    square_ = upload_mesh(renderer.gl(), renderer.caps(), square, full_storage(square));
    const Scene& scene = renderer.scene();
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        if (scene.surfaces[i].dynamic) objects_.push_back(static_cast<int>(i));
    }
}

void ShadowBlobs::draw(Renderer& renderer, const View& view, int) {
    gl::EntryPoints& gl = renderer.gl();
    renderer.set_color_mask(true);
    renderer.set_depth(true, false, GL_LEQUAL);
    renderer.set_cull(true);
    renderer.set_blend(Blend::multiply);
    renderer.use(*program_);
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(kSlopeOffset, kStepOffset);
    for (const int index : objects_) {
        const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(index)];
        const auto blob = blob_under(world_box(renderer.mesh(surface.mesh).box, surface.world_from_local), grounds_);
        if (!blob) continue;
        glm::mat4 world_from_radii(1.0f);
        world_from_radii[0].x = blob->radius.x;
        world_from_radii[2].z = blob->radius.y;
        world_from_radii[3] = glm::vec4(blob->centre, 1.0f);
        const glm::mat4 matrix = clip_from_local(view, world_from_radii);
        if (outside_view({{-1.0f, 0.0f, -1.0f}, {1.0f, 0.0f, 1.0f}}, matrix)) continue;
        const glm::vec4 strength(blob->strength, 0.0f, 0.0f, 0.0f);
        gl.UniformMatrix4fv(clip_from_local_, 1, GL_FALSE, &matrix[0][0]);
        gl.Uniform4fv(span_, 1, &blob->span.x);
        gl.Uniform4fv(blob_, 1, &strength.x);
        renderer.draw_mesh(square_);
    }
    gl.PolygonOffset(0.0f, 0.0f);
    gl.Disable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace halfframe
