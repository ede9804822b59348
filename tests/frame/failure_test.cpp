// What a frame does when the world fails it: a lost context, a target that cannot be allocated. The failures are played
// by a loader that hands out a function of ours in place of the driver's.
#include <gtest/gtest.h>

#include "engine/error.h"
#include "engine/frame/renderer.h"
#include "tests/frame/planning.h"
#include "tests/harness/gl_fixture.h"

namespace halfframe::tests {
namespace {

// The stand-ins need somewhere to keep their state: GL functions take no user pointer.
GLenum answer_of_get_error = GL_NO_ERROR;
GLenum GL_APIENTRY played_get_error() {
    const GLenum answer = answer_of_get_error;
    if (answer != 0x0507) answer_of_get_error = GL_NO_ERROR;  // a lost context stays lost
    return answer;
}
void GL_APIENTRY out_of_memory_tex_image(GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*) {
    answer_of_get_error = GL_OUT_OF_MEMORY;
}

class Failure : public harness::GlFixture {
protected:
    void SetUp() override {
        answer_of_get_error = GL_NO_ERROR;
        harness::GlFixture::SetUp();
    }
    gl::EntryPoints with_stand_ins(bool no_memory) {
        const gl::Loader real = ground().context.loader();
        gl::EntryPoints entry_points([=](const char* function) -> void* {
            if (std::string_view(function) == "glGetError") return reinterpret_cast<void*>(&played_get_error);
            if (no_memory && std::string_view(function) == "glTexImage2D")
                return reinterpret_cast<void*>(&out_of_memory_tex_image);
            return real(function);
        });
        entry_points.restrict_to(caps());
        return entry_points;
    }
};

TEST_F(Failure, ALostContextIsOneSentence) {
    gl::EntryPoints played = with_stand_ins(false);
    const Scene scene = square_scene();
    const View view = square_view();
    Renderer renderer(played, caps());
    renderer.prepare(scene, plan_frame(scene, view, {}, caps(), all_effects()));
    renderer.draw(view);
    answer_of_get_error = 0x0507;  // GL_CONTEXT_LOST
    try {
        renderer.draw(view);
        FAIL() << "the loss went unnoticed";
    } catch (const Error& error) {
        EXPECT_EQ(error.exit_code(), 4);
        EXPECT_NE(std::string(error.what()).find("context was lost while drawing square"), std::string::npos)
            << error.what();
    }
}

TEST_F(Failure, ATargetThatCannotBeAllocatedIsNamed) {
    gl::EntryPoints played = with_stand_ins(true);
    const Scene scene = square_scene();
    const View view = square_view();
    Renderer renderer(played, caps());
    try {
        renderer.prepare(scene, plan_frame(scene, view, {.reads_light = true}, caps(), all_effects()));
        FAIL() << "the failure went unnoticed";
    } catch (const Error& error) {
        EXPECT_EQ(error.exit_code(), 4);
        const std::string sentence = error.what();
        EXPECT_NE(sentence.find("scene_color"), std::string::npos) << sentence;
        EXPECT_NE(sentence.find("64x64"), std::string::npos) << sentence;
        EXPECT_NE(sentence.find("GL_OUT_OF_MEMORY"), std::string::npos) << sentence;
    }
}

TEST_F(Failure, ABrokenPlanIsAMistakeBeforeAnythingIsAllocated) {
    const Scene scene = square_scene();
    FramePlan plan = plan_frame(scene, square_view(), {}, caps(), all_effects());
    std::swap(plan.passes.front(), plan.passes.back());
    Renderer renderer(gl(), caps());
    gl().ledger.clear();
    EXPECT_THROW(renderer.prepare(scene, plan), Mistake);
    EXPECT_EQ(gl().ledger.object_creations(), 0u);
}

}  // namespace
}  // namespace halfframe::tests
