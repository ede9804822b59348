// Whole frames through the command, as a child process: counts, repeatability, tables, errors.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "content/data_files.h"
#include "perf/cost/effect_table.h"
#include "perf/process/child_process.h"
#include "tests/cost/json_schema.h"

namespace halfframe::cost {
namespace {

using nlohmann::json;
using Environment = std::vector<std::pair<std::string, std::optional<std::string>>>;

struct Answer {
    int code = 0;
    std::string out;
    std::string err;
};

Answer halfframe(std::vector<std::string> arguments, const Environment& environment = {}) {
    arguments.insert(arguments.begin(), HALFFRAME_COMMAND);
    process::ChildResult result = process::run_child({.arguments = arguments, .environment = environment});
    return {result.exit_code, std::move(result.output), std::move(result.errors)};
}

json cost_of(std::vector<std::string> arguments, const Environment& environment = {},
             const std::string& size = "160x90") {
    arguments.insert(arguments.begin(), "cost");
    arguments.insert(arguments.end(), {"--json", "--size", size});
    const Answer result = halfframe(arguments, environment);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.code == 0 ? json::parse(result.out) : json();
}

json find(const json& list, const std::string& key, const std::string& value) {
    for (const json& one : list)
        if (one.at(key) == value) return one;
    ADD_FAILURE() << "nothing with " << key << " " << value;
    return {};
}

std::string temporary(const std::string& name, const std::string& text) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / name;
    std::ofstream(file) << text;
    return file.string();
}

void expect_in(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Frames, CountsAreTheSameUnderAnyThreadsAndVectorUnits) {
    const json plain = cost_of({"test_room"});
    ASSERT_FALSE(plain.is_null());
    for (const Environment& environment :
         {Environment{{"LP_NUM_THREADS", "0"}}, Environment{{"LP_NUM_THREADS", "5"}},
          Environment{{"GALLIUM_OVERRIDE_CPU_CAPS", "sse2"}}, Environment{{"GALLIUM_OVERRIDE_CPU_CAPS", "avx"}}}) {
        const json again = cost_of({"test_room"}, environment);
        EXPECT_EQ(again, plain) << environment[0].first << "=" << environment[0].second.value_or("unset");
    }
}

TEST(Frames, EveryTierIsCountedAndFullScreenPassesAreArithmetic) {
    for (const std::string tier : {"low", "console", "reference"}) {
        const json cost = cost_of({"test_room", "--tier", tier});
        ASSERT_FALSE(cost.is_null());
        EXPECT_EQ(cost.at("tier"), tier);
        const json surface = find(cost.at("counts"), "pass", "surface");
        EXPECT_GT(surface.at("fragments_shaded").get<double>(), 0.0) << tier;
        EXPECT_GT(surface.at("draws").get<int>(), 1) << tier;
        // No pixel is without a surface or the sky.
        if (tier == "console") {
            const json tone_map = find(cost.at("counts"), "pass", "tone_map");
            EXPECT_EQ(tone_map.at("fragments_shaded").get<double>(), 160.0 * 90.0);
            EXPECT_EQ(tone_map.at("samples_written").get<double>(), 160.0 * 90.0);
            const double sky = find(cost.at("counts"), "pass", "sky").at("samples_written").get<double>();
            EXPECT_LE(sky, 160.0 * 90.0);
        }
        for (const json& device : cost.at("devices")) EXPECT_GT(device.at("frame_ms").get<double>(), 0.0);
    }
}

TEST(Frames, DiscardIsShadedAndNotWritten) {
    // test_room has a grating with a mask, whose holes are lost in small pictures.
    const json counts = cost_of({"test_room"}, {}, "640x360").at("counts");
    const json surface = find(counts, "pass", "surface");
    EXPECT_GT(surface.at("fragments_shaded").get<double>(), surface.at("samples_written").get<double>());
    const json transparent = find(counts, "pass", "transparent");
    EXPECT_EQ(transparent.at("fragments_shaded"), transparent.at("samples_written"));
}

TEST(Frames, RowsOfEffectsAddUpToTheFrame) {
    const json cost = cost_of({"test_room"});
    for (const json& device : cost.at("devices")) {
        double rows = 0.0, passes = 0.0;
        bool marginal = false;
        for (const json& effect : device.at("effects")) {
            rows += effect.at("ms").get<double>();
            marginal = marginal || effect.at("marginal_ms").get<double>() > 0.0;
        }
        for (const json& pass : device.at("passes")) passes += pass.at("ms").get<double>();
        EXPECT_TRUE(marginal) << device.at("profile");
        // 1e-9: sums of a dozen doubles in two orders.
        EXPECT_NEAR(rows, passes, 1e-9) << device.at("profile");
    }
}

TEST(Frames, HalfIsNotDearerThanFullOnTheRsx) {
    const json half = cost_of({"test_room", "--arithmetic", "half"});
    const json full = cost_of({"test_room", "--arithmetic", "full"});
    const json ps3_half = find(half.at("devices"), "profile", "ps3");
    const json ps3_full = find(full.at("devices"), "profile", "ps3");
    EXPECT_LT(ps3_half.at("frame_ms").get<double>(), ps3_full.at("frame_ms").get<double>());
    EXPECT_DOUBLE_EQ(ps3_half.at("other_arithmetic_frame_ms").get<double>(), ps3_full.at("frame_ms").get<double>());
    EXPECT_EQ(half.at("counts")[0].at("fragments_shaded"), full.at("counts")[0].at("fragments_shaded"));
}

TEST(Frames, OutputFollowsThePublishedSchema) {
    for (const std::string scene : {"test_room", "empty"})
        EXPECT_EQ(schema_violation(schema_named("cost.schema.json"), cost_of({scene})), "") << scene;
    for (const content::DataFile& file : content::data_files()) {
        if (!std::string(file.path).starts_with("profiles/")) continue;
        EXPECT_EQ(schema_violation(schema_named("profile.schema.json"), json::parse(file.text)), "") << file.path;
    }
    json broken = cost_of({"empty"});
    broken["devices"][0]["frame_mss"] = 1;
    EXPECT_EQ(schema_violation(schema_named("cost.schema.json"), broken), "/devices/0: unknown key frame_mss");
    broken["devices"] = 3;
    EXPECT_EQ(schema_violation(schema_named("cost.schema.json"), broken), "/devices: not of type array");
}

TEST(Frames, AProfileOfTheUsersStandsAlone) {
    json profile;
    for (const content::DataFile& file : content::data_files())
        if (std::string(file.path) == "profiles/ps3.json") profile = json::parse(file.text);
    profile["name"] = "half_a_ps3";
    profile["constants"]["fragment_pipes"]["value"] = 12;
    const std::string file = temporary("halfframe_half_ps3.json", profile.dump());
    const json cost = cost_of({"test_room", "--profile", file, "--profile", "ps3"}).at("devices");
    ASSERT_EQ(cost.size(), 2u);
    EXPECT_EQ(cost[0].at("profile"), "half_a_ps3");
    const auto shader_ms = [](const json& device) {
        return find(device.at("passes"), "pass", "surface").at("units_ms").at("shader").get<double>();
    };
    EXPECT_DOUBLE_EQ(shader_ms(cost[0]), 2.0 * shader_ms(cost[1]));
}

TEST(Frames, WhyListsInstructionsUnderTheirLines) {
    const Answer why = halfframe({"cost", "test_room", "--size", "64x36", "--why", "tone_map"});
    EXPECT_EQ(why.code, 0) << why.err;
    expect_in(why.out, "tone_map/tone_map.glsl:11");
    expect_in(why.out, "TONE_MAP_B * x / (x + TONE_MAP_A)");
    expect_in(why.out, "half divide vec3");
    expect_in(why.out, "no mediump hardware was measured");
    const Answer wrong = halfframe({"cost", "test_room", "--size", "64x36", "--why", "tonemap"});
    EXPECT_EQ(wrong.code, 2);
    expect_in(wrong.err, "this frame has no such pass; it has shadow");
}

TEST(Frames, TraceAndCsv) {
    const std::string trace = temporary("halfframe_trace.json", ""), csv = temporary("halfframe_cost.csv", "");
    const Answer result = halfframe({"cost", "test_room", "--size", "64x36", "--trace", trace, "--csv", csv});
    ASSERT_EQ(result.code, 0) << result.err;
    std::ifstream stream(trace);
    const json events = json::parse(stream).at("traceEvents");
    std::set<int> processes;
    std::set<std::string> names;
    for (const json& event : events) {
        processes.insert(event.at("pid").get<int>());
        if (event.at("name") == "process_name") names.insert(event.at("args").at("name").get<std::string>());
        EXPECT_TRUE(event.at("ph") != "X" || event.at("dur").get<double>() >= 0.0) << event;
    }
    EXPECT_EQ(processes.size(), 4u);
    EXPECT_EQ(names.size(), 4u);
    std::ifstream lines(csv);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) ++count;
    EXPECT_EQ((count - 1) % 3, 0u);
    EXPECT_GT(count, 10u);
}

TEST(UserShaders, BothLanguagesAreCountedInThreePrecisions) {
    const std::string old_text =
        "precision mediump float;\nvarying vec2 uv;\nuniform sampler2D image;\nvoid main() {\n"
        "  vec3 n = normalize(texture2D(image, uv).xyz);\n  gl_FragColor = vec4(n, 1.0);\n}\n";
    const std::string new_text =
        "#version 300 es\nprecision mediump float;\nin vec2 uv;\nuniform sampler2D image;\nout vec4 color;\n"
        "void main() {\n  vec3 n = normalize(texture(image, uv).xyz);\n  color = vec4(n, 1.0);\n}\n";
    const json first = cost_of({temporary("halfframe_old.frag", old_text)});
    const json second = cost_of({temporary("halfframe_new.frag", new_text)});
    ASSERT_EQ(first.at("variants").size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(first.at("variants")[i].at("weighted"), second.at("variants")[i].at("weighted")) << i;
    EXPECT_EQ(first.at("variants")[1].at("weighted").at("half_normalizes"), 1.0);
    EXPECT_EQ(first.at("variants")[2].at("weighted").at("half_normalizes"), 0.0);
    EXPECT_EQ(first.at("variants")[0].at("notices")[0], "ES 1.00, counted as its ES 3.00 twin");
}

TEST(UserShaders, ErrorsNameFileAndLine) {
    const std::string file = temporary("halfframe_bad.frag",
                                       "precision mediump float;\nvoid main() {\n  gl_FragColor = "
                                       "vec4(nothing);\n}\n");
    const Answer result = halfframe({"cost", file});
    EXPECT_EQ(result.code, 1);
    expect_in(result.err, "halfframe_bad.frag:3: 'nothing' : undeclared identifier");
    const Answer version = halfframe({"cost", temporary("halfframe_core.frag", "#version 330 core\n")});
    EXPECT_EQ(version.code, 3);
    expect_in(version.err, "write 100, 300 es or 310 es");
    const std::string good = temporary("halfframe_good.frag",
                                       "precision mediump float;\nuniform sampler2D image;\n"
                                       "void main() { gl_FragColor = texture2D(image, vec2(0.5)); }\n");
    const Answer sampler = halfframe({"cost", good, "--texture", "imag=rgba8"});
    EXPECT_EQ(sampler.code, 2);
    expect_in(sampler.err, "did you mean 'image'?");
    EXPECT_EQ(halfframe({"cost", good, "--texture", "image=rgba9"}).code, 2);
    EXPECT_EQ(halfframe({"cost", good, "--profile", "ps4"}).code, 3);
    EXPECT_EQ(halfframe({"cost"}).code, 2);
}

TEST(Tables, CostsOfEffectsAreThoseOfTheShaders) {
    std::string kept;
    for (const content::DataFile& file : content::data_files())
        if (std::string(file.path) == "costs/effects.json") kept = file.text;
    // Not EXPECT_EQ: two long texts help nobody.
    EXPECT_TRUE(kept == effect_table_text())
        << "content/costs/effects.json is stale: shaders or the compiler have changed. Refresh it with\n"
           "  build/release/halfframe cost --refresh-tables content/costs/effects.json";
    const json table = json::parse(kept);
    EXPECT_EQ(table.at("model_version"), 1);
    EXPECT_GT(table.at("rows").size(), 20u);
}

/// Passes times the slowdown by temporaries: what the RSX's shader time is proportional to.
double rsx_cost(const json& row) {
    const double temporaries =
        row.at("full_temporaries").get<double>() + 0.5 * row.at("half_temporaries").get<double>();
    return row.at("rsx_passes").get<double>() * std::max(1.0, std::sqrt(temporaries / 4.0));
}

TEST(Tables, HalfIsDearerThanFullInNoShaderOnTheRsx) {
    const json rows = json::parse(effect_table_text()).at("rows");
    std::map<std::string, double> half;
    int compared = 0;
    for (const json& row : rows) {
        const std::string key = row.at("effect").get<std::string>() + row.at("tier").get<std::string>() +
                                row.at("fragment").get<std::string>() + row.at("defines").get<std::string>();
        if (row.at("arithmetic") == "half") {
            half[key] = rsx_cost(row);
        } else {
            ++compared;
            EXPECT_LE(half.at(key), rsx_cost(row) + 1e-9) << key;  // 1e-9: both are quotients of doubles
        }
    }
    EXPECT_GT(compared, 20);
}

}  // namespace
}  // namespace halfframe::cost
