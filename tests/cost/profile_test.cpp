// Profiles: the built-in ones load, and every way to write one wrong is told with its place.
#include <gtest/gtest.h>

#include <filesystem>

#include <nlohmann/json.hpp>

#include "content/data_files.h"
#include "engine/error.h"
#include "perf/cost/profile.h"
#include "tests/harness/temporary_folder.h"

namespace halfframe::cost {
namespace {

nlohmann::json ps3() {
    for (const content::DataFile& file : content::data_files())
        if (std::string(file.path) == "profiles/ps3.json") return nlohmann::json::parse(file.text);
    ADD_FAILURE() << "there is no profiles/ps3.json";
    return {};
}

std::string complaint(const nlohmann::json& profile) {
    const harness::TemporaryFolder folder;
    const std::filesystem::path file = folder.write("profile.json", profile.dump());
    try {
        (void)load_profile(file.string());
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
        EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "no Error was thrown";
    return {};
}

void expect_in(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Profiles, BuiltInOnesLoadWithTagsAndSources) {
    const std::vector<Profile> profiles = built_in_profiles();
    ASSERT_EQ(profiles.size(), 3u);
    EXPECT_EQ(profiles[0].name, "ps3");
    EXPECT_EQ(profiles[1].name, "x360");
    EXPECT_EQ(profiles[2].name, "es2_class");
    EXPECT_EQ(profiles[0].at("core_clock"), 500e6);
    EXPECT_THROW((void)profiles[0].at("edram"), Mistake);
    for (const Profile& profile : profiles) {
        for (const ConstantValue& constant : profile.constants) EXPECT_GT(constant.source.size(), 10u) << constant.key;
    }
}

TEST(Profiles, AMistypedKeyNamesPlaceAndNearest) {
    nlohmann::json profile = ps3();
    profile["constants"]["core_clok"] = profile["constants"]["core_clock"];
    const std::string text = complaint(profile);
    expect_in(text, "/constants: unknown key 'core_clok'");
    expect_in(text, "did you mean 'core_clock'?");
}

TEST(Profiles, WhatIsWrongIsNamedWithItsPlace) {
    nlohmann::json profile = ps3();
    profile["constants"].erase("draw");
    expect_in(complaint(profile), "/constants: 'draw' is missing");
    profile = ps3();
    profile["constants"]["draw"]["tag"] = "guess";
    expect_in(complaint(profile), "/constants/draw/tag: is 'guess' but must be S, D, M or A");
    profile = ps3();
    profile["constants"]["core_clock"]["unit"] = "MHz";
    expect_in(complaint(profile), "/constants/core_clock/unit: is 'MHz' but must be 'Hz'");
    profile = ps3();
    profile["constants"]["core_clock"]["value"] = 0;
    expect_in(complaint(profile), "/constants/core_clock/value: is 0 but must lie from 1");
    profile = ps3();
    profile["constants"]["draw"]["source"] = "";
    expect_in(complaint(profile), "/constants/draw/source: is empty");
    profile = ps3();
    profile["model"] = "xsx";
    expect_in(complaint(profile), "/model: unknown model 'xsx', did you mean 'rsx'?");
    profile = ps3();
    profile["model_version"] = 2;
    expect_in(complaint(profile), "/model_version: must be 1");
    profile = ps3();
    profile["packing"] = 1;
    expect_in(complaint(profile), "unknown key 'packing'");
    profile = ps3();
    profile["constants"]["packing_worst"]["value"] = 0.95;
    expect_in(complaint(profile), "packing_worst <= packing_efficiency");
}

TEST(Profiles, AnUnknownNameListsThoseThereAre) {
    try {
        (void)load_profile("ps4");
        FAIL() << "no Error was thrown";
    } catch (const Error& error) {
        expect_in(error.what(), "did you mean 'ps3'?");
        expect_in(error.what(), "es2_class, ps3, x360");
    }
}

}  // namespace
}  // namespace halfframe::cost
