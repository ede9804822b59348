// One function's modelled price: more work costs more, half never costs more than full, and lines that do not compile
// are named.
#include "perf/cost/function_cost.h"

#include <gtest/gtest.h>

#include "engine/error.h"

namespace halfframe::cost {
namespace {

constexpr double kPixels = 1280.0 * 720.0;

double ms_of(const std::string& text, const Profile& profile, bool full = false) {
    std::vector<gl::ShaderFile> files(gl::shader_files().begin(), gl::shader_files().end());
    files.push_back({"f.glsl", text});
    const FunctionCall call{.function = "f",
                            .parameters = {{.components = 3, .full = full}, {.components = 3, .full = full}},
                            .returned = 1,
                            .paths = {"f.glsl"},
                            .defines = {{"TIER_CONSOLE", "1"}}};
    return modelled_ms(call, profile, kPixels, files);
}

TEST(FunctionCost, GrowsWithItsWorkAndItsPixels) {
    for (const Profile& profile : built_in_profiles()) {
        const double dot = ms_of("float f(vec3 a, vec3 b) { return dot(a, b); }", profile);
        const double power = ms_of("float f(vec3 a, vec3 b) { return pow(max(dot(a, b), 0.0), a.x * 64.0); }", profile);
        EXPECT_GT(dot, 0.0) << profile.name;
        EXPECT_GT(power, dot) << profile.name;
    }
}

TEST(FunctionCost, OnTheRsxHalfIsNeverDearer) {
    const Profile ps3 = load_profile("ps3");
    const char* half = "float f(vec3 a, vec3 b) { return dot(normalize(a), normalize(b)); }";
    const char* full = "FULL float f(FULL vec3 a, FULL vec3 b) { return dot(normalize(a), normalize(b)); }";
    EXPECT_LT(ms_of(half, ps3), ms_of(full, ps3, true)) << "a mediump normalize has a unit of its own";
    const Profile x360 = load_profile("x360");
    EXPECT_NEAR(ms_of(half, x360), ms_of(full, x360, true), 1e-9) << "Xenos has no half arithmetic";
}

TEST(FunctionCost, NamesWhatDoesNotCompile) {
    try {
        (void)ms_of("float f(vec3 a, vec3 b) { return dot(a, c); }", load_profile("ps3"));
        FAIL() << "it compiled";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("f.glsl:1"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace halfframe::cost
