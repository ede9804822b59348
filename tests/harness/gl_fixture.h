// A context for tests, and one call that draws a scene and checks what every picture must satisfy.
#pragma once

#include <memory>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "engine/frame/frame_plan.h"
#include "engine/frame/image.h"
#include "engine/frame/scene.h"
#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "platform/context.h"

namespace halfframe::harness {

/// Which context a test runs on.
struct GroundWish {
    platform::Backend backend = platform::Backend::egl;
    platform::Api api = platform::Api::es;
    std::string device = "native";  ///< a device mask of content/devices, in force for Caps and entry points
};

/// A current context with its entry points and Caps. Destroyed in the right order: calls first, context last.
struct Ground {
    platform::Context context;
    gl::EntryPoints gl;
    gl::Caps caps;         ///< masked
    gl::Caps native_caps;  ///< as the machine has it
    explicit Ground(const GroundWish& wish);
};

/// Makes the ground, or returns nothing and the sentence that says why there is none (for GTEST_SKIP).
struct GroundOrReason {
    std::unique_ptr<Ground> ground;
    std::string reason;
};
[[nodiscard]] GroundOrReason make_ground(const GroundWish& wish);

/// A drawn picture with the plan that made it.
struct Rendered {
    FramePlan plan;
    Picture picture;
};

/// Whether a picture of one flat colour is a failure. A white furnace is flat on purpose.
enum class FlatPicture { is_a_failure, is_expected };

/// Plans, prepares, draws one frame and reads it back. Adds a test failure when the plan breaks a rule, when GL reports
/// an error, and when the picture is blank.
[[nodiscard]] Rendered render(Ground& ground, const Scene& scene, const View& view, const Wishes& wishes = {},
                              std::span<const EffectCard* const> cards = all_effects(),
                              FlatPicture flat = FlatPicture::is_a_failure);

/// Has a ground in SetUp() or skips with the sentence why not. Override wish() for another than native ES on EGL.
class GlFixture : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;
    [[nodiscard]] virtual GroundWish wish() const { return {}; }

    Ground& ground() { return *ground_; }
    gl::EntryPoints& gl() { return ground_->gl; }
    [[nodiscard]] const gl::Caps& caps() const { return ground_->caps; }
    [[nodiscard]] Rendered render(const Scene& scene, const View& view, const Wishes& wishes = {},
                                  std::span<const EffectCard* const> cards = all_effects(),
                                  FlatPicture flat = FlatPicture::is_a_failure) {
        return harness::render(ground(), scene, view, wishes, cards, flat);
    }

private:
    std::unique_ptr<Ground> ground_;
};

}  // namespace halfframe::harness
