// The halfframe command as its users see it: exit codes, streams, files, repeatability.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/perf/child_process.h"

namespace halfframe::test {
namespace {

const std::string kCommand = HALFFRAME_BINARY_DIR "/halfframe";

/// What every run has: small pictures, no program cache outside the test.
ChildResult halfframe(const std::vector<std::string>& arguments, const ChildOptions& options = {}) {
    return run_child(kCommand, arguments, options);
}

std::vector<std::string> render(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", "test_room", "--size", "64x48", "--cache", "none"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// Skips where no context exists at all: those machines test the rest.
class Drawing : public ::testing::Test {
protected:
    void SetUp() override {
        const ChildResult info = halfframe({"info", "--json"});
        if (info.code == 4) {
            GTEST_SKIP() << "no graphics context here: " << info.err;
        }
        ASSERT_EQ(info.code, 0) << info.err;
    }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Usage, an_unknown_option_is_2_and_names_the_nearest) {
    const ChildResult result = halfframe({"render", "test_room", "--sizes", "64x64"});
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(contains(result.err, "did you mean '--size'")) << result.err;
    EXPECT_TRUE(result.out.empty()) << result.out;
}

TEST(Usage, an_unknown_command_is_2_and_names_the_nearest) {
    const ChildResult result = halfframe({"rendr", "test_room"});
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(contains(result.err, "did you mean 'render'")) << result.err;
}

TEST(Usage, wrong_values_are_2) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"render", "test_room", "--size", "0x10"}, "--size 0x10"},
        {{"render", "test_room", "--size", "8193x10"}, "--size 8193x10"},
        {{"render", "test_room", "--size", "64"}, "--size 64"},
        {{"render", "test_room", "--tier", "consol"}, "did you mean 'console'"},
        {{"render", "test_room", "--tier", "tonemap=low"}, "did you mean 'tone_map'"},
        {{"render", "test_room", "--arithmetic", "haf"}, "did you mean 'half'"},
        {{"render", "test_room", "--storage", "rgba16"}, "did you mean 'rgba16f'"},
        {{"render", "test_room", "--context", "elg"}, "did you mean 'egl'"},
        {{"render", "test_room", "--set", "exposur=1"}, "did you mean 'exposure'"},
        {{"render", "test_room", "--set", "exposure"}, "KEY=VALUE"},
        {{"render", "test_room", "--set", "exposure=-1"}, "above 0"},
        {{"render", "test_room", "--set", "ambient=1,2"}, "three numbers"},
        {{"render", "test_room", "--eye", "1,2,3"}, "--target"},
        {{"render", "test_room", "--eye", "-1,2,3", "--target", "-1,2,3"}, "same point"},
        {{"render", "test_room", "--fov-y", "180"}, "0.1 to 179"},
        {{"render", "test_room", "--fov-y", "179.9999999"}, "0.1 to 179"},
        {{"render", "test_room", "--eye", "1e-30,1,0", "--target", "0,1,0"}, "same point"},
        {{"render", "test_room", "--eye", "3e38,1,0", "--target", "0,1,0"}, "too far apart"},
        {{"render", "test_room", "--set", "tone_map.on=0", "--size", "8x8"}, "cannot be switched off"},
        {{"render", "test_room", "--set", "sky.zenith=2,0,0"}, "0 to 1"},
        {{"render", "test_room", "--set", "bloom.strength=1.5"}, "0 to 1"},
        {{"render", "test_room", "--set", "wet.level=1.5"}, "0 to 1"},
        {{"render", "test_room", "--set", "puddles.level=-0.1"}, "0 to 1"},
        {{"render", "test_room", "--set", "wet.live=yes"}, "0 or 1"},
        {{"render", "test_room", "--set", "wet.dry_s=0"}, "at least 0.1"},
        {{"bake-wet", "test_room", "-o", "dry.glb"}, "wet.level"},
        {{"bake-wet", "test_room", "-o", "wet.gltf"}, ".glb"},
        {{"surface-at", "test_room", "here", "0"}, "not a finite number"},
        {{"render", "test_room", "-o", "one.png", "--trace", "one.png"}, "named twice"},
        {{"render", "test_room", "-o", "picture.jpg"}, ".png or .exr"},
        {{"render", "test_room", "--measure", "-1"}, "--measure"},
        {{"render", "test_room", "a_second_scene"}, "too many"},
        {{"render"}, "SCENE"},
        {{"plan"}, "SCENE"},
        {{}, "no command"},
    };
    for (const auto& [arguments, expected] : cases) {
        const ChildResult result = halfframe(arguments);
        std::string line;
        for (const std::string& argument : arguments) {
            line += argument + " ";
        }
        EXPECT_EQ(result.code, 2) << line << "\n" << result.err;
        EXPECT_TRUE(contains(result.err, expected)) << line << "\n" << result.err;
        EXPECT_TRUE(result.out.empty()) << line << "\n" << result.out;
    }
}

TEST(Usage, every_effect_can_be_switched_by_hand) {
    for (const char* effect : {"surface", "depth_prepass", "sky"}) {
        for (const char* on : {"0", "1"}) {
            for (const char* scene : {"test_room", "empty"}) {
                const std::string setting = std::string(effect) + ".on=" + on;
                const ChildResult result = halfframe({"plan", scene, "--set", setting, "--size", "8x8"});
                EXPECT_EQ(result.code, 0) << scene << " --set " << setting << "\n" << result.err;
            }
        }
    }
    const ChildResult drawn = halfframe({"render", "furnace", "--set", "sky.on=1", "--size", "8x8", "--measure", "0"});
    EXPECT_EQ(drawn.code, 0) << drawn.err;
}

TEST(Usage, nobody_has_to_listen_to_complaints) {
    for (const char* redirection : {"2>&-", "2>/dev/full"}) {
        const std::string line = "'" + kCommand + "' render no_such_scene " + redirection;
        const ChildResult result = run_child("/bin/sh", {"-c", line});
        EXPECT_EQ(result.code, 3) << line;
    }
}

TEST(Usage, version_and_lists_are_0) {
    EXPECT_EQ(halfframe({"--version"}).code, 0);
    EXPECT_TRUE(contains(halfframe({"--version"}).out, "halfframe "));
    const ChildResult scenes = halfframe({"scenes"});
    EXPECT_EQ(scenes.code, 0);
    EXPECT_TRUE(contains(scenes.out, "test_room")) << scenes.out;
    const ChildResult effects = halfframe({"effects", "--json"});
    EXPECT_EQ(effects.code, 0);
    const auto cards = nlohmann::json::parse(effects.out);
    ASSERT_FALSE(cards.empty());
    for (const auto& card : cards) {
        EXPECT_FALSE(card.at("purpose").get<std::string>().empty()) << card;
        EXPECT_EQ(card.at("tiers").size(), 3u) << card;
    }
}

/// Every line of an option has words of its own, on the line or under it.
TEST(Usage, help_explains_every_option_and_the_exit_codes) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> commands{
        {"render", {"--output", "--size",  "--tier",   "--arithmetic", "--storage", "--context", "--device",
                    "--camera", "--eye",   "--target", "--fov-y",      "--set",     "--measure", "--budget",
                    "--census", "--cache", "--json",   "--trace",      "--ledger",  "--html",    "--cost"}},
        {"report", {"--output", "--size", "--tier", "--measure", "--budget", "--json"}},
        {"plan", {"--size", "--tier", "--device", "--json"}},
        {"info", {"--context", "--device", "--json"}},
        {"effects", {"--json"}},
        {"scenes", {"--json"}},
        {"accuracy", {"--json"}},
        {"check", {"--thresholds", "--strict", "--json", "--sarif", "--picture", "--font", "--device", "--size"}},
        {"contact-sheet", {"--output", "--cell", "--columns", "--tier", "--device", "--measure", "--limit", "--font"}},
        {"cost", {"--size", "--tier", "--profile", "--why", "--texture", "--into", "--json", "--csv", "--trace"}}};
    for (const auto& [command, options] : commands) {
        const ChildResult help = halfframe({command, "--help"});
        EXPECT_EQ(help.code, 0) << command;
        EXPECT_TRUE(contains(help.out, "Exit codes: 0 done")) << command;
        for (const std::string& option : options) {
            EXPECT_TRUE(contains(help.out, option)) << command << " " << option;
        }
        std::istringstream lines(help.out);
        std::string line;
        std::string pending;
        int explained = 0;
        while (std::getline(lines, line)) {
            const std::size_t start = line.find_first_not_of(' ');
            const bool is_option = line.starts_with("  -");
            if (!pending.empty()) {
                EXPECT_TRUE(!is_option && start != std::string::npos && start > 10) << command << ": " << pending;
                pending.clear();
                ++explained;
            }
            if (is_option) {
                if (line.find("  ", 4) == std::string::npos) {
                    pending = line;
                } else {
                    ++explained;
                }
            }
        }
        EXPECT_TRUE(pending.empty()) << command << ": " << pending;
        EXPECT_GE(explained, static_cast<int>(options.size())) << command;
    }
}

TEST_F(Drawing, a_missing_file_is_3_and_named) {
    const ChildResult result = halfframe({"render", "no_such_file.gltf"});
    EXPECT_EQ(result.code, 3) << result.err;
    EXPECT_TRUE(contains(result.err, "no_such_file.gltf")) << result.err;
    EXPECT_EQ(halfframe({"render", "no_such_scene"}).code, 3);
}

TEST(Context, without_any_egl_driver_is_4) {
    ChildOptions options;
    options.environment = {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"}};
    const ChildResult result = halfframe({"render", "test_room", "--context", "egl"}, options);
    EXPECT_EQ(result.code, 4) << result.err;
    EXPECT_TRUE(contains(result.err, "EGL")) << result.err;
    EXPECT_EQ(halfframe({"plan", "test_room", "--context", "egl"}, options).code, 4);
    EXPECT_EQ(halfframe({"info", "--context", "egl"}, options).code, 4);
}

TEST(Environment, an_output_that_cannot_be_written_is_5_before_anything_is_drawn) {
    const TemporaryFolder folder;
    std::ofstream(folder / "file") << "not a folder";
    const ChildResult result = halfframe(render({"-o", (folder / "file/picture.png").string()}));
    EXPECT_EQ(result.code, 5) << result.err;
    EXPECT_TRUE(contains(result.err, "file/picture.png")) << result.err;
}

TEST_F(Drawing, a_full_disk_is_5_and_leaves_no_partial_file) {
    const TemporaryFolder folder;
    ChildOptions options;
    options.file_size_limit = 20000;  // above the tables, below the page
    options.environment = {{"MESA_SHADER_CACHE_DISABLE", "true"}};
    const ChildResult result = halfframe({"render", "test_room", "--size", "320x240", "--measure", "0", "--cache",
                                          "none", "-o", (folder / "picture.exr").string()},
                                         options);
    EXPECT_EQ(result.code, 5) << result.err;
    EXPECT_TRUE(contains(result.err, "picture.exr")) << result.err;
    EXPECT_TRUE(folder.names().empty()) << folder.names().front();
}

TEST_F(Drawing, a_full_standard_output_is_5) {
    ChildOptions options;
    options.standard_output = "/dev/full";
    EXPECT_EQ(halfframe(render({"--measure", "0"}), options).code, 5);
}

TEST_F(Drawing, json_alone_is_on_standard_output) {
    const TemporaryFolder folder;
    const ChildResult result = halfframe(render({"--measure", "2", "--json", "-o", (folder / "a.png").string()}));
    ASSERT_EQ(result.code, 0) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report.at("plan").at("width"), 64);
    EXPECT_EQ(report.at("measurement").at("passes").size(), report.at("plan").at("passes").size());
    EXPECT_EQ(report.at("measurement").at("frame").at("frames"), 2);
    EXPECT_EQ(report.at("frame_calls").at("object_creations"), 0);
    EXPECT_EQ(report.at("frame_calls").at("program_links"), 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "a.png"));
    for (const auto& arguments :
         std::vector<std::vector<std::string>>{{"plan", "test_room", "--json"}, {"info", "--json"}}) {
        const ChildResult other = halfframe(arguments);
        ASSERT_EQ(other.code, 0) << other.err;
        EXPECT_TRUE(nlohmann::json::accept(other.out)) << other.out;
    }
}

TEST_F(Drawing, two_runs_write_the_same_bytes) {
    const TemporaryFolder folder;
    std::vector<std::string> outs;
    for (const std::string run : {"1", "2"}) {
        const ChildResult result =
            halfframe(render({"--measure", "0", "--ledger", "--trace", (folder / ("trace" + run)).string(), "-o",
                              (folder / ("picture" + run + ".png")).string()}));
        ASSERT_EQ(result.code, 0) << result.err;
        outs.push_back(result.out);
    }
    EXPECT_EQ(outs[0], outs[1]);
    EXPECT_TRUE(contains(outs[0], "objects made in the frame: 0")) << outs[0];
    EXPECT_EQ(file_text(folder / "picture1.png"), file_text(folder / "picture2.png"));
    const std::string trace = file_text(folder / "trace1");
    EXPECT_EQ(trace, file_text(folder / "trace2"));
    const auto calls = nlohmann::json::parse(trace);
    ASSERT_TRUE(calls.is_array());
    EXPECT_GT(calls.size(), 10u);
}

TEST_F(Drawing, linear_light_goes_to_exr) {
    const TemporaryFolder folder;
    const ChildResult result = halfframe(render({"--measure", "0", "-o", (folder / "a.exr").string()}));
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(file_text(folder / "a.exr").substr(0, 4), std::string("\x76\x2f\x31\x01", 4));  // OpenEXR's magic number
}

TEST_F(Drawing, the_census_of_a_sound_scene_finds_nothing) {
    const ChildResult result = halfframe(render({"--measure", "0", "--census", "--json"}));
    ASSERT_EQ(result.code, 0) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    ASSERT_FALSE(report.at("census").empty());
    for (const auto& row : report.at("census")) {
        EXPECT_GT(row.at("values").get<int>(), 0) << row;
        EXPECT_EQ(row.at("nan"), 0) << row;
        EXPECT_EQ(row.at("inf"), 0) << row;
    }
}

TEST_F(Drawing, a_budget_that_cannot_be_met_is_1) {
    const TemporaryFolder folder;
    std::ofstream(folder / "tight.json") << R"({"name": "tight", "frame_ms": 33.3, "draws": 0, "rows": []})";
    const ChildResult result = halfframe(render({"--measure", "0", "--budget", (folder / "tight.json").string()}));
    EXPECT_EQ(result.code, 1) << result.err;
    EXPECT_TRUE(contains(result.err, "draws")) << result.err;
}

TEST_F(Drawing, a_report_is_a_folder_with_one_page_that_stands_alone) {
    const TemporaryFolder folder;
    const ChildResult result = halfframe({"report", "test_room", "furnace", "--size", "64x48", "--measure", "2",
                                          "--cache", "none", "-o", (folder / "deep/out").string()});
    ASSERT_EQ(result.code, 0) << result.err;
    const std::string page = file_text(folder / "deep/out/index.html");
    EXPECT_TRUE(std::filesystem::exists(folder / "deep/out/test_room.png"));
    EXPECT_TRUE(std::filesystem::exists(folder / "deep/out/furnace.png"));
    EXPECT_TRUE(contains(page, "data:image/png;base64,"));
    EXPECT_TRUE(contains(page, "halfframe render furnace --size 64x48"));
    for (const char* outside : {"http://", "https://", "<script", "<link"}) {
        EXPECT_FALSE(contains(page, outside)) << outside;
    }
}

TEST_F(Drawing, an_interrupt_is_130_and_leaves_no_file) {
    // At once, and well inside the measurement (which would take minutes).
    for (const int after_ms : {0, 700}) {
        const TemporaryFolder folder;
        ChildOptions options;
        options.interrupt_after_ms = after_ms;
        const ChildResult result =
            halfframe(render({"--measure", "100000", "-o", (folder / "picture.png").string()}), options);
        EXPECT_EQ(result.code, 130) << "after " << after_ms << " ms: " << result.err;
        EXPECT_TRUE(folder.names().empty()) << folder.names().front();
    }
}

TEST_F(Drawing, info_tells_tiers_formats_and_arithmetic) {
    const ChildResult result = halfframe({"info", "--json"});
    ASSERT_EQ(result.code, 0) << result.err;
    const auto info = nlohmann::json::parse(result.out);
    EXPECT_EQ(info.at("tiers").size(), 3u);
    EXPECT_TRUE(info.at("tiers")[0].at("runs")) << "tier low runs everywhere: " << info.at("tiers")[0];
    EXPECT_TRUE(info.at("arithmetic").at("mediump").at("drawn"));
    EXPECT_TRUE(info.at("caps").at("renders").at("RGBA8"));
    EXPECT_FALSE(info.at("timing").at("sentence").get<std::string>().empty());
}

/// The control of the precision probe: highp is never half where fragments have it.
TEST_F(Drawing, the_precision_probe_tells_half_from_single) {
    const auto info = nlohmann::json::parse(halfframe({"info", "--json"}).out);
    if (!info.at("caps").at("fragment_highp").get<bool>()) {
        GTEST_SKIP() << "no fragment highp here, so there is nothing to tell half from";
    }
    EXPECT_FALSE(info.at("arithmetic").at("highp").at("is_half"));
    if (!info.at("caps").at("renderer").get<std::string>().starts_with("llvmpipe")) {
        GTEST_SKIP() << "mediump may be anything here; only llvmpipe's is known";
    }
    // llvmpipe runs mediump in half where the CPU converts halves (F16C), and says so in the precision it states.
    const bool states_half = info.at("caps").at("fragment_mediump_format").at("fraction_bits").get<int>() <= 10;
    EXPECT_EQ(info.at("arithmetic").at("mediump").at("is_half").get<bool>(), states_half);
}

}  // namespace
}  // namespace halfframe::test
