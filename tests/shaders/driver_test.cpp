// The same variants through a real compiler and linker.
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "engine/gl/program.h"
#include "perf/process/child_process.h"
#include "tests/harness/gl_fixture.h"
#include "tests/shaders/shader_variants.h"

namespace halfframe::shaders {
namespace {

/// Links each program; one failure for each that does not, with the driver's words.
void link_all(harness::Ground& ground, const std::vector<NamedProgram>& programs) {
    gl::ProgramCache cache(ground.gl, ground.caps, {});
    std::size_t plain = 0;
    for (const NamedProgram& program : programs) {
        try {
            const gl::Program& linked = cache.get(program.description);
            EXPECT_NE(linked.name(), 0u) << program.name;
            if (!linked.description().uniforms_by_vertex) ++plain;
        } catch (const Error& error) {
            ADD_FAILURE() << program.name << ": " << error.what();
        }
    }
    EXPECT_GT(cache.statistics().compiled, 0);
    // Only what has more uniforms than varyings keeps them: a handful of variants with every light and every extension.
    if (ground.caps.gathers_uniforms) {
        EXPECT_LT(plain, programs.size() / 10);
    }
    EXPECT_EQ(ground.gl.GetError(), 0u);
}

using EsDriver = harness::GlFixture;

TEST_F(EsDriver, LinksEveryLowVariant) { link_all(ground(), every_variant(Tier::low)); }

TEST_F(EsDriver, LinksEveryConsoleVariant) {
    if (caps().es_version < 30) GTEST_SKIP() << "this context is ES " << caps().es_version << ", console needs 30";
    link_all(ground(), every_variant(Tier::console));
}

TEST_F(EsDriver, LinksEveryReferenceVariant) {
    if (caps().es_version < 30) GTEST_SKIP() << "this context is ES " << caps().es_version << ", reference needs 30";
    link_all(ground(), every_variant(Tier::reference));
}

TEST_F(EsDriver, RefusesAPlantedFault) {
    const std::vector<NamedProgram> programs = programs_without_card();
    ASSERT_FALSE(programs.empty());
    gl::ProgramDescription broken = programs.front().description;
    broken.defines.emplace_back("main", "broken +");
    gl::ProgramCache cache(gl(), caps(), {});
    EXPECT_THROW(static_cast<void>(cache.get(broken)), Error);
}

constexpr const char* kOverride = "MESA_GLES_VERSION_OVERRIDE";

/// Does its work in a child of itself, because Mesa reads the variable once in a process.
TEST(OverriddenDriver, LinksEveryLowVariantAsEs20) {
    if (std::getenv(kOverride) == nullptr) {
        const process::ChildResult child =
            process::run_child({.arguments = {std::filesystem::read_symlink("/proc/self/exe").string(),
                                              "--gtest_filter=OverriddenDriver.LinksEveryLowVariantAsEs20"},
                                .environment = {{kOverride, "2.0"}, {"GTEST_OUTPUT", std::nullopt}}});
        if (child.output.find("[  SKIPPED ]") != std::string::npos)
            GTEST_SKIP() << "as the child says:\n" << child.output;
        EXPECT_EQ(child.exit_code, 0) << child.story();
        EXPECT_NE(child.output.find("[  PASSED  ] 1 test"), std::string::npos) << child.story();
        return;
    }
    const harness::GroundOrReason made = harness::make_ground({});
    if (!made.ground) GTEST_SKIP() << made.reason;
    const gl::Caps& caps = made.ground->caps;
    if (caps.version.find("Mesa") == std::string::npos) GTEST_SKIP() << "not a Mesa driver: " << caps.version;
    ASSERT_NE(caps.version.find("OpenGL ES 2.0"), std::string::npos)
        << "the override is not in force: " << caps.version;
    EXPECT_EQ(caps.es_version, 20);
    link_all(*made.ground, every_variant(Tier::low));
}

}  // namespace
}  // namespace halfframe::shaders
