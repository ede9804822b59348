// A context with its entry points and Caps, for the tests of the GL layer alone.
#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "platform/context.h"

namespace halfframe::gl {

/// A context, its entry points without a mask, and what it can do.
struct Ground {
    platform::Context context;
    EntryPoints gl;
    Caps caps;
    explicit Ground(const platform::ContextDescription& wish = {.backend = platform::Backend::egl})
        : context(platform::Context::create(wish)), gl(context.loader()), caps(read_caps(gl)) {}
};

/// Has a ground, on ES through EGL, or skips with the reason why there is none.
class GroundTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            ground_ = std::make_unique<Ground>();
        } catch (const platform::ContextError& error) {
            GTEST_SKIP() << error.what();
        }
    }
    EntryPoints& gl() { return ground_->gl; }
    [[nodiscard]] const Caps& caps() const { return ground_->caps; }

private:
    std::unique_ptr<Ground> ground_;
};

/// The smallest device ES 2.0 allows, but for textures of 2048 and cubes of 512.
inline DeviceProfile es2_minimum() {
    DeviceProfile profile;
    profile.name = "es2-minimum";
    profile.source = "OpenGL ES 2.0.25, tables 6.18 to 6.20";
    profile.es_version = 20;
    profile.fragment_highp = false;
    profile.extensions = std::vector<std::string>{};
    profile.max_texture_size = 2048;
    profile.max_cube_map_size = 512;
    profile.max_renderbuffer_size = 2048;
    profile.max_vertex_attributes = 8;
    profile.max_vertex_uniform_vectors = 128;
    profile.max_fragment_uniform_vectors = 16;
    profile.max_varying_vectors = 8;
    profile.max_fragment_samplers = 8;
    profile.max_vertex_samplers = 0;
    profile.max_combined_samplers = 8;
    return profile;
}

/// What the Mistake thrown by `act` says; a failure of the test when none is thrown.
template <typename Kind, typename Act>
std::string sentence_of(Act act) {
    try {
        act();
    } catch (const Kind& problem) {
        return problem.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

}  // namespace halfframe::gl
