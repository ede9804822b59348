// The table of entry points: loading, counting, and what masks refuse.
#include "engine/gl/entry_points.h"

#include <cstring>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "engine/gl/call_number.h"
#include "engine/gl/object.h"
#include "tests/gl/ground.h"
#include "tests/gl/sample_frame.h"

namespace halfframe::gl {
namespace {

class EntryPointsTest : public GroundTest {
protected:
    [[nodiscard]] const PassCalls& pass(const char* name) { return gl().ledger.pass(gl().ledger.pass_index(name)); }
    [[nodiscard]] std::uint32_t count(const char* name, Call call) {
        return pass(name).count[static_cast<std::size_t>(number(call))];
    }

    /// A restricted context refuses `act` in a pass, and says which call, pass, device and `detail`.
    template <typename Act>
    void expect_refused(const char* call, const std::string& detail, Act act) {
        gl().begin_pass("shadow");
        const std::string sentence = sentence_of<Mistake>(act);
        gl().end_pass();
        for (const std::string& part : {std::string(call), std::string("\"shadow\""), gl().caps().device, detail}) {
            EXPECT_NE(sentence.find(part), std::string::npos) << "\"" << part << "\" is not in: " << sentence;
        }
    }
};

TEST(EntryPointsLoading, NamesAMissingFunction) {
    try {
        const platform::Context context = platform::Context::create({.backend = platform::Backend::egl});
        const Loader without_draws = [&](const char* name) -> void* {
            return std::strcmp(name, "glDrawElements") == 0 ? nullptr : context.function(name);
        };
        const std::string sentence = sentence_of<Error>([&] { const EntryPoints gl(without_draws); });
        EXPECT_NE(sentence.find("glDrawElements"), std::string::npos) << sentence;
    } catch (const platform::ContextError& error) {
        GTEST_SKIP() << error.what();
    }
}

TEST(EntryPointsLoading, NoContextIsTheWorldsFault) {
    const Loader nothing = [](const char*) -> void* { return nullptr; };
    const std::string sentence = sentence_of<Error>([&] { const EntryPoints gl(nothing); });
    EXPECT_NE(sentence.find("context"), std::string::npos) << sentence;
    EXPECT_THROW(EntryPoints(Loader{}), Mistake);
}

TEST(CallNames, AreThoseOfGl) {
    EXPECT_EQ(call_count(), kCallCount);
    EXPECT_STREQ(call_name(number(Call::DrawElements)), "glDrawElements");
    EXPECT_STREQ(call_name(kCallCount - 1), "glGetQueryObjectui64v");
    EXPECT_THROW((void)call_name(kCallCount), Mistake);
    EXPECT_THROW((void)call_name(-1), Mistake);
}

TEST(CallLedger, KeepsPassesApartAndForgetsOnlyCounts) {
    CallLedger ledger;
    EXPECT_EQ(ledger.pass_names().front(), "set-up");
    const int sky = ledger.pass_index("sky");
    EXPECT_EQ(ledger.pass_index("sky"), sky);
    EXPECT_NE(ledger.pass_index("surface"), sky);
    ledger.pass(sky).count[static_cast<std::size_t>(number(Call::GenTextures))] = 3;
    ledger.pass(sky).count[static_cast<std::size_t>(number(Call::GenerateMipmap))] = 5;
    ledger.pass(0).count[static_cast<std::size_t>(number(Call::CreateProgram))] = 1;
    ledger.pass(0).count[static_cast<std::size_t>(number(Call::LinkProgram))] = 2;
    ledger.pass(0).count[static_cast<std::size_t>(number(Call::ProgramBinary))] = 4;
    EXPECT_EQ(ledger.pass(sky).calls(), 8u);
    EXPECT_EQ(ledger.object_creations(), 4u) << "glGenerateMipmap makes no object";
    EXPECT_EQ(ledger.program_links(), 6u);
    ledger.clear();
    EXPECT_EQ(ledger.object_creations(), 0u);
    EXPECT_EQ(ledger.pass_index("sky"), sky);
}

TEST(CallLedger, RefusesMorePassesThanItHasRoomFor) {
    CallLedger ledger;
    for (int i = 1; i < kMaxPasses; ++i) ledger.pass_index(("pass " + std::to_string(i)).c_str());
    EXPECT_THROW(ledger.pass_index("one more"), Mistake);
}

TEST_F(EntryPointsTest, CountsCallsBytesAndDrawsByPass) {
    gl().ledger.clear();
    const std::array<std::uint8_t, 4> pixel = draw_sample_frame(gl(), caps());
    EXPECT_EQ(pixel, (std::array<std::uint8_t, 4>{51, 102, 153, 255})) << "0.2, 0.4, 0.6 of 255";
    EXPECT_EQ(count("upload", Call::BufferData), 2u);
    EXPECT_EQ(pass("upload").bytes_uploaded, 24u + 6u + 4u) << "a triangle, its indices, one texel";
    EXPECT_EQ(pass("upload").draws, 0u);
    EXPECT_EQ(pass("draw").draws, 1u);
    EXPECT_EQ(pass("draw").vertices, 3u);
    EXPECT_EQ(pass("draw").bytes_uploaded, 0u) << "a texture without data uploads nothing";
    EXPECT_EQ(pass("read").bytes_read_back, 4u);
    EXPECT_EQ(pass("read").calls(), 1u);
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(EntryPointsTest, UploadsFollowThePixelStoreAlignment) {
    const Texture texture = create<Kind::texture>(gl());
    gl().BindTexture(GL_TEXTURE_2D, texture.name());
    constexpr std::uint8_t kPixels[24] = {};
    gl().begin_pass("padded");
    gl().TexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 3, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, kPixels);
    gl().end_pass();
    gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl().begin_pass("tight");
    gl().TexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 3, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, kPixels);
    gl().end_pass();
    EXPECT_EQ(pass("padded").bytes_uploaded, 21u);
    EXPECT_EQ(pass("tight").bytes_uploaded, 18u);
}

TEST_F(EntryPointsTest, PassesOpenAndCloseGroupsThatAreCounted) {
    gl().begin_pass("unknown caps");
    gl().end_pass();
    EXPECT_EQ(pass("unknown caps").calls(), 0u) << "before restrict_to() nobody knows whether KHR_debug is there";
    if (!caps().debug_labels) GTEST_SKIP() << "this context has no KHR_debug";
    gl().restrict_to(caps());
    gl().begin_pass("sky");
    EXPECT_STREQ(gl().current_pass(), "sky");
    gl().end_pass();
    EXPECT_STREQ(gl().current_pass(), "set-up");
    EXPECT_EQ(count("sky", Call::PushDebugGroup), 1u);
    EXPECT_EQ(count("sky", Call::PopDebugGroup), 1u);
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(EntryPointsTest, PassesDoNotNest) {
    gl().begin_pass("one");
    EXPECT_THROW(gl().begin_pass("two"), Mistake);
    gl().end_pass();
    EXPECT_THROW(gl().end_pass(), Mistake);
    EXPECT_THROW(gl().begin_pass("set-up"), Mistake);
}

TEST_F(EntryPointsTest, TheMachineItselfRefusesNothingOfItsOwn) {
    gl().restrict_to(caps());
    EXPECT_EQ(draw_sample_frame(gl(), caps())[1], 102);
}

TEST_F(EntryPointsTest, TheSampleIsDrawnUnderTheEs2Minimum) {
    const Caps poor = masked(caps(), es2_minimum());
    gl().restrict_to(poor);
    EXPECT_EQ(draw_sample_frame(gl(), poor)[1], 102);
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(EntryPointsTest, AMaskRefusesCallsThatCameLater) {
    gl().restrict_to(masked(caps(), es2_minimum()));
    GLuint name = 0;
    expect_refused("glGenVertexArrays", "ES 3.0", [&] { gl().GenVertexArrays(1, &name); });
    expect_refused("glInvalidateFramebuffer", "ES 3.0",
                   [&] { gl().InvalidateFramebuffer(GL_FRAMEBUFFER, 0, nullptr); });
    expect_refused("glProgramBinary", "ES 3.0", [&] { gl().ProgramBinary(0, 0, nullptr, 0); });
    expect_refused("glGetStringi", "ES 3.0", [&] { (void)gl().GetStringi(GL_EXTENSIONS, 0); });
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR)) << "a refused call must not reach the driver";
}

TEST_F(EntryPointsTest, AMaskRefusesWhatIsOverItsLimits) {
    gl().restrict_to(masked(caps(), es2_minimum()));
    expect_refused("glTexImage2D", "4096", [&] {
        gl().TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 16, 4096, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    });
    expect_refused("glTexImage2D", "max_cube_map_size = 512", [&] {
        gl().TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X, 0, GL_RGBA, 1024, 1024, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    });
    expect_refused("glRenderbufferStorage", "2049",
                   [&] { gl().RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, 2049, 1); });
    expect_refused("glActiveTexture", "texture unit 8", [&] { gl().ActiveTexture(GL_TEXTURE0 + 8); });
    expect_refused("glVertexAttribPointer", "attribute index 8",
                   [&] { gl().VertexAttribPointer(8, 4, GL_FLOAT, GL_FALSE, 0, nullptr); });
    expect_refused("glEnableVertexAttribArray", "attribute index 9", [&] { gl().EnableVertexAttribArray(9); });
    expect_refused("glFramebufferTexture2D", "colour attachment 1",
                   [&] { gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + 1, GL_TEXTURE_2D, 0, 0); });
}

TEST_F(EntryPointsTest, AMaskRefusesMoreSamplesThanItsDeviceHas) {
    DeviceProfile profile;
    profile.name = "two samples";
    profile.es_version = 30;
    profile.max_samples = 2;
    gl().restrict_to(masked(caps(), profile));
    expect_refused("glRenderbufferStorageMultisample", "max_samples = 2",
                   [&] { gl().RenderbufferStorageMultisample(GL_RENDERBUFFER, 4, GL_RGBA8, 4, 4); });
    gl().restrict_to(masked(caps(), es2_minimum()));
    expect_refused("glBlitFramebuffer", "ES 3.0",
                   [&] { gl().BlitFramebuffer(0, 0, 1, 1, 0, 0, 1, 1, GL_COLOR_BUFFER_BIT, GL_NEAREST); });
}

TEST_F(EntryPointsTest, AMaskRefusesFormatsAndTypesThatCameLater) {
    gl().restrict_to(masked(caps(), es2_minimum()));
    const auto texture = [&](GLenum internal_format, GLenum format, GLenum type) {
        return [=, this] {
            gl().TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal_format), 4, 4, 0, format, type, nullptr);
        };
    };
    expect_refused("glTexImage2D", "sized internal formats", texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE));
    expect_refused("glTexImage2D", "GL_OES_texture_half_float", texture(GL_RGBA, GL_RGBA, GL_HALF_FLOAT_OES));
    expect_refused("glTexImage2D", "GL_OES_texture_float", texture(GL_RGBA, GL_RGBA, GL_FLOAT));
    expect_refused("glTexImage2D", "GL_OES_depth_texture",
                   texture(GL_DEPTH_COMPONENT, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT));
    expect_refused("glTexImage2D", "GL_EXT_sRGB", texture(GL_SRGB_ALPHA_EXT, GL_SRGB_ALPHA_EXT, GL_UNSIGNED_BYTE));
    expect_refused("glRenderbufferStorage", "DEPTH24",
                   [&] { gl().RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, 4, 4); });
    expect_refused("glRenderbufferStorage", "GL_OES_rgb8_rgba8",
                   [&] { gl().RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 4, 4); });
    expect_refused("glDrawElements", "GL_OES_element_index_uint",
                   [&] { gl().DrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, nullptr); });
    expect_refused("glTexParameteri", "0x813D", [&] { gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 3); });
    expect_refused("glBindFramebuffer", "0x8CA8", [&] { gl().BindFramebuffer(GL_READ_FRAMEBUFFER, 0); });
    const char* later = "#version 300 es\nvoid main() {}\n";
    expect_refused("glShaderSource", "#version 300 es", [&] { gl().ShaderSource(1, 1, &later, nullptr); });
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR)) << "a refused call must not reach the driver";
}

TEST(EntryPointsDesktop, CoreProfileKeepsItsVertexArrayUnderEveryMask) {
    try {
        Ground ground({.backend = platform::Backend::egl, .api = platform::Api::desktop});
        const Caps poor = masked(ground.caps, es2_minimum());
        EXPECT_FALSE(poor.vertex_array_objects);
        ground.gl.restrict_to(poor);
        EXPECT_EQ(draw_sample_frame(ground.gl, poor), (std::array<std::uint8_t, 4>{51, 102, 153, 255}));
        EXPECT_EQ(ground.gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    } catch (const platform::ContextError& error) {
        GTEST_SKIP() << error.what();
    }
}

TEST_F(EntryPointsTest, ObjectsDeleteThemselvesOnce) {
    gl().ledger.clear();
    {
        Buffer first = create<Kind::buffer>(gl());
        Buffer second = std::move(first);
        EXPECT_FALSE(first);  // NOLINT(bugprone-use-after-move): a moved-from object is empty by contract
        EXPECT_TRUE(second);
        second = create<Kind::buffer>(gl());
        EXPECT_EQ(gl().ledger.total(number(Call::DeleteBuffers)), 1u);
        second.reset();
        second.reset();
    }
    EXPECT_EQ(gl().ledger.total(number(Call::GenBuffers)), 2u);
    EXPECT_EQ(gl().ledger.total(number(Call::DeleteBuffers)), 2u);
    EXPECT_THROW((void)create<Kind::shader>(gl()), Mistake);
}

TEST_F(EntryPointsTest, LabelsOfEveryKindAreAccepted) {
    if (!caps().debug_labels || !caps().vertex_array_objects) GTEST_SKIP() << "this context has no KHR_debug";
    gl().restrict_to(caps());
    const Buffer buffer = create<Kind::buffer>(gl());
    const Texture texture = create<Kind::texture>(gl());
    const Framebuffer framebuffer = create<Kind::framebuffer>(gl());
    const Renderbuffer renderbuffer = create<Kind::renderbuffer>(gl());
    const VertexArray vertex_array = create<Kind::vertex_array>(gl());
    const ProgramName program = create<Kind::program>(gl());
    gl().BindBuffer(GL_ARRAY_BUFFER, buffer.name());
    gl().BindTexture(GL_TEXTURE_2D, texture.name());
    gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl().BindRenderbuffer(GL_RENDERBUFFER, renderbuffer.name());
    gl().BindVertexArray(vertex_array.name());
    label(gl(), buffer, "vertices");
    label(gl(), texture, "image");
    label(gl(), framebuffer, "target");
    label(gl(), renderbuffer, "depth");
    label(gl(), vertex_array, "layout");
    label(gl(), program, "surface");
    EXPECT_EQ(gl().ledger.total(number(Call::ObjectLabel)), 6u);
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace halfframe::gl
