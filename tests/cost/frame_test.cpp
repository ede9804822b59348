// Whole frames through the command, as a child process: counts, repeatability, tables, errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "content/data_files.h"
#include "perf/cost/effect_table.h"
#include "tests/cost/command.h"
#include "tests/cost/json_schema.h"

namespace halfframe::cost {
namespace {

using nlohmann::json;

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

TEST(Frames, LittleThatIsHiddenIsShadedWithoutAPrepass) {
    // Whatever its state, what is large goes near before far: 1.06 of what a prepass leaves. By state first it is 1.16.
    const auto shaded = [](const std::string& prepass) {
        const json cost = cost_of({"test_room", "--set", "depth_prepass.on=" + prepass}, {}, "640x360");
        return find(cost.at("counts"), "pass", "surface").at("fragments_shaded").get<double>();
    };
    EXPECT_LT(shaded("0"), 1.1 * shaded("1"));
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
    const Answer drawn = halfframe({"render", "test_room", "--size", "64x36", "--measure", "1", "--cost", "--json"});
    EXPECT_EQ(schema_violation(schema_named("report.schema.json"), json::parse(drawn.out)), "") << drawn.err;
    const std::string shader = temporary("halfframe_schema.frag", "void main() { gl_FragColor = vec4(1.0); }\n");
    EXPECT_EQ(schema_violation(schema_named("shader_cost.schema.json"), cost_of({shader})), "");
    broken["devices"] = 3;
    EXPECT_EQ(schema_violation(schema_named("cost.schema.json"), broken), "/devices: not of type array");
}

TEST(Frames, PlansFollowTheirSchema) {
    const json schema = schema_named("plan.schema.json");
    json plan;
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"test_room"}, {"empty"}, {"street", "--tier", "low"}, {"charts", "--arithmetic", "full"}}) {
        std::vector<std::string> arguments{"plan", "--json", "--size", "160x90"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        const Answer answer = halfframe(arguments);
        ASSERT_EQ(answer.code, 0) << answer.err;
        plan = json::parse(answer.out);
        EXPECT_EQ(schema_violation(schema, plan), "") << words[0];
    }
    plan["estimate"][0]["most"] = 3;
    EXPECT_EQ(schema_violation(schema, plan), "/estimate/0: unknown key most");
    plan.erase("broken_rule");
    EXPECT_EQ(schema_violation(schema, plan), ": without broken_rule");
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
    expect_in(why.out, "x / (x + TONE_MAP_A) * TONE_MAP_B");
    expect_in(why.out, "half divide vec3");
    expect_in(why.out, "no mediump hardware was measured");
    const Answer wrong = halfframe({"cost", "test_room", "--size", "64x36", "--why", "tonemap"});
    EXPECT_EQ(wrong.code, 2);
    expect_in(wrong.err, "this frame has no such pass; it has shadow");
}

/// One breach of the trace event format as Perfetto reads it, or nothing. Complete events and names alone are known.
std::string trace_breach(const json& trace) {
    using Track = std::pair<int, int>;
    std::set<Track> named, used;
    std::set<int> processes;
    std::map<Track, double> ends;
    std::map<int, std::vector<std::pair<double, double>>> passes;  // by process: start and end on the first thread
    for (const json& event : trace.at("traceEvents")) {
        const Track track{event.at("pid").get<int>(), event.at("tid").get<int>()};
        const json& words = event.at("name");
        if (!words.is_string() || words.get<std::string>().empty()) return "a name that is no text: " + event.dump();
        if (event.at("ph") == "M") {
            const bool process = words == "process_name";
            if (!process && words != "thread_name") return "an unknown name: " + event.dump();
            if (event.at("args").at("name").get<std::string>().empty()) return "a name of nothing: " + event.dump();
            if (!(process ? processes.insert(track.first).second : named.insert(track).second))
                return "named twice: " + event.dump();
            continue;
        }
        if (event.at("ph") != "X") return "an unknown event: " + event.dump();
        const double start = event.at("ts").get<double>(), length = event.at("dur").get<double>();
        if (!std::isfinite(start) || !std::isfinite(length) || start < 0.0 || length < 0.0)
            return "no time: " + event.dump();
        constexpr double kSlack = 1e-6;  // of microseconds: sums of doubles
        if (start + kSlack < ends[track]) return "begins inside the one before it: " + event.dump();
        ends[track] = start + length;
        used.insert(track);
        auto& slices = passes[track.first];
        if (track.second == 0) slices.emplace_back(start, start + length);
        else if (slices.empty() || start + kSlack < slices.back().first ||
                 start + length > slices.back().second + kSlack)
            return "a unit that is not inside its pass: " + event.dump();
    }
    for (const Track& track : used)
        if (!named.contains(track) || !processes.contains(track.first)) return "a thread or process without a name";
    return used.empty() ? "no events" : "";
}

TEST(Frames, TraceAndCsv) {
    const std::string trace = temporary("halfframe_trace.json", ""), csv = temporary("halfframe_cost.csv", "");
    const Answer result = halfframe({"cost", "test_room", "--size", "64x36", "--trace", trace, "--csv", csv, "--json"});
    ASSERT_EQ(result.code, 0) << result.err;
    std::ifstream stream(trace);
    json written = json::parse(stream);
    EXPECT_EQ(trace_breach(written), "");
    EXPECT_EQ(written.at("displayTimeUnit"), "ms");
    std::map<int, std::string> names;
    std::map<int, double> lengths;  // of the frame, in microseconds
    for (const json& event : written.at("traceEvents")) {
        if (event.at("name") == "process_name") names[event.at("pid")] = event.at("args").at("name").get<std::string>();
        if (event.at("ph") == "X" && event.at("tid") == 0) lengths[event.at("pid")] += event.at("dur").get<double>();
    }
    ASSERT_EQ(names.size(), 4u);
    int modelled = 0;
    const json printed = json::parse(result.out);
    for (const json& device : printed.at("devices")) {
        const auto named = std::ranges::find_if(names, [&](const auto& one) {
            return one.second.starts_with(device.at("profile").get<std::string>() + " (modelled)");
        });
        ASSERT_NE(named, names.end()) << device.at("profile");
        ++modelled;
        EXPECT_NEAR(lengths[named->first], device.at("frame_ms").get<double>() * 1e3, 1e-6);  // sums of doubles
    }
    EXPECT_EQ(modelled, 3);
    EXPECT_TRUE(std::ranges::any_of(names, [](const auto& one) { return one.second.starts_with("measured here"); }));
    // The judge sees what is wrong.
    json broken = written;
    for (json& event : broken["traceEvents"])
        if (event.at("ph") == "X") event["ts"] = 0.0;
    EXPECT_NE(trace_breach(broken).find("begins inside"), std::string::npos);
    broken = written;
    broken["traceEvents"].push_back(written.at("traceEvents")[0]);
    EXPECT_NE(trace_breach(broken).find("named twice"), std::string::npos);
    std::ifstream lines(csv);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) ++count;
    EXPECT_EQ((count - 1) % 3, 0u);
    EXPECT_GT(count, 10u);
}

TEST(Frames, ViewsAreTheSameInOneProcessAndInSeveral) {
    const std::vector<std::string> words{"cost",        "memory_room", "--all-cameras", "--tiers",
                                         "low,console", "--size",      "64x36",         "--json"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        const Answer answer = halfframe(more);
        EXPECT_EQ(answer.code, 0) << answer.err;
        return json::parse(answer.out);
    };
    const json one = with({"--jobs", "1"});
    ASSERT_EQ(one.size(), 4u);
    EXPECT_EQ(with({"--jobs", "3"}), one);
    EXPECT_EQ(with({"--part", "2/2"}), json::array({one[1], one[3]}));
    for (const json& view : one) EXPECT_EQ(schema_violation(schema_named("cost.schema.json"), view), "");
    // A view among others is what it is alone.
    json alone =
        cost_of({"memory_room", "--camera", one[3].at("camera").get<std::string>(), "--tier", "console"}, {}, "64x36");
    EXPECT_EQ(alone, one[3]);
    EXPECT_EQ(halfframe({"cost", "memory_room", "--all-cameras", "--part", "3/2"}).code, 2);
    EXPECT_EQ(halfframe({"cost", "memory_room", "--all-cameras", "--why", "surface"}).code, 2);
    EXPECT_EQ(halfframe({"cost", "memory_room", "--tiers", "low,hgih"}).code, 2);
}

TEST(Frames, ThePageStandsAlone) {
    const std::string page = temporary("halfframe_cost.html", "");
    const Answer result = halfframe({"cost", "test_room", "--size", "64x36", "--html", page});
    ASSERT_EQ(result.code, 0) << result.err;
    std::ifstream stream(page);
    const std::string html{std::istreambuf_iterator<char>(stream), {}};
    for (const char* part :
         {"no mediump hardware was measured", "Limits of the frame", "frame on ps3", "bound by", "Effects, in and out",
          "not called for", "colspan=\"3\" class=\"group\">measured here", "ps3, mark: allowed"})
        expect_in(html, part);
    EXPECT_EQ(html.find("http://"), std::string::npos);
    EXPECT_EQ(html.find("src=\"data:image/png"), std::string::npos);  // nothing was drawn
}

TEST(UserShaders, StrangeOnesAreCountedOrRefusedInWords) {
    const std::string es3 = "#version 300 es\nprecision highp float;\nin vec4 a;\nout vec4 c;\n";
    int number = 0;
    const auto expect_case = [&](const std::string& text, int code, const char* says) {
        const std::string file = temporary("halfframe_odd_" + std::to_string(number++) + ".frag", text);
        const Answer answer = halfframe({"cost", file});
        EXPECT_EQ(answer.code, code) << text << answer.err;
        expect_in(answer.out + answer.err, says);
        EXPECT_EQ(answer.err.find("internal error"), std::string::npos) << text;
    };
    expect_case("precision mediump float;\nfloat f() { return 1.0; }\n", 1, "there is no main()");
    expect_case(es3 + "float f(float x) { return f(x); }\nvoid main() { c = vec4(f(1.0)); }\n", 1, "calls itself");
    expect_case(
        "#version 310 es\nprecision highp float;\nout vec4 c;\nlayout(binding=0) buffer B { float x[]; };\n"
        "void main() {\n c = vec4(x[3]); }\n",
        1, ".frag:6: uses the storage buffer 'B'");
    expect_case(
        "#version 310 es\nprecision highp float;\nout vec4 c;\nlayout(rgba8) uniform readonly mediump image2D "
        "picture;\nvoid main() { c = imageLoad(picture, ivec2(1)); }\n",
        1, ".frag:5: uses the image 'picture'");
    expect_case(
        "#version 310 es\nprecision highp float;\nout vec4 c;\nlayout(binding=0) uniform atomic_uint ticket;\n"
        "void main() { c = vec4(atomicCounterIncrement(ticket)); }\n",
        1, ".frag:5: uses the atomic counter 'ticket'");
    // What is declared and not used is in the way of nothing.
    expect_case(
        "#version 310 es\nprecision highp float;\nout vec4 c;\nlayout(binding=0) buffer B { float x[]; };\n"
        "void main() { c = vec4(1.0); }\n",
        0, "cost of");
    expect_case(es3 + "void main() { float x[1000000000]; x[int(a.x)] = 1.0; c = vec4(x[3]); }\n", 1,
                ".frag:5: 'x' holds 1000000000 numbers");
    expect_case(es3 + "uniform vec4 many[100000000];\nvoid main() { c = many[int(a.x)]; }\n", 1,
                "'many' holds 400000000 numbers");
    // Loops that nothing ends.
    for (const char* loop : {"while (true)", "for (;;)", "for (int i = 0; 2 > 1; ++i)"})
        expect_case(es3 + "void main() { vec4 s = a;\n " + loop + " { s = s * 1.5 + a; }\n c = s; }\n", 0,
                    ".frag:6: nothing ends this loop");
    expect_case(es3 + "vec4 f(vec4 x) {\n do { x *= a; } while (true);\n return x; }\nvoid main() { c = f(a); }\n", 0,
                ".frag:6: nothing ends this loop");
    expect_case("precision mediump float;\nvarying vec4 a;\nvoid main() { gl_FragData[0] = a; }\n", 0, "ES 3.00 twin");
    expect_case(
        "#extension GL_EXT_draw_buffers : require\nprecision mediump float;\nvarying vec4 a;\nvoid main() { "
        "gl_FragData[0] = a; gl_FragData[1] = a * 2.0; }\n",
        0, "ES 3.00 twin");
    expect_case(
        "#extension GL_OES_EGL_image_external : require\nprecision mediump float;\nvarying vec2 a;\n"
        "uniform samplerExternalOES camera;\nvoid main() { gl_FragColor = texture2D(camera, a); }\n",
        0, "samplerExternalOES is counted as sampler2D");
    // One expression of twenty thousand operators, and more parentheses than the compiler has room for.
    std::string sum = es3 + "void main() { c = a";
    for (int i = 0; i < 20000; ++i) sum += " + a";
    expect_case(sum + "; }\n", 0, "20000");
    const std::string nest(40000, '(');
    expect_case(es3 + "void main() { c = " + nest + "a" + std::string(nest.size(), ')') + "; }\n", 1,
                ".frag:5: nested more deeply than a compiler goes");
    // Names that only ES 3.00 has a meaning for.
    expect_case(
        "precision mediump float;\nvarying vec2 v;\nuniform sampler2D texture;\nfloat round(float x) { return "
        "floor(x + 0.5); }\nvoid main() { float smooth = round(v.x); gl_FragColor = smooth * texture2D(texture, "
        "v); }\n",
        0, "ES 3.00 twin");
    // The counter of a loop may choose a sampler in ES 1.00.
    expect_case(
        "precision mediump float;\nvarying vec2 v;\nuniform sampler2D images[3];\nvoid main() { vec4 s = "
        "vec4(0.0); for (int i = 0; i < 3; ++i) s += texture2D(images[i], v); gl_FragColor = s; }\n",
        0, "ES 3.00 twin");
    expect_case("\xef\xbb\xbfvoid main() { gl_FragColor = vec4(1.0); }\n", 0, "cost of");
    // No compiler writes this loop out, and nobody waits for one that tries.
    expect_case(es3 + "void main() { vec4 s = a; for (int i = 0; i < 100000000; ++i) s = s * 1.5 + a; c = s; }\n", 0,
                "at most 100000000 rounds");
    expect_case(es3 + "void main() { vec4 s = a; for (int i = 100000000; i > 0; --i) s = s * 1.5 + a; c = s; }\n", 0,
                "at most 100000000 rounds");
    EXPECT_EQ(halfframe({"cost", temporary("halfframe_odd.vert", "void main() {}\n")}).code, 2);
}

TEST(UserShaders, LoopsThatEndGiveNoWarning) {
    const std::string file = temporary(
        "halfframe_ending.frag",
        "#version 300 es\nprecision highp float;\nin vec4 a;\nout vec4 c;\nvec4 f(vec4 x) { while (true) { x *= a; if "
        "(x.x > 2.0) return x; } }\nvoid never() { while (true) { } }\nvoid main() { vec4 s = f(a);\n"
        "  for (;;) { s *= 2.0; if (s.x > 9.0) break; }\n  while (true) { s *= 2.0; if (s.y > 9.0) discard; }\n"
        "  c = s; }\n");
    const Answer answer = halfframe({"cost", file});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.out.find("nothing ends"), std::string::npos) << answer.out;
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
    // With all that adds something in, no effect adds nothing: unlit surfaces, where that is so, are left out.
    int marginal = 0;
    for (const json& row : table.at("rows")) {
        if (!row.contains("marginal") || row.at("defines") != "all") continue;
        ++marginal;
        EXPECT_GT(row.at("slots").get<double>() + row.at("fetches").get<double>(), 0.0) << row;
    }
    EXPECT_GT(marginal, 10);
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
