// The search finds what is wrong and shrinks it, lets alone what is right, and the ledger keeps what it found.
#include "perf/stability/search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>

#include "engine/error.h"
#include "perf/stability/argument_census.h"
#include "perf/stability/exhibit.h"
#include "perf/stability/ledger.h"
#include "perf/stability/stability_report.h"
#include "tests/harness/gl_fixture.h"

namespace halfframe::stability {
namespace {

using shader_ir::Model;

/// Functions of a made-up file.
class Own {
public:
    explicit Own(std::string text)
        : text_(std::move(text)), files_(gl::shader_files().begin(), gl::shader_files().end()) {
        files_.push_back({"own/own.glsl", text_});
    }
    [[nodiscard]] FunctionStability search() const { return stability::search(subject(), kFastEffort, nullptr); }
    [[nodiscard]] Subject subject() const {
        return Subject(functions_of("own/own.glsl", text_).at(0), "TIER_CONSOLE", files_);
    }

private:
    std::string text_;
    std::vector<gl::ShaderFile> files_;
};

const Tally& tally_of(const FunctionStability& found, const std::string& arithmetic) {
    for (const Tally& one : found.tallies) {
        if (one.arithmetic == arithmetic) return one;
    }
    throw Mistake("there is no tally of " + arithmetic);
}

bool says(const FunctionStability& found, const std::string& words) {
    for (const std::string& one : found.violations) {
        if (one.find(words) != std::string::npos) return true;
    }
    return false;
}

TEST(Search, AnOverflowIsFoundAndShrunkToTheSmallestHalf) {
    const FunctionStability found =
        Own("//@domain x: 0..1000\nfloat square(float x) { float y = x * x; return y * 0.001; }\n").search();
    EXPECT_EQ(tally_of(found, "float").not_finite, 0u);
    // 255.875^2 rounds to 65472; from 256 on it is inf: 256 to 1000 are 1024 halves below 512 and 976 above.
    EXPECT_EQ(tally_of(found, "half").not_finite, 2001u);
    EXPECT_TRUE(says(found, "own/own.glsl:2: square, half: 2001 inputs give NaN or inf; try x = 256"))
        << found.violations[0];
    EXPECT_FALSE(found.portable());
    EXPECT_EQ(found.method, "all 25554 halves");
}

TEST(Search, CancellationIsFoundAndItsConditionIsNot) {
    // 1 - x loses nothing that rounding x has not lost; 1 - (1 - x) loses x.
    EXPECT_TRUE(Own("//@domain x: 0..1\nfloat f(float x) { return 1.0 - x; }\n").search().portable());
    const FunctionStability lost =
        Own("//@domain x: 0..1\nfloat f(float x) { float y = 1.0 - x; return 1.0 - y; }\n").search();
    EXPECT_TRUE(says(lost, "f, half: ")) << "1 - (1 - x) passed";
    EXPECT_TRUE(tally_of(lost, "float").holds());
}

TEST(Search, WhatIsFullIsHeldToTheStepsOfFloat) {
    const FunctionStability found =
        Own("//@domain t: 0..4000\nfloat f(FULL float t) { float s = t; return s - floor(s); }\n").search();
    EXPECT_TRUE(says(found, "f, half: "));
    EXPECT_TRUE(tally_of(found, "float").holds());
}

TEST(Search, JumpsAreLetAloneWhereTheyAreDeclared) {
    const std::string body = "float f(float x) { return floor(x * 10.3); }\n";
    const FunctionStability declared = Own("//@domain x: 0..1\n//@jumps floor(x * 10.3)\n" + body).search();
    EXPECT_TRUE(declared.violations.empty()) << declared.violations[0];
    EXPECT_GT(declared.near_jump, 0u);
    EXPECT_LT(declared.near_jump, declared.lanes / 10);
}

TEST(Search, PromisesAreHeld) {
    const std::string body = "float f(float x, float y) { return x * y; }\n";
    const auto with = [&](const char* promise) {
        return Own("//@domain x: 0..1; y: -1..1\n//@promise " + std::string(promise) + "\n" + body).search();
    };
    for (const char* kept :
         {"in -1..1", "rising y", "where x == 0.0: result == 0.0", "error 0.001", "within(f(y, x), result, slack)"}) {
        EXPECT_TRUE(with(kept).violations.empty()) << kept;
    }
    for (const char* broken : {"in 0..1", "falling y", "rising x", "where x == 1.0: result == 0.0", "error 1e-5"}) {
        EXPECT_TRUE(says(with(broken), "'" + std::string(broken) + "' does not hold")) << broken;
    }
}

TEST(Search, EachKindOfPropertyKnowsARightFormulaFromAWrongOne) {
    struct Property {
        const char* kind;
        const char* declared;
        const char* right;
        const char* wrong;
    };
    const Property properties[] = {
        {"both ends of Fresnel",
         "//@domain s, c: 0..1\n//@promise where c == 1.0: result == s; where c == 0.0: within(result, 1.0, slack)\n"
         "float f(float s, float c) ",
         "{ FULL float x = 1.0 - c; return s + (1.0 - s) * (x * x * x * x * x); }",
         "{ FULL float x = 1.0 - c; return s + x * x * x * x * x; }"},
        {"a lobe at n = h",
         "//@domain n, h: unit; power: 2..2048\n//@promise where n == h: result == 1.0\n"
         "float f(vec3 n, vec3 h, float power) ",
         "{ FULL vec3 d = n - h; return exp2(-0.72 * power * dot(d, d)); }",
         "{ return pow(max(dot(n, h), 0.0), power); }"},
        {"no wetness is the identity",
         "//@domain albedo, wetness: 0..1\n//@promise where wetness == 0.0: result == albedo\n"
         "float f(float albedo, float wetness) ",
         "{ return albedo * (1.0 - 0.5 * wetness); }", "{ return albedo * (0.998 - 0.5 * wetness); }"},
        {"an inverse", "//@domain x: 0..1\n//@promise within(back(result), x, 0.01)\nfloat f(float x) ",
         "{ return x / (x + 1.0); }\n//@not_run a helper\nfloat back(float y) { return y / (1.0 - y); }",
         "{ return x / (x + 1.0); }\n//@not_run a helper\nfloat back(float y) { return y / (1.05 - y); }"},
        {"monotone", "//@domain x: 0..1\n//@promise rising x\nfloat f(float x) ", "{ return x * (2.0 - x); }",
         "{ return x * (1.9 - x); }"},
        {"axes permuted", "//@domain v: -1..1\n//@promise within(f(v.yzx), result, slack)\nfloat f(vec3 v) ",
         "{ return max(max(abs(v.x), abs(v.y)), abs(v.z)); }", "{ return max(max(abs(v.x), abs(v.y)), v.z); }"},
        {"another unit of length",
         "//@domain d: 0..64; r: 0.25..4\n//@promise within(f(4.0 * d, 0.25 * r), 0.25 * result, slack)\n"
         "float f(FULL float d, FULL float r) ",
         "{ return r / (1.0 + d * r); }", "{ return r / (1.0 + d); }"},
    };
    int found = 0;
    for (const Property& one : properties) {
        const auto broken = [&](const char* body) {
            return says(Own(one.declared + std::string(body) + "\n").search(), "does not hold");
        };
        EXPECT_FALSE(broken(one.right)) << one.kind;
        const bool is_found = broken(one.wrong);
        EXPECT_TRUE(is_found) << one.kind;
        found += is_found ? 1 : 0;
    }
    std::cout << "wrong formulas found " << found << " / " << std::size(properties) << "\n";
}

TEST(Search, OnlyWhatLetsNanInMustSurviveIt) {
    const FunctionStability found =
        Own("//@domain x: any\n//@promise finite\nfloat f(float x) { return min(x, 8.0); }\n").search();
    EXPECT_TRUE(says(found, "'finite' does not hold"));
}

TEST(Search, AnExemptionIsNoBlankCheque) {
    const std::string body = "float f(float x) { float y = 1.0 - x; return 1.0 - y; }\n";
    const auto with = [&](const char* exemption) {
        return Own("//@domain x: 0..1\n//@exempt half, half_flushed, es_minimum: " + std::string(exemption) + "\n" +
                   body)
            .search();
    };
    const FunctionStability enough = with("within 0.0003; 2^-12 is lost");
    EXPECT_TRUE(enough.violations.empty()) << enough.violations[0];
    EXPECT_FALSE(enough.portable());
    EXPECT_FALSE(with("within 0.0002; too little").violations.empty());
    EXPECT_FALSE(with("at most 2 times; too little").violations.empty());
}

TEST(Search, StepsShowWhereTheArithmeticsPart) {
    const Own own("//@domain x: 0..1000\nfloat f(float x) {\n    float y = x * x;\n    return y * 0.001;\n}\n");
    const std::vector<Step> steps = steps_of(own.subject(), {300.0}, Model::half);
    ASSERT_EQ(steps.size(), 2u);
    EXPECT_EQ(steps[0].place, "own/own.glsl:3");
    EXPECT_EQ(steps[0].text, "float y = x * x;");
    EXPECT_EQ(steps[0].in_double, std::vector<double>{90000.0});
    EXPECT_EQ(steps[0].in_model, std::vector<double>{HUGE_VAL});
}

TEST(Search, AVariantThatLeavesTheFunctionOutIsRefused) {
    const std::string text = "#ifdef ELSEWHERE\n//@domain x: 0..1\nfloat f(float x) { return x; }\n#endif\n";
    std::vector<gl::ShaderFile> files(gl::shader_files().begin(), gl::shader_files().end());
    files.push_back({"own/own.glsl", text});
    EXPECT_THROW(Subject(functions_of("own/own.glsl", text).at(0), "TIER_LOW", files), Error);
}

std::vector<FunctionStability> all_searched(const Effort& effort, const Drawing* drawing) {
    const std::vector<gl::ShaderFile> files = files_with_exhibit();
    std::vector<FunctionStability> all;
    for (const Declaration& function : all_functions()) {
        if (!function.not_run.empty()) continue;
        for (const std::string& variant : function.variants)
            all.push_back(search(Subject(function, variant, files), effort, drawing));
    }
    return all;
}

/// Why functions are not drawn on this context; empty: they are.
std::string no_lanes(const gl::Caps& caps) {
    if (caps.renders[static_cast<std::size_t>(gl::PixelFormat::rgba32f)] && caps.es_version >= 30) return {};
    return fmt::format("lanes are drawn into RGBA32F, which {} does not render", caps.renderer);
}

// One search for the models and the context: what its inputs must give is most of the work, and the same for both.
TEST(ShadersEs, EveryFunctionHoldsInAllModelsAndOnAContextAndTheLedgerKnowsItsWorstInputs) {
    const harness::GroundOrReason made = harness::make_ground({});
    const std::string obstacle = made.ground ? no_lanes(made.ground->caps) : made.reason;
    std::optional<Drawing> drawing;
    if (obstacle.empty()) {
        gl::EntryPoints& gl = made.ground->gl;
        drawing.emplace(Drawing{gl, made.ground->caps, perf::probe_precision(gl, made.ground->caps)});
    }
    const std::vector<FunctionStability> all = all_searched(kFastEffort, drawing ? &*drawing : nullptr);
    std::size_t inputs = 0, lost = 0, drawn = 0;
    for (const FunctionStability& one : all) {
        for (const std::string& violation : one.violations) ADD_FAILURE() << violation;
        for (const Tally& tally : one.tallies) {
            (tally.arithmetic.ends_with("here") ? drawn : inputs) += tally.lanes;
            lost += tally.not_finite;
        }
        if (drawing) {
            EXPECT_EQ(tally_of(one, "mediump here").lanes, tally_of(one, "half").lanes);
            EXPECT_EQ(tally_of(one, "highp here").lanes, tally_of(one, "half").lanes);
        }
    }
    std::cout << "inputs " << inputs << " in models, " << drawn << " on a context, NaN or inf " << lost << "\n";
    EXPECT_GT(inputs, 4'000'000u);
    EXPECT_EQ(lost, 0u);
    const std::string path = HALFFRAME_SOURCE_DIR "/tests/stability/ledger.json";
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    const std::vector<LedgerRow> kept = read_ledger(text.str(), path);
    EXPECT_EQ(kept.size(), all.size() * shader_ir::kModels.size());
    for (const std::string& change : differences(kept, ledger_rows(all)))
        ADD_FAILURE() << change << "; if it is meant: halfframe stability --write-ledger tests/stability/ledger.json";
    if (!drawing) GTEST_SKIP() << "the models were tried, and no context: " << obstacle;
    EXPECT_GT(drawn, 1'600'000u);
}

TEST(Ledger, NamesWhatIsNewGoneOrDifferent) {
    const LedgerRow row{"f", "half", "x = 1", 1.0, 1.001, 0.01, "so"};
    EXPECT_TRUE(differences({row}, {row}).empty());
    EXPECT_EQ(read_ledger(ledger_text({row}), "l").at(0).got, 1.001);
    LedgerRow infinite = row;
    infinite.got = HUGE_VAL;
    EXPECT_EQ(read_ledger(ledger_text({infinite}), "l").at(0).got, HUGE_VAL);
    LedgerRow other = row;
    for (const auto change : {+[](LedgerRow& r) { r.got = 1.01; }, +[](LedgerRow& r) { r.input = "x = 2"; },
                              +[](LedgerRow& r) { r.tolerance = 0.02; }, +[](LedgerRow& r) { r.model = "float"; },
                              +[](LedgerRow& r) { r.expected = 1.1; }, +[](LedgerRow& r) { r.got = std::nan(""); }}) {
        other = row;
        change(other);
        EXPECT_FALSE(differences({row}, {other}).empty());
    }
    EXPECT_EQ(differences({row}, {}).size(), 1u);
    EXPECT_THROW((void)read_ledger("{\"a\": 1}", "l"), Error);
    // A step of half is the C library's; four are not.
    other = row;
    other.got = 1.001 + 0x1p-11;
    EXPECT_TRUE(differences({row}, {other}).empty());
}

TEST(Exhibit, EveryListingIsFoundAndWhatIsBesideItIsNot) {
    std::size_t found = 0, seen = 0;
    const std::vector<ExhibitEntry> entries = exhibit_list();
    for (const ExhibitEntry& entry : entries) {
        const ExhibitResult result = measure(entry, kFastEffort, nullptr);
        ASSERT_EQ(result.costs.size(), 3u) << entry.name;
        for (const FixCost& cost : result.costs) {
            EXPECT_GT(cost.printed_ms, 0.0) << entry.name << " on " << cost.profile;
            EXPECT_GT(cost.mended_ms, 0.0) << entry.name << " on " << cost.profile;
        }
        EXPECT_TRUE(result.found) << entry.name;
        found += result.found ? 1 : 0;
        seen += result.picture_printed.rgba != result.picture_mended.rgba ? 1 : 0;
    }
    std::cout << "planted faults found " << found << " / " << entries.size() << "\n";
    EXPECT_GE(entries.size(), 8u);
    // All but one break in the pictures too, which are drawn in half: RGBM of black needs flushed subnormals for that.
    EXPECT_GE(seen + 1, entries.size());
    // A form that holds is not found, and a fault beside a fault neither.
    ExhibitEntry sound = entries[4];
    sound.printed = sound.mended;
    EXPECT_FALSE(measure(sound, kFastEffort, nullptr).found);
    ExhibitEntry hopeless = entries[4];
    hopeless.mended = hopeless.printed;
    EXPECT_FALSE(measure(hopeless, kFastEffort, nullptr).found);
}

class OnAContext : public harness::GlFixture {
protected:
    void SetUp() override {
        GlFixture::SetUp();
        if (IsSkipped()) return;
        if (const std::string obstacle = no_lanes(caps()); !obstacle.empty()) GTEST_SKIP() << obstacle;
    }
};

TEST_F(OnAContext, ABreakIsSeenThereToo) {
    const Drawing drawing{gl(), caps(), perf::probe_precision(gl(), caps())};
    if (!drawing.probe.mediump.is_half()) GTEST_SKIP() << drawing.probe.sentence;
    const Own own("//@domain x: 0..1000\nfloat far(float x) { return length(vec3(x, 200.0, 10.0)); }\n");
    const FunctionStability found = search(own.subject(), kFastEffort, &drawing);
    EXPECT_GT(tally_of(found, "mediump here").not_finite, 1000u);
    EXPECT_EQ(tally_of(found, "highp here").not_finite, 0u);
}

TEST_F(OnAContext, DomainsHoldWhatTheBuiltInScenesAskFor) {
    const std::vector<SeenArgument> seen = see_arguments(gl(), caps());
    for (const SeenArgument& one : seen)
        EXPECT_GT(one.pixels, 0u) << one.function << "." << one.parameter << ": nothing was recorded";
    for (const std::string& violation : violations_of(seen)) ADD_FAILURE() << violation;
    EXPECT_GE(seen.size(), 20u);
    SeenArgument outside = seen.at(3);
    outside.declared.high = outside.high / 2.0;
    EXPECT_EQ(violations_of({outside}).size(), 1u);
}

}  // namespace
}  // namespace halfframe::stability
