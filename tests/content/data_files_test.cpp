// Devices and budgets: what the built-in files say, and how strict the parsers are.
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "content/nearest.h"
#include "engine/error.h"
#include "tests/content/temporary_gltf.h"

namespace halfframe::tests {
namespace {

using nlohmann::json;

std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
        return error.what();
    }
    return {};
}

TEST(Devices, NamesAreTheFourKnownOnes) {
    EXPECT_EQ(content::device_profile_names(),
              (std::vector<std::string>{"native", "es2-mali400-class", "es2-minimum", "es3-minimum"}));
    for (const std::string& name : content::device_profile_names()) {
        const gl::DeviceProfile profile = content::device_profile(name);
        EXPECT_EQ(profile.name, name);
        EXPECT_FALSE(profile.source.empty()) << name;
    }
}

TEST(Devices, NativeMasksNothing) {
    gl::Caps caps;
    caps.es_version = 32;
    caps.max_texture_size = 16384;
    caps.extensions = {"GL_EXT_color_buffer_float"};
    const gl::Caps masked = gl::masked(caps, content::device_profile("native"));
    EXPECT_EQ(masked.es_version, 32);
    EXPECT_EQ(masked.max_texture_size, 16384);
    EXPECT_EQ(masked.extensions, caps.extensions);
    EXPECT_EQ(masked.device, "native");
}

TEST(Devices, MinimaAreThoseOfTheSpecifications) {
    const gl::DeviceProfile es2 = content::device_profile("es2-minimum");
    EXPECT_EQ(es2.es_version, 20);
    EXPECT_EQ(es2.fragment_highp, false);
    EXPECT_EQ(es2.extensions, std::vector<std::string>{});
    EXPECT_EQ(es2.max_texture_size, 2048);
    EXPECT_EQ(es2.max_cube_map_size, 512);
    EXPECT_EQ(es2.max_vertex_attributes, 8);
    EXPECT_EQ(es2.max_vertex_uniform_vectors, 128);
    EXPECT_EQ(es2.max_fragment_uniform_vectors, 16);
    EXPECT_EQ(es2.max_varying_vectors, 8);
    EXPECT_EQ(es2.max_fragment_samplers, 8);
    EXPECT_EQ(es2.max_vertex_samplers, 0);
    EXPECT_EQ(es2.max_combined_samplers, 8);
    EXPECT_EQ(es2.max_texture_3d_size, 0);
    const gl::DeviceProfile es3 = content::device_profile("es3-minimum");
    EXPECT_EQ(es3.es_version, 30);
    EXPECT_EQ(es3.max_texture_size, 2048);
    EXPECT_EQ(es3.max_fragment_uniform_vectors, 224);
    EXPECT_EQ(es3.max_varying_vectors, 15);
    EXPECT_EQ(es3.max_combined_samplers, 32);
    EXPECT_EQ(es3.max_draw_buffers, 4);
    EXPECT_EQ(es3.max_texture_3d_size, 256);
}

TEST(Devices, StrictnessNamesTheKeyAndTheNearest) {
    const TemporaryFolder folder;
    const json whole = {{"name", "mine"}, {"source", "a test"}, {"es_version", 20}};
    const auto message = [&](const std::function<void(json&)>& change) {
        json device = whole;
        change(device);
        const std::string path = folder.write("mine.json", device.dump()).string();
        return message_of([&] { (void)content::device_profile(path); });
    };
    EXPECT_EQ(message([](json&) {}), "");
    EXPECT_NE(
        message([](json& d) { d["max_texure_size"] = 64; }).find("'max_texure_size', did you mean 'max_texture_size'?"),
        std::string::npos);
    EXPECT_NE(message([](json& d) { d["colour"] = 1; }).find("unknown key 'colour'; the keys here are name, source"),
              std::string::npos);
    EXPECT_NE(message([](json& d) { d.erase("source"); }).find("'source' is missing"), std::string::npos);
    EXPECT_NE(message([](json& d) { d["es_version"] = 21; }).find("/es_version: must be 20, 30, 31 or 32"),
              std::string::npos);
    EXPECT_NE(message([](json& d) { d["max_samples"] = -1; }).find("/max_samples"), std::string::npos);
    EXPECT_NE(message([](json& d) { d["fragment_highp"] = "no"; }).find("/fragment_highp: must be true or false"),
              std::string::npos);
    EXPECT_NE(message([](json& d) { d["extensions"] = {"OES_depth24"}; }).find("/extensions/0"), std::string::npos);
    EXPECT_NE(message_of([] { (void)content::device_profile("es2-minimun"); }).find("did you mean 'es2-minimum'?"),
              std::string::npos);
    EXPECT_NE(message_of([] { (void)content::device_profile("absent.json"); }).find("no file"), std::string::npos);
    EXPECT_NE(message_of([] { (void)content::device_profile(""); }).find("native, es2-mali400-class"),
              std::string::npos);
}

TEST(Budgets, TheBuiltInOneHoldsTheTalksRows) {
    const Budget budget = content::budget("ps3_30fps");
    EXPECT_EQ(budget.name, "ps3_30fps");
    EXPECT_DOUBLE_EQ(budget.frame_ms, 33.3);
    ASSERT_TRUE(budget.target_mib && budget.texture_mib && budget.draws);
    EXPECT_LE(*budget.target_mib + *budget.texture_mib, 256.0) << "all of a PS3's video memory";
    struct Published {
        const char* name;
        double low_ms;
        double high_ms;  ///< 0: one figure
        const char* platforms;
    };
    for (const Published& each :
         {Published{"capsule_ao", 0.5, 1.5, "PS3"}, Published{"rain", 1.7, 0, "PS3 and X360"},
          Published{"splashes", 0.5, 0, "PS3 and X360"}, Published{"ripples", 0.15, 0, "PS3 and X360"},
          Published{"droplets", 0.4, 0, "PS3 and X360"}, Published{"depth_colour_grading", 0.6, 0, "PS3"},
          Published{"dof_translucency", 1.6, 2.0, "PS3"}}) {
        const BudgetRow* row = budget.find(each.name);
        ASSERT_NE(row, nullptr) << each.name;
        EXPECT_EQ(row->published_ms, each.low_ms) << each.name;
        EXPECT_EQ(row->published_high_ms.value_or(0.0), each.high_ms) << each.name;
        EXPECT_EQ(row->platforms, each.platforms) << each.name;
        EXPECT_NE(row->source.find("Remember Me"), std::string::npos) << each.name;
        EXPECT_FALSE(row->ours_ms) << each.name;
    }
    double total_ms = 0.0;
    for (const BudgetRow& row : budget.rows) {
        total_ms += row.ours_ms.value_or(0.0) + row.published_high_ms.value_or(row.published_ms.value_or(0.0));
        EXPECT_TRUE(row.published_ms.has_value() != row.ours_ms.has_value())
            << row.name << ": published or ours, not both";
    }
    EXPECT_LT(total_ms, budget.frame_ms);
    for (const char* name : {"depth_prepass", "surface", "sky", "tone_map"}) {
        ASSERT_NE(budget.find(name), nullptr) << name;
        EXPECT_TRUE(budget.find(name)->source.starts_with("ours")) << name;
    }
    EXPECT_EQ(budget.find("fog"), nullptr);
}

TEST(Budgets, StrictnessNamesTheKeyAndTheNearest) {
    const TemporaryFolder folder;
    const json whole = {
        {"name", "mine"}, {"frame_ms", 16.6}, {"rows", {{{"name", "sky"}, {"ours_ms", 1}, {"source", "a guess"}}}}};
    const auto message = [&](const std::function<void(json&)>& change) {
        json budget = whole;
        change(budget);
        const std::string path = folder.write("mine.json", budget.dump()).string();
        return message_of([&] { (void)content::budget(path); });
    };
    EXPECT_EQ(message([](json&) {}), "");
    EXPECT_NE(message([](json& b) { b["frame_mz"] = 1; }).find("/: unknown key 'frame_mz', did you mean 'frame_ms'?"),
              std::string::npos);
    EXPECT_NE(message([](json& b) {
                  b["rows"][0]["our_ms"] = 1;
              }).find("/rows/0: unknown key 'our_ms', did you mean 'ours_ms'?"),
              std::string::npos);
    EXPECT_NE(message([](json& b) { b["rows"][0].erase("ours_ms"); }).find("/rows/0: has neither"), std::string::npos);
    EXPECT_NE(message([](json& b) { b["rows"][0]["source"] = ""; }).find("/rows/0/source"), std::string::npos);
    EXPECT_NE(message([](json& b) { b["rows"][0]["published_high_ms"] = 1; }).find("/rows/0/published_high_ms"),
              std::string::npos);
    EXPECT_NE(message([](json& b) { b["rows"].push_back(b["rows"][0]); }).find("/rows/1/name: 'sky'"),
              std::string::npos);
    EXPECT_NE(message([](json& b) { b["frame_ms"] = 0; }).find("/frame_ms: is 0"), std::string::npos);
    EXPECT_NE(message([](json& b) { b["rows"] = 1; }).find("/rows: must be an array"), std::string::npos);
    EXPECT_NE(message_of([] { (void)content::budget("ps3_60fps"); }).find("did you mean 'ps3_30fps'?"),
              std::string::npos);
}

TEST(Nearest, DistanceAndLimit) {
    EXPECT_EQ(content::edit_distance("", "abc"), 3u);
    EXPECT_EQ(content::edit_distance("kitten", "sitting"), 3u);
    const std::vector<std::string> words{"surface", "sky"};
    EXPECT_EQ(content::nearest("surfaze", words), "surface");
    EXPECT_EQ(content::nearest("tone_map", words), std::nullopt);
}

}  // namespace
}  // namespace halfframe::tests
