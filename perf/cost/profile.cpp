// Profiles: the built-in files in content/profiles, or a file of the user's.
#include "perf/cost/profile.h"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

#include "content/data_lookup.h"
#include "content/nearest.h"
#include "engine/error.h"

namespace halfframe::cost {
namespace {

constexpr const char* kAdvice = "content/schemas/profile.schema.json and perf/cost/README.md describe a profile";
constexpr double kLargest = 1e15;

/// A constant of a model. `least` is what a division or a cache needs.
struct Wanted {
    std::string_view key;
    std::string_view unit;
    double least;
};

constexpr double kPositive = 1e-9;

constexpr auto kRsx = std::to_array<Wanted>({
    {"core_clock", "Hz", 1.0},
    {"fragment_pipes", "pipes", 1.0},
    {"units_per_pipe", "vec4 units", 1.0},
    {"half_normalize_slots", "slots", 0.0},
    {"packing_efficiency", "1", kPositive},
    {"packing_best", "1", kPositive},
    {"packing_worst", "1", kPositive},
    {"full_thread_temporaries", "fp32 vec4", kPositive},
    {"half_temporary", "fp32 vec4", 0.0},
    {"pressure_exponent", "1", 0.0},
    {"vertex_pipes", "pipes", 1.0},
    {"vertex_cache", "vertices", 1.0},
    {"triangle_clocks", "clocks", 0.0},
    {"target_pixels", "pixels/clock", kPositive},
    {"depth_only_factor", "1", 1.0},
    {"wide_target_factor", "1", 1.0},
    {"blend_factor", "1", 1.0},
    {"memory_rate", "bytes/s", 1.0},
    {"memory_efficiency", "1", kPositive},
    {"fetch_trilinear", "clocks", 1.0},
    {"fetch_volume", "clocks", 1.0},
    {"fetch_half_float", "clocks", 1.0},
    {"fetch_float", "clocks", 1.0},
    {"overlap_exponent", "1", 1.0},
    {"target_switch", "s", 0.0},
    {"draw", "s", 0.0},
});

constexpr auto kXenos = std::to_array<Wanted>({
    {"core_clock", "Hz", 1.0},
    {"shader_units", "units", 1.0},
    {"packing_efficiency", "1", kPositive},
    {"packing_best", "1", kPositive},
    {"packing_worst", "1", kPositive},
    {"texels", "texels/clock", kPositive},
    {"texture_efficiency", "1", kPositive},
    {"fetch_64_bit", "clocks", 1.0},
    {"fetch_128_bit", "clocks", 1.0},
    {"fetch_packed", "clocks", 1.0},
    {"fetch_half_float", "clocks", 1.0},
    {"fetch_trilinear", "1", 1.0},
    {"fetch_volume", "1", 1.0},
    {"vertex_cache", "vertices", 1.0},
    {"triangle_clocks", "clocks", 0.0},
    {"target_pixels", "pixels/clock", kPositive},
    {"wide_target_factor", "1", 1.0},
    {"blend_factor", "1", 1.0},
    {"edram", "bytes", 1.0},
    {"edram_tile_width", "samples", 1.0},
    {"edram_tile_height", "samples", 1.0},
    {"resolve_pixels", "pixels/clock", kPositive},
    {"memory_rate", "bytes/s", 1.0},
    {"memory_efficiency", "1", kPositive},
    {"overlap_exponent", "1", 1.0},
    {"target_switch", "s", 0.0},
    {"draw", "s", 0.0},
});

constexpr auto kTiler = std::to_array<Wanted>({
    {"core_clock", "Hz", 1.0},
    {"fragment_cores", "cores", 1.0},
    {"mads", "multiply-adds/clock", kPositive},
    {"packing_efficiency", "1", kPositive},
    {"packing_best", "1", kPositive},
    {"packing_worst", "1", kPositive},
    {"vertex_instructions", "instructions/s", 1.0},
    {"vertex_cache", "vertices", 1.0},
    {"fetch_trilinear", "1", 1.0},
    {"fetch_volume", "1", 1.0},
    {"fetch_wide", "1", 1.0},
    {"memory_rate", "bytes/s", 1.0},
    {"overlap_exponent", "1", 1.0},
    {"target_switch", "s", 0.0},
    {"draw", "s", 0.0},
});

std::span<const Wanted> wanted_by(ModelKind kind) {
    switch (kind) {
        case ModelKind::rsx: return kRsx;
        case ModelKind::xenos: return kXenos;
        case ModelKind::tiler: return kTiler;
    }
    throw Mistake("a model without constants");
}

ModelKind model_at(const content::JsonPlace& place) {
    constexpr std::array kKinds{ModelKind::rsx, ModelKind::xenos, ModelKind::tiler};
    std::vector<std::string> names;
    for (const ModelKind kind : kKinds) {
        if (place.text() == name(kind)) return kind;
        names.emplace_back(name(kind));
    }
    place.fail(fmt::format("unknown model '{}'{}", place.text(), content::did_you_mean(place.text(), names)),
               "the models are rsx, xenos, tiler");
}

ConstantValue constant_at(const content::JsonPlace& place, const Wanted& wanted) {
    place.expect_only({"value", "unit", "tag", "source"});
    ConstantValue constant{.key = std::string(wanted.key),
                           .value = place.at("value").number(wanted.least, kLargest),
                           .unit = place.at("unit").text(),
                           .tag = place.at("tag").text(),
                           .source = place.at("source").text()};
    if (constant.unit != wanted.unit)
        place.at("unit").fail(fmt::format("is '{}' but must be '{}'", constant.unit, wanted.unit));
    constexpr std::string_view kTags = "SDMA";
    if (constant.tag.size() != 1 || kTags.find(constant.tag.front()) == std::string_view::npos)
        place.at("tag").fail(fmt::format("is '{}' but must be S, D, M or A", constant.tag));
    if (constant.source.empty()) place.at("source").fail("is empty: a constant needs a source or a reasoning");
    return constant;
}

void expect_known_constants(const content::JsonPlace& constants, std::span<const Wanted> wanted) {
    constants.expect_object();
    std::vector<std::string_view> keys;
    std::string list;
    for (const Wanted& one : wanted) {
        keys.push_back(one.key);
        list += (list.empty() ? "" : ", ") + std::string(one.key);
    }
    for (const content::JsonMember& member : constants.value().members()) {
        const std::string& key = *member.key;
        if (std::ranges::find(keys, std::string_view(key)) == keys.end())
            constants.fail(fmt::format("unknown key '{}'{}", key, content::did_you_mean(key, keys)),
                           "the constants of this model are " + list);
    }
}

Profile profile_from(const content::JsonPlace& root) {
    root.expect_only({"name", "device", "model", "model_version", "constants"});
    Profile profile;
    profile.name = root.at("name").text();
    profile.device = root.at("device").text();
    profile.model = model_at(root.at("model"));
    if (root.at("model_version").whole() != static_cast<std::uint64_t>(kModelVersion))
        root.at("model_version").fail(fmt::format("must be {}, the version of the model here", kModelVersion));
    const content::JsonPlace constants = root.at("constants");
    expect_known_constants(constants, wanted_by(profile.model));
    for (const Wanted& wanted : wanted_by(profile.model))
        profile.constants.push_back(constant_at(constants.at(wanted.key), wanted));
    if (!(profile.at("packing_worst") <= profile.at("packing_efficiency") &&
          profile.at("packing_efficiency") <= profile.at("packing_best") && profile.at("packing_best") <= 1.0))
        constants.fail("packing_worst <= packing_efficiency <= packing_best <= 1 does not hold");
    return profile;
}

}  // namespace

const char* name(ModelKind kind) {
    switch (kind) {
        case ModelKind::rsx: return "rsx";
        case ModelKind::xenos: return "xenos";
        case ModelKind::tiler: return "tiler";
    }
    return "";
}

double Profile::at(std::string_view key) const {
    const auto found = std::ranges::find(constants, key, &ConstantValue::key);
    expect(found != constants.end(),
           [&] { return fmt::format("the profile {} has no constant {}", name, std::string(key)); });
    return found->value;
}

Profile load_profile(const std::string& name_or_path) {
    const content::DataDocument document = content::open_data("profiles", name_or_path, {}, kAdvice);
    return profile_from({document.json, document.source});
}

std::vector<Profile> built_in_profiles() {
    return {load_profile("ps3"), load_profile("x360"), load_profile("es2_class")};
}

}  // namespace halfframe::cost
