// Caps: what is read, that reading leaves no trace, and that masks only take away.
#include "engine/gl/caps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/error.h"
#include "engine/gl/call_number.h"
#include "tests/gl/ground.h"

namespace halfframe::gl {
namespace {

bool renders(const Caps& caps, PixelFormat format) { return caps.renders[static_cast<std::size_t>(format)]; }

class CapsTest : public GroundTest {};

TEST_F(CapsTest, ReadingLeavesNoErrorAndNoObject) {
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
    const auto made = [&](Call gen) { return gl().ledger.total(number(gen)); };
    EXPECT_GT(made(Call::GenTextures), 0u) << "nothing was tried";
    EXPECT_EQ(made(Call::GenTextures), made(Call::DeleteTextures));
    EXPECT_EQ(made(Call::GenFramebuffers), made(Call::DeleteFramebuffers));
    EXPECT_EQ(made(Call::GenRenderbuffers), made(Call::DeleteRenderbuffers));
    for (const GLenum binding : {GL_FRAMEBUFFER_BINDING, GL_RENDERBUFFER_BINDING, GL_TEXTURE_BINDING_2D}) {
        GLint bound = -1;
        gl().GetIntegerv(binding, &bound);
        EXPECT_EQ(bound, 0) << "binding " << binding;
    }
}

TEST_F(CapsTest, AnErrorOfBeforeIsNotTakenForOurs) {
    gl().Enable(0xFFFF);  // no capability: leaves GL_INVALID_ENUM
    const Caps again = read_caps(gl());
    EXPECT_EQ(again.renders, caps().renders);
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(CapsTest, LimitsAreAtLeastTheMinimumsOfTheirVersion) {
    const bool es3 = caps().es_version >= 30;
    EXPECT_GE(caps().es_version, 20);
    EXPECT_GE(caps().max_texture_size, es3 ? 2048 : 64);
    EXPECT_GE(caps().max_vertex_attributes, es3 ? 16 : 8);
    EXPECT_GE(caps().max_fragment_uniform_vectors, es3 ? 224 : 16);
    EXPECT_GE(caps().max_combined_samplers, es3 ? 32 : 8);
    EXPECT_GE(caps().max_draw_buffers, es3 ? 4 : 1);
    EXPECT_GE(caps().fragment_mediump.precision, 10);
    EXPECT_TRUE(std::is_sorted(caps().extensions.begin(), caps().extensions.end()));
    EXPECT_FALSE(caps().extensions.empty());
    EXPECT_TRUE(caps().has_extension(caps().extensions.front().c_str()));
    EXPECT_TRUE(caps().has_extension(caps().extensions.back().c_str()));
    EXPECT_FALSE(caps().has_extension("GL_NO_such_extension"));
}

TEST_F(CapsTest, LlvmpipeRendersWhatWeRelyOn) {
    if (caps().renderer.find("llvmpipe") == std::string::npos) GTEST_SKIP() << "the driver is " << caps().renderer;
    EXPECT_TRUE(caps().software);
    if (caps().es_version < 30) GTEST_SKIP() << "the context is " << caps().version;
    for (int i = 0; i < kPixelFormatCount; ++i) {
        const auto format = static_cast<PixelFormat>(i);
        EXPECT_EQ(renders(caps(), format), format != PixelFormat::srgb8_alpha8) << name(format);
    }
    EXPECT_TRUE(caps().debug_labels);
    EXPECT_TRUE(caps().float_blend);
    EXPECT_TRUE(caps().fence_sync);
    EXPECT_FALSE(caps().samples_passed) << "an ES context has boolean occlusion only";
}

TEST_F(CapsTest, TheMinimumOfEs2HasNothingElse) {
    const Caps poor = masked(caps(), es2_minimum());
    EXPECT_EQ(poor.device, "es2-minimum");
    EXPECT_EQ(poor.es_version, 20);
    EXPECT_EQ(poor.max_vertex_attributes, 8);
    EXPECT_EQ(poor.max_fragment_uniform_vectors, 16);
    EXPECT_EQ(poor.max_draw_buffers, 1);
    EXPECT_EQ(poor.max_samples, 0);
    EXPECT_EQ(poor.max_texture_3d_size, 0);
    EXPECT_FALSE(poor.fragment_highp);
    EXPECT_EQ(poor.fragment_highp_format.precision, 0);
    for (const bool ability : {poor.explicit_lod, poor.derivatives, poor.index_uint, poor.vertex_array_objects,
                               poor.sized_formats, poor.srgb_textures, poor.depth_texture, poor.npot_textures,
                               poor.program_binary, poor.anisotropy, poor.discard_framebuffer, poor.float_blend}) {
        EXPECT_FALSE(ability);
    }
    for (int i = 0; i < kPixelFormatCount; ++i) {
        const auto format = static_cast<PixelFormat>(i);
        EXPECT_EQ(renders(poor, format), format == PixelFormat::rgba8 || format == PixelFormat::depth16)
            << name(format);
    }
    EXPECT_TRUE(poor.extensions.empty());
    // Measuring is not part of the imitated device.
    EXPECT_EQ(poor.fence_sync, caps().fence_sync);
    EXPECT_EQ(poor.timer_query, caps().timer_query);
    EXPECT_EQ(poor.debug_labels, caps().debug_labels);
}

TEST_F(CapsTest, AKeptExtensionBringsItsAbilityBack) {
    if (caps().es_version < 30) GTEST_SKIP() << "the context is " << caps().version;
    struct Row {
        const char* extension;
        bool Caps::*ability;
    };
    for (const Row& row :
         {Row{"GL_OES_element_index_uint", &Caps::index_uint},
          Row{"GL_OES_vertex_array_object", &Caps::vertex_array_objects},
          Row{"GL_OES_depth_texture", &Caps::depth_texture}, Row{"GL_EXT_shader_texture_lod", &Caps::explicit_lod},
          Row{"GL_OES_standard_derivatives", &Caps::derivatives}, Row{"GL_OES_texture_npot", &Caps::npot_textures},
          Row{"GL_EXT_sRGB", &Caps::srgb_textures}}) {
        DeviceProfile profile = es2_minimum();
        EXPECT_FALSE(masked(caps(), profile).*row.ability) << row.extension;
        profile.extensions = std::vector<std::string>{row.extension};
        EXPECT_TRUE(masked(caps(), profile).*row.ability) << row.extension;
    }
    DeviceProfile profile = es2_minimum();
    profile.extensions = std::vector<std::string>{"GL_OES_depth24"};
    EXPECT_TRUE(renders(masked(caps(), profile), PixelFormat::depth24));
}

TEST_F(CapsTest, Es3WithoutFloatTargetsKeepsTheOthers) {
    if (caps().es_version < 30) GTEST_SKIP() << "the context is " << caps().version;
    DeviceProfile profile;
    profile.name = "es3";
    profile.es_version = 30;
    profile.extensions = std::vector<std::string>{};
    const Caps poor = masked(caps(), profile);
    EXPECT_EQ(poor.es_version, 30);
    EXPECT_FALSE(renders(poor, PixelFormat::rgba16f));
    EXPECT_FALSE(renders(poor, PixelFormat::r11g11b10f));
    EXPECT_EQ(renders(poor, PixelFormat::rgb10_a2), renders(caps(), PixelFormat::rgb10_a2));
    EXPECT_TRUE(poor.sized_formats);
    profile.extensions = std::vector<std::string>{"GL_EXT_color_buffer_half_float"};
    EXPECT_EQ(renders(masked(caps(), profile), PixelFormat::rgba16f), renders(caps(), PixelFormat::rgba16f));
    EXPECT_FALSE(renders(masked(caps(), profile), PixelFormat::rgba32f));
}

TEST(CapsMask, OnlyEverTakesAway) {
    const Caps minimum;  // the ES 2.0 minimums
    DeviceProfile rich;
    rich.name = "rich";
    rich.es_version = 32;
    rich.fragment_highp = true;
    rich.max_texture_size = 16384;
    rich.max_samples = 8;
    rich.extensions = std::vector<std::string>{"GL_OES_element_index_uint", "GL_OES_texture_npot"};
    Caps without_highp = minimum;
    without_highp.fragment_highp = false;
    const Caps result = masked(without_highp, rich);
    EXPECT_EQ(result.es_version, 20);
    EXPECT_EQ(result.max_texture_size, minimum.max_texture_size);
    EXPECT_EQ(result.max_samples, 0);
    EXPECT_FALSE(result.fragment_highp);
    EXPECT_FALSE(result.index_uint);
    EXPECT_FALSE(result.npot_textures);
    EXPECT_TRUE(result.extensions.empty());
}

TEST(CapsMask, TakesSamplesWithTheFormatAndTheLimit) {
    Caps rich;
    rich.es_version = 30;
    rich.max_samples = 8;
    rich.renders.fill(true);
    rich.samples.fill(8);
    DeviceProfile profile;
    profile.name = "four samples, no float targets";
    profile.es_version = 30;
    profile.max_samples = 4;
    profile.extensions = std::vector<std::string>{};
    const Caps poorer = masked(rich, profile);
    EXPECT_EQ(poorer.samples[static_cast<std::size_t>(PixelFormat::rgba8)], 4);
    EXPECT_EQ(poorer.samples[static_cast<std::size_t>(PixelFormat::rgba32f)], 0);
    profile.es_version = 20;
    for (const int samples : masked(rich, profile).samples) EXPECT_EQ(samples, 0) << "ES 2.0 resolves nothing";
}

TEST(CapsDesktop, RunsEsTextAndCountsSamples) {
    try {
        Ground ground({.backend = platform::Backend::egl, .api = platform::Api::desktop});
        EXPECT_TRUE(ground.caps.desktop);
        EXPECT_TRUE(ground.caps.core_profile);
        EXPECT_EQ(ground.caps.es_version, 30);
        EXPECT_TRUE(ground.caps.samples_passed);
        EXPECT_TRUE(ground.caps.timer_query);
        EXPECT_GE(ground.caps.max_fragment_uniform_vectors, 224);
        EXPECT_TRUE(renders(ground.caps, PixelFormat::rgba16f));
        EXPECT_EQ(ground.gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    } catch (const platform::ContextError& error) {
        GTEST_SKIP() << error.what();
    }
}

}  // namespace
}  // namespace halfframe::gl
